"""Problems from a CSV file, a row each, and the same rows with their answers."""

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
    """The rows as they were read, and the numbers in the columns that were asked for, (n,) each."""

    header: list[str]
    rows: list[list[str]]
    columns: dict[str, Array]


def read(path: Path, required: Sequence[str], possible: Sequence[str] = ()) -> Rows:
    """Read numbers from the columns required, and from those possible that are there; others are kept.

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
            raise ValueError(f"line 1: column {missing[0]} is missing, takes {', '.join(required)}")
        wanted = [*required, *(name for name in possible if name in header)]
        rows, numbers = [], []
        for row in reader:
            if row:
                rows.append(row)
                numbers.append(_numbers(row, header, wanted, reader.line_num))
    if not rows:
        raise ValueError("line 2: there is no problem")
    return Rows(header, rows, dict(zip(wanted, np.array(numbers).T, strict=True)))


def _numbers(row: list[str], header: list[str], wanted: Sequence[str], line: int) -> list[float]:
    if len(row) != len(header):
        raise ValueError(f"line {line}: {len(row)} entries under {len(header)} columns")
    values = []
    for name in wanted:
        text = row[header.index(name)]
        try:
            values.append(formula.number(text))
        except ValueError:
            raise ValueError(f"line {line}: {name} takes a number, got {text!r}") from None
    return values


def to_csv(read: Rows, answers: Mapping[str, Any]) -> str:
    """The rows as they were read, each with its entries of the answers (n,); empty where they are nan."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*read.header, *answers])
    found = zip(*(np.asarray(column).tolist() for column in answers.values()), strict=True)
    for row, values in zip(read.rows, found, strict=True):
        writer.writerow([*row, *map(_cell, values)])
    return text.getvalue()


def _cell(value: Any) -> str:
    return "" if isinstance(value, float) and math.isnan(value) else str(value)
