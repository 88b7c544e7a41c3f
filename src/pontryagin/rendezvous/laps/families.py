"""Continuation of a transfer on a lap: to the target, to a bound, to least time.

Each continuation follows transcribed extremals over one parameter, with guesses by the secant. Its points are
guesses for the next and, at its end, for Newton's method on flights, so that a rough correction suffices.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain, pairwise

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, march
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps import folds
from pontryagin.rendezvous.laps.ends import Ends
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.laps.hamiltonian import Cost, RunningCost
from pontryagin.rendezvous.laps.power import PowerCost
from pontryagin.rendezvous.laps.start import least_energy_guesses
from pontryagin.rendezvous.laps.transcription import NODES_PER_LAP, ROUGH, Path, extremal, refined, switching

LEAST_ENERGY = RunningCost(0.0, 1.0, math.inf)
SHARES = (1.0, 0.5, 0.2, 0.05)
"""Shares of the way to the target's orbit at which a guess is tried."""
TRIES, GROWTH = 120, 2.0
"""How many steps of a continuation are tried, and the factor by which one grows after a success."""
FIRST, LARGEST, LEAST = 0.5, 1.0, 1 / 16
"""First, largest and least step of a continuation whose end is wanted, in units of its length."""
FINEST = 1 / 512
"""The least step where no other start is tried, as for a fixed duration."""

LATE = 0.2
"""Value of theta from which the time of the meeting is free on the way to least time."""
FASTEST, CLOSE = 0.1, 0.05
"""Largest change of the logarithm of a duration in one step; a mean thrust whose logarithm is near enough."""
PACE = 0.05, 0.15, 0.01
"""First, largest and least step of the logarithm of a duration on the way to a mean thrust."""

Posed = Callable[[float, Path], tuple[Ends, Cost, float | None]]
"""A function of the parameter and a guess.

It returns the ends, a cost, and the duration, which is None if it is free.
"""


def points(
    posed: Posed, path: Path, begin: float, end: float, steps: tuple[float, float, float]
) -> Iterator[Point[None]]:
    """Roughly corrected extremals from one value of the parameter towards another.

    The first step, the largest and the one below which the continuation ends are given.
    """
    first, largest, least = steps

    def at(parameter: float, guess: Array) -> Point[None]:
        near = Path.of(guess)
        with np.errstate(invalid="ignore"):  # A guess by the secant may leave the ellipses.
            ends, cost, duration = posed(parameter, near)
        return Point(extremal(ends, cost, duration, near, ROUGH).unknowns, parameter, None)

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


def continued(posed: Posed, path: Path, begin: float, end: float, name: str, least: float = LEAST) -> Path:
    """The extremal at the last value of a parameter with a name, from that at the first.

    The continuation ends at steps below ``least``, in units of its length.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    way = abs(end - begin)
    *_, last = points(posed, path, begin, end, (FIRST * way, LARGEST * way, least * way))
    if last.parameter != end:
        left = abs(end - last.parameter) / way
        raise NotConverged(f"the walk over {name} broke off at {1 - left:.0%} of its length", left)
    return Path.of(last.unknowns)


def stretched(ends: Ends, path: Path, duration: float, round_folds: bool) -> Path:
    """The extremal of least energy of another duration; if wanted, the walk goes on round folds.

    Raises
    ------
    NotConverged
        If the walk breaks off, or has taken too many steps.
    """
    begin, end = math.log(path.duration), math.log(duration)
    way = abs(end - begin)
    steps = FIRST * way, LARGEST * way, LEAST * way
    walk = [*points(lambda x, _: (ends, LEAST_ENERGY, math.exp(x)), path, begin, end, steps)]
    passed = [Path.of(point.unknowns) for point in walk]
    if walk[-1].parameter == end:
        return passed[-1]
    onward = round_folds and len(passed) > 1
    beyond = folds.along(ends, LEAST_ENERGY, *passed[-2:]) if onward else iter(())
    for one, other in pairwise(chain(passed[-1:], beyond)):
        if (one.duration - duration) * (other.duration - duration) <= 0:
            share = (duration - one.duration) / (other.duration - one.duration)
            guess = Path.of(one.unknowns + share * (other.unknowns - one.unknowns))
            return extremal(ends, LEAST_ENERGY, duration, guess, ROUGH)
        passed.append(other)
    farthest = passed[-1].duration
    raise NotConverged(
        f"the walk over the duration broke off at {farthest:.4g}, before {duration:.4g}",
        abs(math.log(farthest / duration)),
    )


def least_energy(lap: Lap, duration: float, least: float = LEAST) -> Path:
    """The extremal of least energy, without a bound, of a fixed duration.

    If it is not reached from a guess, that for a nearer goal is continued, by steps down to ``least``: the
    goal moves from the craft's orbit to the target's, at the same longitude.

    Raises
    ------
    NotConverged
        If it is not reached.
    """
    end = float(lap.longitude(duration)[0])
    coasting = _coasting_time(lap, end)
    reason = NotConverged("the meeting is not ahead of the craft", math.inf)

    def nearer(share: float) -> tuple[Lap, Cost, float]:
        if share == 1.0:
            return lap, LEAST_ENERGY, duration
        goal = lap.start[:5] + share * (lap.goal - lap.start[:5])
        return replace(lap, goal=goal, end=end), LEAST_ENERGY, coasting + share * (duration - coasting)

    for share in SHARES:
        near, _, time = nearer(share)
        guesses = least_energy_guesses(near, np.array([time]))
        if guesses.durations.size:
            try:
                start = extremal(*nearer(share), guesses.path(0), ROUGH)
                if share == 1:
                    return start
                return continued(lambda x, _: nearer(x), start, share, 1.0, "the way to the target", least)
            except NotConverged as failure:
                reason = failure
    raise reason


def least_energy_by_way_of(
    lap: Lap,
    duration: float,
    other: float,
    share: float = 1.0,
    per_lap: int = NODES_PER_LAP,
    round_folds: bool = False,
) -> Path:
    """The extremal of least energy, without a bound, of a fixed duration, continued from another duration.

    It begins with planes that are inclined by a share of their angle. Extremals that climb to turn their
    plane there are reached in this way from those of lesser inclinations.

    Raises
    ------
    NotConverged
        If none of the other duration is reached from a guess, or a continuation ends before.
    """
    lower = tilted(lap, share)
    guesses = least_energy_guesses(lower, np.array([other]), per_lap=per_lap)
    if not guesses.durations.size:
        raise NotConverged("the meeting is not ahead of the craft", math.inf)
    path = extremal(lower, LEAST_ENERGY, other, guesses.path(0), ROUGH)
    path = stretched(lower, path, duration, round_folds)
    if share == 1.0:
        return path
    way = "the inclination"
    return continued(lambda x, _: (tilted(lap, x), LEAST_ENERGY, duration), path, share, 1.0, way)


def tilted(lap: Lap, share: float) -> Lap:
    """The lap with its two planes inclined by a share of their angle, both alike."""
    size = float(np.hypot(*lap.start[3:5]))
    factor = math.tan(share * math.atan(size)) / size if size else 1.0
    scale = np.array([1.0, 1.0, 1.0, factor, factor, 1.0])
    return replace(lap, start=scale * lap.start, goal=scale[:5] * lap.goal)


def _coasting_time(lap: Lap, end: float) -> float:
    """The time in which the craft coasts to a longitude."""
    longitude = (np.arange(200) + 0.5) * end / 200
    p, f, g = lap.start[:3]
    return float(kernels.equinoctial_weight(p, f, g, longitude).sum()) * end / 200


def bounded(ends: Ends, path: Path, cost: RunningCost, duration: float | None) -> Path:
    """The extremal under a bound, from one without.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    largest = float(switching(ends, path).max()) / (2 * cost.energy_weight)
    if largest <= cost.peak:
        return path

    def posed(logarithm: float, _: Path) -> tuple[Ends, Cost, float | None]:
        return ends, replace(cost, peak=math.exp(logarithm)), duration

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


def least_time(ends: Ends, path: Path, peak: float, least: float = LEAST, doublings: int = 0) -> Path:
    """The extremal of least time under a bound, from one of least energy, by steps down to ``least``.

    At its end the number of intervals is doubled so many times.

    First the duration is changed until the mean thrust is the bound. It is kept there by the duration, while
    the exponent of the mean grows. Then the exponent grows without limit, while the meeting's time is free.

    Raises
    ------
    NotConverged
        If a continuation ends before.
    """

    def posed(theta: float, guess: Path) -> tuple[Ends, Cost, float]:
        cost = PowerCost(theta, peak)
        mean, slope = cost.mean_thrust(ends, guess)
        return ends, cost, guess.duration * math.exp(float(np.clip(-mean / slope, -FASTEST, FASTEST)))

    path = _of_mean_thrust(ends, PowerCost(0.5, peak), _scaled(path, 1 / (2 * peak**2)), doublings > 0)
    name = "the exponent of the thrust"
    path = continued(posed, path, 0.5, LATE, name, least)
    end = float(switching(ends, path)[-1])
    path = continued(lambda theta, _: (ends, PowerCost(theta, peak, end), None), path, LATE, 0.0, name, least)
    path = refined(ends, PowerCost(0.0, peak, end), None, path, doublings)
    return _scaled(path, 1 / (peak * end))


def _of_mean_thrust(ends: Ends, cost: PowerCost, path: Path, round_folds: bool) -> Path:
    """The extremal whose mean thrust is the bound, from one of another duration."""
    begin, (mean, _) = math.log(path.duration), cost.mean_thrust(ends, path)
    end = begin + math.copysign(1.0, mean)
    passed: list[Path] = []
    for point in points(lambda logarithm, _: (ends, cost, math.exp(logarithm)), path, begin, end, PACE):
        passed.append(Path.of(point.unknowns))
        if cost.mean_thrust(ends, passed[-1])[0] * math.copysign(1.0, mean) < CLOSE:
            return passed[-1]
    if round_folds and len(passed) > 1:
        for here in folds.along(ends, cost, *passed[-2:]):
            if abs(cost.mean_thrust(ends, here)[0]) < CLOSE:
                return here
    raise NotConverged("the mean thrust does not reach the bound along the duration", abs(mean))


def _scaled(path: Path, factor: float) -> Path:
    """A path with all costates multiplied."""
    nodes = path.nodes.copy()
    nodes[6:] *= factor
    return replace(path, nodes=nodes, price=path.price * factor)
