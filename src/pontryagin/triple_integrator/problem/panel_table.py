"""Panels of intervals as tables of columns: chosen, joined, halved."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Table = dict[str, Any]
"""Panels by columns, (p,) or (p, ...) each."""


def chosen(table: Table, which: NDArray[np.bool_]) -> Table:
    """Some of the panels."""
    return {name: column[which] for name, column in table.items()}


def joined(tables: list[Table]) -> Table:
    """The panels of several tables, in the columns of the first."""
    return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}


def halved(panels: Table) -> Table:
    """The halves of panels."""
    halves = {
        name: np.repeat(panels[name], 2) for name in ("stretch", "low", "high", "low_inside", "high_inside")
    }
    middle = (panels["low"] + panels["high"]) / 2
    halves["low"][1::2], halves["high"][::2] = middle, middle
    halves["low_inside"][1::2], halves["high_inside"][::2] = True, True
    return halves
