"""Flights one by one and many in one call, and Newton's method from many starts in both ways."""

from functools import partial

import numpy as np

from benchmarks.clock import one_by_one, one_call, take_turns
from benchmarks.contest import worst
from benchmarks.rendezvous import problems
from benchmarks.table import by_heading
from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight, fly
from pontryagin.rendezvous.reduced.flights import fly_all
from pontryagin.rendezvous.reduced.multistart import (
    NEAR,
    newton_from_all,
)
from pontryagin.rendezvous.reduced.shooting import largest_thrust, meet

COUNT, NEARBY = 512, 0.02
"""Number of flights, and the standard deviation of their costates."""
DEGREES, SPREAD, STARTS = 20, 0.05, 64
"""Inclination, standard deviation of the starts' costates, and number of starts."""
BOUND = 0.6
"""The bound on the thrust, in units of the largest thrust without a bound."""
ARCS = ("unsaturated", "saturated", "with switches")


def flights(quick: bool) -> dict[str, list]:
    """Microseconds per flight with and without derivatives, and the largest difference of the ends."""
    count, rounds = (16, 1) if quick else (COUNT, 5)
    best = problems.solved_leap(DEGREES)
    scaled, duration = best.problem.scaled, best.flight.duration
    costates = best.flight.costates + problems.deviations(count, NEARBY)
    rows = []
    peaks = dict.fromkeys(ARCS, BOUND * largest_thrust(best.flight)) | {"unsaturated": np.inf}
    for arcs, peak in peaks.items():
        how = (duration, peak, arcs == "saturated")

        def single(z: Array, how: tuple[float, float, bool] = how) -> Flight:
            return fly(scaled, z, *how)

        together = partial(fly_all, scaled, costates, *how)
        runs = {
            "one": one_by_one(single, costates[: 8 if quick else 64]),
            "many": one_call(together, count),
            "ends": one_call(partial(together, slopes=False), count),
        }
        one, many, ends = (1e6 * timing.typical for timing in take_turns(runs, rounds).values())
        found, alone = together(), np.array([single(z).end for z in costates[:64]])
        rows.append(
            {
                "flights": arcs,
                "number": count,
                "switches a flight": float(found.switches.mean()),
                "one by one, microseconds": one,
                "many, microseconds": many,
                "many, ends alone, microseconds": ends,
                "faster": one / many,
                "faster, ends alone": one / ends,
                "largest difference": worst(
                    (found.ends[:64] - alone) / np.abs(alone).max(axis=1, keepdims=True)
                ),
            }
        )
    return by_heading(rows)


def multistarts(quick: bool) -> dict[str, list]:
    """Times of Newton's method from random starts, one by one and together."""
    best = problems.solved_leap(DEGREES)
    setting = problems.setting(best.problem)
    starts = problems.deviations(8 if quick else STARTS, SPREAD)
    runs = {
        "one by one": one_by_one(partial(_newton, setting), starts),
        "side by side": one_call(partial(newton_from_all, setting, starts), len(starts)),
    }
    timings = take_turns(runs, 1 if quick else 5)
    found = {
        "one by one": float(np.mean([_newton(setting, z) for z in starts])),
        "side by side": float(np.mean(newton_from_all(setting, starts)[1] < NEAR)),
    }
    return {
        "way": list(timings),
        "starts": [len(starts)] * 2,
        "milliseconds a start": [1e3 * timing.typical for timing in timings.values()],
        "fastest round": [1e3 * timing.least for timing in timings.values()],
        "arrived": [found[way] for way in timings],
    }


def _newton(setting: Setting, start: Array) -> bool:
    """Whether Newton's method converges from a start."""
    try:
        meet(setting, start)
    except (NotConverged, np.linalg.LinAlgError):
        return False
    return True
