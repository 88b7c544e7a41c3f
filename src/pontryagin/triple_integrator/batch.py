"""Problems read from the rows of a CSV file, and their solutions as columns."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from pontryagin.io import rows
from pontryagin.triple_integrator.transcript import account, certificate_of

START, END = ("x10", "x20", "x30"), ("x1f", "x2f", "x3f")
"""The CSV columns with the states at the start and at the end."""

UNSTACKED = ("q", "breakpoints", "breakpoint_offsets", "multipliers")
"""Quantities of a single solution that are not written to CSV."""


def blocks(path: Path, least_time: bool, whole: bool = False) -> Iterator[rows.Rows]:
    """Read ``x10, x20, x30, x1f, x2f, x3f``; for a given duration also ``tf``, and ``t0`` if there is one.

    All rows are one block if ``whole``. A row that ends before it starts is at fault.

    Raises
    ------
    ValueError
        With the number of the line, if a column is missing or there is no row.
    OSError
        If the file cannot be read.
    """
    size = None if whole else 0
    if least_time:
        yield from rows.blocks(path, [*START, *END], size=size)
        return
    for block in rows.blocks(path, [*START, *END, "tf"], ["t0"], size=size):
        tf = block.columns["tf"]
        t0 = block.columns.get("t0", np.zeros_like(tf))
        late = {
            i: f"tf must be later than t0, got t0 = {t0[i]} and tf = {tf[i]}"
            for i in np.flatnonzero(tf <= t0).tolist()
        }
        yield block._replace(faults={**block.faults, **late}) if late else block


def answers(solution: Any) -> dict[str, Any]:
    """The quantities of a stack of solutions and of its certificate by name, each (n,) or (n, k)."""
    names = (name for name in account(solution).quantities if name not in UNSTACKED)
    return {name: getattr(solution, name) for name in names} | certificate_of(solution)
