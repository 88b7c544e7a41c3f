"""Processor time of contestants who take turns, so that what slows the machine slows all of them."""

import gc
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median
from time import process_time

LIMITS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
SINGLE_THREAD = dict.fromkeys(LIMITS, "1")
"""Environment under which every contestant runs."""


@dataclass(frozen=True)
class Timing:
    """Processor seconds per problem: the median and the least of the rounds; problems a round."""

    typical: float
    least: float
    count: int


def repeated(run: Callable[[], int], times: int) -> Callable[[], int]:
    """A contestant that runs several times over, so that what only its first run pays does not count."""
    return lambda: sum(run() for _ in range(times))


def take_turns(contestants: Mapping[str, Callable[[], int]], rounds: int = 5) -> dict[str, Timing]:
    """Time each contestant once a round, after one round that does not count.

    Parameters
    ----------
    contestants : mapping of str to callable
        Each solves some problems and returns how many.
    rounds : int
        Rounds that count.

    Returns
    -------
    dict of str to Timing
        Per problem.
    """
    counts = {name: contestant() for name, contestant in contestants.items()}
    seconds: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in range(rounds):
        for name, contestant in contestants.items():
            gc.collect()
            gc.disable()
            start = process_time()
            contestant()
            seconds[name].append((process_time() - start) / counts[name])
            gc.enable()
    return {name: Timing(median(taken), min(taken), counts[name]) for name, taken in seconds.items()}
