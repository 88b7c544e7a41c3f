"""Contestants on the same problems, and a row of results for each."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.apart import answer
from benchmarks.clock import Timing, one_by_one, take_turns

CALL, STACK = "pontryagin, one call", "pontryagin, in a stack"


@dataclass(frozen=True)
class Contestant:
    """One method on a set of problems.

    Attributes
    ----------
    run : callable
        Solves the problems, input set-up included, and returns their number.
    error : float
        Worst relative difference of its costs from the exact optimum; for ours, the worst relative gap
        between its cost and its dual bound. nan if nothing was solved.
    solved : float
        Share of the problems solved.
    """

    run: Callable[[], int]
    error: float
    solved: float


@dataclass(frozen=True)
class Row:
    """The times and results of a contestant on a set of problems."""

    problem: str
    method: str
    count: int
    timing: Timing
    error: float
    solved: float


def contest(problem: str, contestants: Mapping[str, Contestant], rounds: int) -> list[Row]:
    """Time all contestants in turns; one row for each."""
    timings = take_turns({method: entrant.run for method, entrant in contestants.items()}, rounds)
    return [
        Row(problem, method, timing.count, timing, contestants[method].error, contestants[method].solved)
        for method, timing in timings.items()
    ]


def peer(solve: Callable[..., float], optima: NDArray, *columns: Iterable[Any]) -> Contestant:
    """A method that solves one problem after the other, judged by their optima; nan is no answer."""
    problems = list(zip(*columns, strict=True))
    none = [float("nan")] * len(problems)
    ratios = np.array(answer("a peer", lambda: [solve(*problem) for problem in problems], none)) / optima
    found = np.isfinite(ratios)
    return Contestant(one_by_one(solve, *columns), worst(ratios[found] - 1), float(found.mean()))


def worst_gap(lower: NDArray, upper: NDArray) -> float:
    """The largest relative gap between a bound from below and one from above."""
    return worst(1 - lower / upper)


def worst(values: NDArray) -> float:
    """The largest modulus; nan if there are no values."""
    return float(np.abs(values).max()) if values.size else float("nan")
