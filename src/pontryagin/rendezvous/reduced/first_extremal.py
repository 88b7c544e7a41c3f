"""A first extremal of the unbounded problem, from which all others are reached.

Of a fixed duration it is led there from coasting, or at a shorter one, which is then stretched. Of a free
one a guess of the duration is marched until the terminal law holds.
"""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.homotopy import (
    Point,
    Root,
    between,
    follow,
    newton,
)
from pontryagin.rendezvous.reduced.search_log import Search
from pontryagin.rendezvous.reduced.shooting import (
    Equations,
    Setting,
    equations,
)
from pontryagin.rendezvous.reduced.start import (
    ballistic_lead,
    coasting_twist,
    cold_start,
)
from pontryagin.rendezvous.witness.cartesian import (
    cartesian_of,
    target_by_kepler,
)

TAU = 2 * math.pi
SHORT = 0.5
"""A free duration shorter than this, by the gap between craft and target, is tried first."""
STRETCHED = (1.0, 0.6, 0.4, 0.2)
"""Parts of a fixed duration from which it is reached."""
GUESSED = (1.0, 1.5, 0.7, 2.5, 0.4)
"""Multiples of a guessed duration that are tried."""
TOGETHER = 1e-8
"""Distance and difference of velocities, in units of the target's orbit, that rounding leaves nothing of."""


def first_duration(scaled: Scaled, ratio: float) -> float:
    """A duration in which thrust of about sqrt(alpha1/alpha2) changes one orbit into the other."""
    radius, radial, areal = scaled.start
    energy_gap = abs(
        math.sqrt(max(2 / radius - radial**2 - (areal / radius) ** 2, 1e-3))
        - math.sqrt(1 - scaled.eccentricity**2)
    )
    eccentricity = math.hypot(areal**2 / radius - 1, areal * radial)
    tilt = 2 * math.asin(min(1.0, float(np.hypot(*scaled.orientation[1:3]))))
    speed = energy_gap + abs(eccentricity - scaled.eccentricity) / 2 + tilt
    return min(max(2.0, speed / math.sqrt(ratio)), 400.0)


def gap(scaled: Scaled) -> tuple[float, float]:
    """How far craft and target are from each other at t0, and the difference of their velocities."""
    craft = cartesian_of(scaled.start, np.array([1.0, 0, 0, 0]))
    between = target_by_kepler(scaled, 0.0) - craft
    return float(np.linalg.norm(between[:3])), float(np.linalg.norm(between[3:]))


def require_apart(scaled: Scaled) -> None:
    """Raise unless there is something to be done before craft and target go on as one.

    Raises
    ------
    ValueError
        If they are at one place with one velocity at t0.
    """
    place, velocity = gap(scaled)
    if max(place, velocity) < TOGETHER:
        raise ValueError(
            "chaser must not be with the target at t0 where the duration is free: the meeting is then at "
            f"t0, and costs nothing; got a distance of {place:.3g} and velocities that differ by "
            f"{velocity:.3g}, in units of the target's orbit"
        )


def short_duration(scaled: Scaled, ratio: float) -> float:
    """In which thrust of about sqrt(alpha1/alpha2) closes the gap as if nothing attracted."""
    place, velocity = gap(scaled)
    return 2 * math.sqrt(place / math.sqrt(ratio)) + velocity / math.sqrt(ratio)


def first(setting: Setting, log: Search) -> Root:
    """An extremal of the unbounded problem, of the fixed duration or of a free one."""
    for duration in _first_durations(setting):
        log.durations.append(duration)
        for extra in (0, 1, -1, 2, -2):
            turns = _even_turns(setting.scaled, duration) + extra
            try:
                root = cold_start(setting.but(duration=duration), turns)
                return _stretched(setting, root) if setting.duration else _free(setting, root)
            except NotConverged as reason:
                asked = duration * setting.scaled.time
                log.given_up.append(f"start with the duration {asked:.3g}, {turns} turns: {reason}")
    raise NotConverged("no first extremal was found", float("inf"))


def _first_durations(setting: Setting) -> list[float]:
    """To start from: the fixed one and shorter ones, or guesses of a free one."""
    if setting.duration:
        return [share * setting.duration for share in STRETCHED]
    usual, short = (guess(setting.scaled, setting.ratio) for guess in (first_duration, short_duration))
    stretches = [usual * stretch for stretch in GUESSED]
    return [short, *stretches] if short < SHORT else stretches


def _stretched(setting: Setting, root: Root) -> Root:
    """The extremal of the fixed duration on the family through one of a shorter duration."""
    wanted = float(setting.duration or 0)
    if root.flight.duration == wanted:
        return root
    end = math.log(wanted)
    last: Point | None = None
    for point in _over_durations(setting.but(ratio=1.0), root, 1.0):
        if last is not None and point.parameter >= end:
            return newton(setting, between(last, point, end))
        last = point
    raise NotConverged("the duration could not be stretched", float("inf"))


def _even_turns(scaled: Scaled, duration: float) -> int:
    """Revolutions that let the craft turn halfway between what it and the target would turn coasting."""
    wanted = ballistic_lead(scaled, duration) / 2
    return round((wanted - coasting_twist(scaled, duration)) / TAU)


def _free(setting: Setting, fixed: Root) -> Root:
    """March the duration from a fixed-time extremal until the terminal law holds."""
    last: Point | None = None
    for point in marched(setting, fixed):
        if last is not None and last.equations.residual[-1] * point.equations.residual[-1] <= 0:
            share = last.equations.residual[-1] / (last.equations.residual[-1] - point.equations.residual[-1])
            whole = [np.append(p.unknowns, math.exp(p.parameter)) for p in (last, point)]
            return newton(setting, whole[0] + share * (whole[1] - whole[0]))
        last = point
    raise NotConverged("the terminal law was not met along the durations", float("inf"))


def marched(setting: Setting, fixed: Root) -> Iterator[Point]:
    """The family of fixed-time extremals towards the terminal law, the last residual of a point."""
    law = equations(setting, np.append(fixed.unknowns, fixed.flight.duration)).residual[-1]
    yield from _over_durations(setting, fixed, float(np.sign(law)))


def _over_durations(setting: Setting, fixed: Root, sense: float) -> Iterator[Point]:
    """The family of fixed-time extremals over log t_k, first to longer ones or to shorter ones."""
    free = setting.but(duration=None, rough=True)

    def family(unknowns: Array, parameter: float) -> tuple[Equations, Array]:
        duration = math.exp(parameter)
        whole = equations(free, np.append(unknowns, duration))
        return whole, whole.jacobian[:6, 6] * duration

    start = math.log(fixed.flight.duration)
    yield from follow(family, fixed.unknowns, start, start + sense, rows=6)
