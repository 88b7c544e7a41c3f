"""Processor time of contestants that run in turns, so that a busy machine slows all of them alike.

Each runs in a process of its own: one that dies loses its own times alone.
"""

import gc
import math
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from statistics import median
from time import process_time
from typing import Any

from benchmarks.apart import Apart, Died

LIMITS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
SINGLE_THREAD = dict.fromkeys(LIMITS, "1")
"""Environment under which every contestant runs."""


@dataclass(frozen=True)
class Timing:
    """Processor seconds per problem, median and least of all rounds, and the problems in each round."""

    typical: float
    least: float
    count: int


def timed(call: Callable[[], Any]) -> tuple[Any, float]:
    """The result of one call, and its seconds of processor time."""
    start = process_time()
    result = call()
    return result, process_time() - start


def one_call(call: Callable[[], Any], count: int = 1) -> Callable[[], int]:
    """A contestant that makes one call, which solves `count` problems."""

    def run() -> int:
        call()
        return count

    return run


def one_by_one(solve: Callable[..., Any], *columns: Iterable[Any]) -> Callable[[], int]:
    """A contestant that solves one problem after the other; each argument of `solve` is a column."""
    problems = list(zip(*columns, strict=True))

    def run() -> int:
        for problem in problems:
            solve(*problem)
        return len(problems)

    return run


def repeated(run: Callable[[], int], times: int) -> Callable[[], int]:
    """A contestant that runs `times` times in each round, so that the cost of a first run hardly counts."""
    return lambda: sum(run() for _ in range(times))


def take_turns(contestants: Mapping[str, Callable[[], int]], rounds: int = 5) -> dict[str, Timing]:
    """Time each contestant once in each round, after an untimed round that warms up.

    Parameters
    ----------
    contestants : mapping of str to callable
        Each solves some problems and returns their number.
    rounds : int
        Number of timed rounds.

    Returns
    -------
    dict of str to Timing
        Per problem; nan for a contestant whose process died, which a line says.
    """
    seconds: dict[str, list[float]] = {name: [] for name in contestants}
    counts = dict.fromkeys(contestants, 0)
    with ExitStack() as processes:
        running = {
            name: processes.enter_context(Apart(partial(_round, contestant)))
            for name, contestant in contestants.items()
        }
        for number in range(1 + rounds):
            for name, process in list(running.items()):
                try:
                    counts[name], taken = process()
                except Died as reason:
                    print(f"{name} {reason}: its times are empty")
                    del running[name]
                    seconds[name] = [math.nan]
                    continue
                if number > 0:
                    seconds[name].append(taken / counts[name])
    return {name: Timing(median(taken), min(taken), counts[name]) for name, taken in seconds.items()}


def _round(contestant: Callable[[], int]) -> tuple[int, float]:
    """The number of problems that a contestant solves in one round, and its seconds of processor time."""
    gc.collect()
    gc.disable()
    count, taken = timed(contestant)
    gc.enable()
    return count, taken
