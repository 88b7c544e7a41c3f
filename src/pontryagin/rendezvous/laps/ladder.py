"""The transfers of free duration on one lap, without a bound: where the terminal law holds along a curve.

The curve of least energy over the duration is followed from the best duration of a guess in both directions,
until a transfer costs more than a given multiple of the best one.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, between
from pontryagin.rendezvous.laps.ends import Ends
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.laps.families import bounded, points
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.start import Guesses, least_energy_guesses
from pontryagin.rendezvous.laps.transcription import ROUGH, Path, extremal, switching

SHORTEST, FACTOR = 0.2, 1.146
"""The shortest of the usual durations of guesses, in units of sqrt(p*^3/fM), and the ratio of two of them."""
HORIZONS = 9.0, 33.0, 120.0
"""Longest durations of the guesses, one after the other."""
COARSE = 12
"""Intervals for each turn of a guess that only estimates a cost."""
SEEDS = 3
"""Largest number of durations from which a curve is begun."""
STEPS = 0.05, 0.05, 0.005
"""First, largest and least step of the curve over the logarithm of the duration."""
ROOM = 0.7
"""Largest mean thrust of a guess from which a curve is begun, in units of the bound."""
WORSE = 2.0
"""Transfers that cost more than this many times the best one on the lap are left out."""
NEAR = 0.9
"""A point is added where the law is expected to fall to this share of its value at the point beside."""
SHORTENINGS = 4
"""How often two points of the curve are brought nearer to each other."""
RANGE = 3.0
"""Largest change of the logarithm of the duration along the curve."""


def guesses_on(
    lap: Lap, shortest: float, needed: Callable[[Guesses], float], limit: float = math.inf
) -> Guesses:
    """Guesses over longer and longer durations, until the longest that is needed or the limit is reached.

    They begin at the shortest of interest or at `SHORTEST`, whichever is less.
    """
    begin = min(shortest, SHORTEST)
    for horizon in HORIZONS:
        end = min(horizon, limit)
        count = max(0, 1 + math.floor(math.log(end / begin) / math.log(FACTOR))) if end > 0 else 0
        durations = np.asarray(begin * FACTOR ** np.arange(count), float)
        guesses = least_energy_guesses(lap, durations, per_lap=COARSE)
        if horizon >= limit or (guesses.durations.size and needed(guesses) <= horizon):
            break
    return guesses


def energy(ends: Ends, path: Path, peak: float = math.inf) -> float:
    """The integral of p^2 along a path of least energy under a bound, alpha2 = 1."""
    rate = np.minimum(switching(ends, path) / 2, peak) ** 2 * ends.weight(path.nodes)
    return float((rate[1:] + rate[:-1]).sum() * path.span / (2 * (rate.size - 1)))


def minima(guesses: Guesses, ratio: float, peak: float = math.inf) -> list[tuple[float, float]]:
    """Prices and durations of the guesses that cost less than their neighbours, the best first.

    Those whose mean thrust is not well below the bound do not count.
    """
    possible = guesses.energies <= (ROOM * peak) ** 2 * guesses.durations
    costs = np.where(possible, ratio * guesses.durations + guesses.energies, math.inf)
    inner = np.pad(costs, 1, constant_values=math.inf)
    least = possible & (costs <= inner[:-2]) & (costs <= inner[2:])
    return sorted(zip(costs[least].tolist(), guesses.durations[least].tolist(), strict=True))


def duration_of_thrust(guesses: Guesses, thrust: float) -> float:
    """The shortest duration for which the root mean square of a guess's thrust is this; inf if none is."""
    sizes = np.log(np.sqrt(guesses.energies / guesses.durations) / thrust)
    (low,) = np.nonzero(sizes <= 0)
    if low.size == 0:
        return math.inf
    pair = slice(max(low[0] - 1, 0), low[0] + 1)
    return float(np.exp(np.interp(0.0, -sizes[pair], np.log(guesses.durations[pair]))))


@dataclass(frozen=True)
class Ladder:
    """The transfers of free duration on a lap, or between ends in other coordinates.

    Attributes
    ----------
    ends : Ends
        The lap.
    cost : RunningCost
        alpha1 + p^2 under a bound.
    least_energy : function of a duration
        The transfer of least energy without a bound, from which a curve is begun.
    """

    ends: Ends
    cost: RunningCost
    least_energy: Callable[[float], Path]

    def price(self, path: Path) -> float:
        """The cost of a transfer."""
        return self.cost.time_weight * path.duration + energy(self.ends, path, self.cost.peak)

    def transfers(self, seeds: list[float], given_up: list[str], most: float = math.inf) -> list[Path]:
        """The transfers on the curves through some durations, the best first.

        Curves are followed, and transfers kept, while they cost less than ``most`` and `WORSE` times the
        best one. Why a curve was not begun, or a transfer not reached, is added to the list given.
        """
        found: list[Path] = []
        passed: list[tuple[float, float]] = []
        for duration in seeds[:SEEDS]:
            if any(shortest <= duration <= longest for shortest, longest in passed):
                continue
            try:
                start = bounded(self.ends, self.least_energy(duration), self.fixed, duration)
            except NotConverged as reason:
                given_up.append(f"from the duration {duration:.4g}: {reason}")
                continue
            reached = [duration]
            for end in (RANGE, -RANGE):
                for one, other in pairwise(self._with_turns(self._along(start, end, most, reached))):
                    if self._law(one) * self._law(other) > 0:
                        continue
                    try:
                        path = self._between(one, other)
                    except NotConverged as reason:
                        given_up.append(f"near the duration {math.exp(one.parameter):.4g}: {reason}")
                        continue
                    found.append(path)
                    most = min(most, WORSE * self.price(path))
            passed.append((min(reached), max(reached)))
        return sorted((path for path in found if self.price(path) < most), key=self.price)

    @property
    def fixed(self) -> RunningCost:
        """The cost of a transfer whose duration is fixed."""
        return replace(self.cost, time_weight=0.0)

    def _law(self, point: Point[None]) -> float:
        """S - alpha1 at the meeting."""
        gain, *_ = self.cost.gain(self.ends.square(Path.of(point.unknowns).nodes[:, -1]))
        return float(gain) - self.cost.time_weight

    def _at(self, logarithm: float) -> tuple[Ends, RunningCost, float]:
        return self.ends, self.fixed, math.exp(logarithm)

    def _along(self, start: Path, end: float, most: float, reached: list[float]) -> Iterator[Point[None]]:
        """Points of the curve in one direction, while they cost little; their durations are recorded."""
        begin = math.log(start.duration)
        for point in points(lambda x, _: self._at(x), start, begin, begin + end, STEPS):
            yield point
            path = Path.of(point.unknowns)
            reached.append(path.duration)
            most = min(most, WORSE * self.price(path))
            if self.price(path) > most:
                return

    def _with_turns(self, curve: Iterable[Point[None]]) -> Iterator[Point[None]]:
        """The points, and one more where the law turns before zero or just beyond it."""
        last: Point[None] | None = None
        here: Point[None] | None = None
        for following in curve:
            if here is not None:
                turn = None if last is None else self._turn(last, here, following)
                pair = [here] if turn is None else [here, turn]
                yield from sorted(
                    pair, key=lambda point: abs(point.parameter - following.parameter), reverse=True
                )
            last, here = here, following
        if here is not None:
            yield here

    def _turn(self, last: Point[None], here: Point[None], following: Point[None]) -> Point[None] | None:
        """The point where a parabola through three values of the law turns, if it turns near zero there."""
        near = [point.parameter - here.parameter for point in (last, here, following)]
        values = [self._law(point) for point in (last, here, following)]
        if min(values) * max(values) <= 0 or abs(values[1]) > min(abs(values[0]), abs(values[2])):
            return None
        bend, slope, value = np.polyfit(near, values, 2)
        shift = -slope / (2 * bend)
        if (value + slope * shift / 2) / value > NEAR:
            return None
        beyond = (shift > 0) == (near[2] > 0)
        logarithm = here.parameter + shift
        guess = between(here, following if beyond else last, logarithm)
        try:
            return Point(extremal(*self._at(logarithm), Path.of(guess), ROUGH).unknowns, logarithm, None)
        except NotConverged:
            return None

    def _between(self, one: Point[None], other: Point[None]) -> Path:
        """The transfer of free duration between two points of the curve, where the law changes its sign.

        While Newton's method does not end between them, the distance is shortened by a point of the curve;
        the last such point is returned if it never does.
        """
        for _ in range(SHORTENINGS):
            here, there = self._law(one), self._law(other)
            logarithm = one.parameter + here / (here - there) * (other.parameter - one.parameter)
            guess = Path.of(between(one, other, logarithm))
            try:
                found = extremal(self.ends, self.cost, None, guess, ROUGH)
                reached = math.log(found.duration)
                if (reached - one.parameter) * (reached - other.parameter) <= 0:
                    return found
            except NotConverged:
                pass
            middle = extremal(*self._at(logarithm), guess, ROUGH)
            point = Point(middle.unknowns, logarithm, None)
            one, other = (point, other) if self._law(point) * here > 0 else (one, point)
        return middle
