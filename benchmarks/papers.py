"""The papers that are measured, one line each; a paper's folder here has ``measure.measure(quick)``."""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from matplotlib.figure import Figure

PAPERS = {
    "triple-integrator": "Turns about one axis (Gorelov & Morozova 2012)",
    "orbit-correction": "Orbit correction with the fewest impulses (Ibragimov 2017)",
    "averaging": "Averaging of nonlinear oscillations (Akulenko 1977)",
    "rendezvous": "Low-thrust rendezvous (Pimkina & Chelnokov; Sapunkov)",
}
"""Title of each paper's section, by its name on the command line and in figures/benchmarks."""

Table = dict[str, list[Any]]


@dataclass(frozen=True)
class Measured:
    """What measuring one paper's solvers gave.

    Attributes
    ----------
    notes : sequence of str
        What its tables mean, beyond what holds for all papers.
    seed : int
        Of its random problems.
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
