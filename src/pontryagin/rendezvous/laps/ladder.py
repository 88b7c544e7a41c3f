"""The transfers of free duration on one lap, without a bound: where the terminal law holds along a curve.

The curve of least energy over the duration is followed from the best duration of a guess in both directions,
until a transfer costs more than a given multiple of the best one.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, between
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.laps.families import LEAST_ENERGY, least_energy, points
from pontryagin.rendezvous.laps.start import Guesses, least_energy_guesses
from pontryagin.rendezvous.laps.transcription import ROUGH, Path, RunningCost, extremal, square

DURATIONS = np.geomspace(0.7, 120.0, 40)
"""Durations of the guesses, in units of sqrt(p*^3/fM)."""
COARSE = 12
"""Intervals for each turn of a guess that only estimates a cost."""
SEEDS = 3
"""Largest number of durations from which a curve is begun."""
FIRST, LARGEST, TRIES = 0.05, 0.05, 120
"""Steps of the curve over the logarithm of the duration, and how many are tried in each direction."""
WORSE = 2.0
"""Transfers that cost more than this many times the best one on the lap are left out."""
SHORTENINGS = 4
"""How often two points of the curve are brought nearer to each other."""
RANGE = 3.0
"""Largest change of the logarithm of the duration along the curve."""


def guesses_on(lap: Lap, longest: float = math.inf) -> Guesses:
    """Guesses over the durations up to the longest of interest."""
    return least_energy_guesses(lap, DURATIONS[longest > DURATIONS], per_lap=COARSE)


def energy(path: Path) -> float:
    """The integral of p^2 along a path without bound, alpha2 = 1."""
    weight = kernels.equinoctial_weight(*[*path.nodes[:3], path.nodes[5]])
    rate = square(path.nodes) / 4 * weight
    return float((rate[1:] + rate[:-1]).sum() * path.span / (2 * (rate.size - 1)))


def price(path: Path, ratio: float) -> float:
    """The integral of alpha1 + alpha2 p^2 for alpha2 = 1."""
    return ratio * path.duration + energy(path)


def minima(guesses: Guesses, ratio: float) -> list[tuple[float, float]]:
    """Prices and durations of the guesses that cost less than their neighbours, the best first."""
    costs = ratio * guesses.durations + guesses.energies
    inner = np.pad(costs, 1, constant_values=math.inf)
    least = (costs <= inner[:-2]) & (costs <= inner[2:])
    return sorted(zip(costs[least].tolist(), guesses.durations[least].tolist(), strict=True))


def duration_of_thrust(guesses: Guesses, thrust: float) -> float:
    """The shortest duration for which the root mean square of a guess's thrust is this; inf if there is none."""
    sizes = np.log(np.sqrt(guesses.energies / guesses.durations) / thrust)
    (low,) = np.nonzero(sizes <= 0)
    if low.size == 0:
        return math.inf
    pair = slice(max(low[0] - 1, 0), low[0] + 1)
    return float(np.exp(np.interp(0.0, -sizes[pair], np.log(guesses.durations[pair]))))


def free_transfers(lap: Lap, ratio: float, seeds: list[float], most: float = math.inf) -> list[Path]:
    """The transfers of free duration for alpha1/alpha2 on the curves through some durations, the best first.

    Curves are followed, and transfers kept, while they cost less than ``most`` and `WORSE` times the best one.

    Raises
    ------
    NotConverged
        If no curve could be begun.
    """
    found: list[Path] = []
    passed: list[tuple[float, float]] = []
    reason: NotConverged | None = None
    for duration in seeds[:SEEDS]:
        if any(shortest <= duration <= longest for shortest, longest in passed):
            continue
        try:
            start = least_energy(lap, duration)
        except NotConverged as failure:
            reason = failure
            continue
        reached = [duration]
        for end in (RANGE, -RANGE):
            for one, other in pairwise(_along(lap, start, ratio, end, most, reached)):
                if _law(one, ratio) * _law(other, ratio) > 0:
                    continue
                try:
                    path = _between(lap, ratio, one, other)
                except NotConverged as failure:
                    reason = failure
                    continue
                found.append(path)
                most = min(most, WORSE * price(path, ratio))
        passed.append((min(reached), max(reached)))
    if reason and not passed:
        raise reason
    kept = [path for path in found if price(path, ratio) < most]
    return sorted(kept, key=lambda path: price(path, ratio))


def _law(point: Point[None], ratio: float) -> float:
    """|p|^2 - alpha1/alpha2 at the meeting."""
    return float(square(Path.of(point.unknowns).nodes[:, -1])) / 4 - ratio


def _between(lap: Lap, ratio: float, one: Point[None], other: Point[None]) -> Path:
    """The transfer of free duration between two points of the curve, where the law changes its sign.

    While Newton's method does not end between them, the distance is shortened by a point of the curve.
    """
    for _ in range(SHORTENINGS):
        here, there = _law(one, ratio), _law(other, ratio)
        logarithm = one.parameter + here / (here - there) * (other.parameter - one.parameter)
        guess = Path.of(between(one, other, logarithm))
        try:
            found = extremal(lap, RunningCost(ratio, 1.0, math.inf), None, guess, ROUGH)
            if (math.log(found.duration) - one.parameter) * (math.log(found.duration) - other.parameter) <= 0:
                return found
        except NotConverged:
            pass
        middle = extremal(lap, LEAST_ENERGY, math.exp(logarithm), guess, ROUGH)
        point = Point(middle.unknowns, logarithm, None)
        one, other = (point, other) if _law(point, ratio) * here > 0 else (one, point)
    raise NotConverged("the transfer of free duration was not reached", other.parameter - one.parameter)


def _along(
    lap: Lap, start: Path, ratio: float, end: float, most: float, reached: list[float]
) -> Iterator[Point[None]]:
    """Points of the curve in one direction, while they cost little; their durations are recorded."""
    begin = math.log(start.duration)

    def posed(logarithm: float) -> tuple[Lap, RunningCost, float]:
        return lap, LEAST_ENERGY, math.exp(logarithm)

    for point in points(posed, start, begin, begin + end, FIRST, LARGEST, TRIES):
        yield point
        path = Path.of(point.unknowns)
        reached.append(path.duration)
        most = min(most, WORSE * price(path, ratio))
        if price(path, ratio) > most:
            return
