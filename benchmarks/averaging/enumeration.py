"""All exact extremals for decreasing epsilon, one exact shot, and the averaged solve, free of epsilon."""

from collections.abc import Callable
from statistics import median
from time import process_time

import numpy as np

from benchmarks.averaging.examples import BODY, EXAMPLES, KEPLER, PAID, SMOOTH
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.averaging.exact.shooting import (
    Shooting,
    shooting,
)

EPSILONS = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002)
QUICK = (0.1, 0.05)
LEAST = {BODY: 0.005}
"""Least epsilon that is run, for examples that are too slow at smaller ones."""
CERTIFIED = 0.02
"""Least epsilon at which certificates are computed; they use SciPy's integrators."""
BRIEF, ROUNDS = 1.0, 3
"""A run that takes less than `BRIEF` seconds is made `ROUNDS` times."""
SHOTS = 20


def table(quick: bool) -> dict[str, list]:
    """Number of extremals, times and errors of the averaged cost, for each example and epsilon."""
    rows: list[tuple] = []
    for name in (SMOOTH, KEPLER) if quick else (SMOOTH, PAID, KEPLER, BODY):
        epsilons = QUICK if quick else [e for e in EPSILONS if e >= LEAST.get(name, 0.0)]
        rows += [(name, *row) for row in _of_one(EXAMPLES[name].one, epsilons)]
    headings = (
        "example",
        "epsilon",
        "turns",
        "extremals",
        "minima",
        "residual of the best",
        "averaged, ms",
        "one exact shot, ms",
        "all exact extremals, ms",
        "exact over averaged",
        "error of J0",
        "error of J0 + epsilon J1",
    )
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


def _of_one(solve: Callable[[], AveragedSolution], epsilons) -> list[tuple]:
    solution, averaged = timed(solve)
    correction = float(solution.correction())
    solution.exact(epsilons[0])
    rows: list[tuple] = []
    for epsilon in epsilons:
        found, every = timed(lambda epsilon=epsilon: solution.exact(epsilon))
        problem, theta, unknowns = shot(solution, found)
        once = median(
            timed(lambda given=(problem, theta, unknowns): given[0].shoot(*given[1:]))[1]
            for _ in range(SHOTS)
        )
        residual = float(found[0].certificate.residual) if epsilon >= CERTIFIED else None
        cost, best = float(solution.cost), found[0].cost
        rows.append(
            (
                epsilon,
                found[0].turns,
                len(found),
                sum(extremal.kind == "minimum" for extremal in found),
                residual,
                1e3 * averaged,
                1e3 * once,
                1e3 * every,
                every / averaged,
                abs(cost / best - 1),
                abs((cost + epsilon * correction) / best - 1),
            )
        )
    return rows


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
        begun = process_time()
        result = run()
        taken.append(process_time() - begun)
    return result, median(taken)
