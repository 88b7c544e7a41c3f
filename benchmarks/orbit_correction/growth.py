"""Time of one gauge against the number of steps, for our solver and the peers."""

import numpy as np

from benchmarks.clock import repeated, take_turns
from benchmarks.contest import CALL, Contestant, peer, worst_gap
from benchmarks.orbit_correction import gauges
from benchmarks.orbit_correction.states import PEAK, states, thrust
from benchmarks.table import by_heading
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
    rows = []
    for name in THRUSTS:
        for steps in QUICK if quick else (*SIZES, *OURS_ALONE):
            entrants = _entrants(name, steps)
            times = 1 if quick else max(1, 300 // steps)
            runs = {method: repeated(entrant.run, times) for method, entrant in entrants.items()}
            timings = take_turns(runs, 2 if quick else 3)
            rows += [
                {
                    "impulses": name,
                    "steps": steps,
                    "method": method,
                    "microseconds": 1e6 * timing.typical,
                    "times our call": timing.typical / timings[CALL].typical,
                    "worst relative error": entrants[method].error,
                    "solved": entrants[method].solved,
                }
                for method, timing in timings.items()
            ]
    return by_heading(rows)


def _entrants(name: str, steps: int) -> dict[str, Contestant]:
    """Our solver, and the peers where all are timed."""
    engine, some = thrust(name), states(STATES)
    exact = engine.gauges(some, np.full(STATES, steps))
    opponents = {} if steps in OURS_ALONE else gauges.peers(name, quick=True)
    ours = Contestant(gauges.one_gauge_each(engine, some, steps), worst_gap(exact.lower, exact.upper), 1.0)
    return {CALL: ours} | {
        method: peer(opponent.make(name, steps), exact.upper, some / PEAK)
        for method, opponent in opponents.items()
    }
