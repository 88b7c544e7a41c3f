"""The rows of a CSV file as texts, some at a time, each with the number of its line."""

import csv
from collections.abc import Iterable, Iterator
from itertools import chain, islice
from typing import TextIO

Block = tuple[list[list[str]], list[int]]
"""Rows, none of them empty, and the numbers of their lines."""


def header_of(file: TextIO) -> tuple[list[str], int]:
    """The texts of the first row, and how many lines of the file it takes.

    Raises
    ------
    ValueError
        If the line is no text or no CSV.
    """
    reader = csv.reader(file)
    try:
        return next(reader, []), reader.line_num
    except (csv.Error, UnicodeDecodeError) as reason:
        raise _near(reader.line_num, reason) from None


def rows_of(file: TextIO, number: int, size: int | None) -> Iterator[Block]:
    """The rows below the header, `size` at a time, or all at once.

    Lines are split at their commas, until a quotation mark is met: from there the module csv reads them,
    which takes twice as long.

    Parameters
    ----------
    file : text file
        Opened with ``newline=""``.
    number : int
        How many lines of it were read.
    size : int or None
        Number of rows in a block; the last one may have fewer.

    Raises
    ------
    ValueError
        With the number of a line near the one that is no text or no CSV.
    """
    rows: list[list[str]] = []
    lines: list[int] = []
    while read := _next(file, number, None if size is None else size - len(rows)):
        text = "".join(read).replace("\r\n", "\n")
        if '"' in text or "\r" in text or max(map(len, read)) > csv.field_size_limit():
            yield from _quoted(zip(rows, lines, strict=True), chain(read, file), number, size)
            return
        plain = text.removesuffix("\n").split("\n")
        numbers: Iterable[int] = range(number + 1, number + 1 + len(plain))
        number += len(plain)
        if "" in plain:
            numbers = [n for n, line in zip(numbers, plain, strict=True) if line]
            plain = [line for line in plain if line]
        rows += [line.split(",") for line in plain]
        lines += numbers
        if len(rows) == size:
            yield rows, lines
            rows, lines = [], []
    if rows:
        yield rows, lines


def _next(file: TextIO, number: int, count: int | None) -> list[str]:
    read: list[str] = []
    try:
        read.extend(islice(file, count))
    except UnicodeDecodeError as reason:
        raise _near(number + len(read), reason) from None
    return read


def _quoted(
    before: Iterable[tuple[list[str], int]], lines: Iterable[str], number: int, size: int | None
) -> Iterator[Block]:
    """Some rows with the numbers of their lines, then those that the module csv reads from further lines."""
    reader = csv.reader(lines)
    filled = chain(before, ((row, number + reader.line_num) for row in reader if row))
    try:
        while block := list(islice(filled, size)):
            rows, numbers = map(list, zip(*block, strict=True))
            yield rows, numbers
    except (csv.Error, UnicodeDecodeError) as reason:
        raise _near(number + reader.line_num, reason) from None


def _near(number: int, reason: Exception) -> ValueError:
    return ValueError(f"near line {number}: {reason}")
