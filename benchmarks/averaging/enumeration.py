"""All exact extremals for decreasing epsilon, one exact shot, and the averaged solve, free of epsilon."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from statistics import median
from typing import Any

import numpy as np

from benchmarks import clock
from benchmarks.averaging.examples import BODY, EXAMPLES, KEPLER, PAID, SMOOTH
from benchmarks.table import by_heading
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.averaging.exact.shooting import (
    Shooting,
    shooting,
)

EPSILONS = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002)
QUICK = (0.1, 0.05)
BRIEF, ROUNDS = 1.0, 3
"""A run that takes less than `BRIEF` seconds is made `ROUNDS` times."""
SHOTS = 20


def table(quick: bool) -> dict[str, list]:
    """Number of extremals, times and errors of the averaged cost, for each example and epsilon."""
    rows: list[dict[str, Any]] = []
    for name in (SMOOTH, KEPLER) if quick else (SMOOTH, PAID, KEPLER, BODY):
        rows += of_one(name, QUICK if quick else EPSILONS)
    return by_heading(rows)


def of_one(name: str, epsilons: Sequence[float]) -> Iterator[dict[str, Any]]:
    """The rows of one example."""
    solve = EXAMPLES[name].one
    solution, averaged = timed(solve)
    correction = float(solution.correction())
    solution.exact(epsilons[0])
    for epsilon in epsilons:
        found, every = timed(partial(solution.exact, epsilon))
        problem, theta, unknowns = shot(solution, found)
        once = median(timed(partial(problem.shoot, theta, unknowns))[1] for _ in range(SHOTS))
        residual = float(found[0].certificate.residual)
        _, certifying = timed(found[0].certify)
        cost, best = float(solution.cost), found[0].cost
        yield {
            "example": name,
            "epsilon": epsilon,
            "turns": found[0].turns,
            "extremals": len(found),
            "minima": sum(extremal.kind == "minimum" for extremal in found),
            "residual of the best": residual,
            "averaged, ms": 1e3 * averaged,
            "one exact shot, ms": 1e3 * once,
            "all exact extremals, ms": 1e3 * every,
            "one certificate, ms": 1e3 * certifying,
            "exact over averaged": every / averaged,
            "error of J0": abs(cost / best - 1),
            "error of J0 + epsilon J1": abs((cost + epsilon * correction) / best - 1),
        }


def shot(solution: AveragedSolution, found: Extremals) -> tuple[Shooting, np.ndarray, np.ndarray]:
    """The exact problem as shooting, and its best extremal: final anomaly (1,) and unknowns (1, n + r)."""
    held = solution if solution.frame is None else solution.frame(solution)
    problem = shooting(held, found.epsilon, found[0].starting_anomaly)
    n = len(problem.start)
    unknowns = np.concatenate([found[0].initial[n : 2 * n], np.zeros(len(problem.scale_m))])
    return problem, np.array([found[0].ending_anomaly]), unknowns[None]


def timed(run: Callable):
    """Result of a run and its median processor time in seconds; only a brief run is repeated."""
    taken: list[float] = []
    while not taken or (len(taken) < ROUNDS and taken[0] < BRIEF):
        result, seconds = clock.timed(run)
        taken.append(seconds)
    return result, median(taken)
