"""Tables given by their columns, written as CSV for files and as Markdown for notebooks and the report."""

import csv
import io
import math
import re
from collections.abc import Mapping, Sequence
from numbers import Integral, Real
from typing import Any, TypeAlias

import numpy as np

from pontryagin.errors import ArgumentValueError

Columns: TypeAlias = Mapping[str, Sequence[Any] | np.ndarray]
"""Heading and entries of each column; all columns have one length."""


def csv_table(columns: Columns) -> str:
    """The table as CSV; numbers have twelve digits.

    Parameters
    ----------
    columns : mapping of str to sequences of one length
        Heading and entries of each column.

    Raises
    ------
    ValueError
        When there is no column or the columns differ in length.

    Examples
    --------
    >>> print(csv_table({"q": [1, 2], "norm": [16.0, 1 / 3]}), end="")
    q,norm
    1,16
    2,0.333333333333
    """
    drawn = io.StringIO()
    writer = csv.writer(drawn, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_csv_cell(value) for value in row] for row in rows_of(columns))
    return drawn.getvalue()


def markdown_table(columns: Columns) -> str:
    r"""The table as Markdown; numbers have six digits, numeric columns are aligned to the right.

    Headings and texts are Markdown themselves, with formulas ``$...$``.

    Parameters
    ----------
    columns : mapping of str to sequences of one length
        Heading and entries of each column.

    Raises
    ------
    ValueError
        When there is no column or the columns differ in length.

    Examples
    --------
    >>> print(markdown_table({"$q$": [2, 3], "gap": [0.0, 1e-16]}))
    | $q$ | gap |
    | --: | --: |
    | 2 | 0 |
    | 3 | $1\times 10^{-16}$ |
    """
    rows = rows_of(columns)
    right = [bool(rows) and all(_is_number(row[i]) for row in rows) for i in range(len(columns))]
    lines = [
        [_markdown_cell(heading) for heading in columns],
        ["--:" if set_right else ":--" for set_right in right],
    ]
    lines += [[_markdown_cell(value) for value in row] for row in rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def rows_of(columns: Columns) -> list[tuple[Any, ...]]:
    """The rows of a table; raises `ValueError` if there is no column or the columns differ in length."""
    if not columns:
        raise ArgumentValueError("columns: got an empty mapping; takes at least one column", "columns")
    lengths = {heading: len(entries) for heading, entries in columns.items()}
    if len(set(lengths.values())) > 1:
        raise ArgumentValueError(
            f"columns: got the different lengths {lengths}; takes columns of one length", "columns"
        )
    return list(zip(*columns.values(), strict=True))


def _csv_cell(value: Any) -> str:
    if _is_number(value) and not isinstance(value, Integral):
        return f"{float(value) + 0.0:.12g}"
    return "" if value is None else str(value)


def _markdown_cell(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, Integral):
        return str(int(value)).replace("-", "−")
    if isinstance(value, Real):
        return _number(float(value))
    text = "" if value is None else " ".join(str(value).split())
    bar = r"\vert{}" if "$" in text else r"\|"
    return re.sub(r"(?<!\\)((?:\\\\)*)\|", lambda found: found[1] + bar, text)


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)


def _number(value: float) -> str:
    if not math.isfinite(value):
        return "—" if math.isnan(value) else "∞" if value > 0 else "−∞"
    mantissa, _, exponent = f"{value + 0.0:.6g}".partition("e")
    return rf"${mantissa}\times 10^{{{int(exponent)}}}$" if exponent else mantissa.replace("-", "−")
