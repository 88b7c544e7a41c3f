"""The papers that are measured, and what measuring one gives: ``measure.measure(quick)`` in its folder."""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from matplotlib.figure import Figure

from pontryagin import papers

PAPERS = papers.benchmarks()
"""Title of each paper's section, by its name on the command line and in figures/benchmarks."""

Table = dict[str, list[Any]]


@dataclass(frozen=True)
class Measured:
    """What measuring one paper's solvers gave.

    Attributes
    ----------
    notes : sequence of str
        Explanations of its tables, beyond those of all papers.
    seed : int
        Seed of its random problems.
    tables : dict
        Title and columns of each table, by the name of its file.
    figures : list of Figure
        Each labelled with the name of its file.
    """

    notes: Sequence[str]
    seed: int
    tables: dict[str, tuple[str, Table]]
    figures: list[Figure]


def measure(paper: str, quick: bool) -> Measured:
    """Measure one of `PAPERS`."""
    return import_module(f"benchmarks.{paper.replace('-', '_')}.measure").measure(quick)
