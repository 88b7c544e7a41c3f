"""Many problems from a CSV file, and their solutions as one: a row a problem."""

import csv
import io
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from pontryagin.arrays import Array
from pontryagin.io import formula
from pontryagin.triple_integrator.transcript import account, certificate_of

START, END = ("x10", "x20", "x30"), ("x1f", "x2f", "x3f")
UNSTACKED = ("q", "breakpoints", "multipliers")


class Problems(NamedTuple):
    """The rows as they were read, and the numbers in them by column, (n,) each."""

    header: list[str]
    rows: list[list[str]]
    columns: dict[str, Array]

    def stack(self, names: Sequence[str]) -> Array:
        """Columns side by side, (n, len(names))."""
        return np.stack([self.columns[name] for name in names], axis=-1)


def read(path: Path, least_time: bool) -> Problems:
    """Read ``x10, x20, x30, x1f, x2f, x3f`` and, unless the time is sought, ``tf`` and ``t0`` if it is there.

    Raises
    ------
    ValueError
        With the number of the line, if a column is missing or a row does not hold a problem.
    OSError
        If the file cannot be read.
    """
    with path.open(newline="", encoding="utf-8-sig") as file:
        reader = csv.reader(file)
        header = [name.strip() for name in next(reader, [])]
        wanted = [*START, *END, *([] if least_time else ["tf"])]
        missing = [name for name in wanted if name not in header]
        if missing:
            raise ValueError(f"line 1: column {missing[0]} is missing, takes {', '.join(wanted)}")
        if not least_time and "t0" in header:
            wanted.append("t0")
        places = [header.index(name) for name in wanted]
        rows, numbers = [], []
        for row in reader:
            if row:
                rows.append(row)
                numbers.append(_numbers(row, header, places, reader.line_num, least_time))
    if not rows:
        raise ValueError("line 2: there is no problem")
    return Problems(header, rows, dict(zip(wanted, np.array(numbers).T, strict=True)))


def _numbers(
    row: list[str], header: list[str], places: list[int], line: int, least_time: bool
) -> list[float]:
    if len(row) != len(header):
        raise ValueError(f"line {line}: {len(row)} entries under {len(header)} columns")
    values = []
    for place in places:
        try:
            values.append(formula.number(row[place]))
        except ValueError:
            raise ValueError(f"line {line}: {header[place]} takes a number, got {row[place]!r}") from None
    named = dict(zip((header[place] for place in places), values, strict=True))
    if not least_time and not named["tf"] > named.get("t0", 0.0):
        raise ValueError(
            f"line {line}: tf must be later than t0, got {named.get('t0', 0.0)} and {named['tf']}"
        )
    return values


def results(solution: Any) -> dict[str, Any]:
    """Columns of a stack of solutions: each (n,), vectors taken apart as ``name_1``, ``name_2``, ..."""
    told = {name: getattr(solution, name) for name in account(solution).quantities if name not in UNSTACKED}
    columns = {}
    for name, value in (told | certificate_of(solution)).items():
        parts = np.moveaxis(np.asarray(value), -1, 0) if np.ndim(value) == 2 else None
        if parts is None:
            columns[name] = np.asarray(value)
        else:
            columns |= {f"{name}_{i}": part for i, part in enumerate(parts, start=1)}
    return columns


def to_csv(problems: Problems, solution: Any) -> str:
    """The rows as they were read, each with its solution and certificate; empty where there is none."""
    columns = results(solution)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*problems.header, *columns])
    values = zip(*(column.tolist() for column in columns.values()), strict=True)
    for row, found in zip(problems.rows, values, strict=True):
        writer.writerow([*row, *map(_cell, found)])
    return text.getvalue()


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if isinstance(value, float) and math.isnan(value) else str(value)
