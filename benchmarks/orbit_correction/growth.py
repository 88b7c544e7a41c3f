"""Time of one gauge against the number of steps, for our solver and the peers."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import repeated, take_turns
from benchmarks.contest import CALL, worst
from benchmarks.orbit_correction import gauges
from benchmarks.orbit_correction.states import PEAK, Solver, states, thrust
from pontryagin.orbit_correction.plan.thrust import THRUSTS

SIZES = (10, 32, 100, 316, 1000, 3162, 10_000)
"""Numbers of steps for which every method is timed."""

QUICK = (10, 100)
"""Numbers of steps in a quick run."""

OURS_ALONE = (31_623, 100_000)
"""Further numbers of steps, for which only our solver is timed."""

STATES = 3
"""Number of states in each measurement."""


def table(quick: bool) -> dict[str, list]:
    """Microseconds per state of each method, by set of impulses and number of steps."""
    some = states(STATES)
    rows: list[tuple] = []
    for name in THRUSTS:
        for steps in QUICK if quick else (*SIZES, *OURS_ALONE):
            counts = np.full(1, steps)
            exact = thrust(name).gauges(some, np.full(STATES, steps))
            opponents = {} if steps in OURS_ALONE else gauges.peers(name, quick=True)
            solvers = {method: peer.make(name, steps) for method, peer in opponents.items()}
            runs = {CALL: _ours(name, some, counts)}
            runs |= {method: _run(solver, some) for method, solver in solvers.items()}
            times = 1 if quick else max(1, 300 // steps)
            timings = take_turns({m: repeated(run, times) for m, run in runs.items()}, 2 if quick else 3)
            gap = worst(1 - exact.lower / exact.upper)
            errors = {CALL: (gap, 1.0)} | {m: _error(s, some, exact.upper) for m, s in solvers.items()}
            ours = timings[CALL].typical
            rows += [
                (name, steps, m, 1e6 * t.typical, t.typical / ours, *errors[m]) for m, t in timings.items()
            ]
    headings = (
        "impulses",
        "steps",
        "method",
        "microseconds",
        "times our call",
        "worst relative error",
        "solved",
    )
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


def _ours(name: str, some: NDArray, counts: NDArray) -> Callable[[], int]:
    engine = thrust(name)

    def run() -> int:
        for state in some:
            engine.gauges(state[None], counts)
        return len(some)

    return run


def _run(solver: Solver, some: NDArray) -> Callable[[], int]:
    def run() -> int:
        for state in some:
            solver(state / PEAK)
        return len(some)

    return run


def _error(solver: Solver, some: NDArray, exact: NDArray) -> tuple[float, float]:
    values = np.array([solver(state / PEAK) for state in some])
    found = np.isfinite(values)
    return worst((values / exact - 1)[found]), float(found.mean())
