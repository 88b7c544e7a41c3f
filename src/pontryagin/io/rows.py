"""Problems from a CSV file, one in each row, and the same rows with their answers."""

import csv
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
import orjson

from pontryagin.arrays import Array
from pontryagin.io import csv_lines, files, formula

DECIMAL = b"0123456789+-.eE,"
"""The characters of decimal numbers in a list."""
BLOCK = 2048
"""Number of rows that are held at a time: the solvers are as fast as on larger stacks."""
SEPARATORS = ";\t|"
"""Characters other than the comma by which programs separate columns."""
WORDS = ("no", "yes")
"""How truth values are written."""
ERROR = "error"
"""The column that says why a row has no answer."""


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
        The numbers in the columns that the reader asked for; nan in rows at fault.
    faults : dict of int to str
        What is wrong with the rows at fault, by their index.
    """

    header: list[str]
    rows: list[list[str]]
    lines: list[int]
    columns: dict[str, Array]
    faults: Mapping[int, str]

    def stack(self, names: Sequence[str]) -> Array:
        """Columns side by side, (n, len(names))."""
        return np.stack([self.columns[name] for name in names], axis=-1)

    def part(self, places: Sequence[int]) -> "Rows":
        """The rows with these indices, which grow."""
        if len(places) == len(self.rows):
            return self
        faults = {k: self.faults[i] for k, i in enumerate(places) if i in self.faults}
        columns = {name: column[list(places)] for name, column in self.columns.items()}
        rows, lines = [self.rows[i] for i in places], [self.lines[i] for i in places]
        return Rows(self.header, rows, lines, columns, faults)


def read(path: Path, required: Sequence[str], possible: Sequence[str] = (), holds: str = "problem") -> Rows:
    """Read numbers from a CSV file with a header line, none of whose rows is at fault; see `blocks`."""
    (whole,) = blocks(path, required, possible, holds, size=None)
    for i, fault in whole.faults.items():
        raise ValueError(f"line {whole.lines[i]}: {fault}")
    return whole


def blocks(
    path: Path,
    required: Sequence[str],
    possible: Sequence[str] = (),
    holds: str = "problem",
    size: int | None = 0,
) -> Iterator[Rows]:
    """Read numbers from a CSV file with a header line, some rows at a time.

    Parameters
    ----------
    path : Path
        The file, or ``-`` for standard input. Numbers may be written like ``pi/2``.
    required, possible : sequence of str
        Columns that must be there, and columns that are read where they are there. Other columns are kept
        as text.
    holds : str
        What a row holds, for the message about a file without rows.
    size : int, optional
        Number of rows in a block; 0 stands for `BLOCK`, and None for all rows.

    Raises
    ------
    ValueError
        With the number of the line, if a column is missing or is there twice, or there is no row.
    OSError
        If the file cannot be read.
    """
    with files.reading(path) as file:
        names, number = csv_lines.header_of(file)
        header = [name.strip() for name in names]
        _check_header(header, required)
        wanted = [*required, *(name for name in possible if name in header)]
        empty = True
        for rows, lines in csv_lines.rows_of(file, number, BLOCK if size == 0 else size):
            yield Rows(header, rows, lines, *_columns(rows, header, wanted))
            empty = False
    if empty:
        raise ValueError(f"line 2: the file holds no {holds}")


def _check_header(header: list[str], required: Sequence[str]) -> None:
    twice = next((name for i, name in enumerate(header) if name in header[:i]), None)
    if twice is not None:
        raise ValueError(f"line 1: column {twice!r} is there twice")
    missing = [name for name in required if name not in header]
    if not missing:
        return
    for separator in SEPARATORS:
        if missing[0] in [name.strip() for part in header for name in part.split(separator)]:
            raise ValueError(f"line 1: columns are separated by {separator!r}, but must be by ','")
    raise ValueError(f"line 1: column {missing[0]} is missing, needs {', '.join(required)}")


def _columns(
    rows: list[list[str]], header: list[str], wanted: Sequence[str]
) -> tuple[dict[str, Array], dict[int, str]]:
    """The numbers in the wanted columns, nan in rows at fault, and the faults."""
    width, faults = len(header), {}
    if set(map(len, rows)) != {width}:
        has = {i: len(row) for i, row in enumerate(rows) if len(row) != width}
        faults = {i: f"has {count} entries, but the header has {width}" for i, count in has.items()}
        rows = [["0"] * width if i in faults else row for i, row in enumerate(rows)]
    texts = list(zip(*rows, strict=True))
    columns = {}
    for name in wanted:
        column = texts[header.index(name)]
        try:
            columns[name] = _numbers(column)
        except ValueError:
            columns[name], wrong = _one_by_one(column)
            said = {i: f"{name} takes a number, got {column[i]!r}" for i in wrong}
            faults = said | faults
    for numbers in columns.values():
        numbers[list(faults)] = math.nan
    return columns, dict(sorted(faults.items()))


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


def _one_by_one(texts: Sequence[str]) -> tuple[Array, list[int]]:
    """The numbers that texts stand for, and the indices of the texts that are no numbers."""
    numbers, wrong = np.full(len(texts), math.nan), []
    for i, text in enumerate(texts):
        try:
            numbers[i] = formula.number(text)
        except ValueError:
            wrong.append(i)
    return numbers, wrong


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
    """Names of the answers' columns, and each row with its answers as CSV without the line's end.

    Raises
    ------
    ValueError
        If an answer has the name of a column that was read.
    """
    columns: dict[str, Sequence[str]] = {}
    known: dict[bytes, list[str]] = {}
    for name, values in answers.items():
        array = np.asarray(values)
        parts = {name: array} if array.ndim == 1 else {f"{name}_{i + 1}": p for i, p in enumerate(array.T)}
        for part, column in parts.items():
            # A norm is often the primal value too, to the last digit, and to write numbers takes longest.
            key = column.dtype.str.encode() + column.tobytes()
            columns[part] = known[key] = known.get(key) or _texts(column)
    require_new(read.header, columns)
    return list(columns), list(map(",".join, zip(_as_written(read.rows), *columns.values(), strict=True)))


def require_new(header: Sequence[str], names: Iterable[str]) -> None:
    """Raise ValueError if a name of an answer is the name of a column that was read."""
    both = [name for name in names if name in header]
    if both:
        raise ValueError(f"line 1: column {both[0]!r} has the name of an answer: rename it or leave it out")


def unanswered(read: Rows) -> list[str]:
    """Rows as CSV without the line's end, with as many entries as the header has."""
    width = len(read.header)
    return _as_written([[*row, *[""] * width][:width] for row in read.rows])


def as_json(read: Rows, answers: Mapping[str, Any], errors: Mapping[int, str]) -> list[str]:
    """Each row with its answers as a JSON object; errors, by the index of their row, are its last entry."""
    require_new(read.header, answers)
    columns = {name: np.asarray(values).tolist() for name, values in (read.columns | dict(answers)).items()}
    lines = []
    for i, row in enumerate(read.rows):
        texts = {name or "": text for name, text in zip_longest(read.header, row) if name is not None}
        numbers = {name: column[i] for name, column in columns.items()}
        error = {ERROR: errors[i]} if i in errors else {}
        lines.append(orjson.dumps(texts | numbers | error).decode())
    return lines


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
    if column.dtype == bool:
        return list(map(WORDS.__getitem__, column.tolist()))
    if column.dtype.kind in "iU":
        return list(map(str, column.tolist()))
    if column.dtype != float:
        return list(map(_cell, column.tolist()))
    written = orjson.dumps(np.ascontiguousarray(column), option=orjson.OPT_SERIALIZE_NUMPY)
    texts = written[1:-1].decode().split(",")
    lost = np.flatnonzero(~np.isfinite(column))
    for i, value in zip(lost.tolist(), column[lost].tolist(), strict=True):
        texts[i] = "" if value != value else str(value)
    return texts


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return WORDS[value]
    return "" if isinstance(value, float) and math.isnan(value) else str(value)
