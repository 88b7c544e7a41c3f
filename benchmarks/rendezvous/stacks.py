"""Flights one by one and in vector mode, and Newton's method from many starts in both ways."""

from collections.abc import Callable

import numpy as np

from benchmarks.clock import take_turns
from benchmarks.contest import worst
from benchmarks.rendezvous import problems
from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import fly
from pontryagin.rendezvous.reduced.lanes import fly_all
from pontryagin.rendezvous.reduced.multistart import (
    NEAR,
    newton_from_all,
)
from pontryagin.rendezvous.reduced.shooting import SHOOTING, meet

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
    peaks = dict.fromkeys(ARCS, BOUND * float(SHOOTING.thrust(best.flight).max())) | {"unsaturated": np.inf}
    for arcs, peak in peaks.items():
        bang = arcs == "saturated"

        def one_by_one(peak: float = peak, bang: bool = bang) -> int:
            few = costates[: 8 if quick else 64]
            return len([fly(scaled, z, duration, peak, bang) for z in few])

        def together(slopes: bool, peak: float = peak, bang: bool = bang) -> Callable[[], int]:
            return lambda: len(fly_all(scaled, costates, duration, peak, bang, slopes).ends)

        timings = take_turns({"one": one_by_one, "many": together(True), "ends": together(False)}, rounds)
        found = fly_all(scaled, costates, duration, peak, bang)
        alone = np.array([fly(scaled, z, duration, peak, bang).end for z in costates[:64]])
        one, many, ends = (1e6 * timings[way].typical for way in ("one", "many", "ends"))
        rows.append(
            (
                arcs,
                count,
                float(found.switches.mean()),
                one,
                many,
                ends,
                one / many,
                one / ends,
                worst((found.ends[:64] - alone) / np.abs(alone).max(axis=1, keepdims=True)),
            )
        )
    headings = (
        "flights",
        "number",
        "switches a flight",
        "one by one, microseconds",
        "many, microseconds",
        "many, ends alone, microseconds",
        "faster",
        "faster, ends alone",
        "largest difference",
    )
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


def multistarts(quick: bool) -> dict[str, list]:
    """Times of Newton's method from random starts, one by one and in vector mode."""
    best = problems.solved_leap(DEGREES)
    setting = problems.setting(best.problem)
    starts = problems.deviations(8 if quick else STARTS, SPREAD)

    def alone() -> int:
        return len([_newton(setting, z) for z in starts])

    def together() -> int:
        return len(newton_from_all(setting, starts)[0])

    timings = take_turns({"one by one": alone, "side by side": together}, 1 if quick else 5)
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
