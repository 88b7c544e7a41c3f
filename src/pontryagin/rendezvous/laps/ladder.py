"""The transfers of free duration on one lap, without a bound: where the terminal law holds along a curve.

The curve of least energy over the duration is followed from the best duration of a guess in both directions,
until a transfer costs more than a given multiple of the best one.
"""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, crossings, march
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.laps.families import ITERATIONS, LEAST_ENERGY, least_energy
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.start import least_energy_guess
from pontryagin.rendezvous.laps.transcription import Path, extremal, square

DURATIONS = np.geomspace(0.5, 120.0, 60)
"""Durations of the guesses, in units of sqrt(p*^3/fM)."""
COARSE = 20
"""Intervals for each turn of a guess that only estimates a cost."""
SEEDS = 3
"""Largest number of durations from which a curve is begun."""
FIRST, LARGEST, LEAST, TRIES = 0.05, 0.2, 1e-3, 60
"""Steps of the curve over the logarithm of the duration, and how many are tried in each direction."""
RANGE = 3.0
"""Largest change of the logarithm of the duration along the curve."""


def energy(path: Path) -> float:
    """The integral of p^2 along a path without bound, alpha2 = 1."""
    weight = kernels.equinoctial_weight(*[*path.nodes[:3], path.nodes[5]])
    rate = square(path.nodes) / 4 * weight
    return float((rate[1:] + rate[:-1]).sum() * path.span / (2 * (rate.size - 1)))


def price(path: Path, ratio: float) -> float:
    """The integral of alpha1 + alpha2 p^2 for alpha2 = 1."""
    return ratio * path.duration + energy(path)


def promising_durations(lap: Lap, ratio: float) -> list[float]:
    """Durations at which the guess costs least, the best first: the minima over a grid."""
    guesses = [least_energy_guess(lap, duration, 2, COARSE) for duration in DURATIONS]
    costs = np.array([math.inf if one is None else price(one, ratio) for one in guesses])
    inner = np.pad(costs, 1, constant_values=math.inf)
    least = np.isfinite(costs) & (costs <= inner[:-2]) & (costs <= inner[2:])
    return [float(DURATIONS[i]) for i in np.argsort(costs) if least[i]]


def free_transfers(lap: Lap, ratio: float, worse: float, best: float = math.inf) -> list[Path]:
    """The transfers of free duration for alpha1/alpha2 on the curves through the most promising durations.

    Curves are followed while they cost less than ``worse`` times the best transfer, or the given best cost.

    Raises
    ------
    NotConverged
        If no curve could be begun.
    """
    found: list[Path] = []
    reason: NotConverged | None = None
    begun = False
    for duration in promising_durations(lap, ratio)[:SEEDS]:
        try:
            start = least_energy(lap, duration)
        except NotConverged as failure:
            reason = failure
            continue
        begun = True
        for end in (RANGE, -RANGE):
            for path in _along(lap, start, ratio, end, worse, best):
                if all(abs(path.duration / other.duration - 1) > 1e-3 for other in found):
                    found.append(path)
                    best = min(best, price(path, ratio))
    if not begun:
        raise reason or NotConverged("no meeting is ahead of the craft on this lap", math.inf)
    return sorted(found, key=lambda path: price(path, ratio))


def _along(lap: Lap, start: Path, ratio: float, end: float, worse: float, best: float) -> Iterator[Path]:
    def at(logarithm: float, guess: Array) -> Point[None]:
        found = extremal(lap, LEAST_ENERGY, math.exp(logarithm), Path.of(guess), ITERATIONS)
        return Point(found.unknowns, logarithm, None)

    def near() -> Iterator[Point[None]]:
        least = best
        begin = math.log(start.duration)
        first = Point(start.unknowns, begin, None)
        for point in march(at, first, begin + end, first=FIRST, largest=LARGEST, least=LEAST, tries=TRIES):
            yield point
            cost = price(Path.of(point.unknowns), ratio)
            least = min(least, cost)
            if cost > worse * least:
                return

    def law(point: Point[None]) -> float:
        return float(square(Path.of(point.unknowns).nodes[:, -1])) / 4 - ratio

    for unknowns, _ in crossings(near(), law):
        try:
            yield extremal(lap, RunningCost(ratio, 1.0, math.inf), None, Path.of(unknowns))
        except NotConverged:
            continue
