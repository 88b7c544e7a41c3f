"""Problems from a CSV file, one in each row, and the same rows with their answers."""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from pontryagin.arrays import Array
from pontryagin.io import formula


class Rows(NamedTuple):
    """The content of a CSV file.

    Attributes
    ----------
    header : list of str
        Names of all columns.
    rows : list of list of str
        The rows as they were read, without the empty ones.
    lines : list of int
        Number of each row's line in the file, counted from 1.
    columns : dict of str to (n,) array
        The numbers in the columns that the reader asked for.
    """

    header: list[str]
    rows: list[list[str]]
    lines: list[int]
    columns: dict[str, Array]

    def stack(self, names: Sequence[str]) -> Array:
        """Columns side by side, (n, len(names))."""
        return np.stack([self.columns[name] for name in names], axis=-1)


def read(path: Path, required: Sequence[str], possible: Sequence[str] = (), holds: str = "problem") -> Rows:
    """Read numbers from a CSV file with a header line.

    Parameters
    ----------
    path : Path
        The file. Numbers may be written like ``pi/2``.
    required, possible : sequence of str
        Columns that must be there, and columns that are read where they are there. Other columns are kept
        as text.
    holds : str
        What a row holds, for the message about a file without rows.

    Raises
    ------
    ValueError
        With the number of the line, if a column is missing or an entry is not a number.
    OSError
        If the file cannot be read.
    """
    with path.open(newline="", encoding="utf-8-sig") as file:
        reader = csv.reader(file)
        header = [name.strip() for name in next(reader, [])]
        missing = [name for name in required if name not in header]
        if missing:
            raise ValueError(f"line 1: column {missing[0]} is missing, needs {', '.join(required)}")
        wanted = [*required, *(name for name in possible if name in header)]
        filled = [(row, reader.line_num) for row in reader if row]
    if not filled:
        raise ValueError(f"line 2: the file holds no {holds}")
    numbers = np.array([_numbers(row, header, wanted, line) for row, line in filled])
    rows, lines = zip(*filled, strict=True)
    return Rows(header, list(rows), list(lines), dict(zip(wanted, numbers.T, strict=True)))


def _numbers(row: list[str], header: list[str], wanted: Sequence[str], line: int) -> list[float]:
    if len(row) != len(header):
        raise ValueError(f"line {line}: has {len(row)} entries, but the header has {len(header)}")
    values = []
    for name in wanted:
        text = row[header.index(name)]
        try:
            values.append(formula.number(text))
        except ValueError:
            raise ValueError(f"line {line}: {name} takes a number, got {text!r}") from None
    return values


def to_csv(read: Rows, answers: Mapping[str, Any]) -> str:
    """The rows as they were read, each followed by its answers.

    Parameters
    ----------
    read : Rows
        What `read` returned.
    answers : mapping of str to (n,) or (n, k) arrays
        An (n, k) array ``name`` becomes the columns ``name_1`` to ``name_k``. Truth values are written as
        yes and no; nan leaves the entry empty.
    """
    columns: dict[str, list[Any]] = {}
    for name, values in answers.items():
        array = np.asarray(values)
        parts = {name: array} if array.ndim == 1 else {f"{name}_{i + 1}": p for i, p in enumerate(array.T)}
        columns |= {part: column.tolist() for part, column in parts.items()}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*read.header, *columns])
    for row, found in zip(read.rows, zip(*columns.values(), strict=True), strict=True):
        writer.writerow([*row, *map(_cell, found)])
    return text.getvalue()


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if isinstance(value, float) and math.isnan(value) else str(value)
