"""Problems from a CSV file, one in each row, and the same rows with their answers."""

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
import orjson

from pontryagin.arrays import Array
from pontryagin.io import formula

DECIMAL = b"0123456789+-.eE,"
"""The characters of decimal numbers in a list."""
BLOCK = 2048
"""Number of rows that are held at a time: the solvers are as fast as on larger stacks."""


class Rows(NamedTuple):
    """The content of a CSV file, or of a part of it.

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
    """Read numbers from a CSV file with a header line; `blocks` reads it in parts."""
    return next(blocks(path, required, possible, holds, whole=True))


def blocks(
    path: Path,
    required: Sequence[str],
    possible: Sequence[str] = (),
    holds: str = "problem",
    whole: bool = False,
) -> Iterator[Rows]:
    """Read numbers from a CSV file with a header line, `BLOCK` rows at a time.

    Parameters
    ----------
    path : Path
        The file. Numbers may be written like ``pi/2``.
    required, possible : sequence of str
        Columns that must be there, and columns that are read where they are there. Other columns are kept
        as text.
    holds : str
        What a row holds, for the message about a file without rows.
    whole : bool
        Whether all rows are one block.

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
        filled = ((row, reader.line_num) for row in reader if row)
        empty = True
        while block := list(islice(filled, None if whole else BLOCK)):
            rows, lines = map(list, zip(*block, strict=True))
            del block
            yield Rows(header, rows, lines, _columns(rows, lines, header, wanted))
            empty = False
    if empty:
        raise ValueError(f"line 2: the file holds no {holds}")


def _columns(
    rows: list[list[str]], lines: list[int], header: list[str], wanted: Sequence[str]
) -> dict[str, Array]:
    """The numbers in the wanted columns, converted column by column; row by row only to name a fault."""
    if set(map(len, rows)) == {len(header)}:
        texts = list(zip(*rows, strict=True))
        try:
            return {name: _numbers(texts[header.index(name)]) for name in wanted}
        except ValueError:
            pass
    for row, line in zip(rows, lines, strict=True):
        _check(row, header, wanted, line)
    raise AssertionError("a row that is at fault was not found")


def _numbers(texts: Sequence[str]) -> Array:
    """The finite numbers that texts stand for; only where one is no plain number are formulas parsed."""
    try:
        numbers = _decimals(texts)
        if numbers is None:
            numbers = np.fromiter(map(float, texts), float, len(texts))
    except ValueError:
        return np.fromiter(map(formula.number, texts), float, len(texts))
    if not np.isfinite(numbers).all():
        raise ValueError("a number is not finite")
    return numbers


def _decimals(texts: Sequence[str]) -> Array | None:
    """Texts read as the numbers of JSON, which is done faster; None if any is written otherwise."""
    joined = ",".join(texts).encode()
    if joined.translate(None, DECIMAL) or b",-0," in b",%b," % joined:  # JSON reads -0 as an integer.
        return None
    try:
        numbers = np.array(orjson.loads(b"[%b]" % joined), float)
    except orjson.JSONDecodeError:
        return None
    return numbers if len(numbers) == len(texts) else None


def _check(row: list[str], header: list[str], wanted: Sequence[str], line: int) -> None:
    """Raise `ValueError` with the number of the line if a row has another length or an entry is no number."""
    if len(row) != len(header):
        raise ValueError(f"line {line}: has {len(row)} entries, but the header has {len(header)}")
    for name in wanted:
        text = row[header.index(name)]
        try:
            formula.number(text)
        except ValueError:
            raise ValueError(f"line {line}: {name} takes a number, got {text!r}") from None


def to_csv(read: Rows, answers: Mapping[str, Any]) -> str:
    """The rows as they were read, each followed by its answers, below a header.

    Parameters
    ----------
    read : Rows
        What `read` returned.
    answers : mapping of str to (n,) or (n, k) arrays
        An (n, k) array ``name`` becomes the columns ``name_1`` to ``name_k``. Truth values are written as
        yes and no; nan leaves the entry empty.
    """
    columns, lines = answered(read, answers)
    return "".join(f"{line}\n" for line in [header_line([*read.header, *columns]), *lines])


def header_line(names: Sequence[str]) -> str:
    """Names of columns as a line of CSV, without its end."""
    return _as_written([names])[0]


def answered(read: Rows, answers: Mapping[str, Any]) -> tuple[list[str], list[str]]:
    """Names of the answers' columns, and each row with its answers as CSV without the line's end."""
    columns: dict[str, Sequence[str]] = {}
    known: dict[bytes, list[str]] = {}
    for name, values in answers.items():
        array = np.asarray(values)
        parts = {name: array} if array.ndim == 1 else {f"{name}_{i + 1}": p for i, p in enumerate(array.T)}
        for part, column in parts.items():
            # A norm is often the primal value too, to the last digit, and to write numbers takes longest.
            key = column.dtype.str.encode() + column.tobytes()
            columns[part] = known[key] = known.get(key) or _texts(column)
    return list(columns), list(map(",".join, zip(_as_written(read.rows), *columns.values(), strict=True)))


def _as_written(rows: Sequence[Sequence[str]]) -> list[str]:
    """Each row of texts as CSV without the line's end; joined by commas where no text needs quotes."""
    joined = list(map(",".join, rows))
    text = "\n".join(joined)
    commas, ends = sum(map(len, rows)) - len(rows), len(rows) - 1
    plain = '"' not in text and "\r" not in text and (text.count(","), text.count("\n")) == (commas, ends)
    if plain and all(joined):
        return joined
    lines: list[str] = []
    csv.writer(SimpleNamespace(write=lines.append), lineterminator="\n").writerows(rows)
    return [line[:-1] for line in lines]


def _texts(column: Any) -> list[str]:
    """The cells of one column of answers."""
    if column.dtype != float:
        return list(map(_cell, column.tolist()))
    written = orjson.dumps(np.ascontiguousarray(column), option=orjson.OPT_SERIALIZE_NUMPY)
    texts = written[1:-1].decode().split(",")
    for i in np.flatnonzero(~np.isfinite(column)).tolist():
        texts[i] = _cell(float(column[i]))
    return texts


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if isinstance(value, float) and math.isnan(value) else str(value)
