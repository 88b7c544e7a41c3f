"""Continuation of a transfer on a lap: to the target, to a bound, to least time.

Each continuation follows transcribed extremals over one parameter, with guesses by the secant. Its points are
guesses for the next and, at its end, for Newton's method on flights, so that a rough correction suffices.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, march
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.laps.hamiltonian import Cost, RunningCost
from pontryagin.rendezvous.laps.power import PowerCost
from pontryagin.rendezvous.laps.start import least_energy_guesses
from pontryagin.rendezvous.laps.transcription import ROUGH, Path, extremal

LEAST_ENERGY = RunningCost(0.0, 1.0, math.inf)
SHARES = (1.0, 0.5, 0.2, 0.05)
"""Shares of the way to the target's orbit at which a guess is tried."""
TRIES, GROWTH = 120, 2.0
"""How many steps of a continuation are tried, and the factor by which one grows after a success."""
FIRST, LARGEST, LEAST = 0.3, 0.5, 1 / 16
"""First, largest and least step of a continuation whose end is wanted, in units of its length."""
FINEST = 1 / 512
"""The least step where no other start is tried, as for a fixed duration."""

Posed = Callable[[float], tuple[Lap, Cost, float | None]]
"""A function of the parameter that returns a lap, a cost, and the duration, which is None if it is free."""


def points(
    posed: Posed, path: Path, begin: float, end: float, steps: tuple[float, float, float]
) -> Iterator[Point[None]]:
    """Roughly corrected extremals from one value of the parameter towards another.

    The first step, the largest and the one below which the continuation ends are given.
    """
    first, largest, least = steps

    def at(parameter: float, guess: Array) -> Point[None]:
        found = extremal(*posed(parameter), Path.of(guess), ROUGH)
        return Point(found.unknowns, parameter, None)

    return march(
        at,
        Point(path.unknowns, begin, None),
        end,
        first=first,
        largest=largest,
        least=least,
        growth=GROWTH,
        tries=TRIES,
    )


def continued(posed: Posed, path: Path, begin: float, end: float, least: float = LEAST) -> Path:
    """The extremal at the last value of the parameter, from that at the first.

    The continuation ends at steps below ``least``, in units of its length.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    way = abs(end - begin)
    *_, last = points(posed, path, begin, end, (FIRST * way, LARGEST * way, least * way))
    if last.parameter != end:
        raise NotConverged("the continuation on this lap ended", abs(end - last.parameter) / way)
    return Path.of(last.unknowns)


def least_energy(lap: Lap, duration: float, least: float = LEAST) -> Path:
    """The extremal of least energy, without a bound, of a fixed duration.

    If it is not reached from a guess, that for a nearer goal is continued, by steps down to ``least``: the
    goal moves from the craft's orbit to the target's, at the same longitude.

    Raises
    ------
    NotConverged
        If it is not reached.
    """
    end = lap.longitude(duration)[0]
    coasting = _coasting_time(lap, end)
    reason = NotConverged("the meeting is not ahead of the craft", math.inf)

    def posed(share: float) -> tuple[Lap, Cost, float]:
        if share == 1.0:
            return lap, LEAST_ENERGY, duration
        goal = lap.start[:5] + share * (lap.goal - lap.start[:5])
        return replace(lap, goal=goal, end=end), LEAST_ENERGY, coasting + share * (duration - coasting)

    for share in SHARES:
        nearer, _, time = posed(share)
        guesses = least_energy_guesses(nearer, np.array([time]))
        if guesses.durations.size:
            try:
                start = extremal(*posed(share), guesses.path(0), ROUGH)
                return continued(posed, start, share, 1.0, least) if share < 1 else start
            except NotConverged as failure:
                reason = failure
    raise reason


def _coasting_time(lap: Lap, end: float) -> float:
    """The time in which the craft coasts to a longitude."""
    longitude = (np.arange(200) + 0.5) * end / 200
    p, f, g = lap.start[:3]
    return float(kernels.equinoctial_weight(p, f, g, longitude).sum()) * end / 200


def bounded(lap: Lap, path: Path, cost: RunningCost, duration: float | None) -> Path:
    """The extremal under a bound, from one without.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    largest = float(path.switching().max()) / (2 * cost.energy_weight)
    if largest <= cost.peak:
        return path

    def posed(logarithm: float) -> tuple[Lap, Cost, float | None]:
        return lap, replace(cost, peak=math.exp(logarithm)), duration

    begin, end = math.log(largest), math.log(cost.peak)
    way = abs(end - begin)
    *_, last = points(posed, path, begin, end, (FIRST * way, LARGEST * way, LEAST * way))
    if last.parameter != end:
        factor = math.exp(last.parameter - end)
        raise NotConverged(
            f"the bound on the thrust could be lowered to {factor:.4g} times the peak, but not to it",
            factor - 1,
        )
    return Path.of(last.unknowns)


def least_time(lap: Lap, path: Path, peak: float) -> Path:
    """The extremal of least time under a bound, from one of least energy whose thrust has about this size.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    size = float(path.switching()[-1])
    nodes = path.nodes.copy()
    nodes[6:] /= peak * size
    start = replace(path, nodes=nodes, price=path.price / (peak * size))

    def posed(theta: float) -> tuple[Lap, Cost, None]:
        return lap, PowerCost(theta, size / (2 * peak), peak), None

    return continued(posed, start, 0.5, 0.0)
