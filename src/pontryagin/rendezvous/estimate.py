"""Estimates made before any extremal is known: the gap between craft and target, durations."""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, Infeasible
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import cartesian_of, target_by_kepler

TOGETHER = 1e-8
"""Craft and target count as together below this distance and velocity difference, in the target's units."""
LONGEST = 400.0
"""Longest duration that is guessed, in units of sqrt(p*^3/fM)."""
SHORTEST = 2.0
"""Shortest duration guessed for changing one orbit into the other, in units of sqrt(p*^3/fM)."""


def gap(scaled: Scaled) -> tuple[float, float]:
    """Distance between craft and target at t0, and the difference of their velocities."""
    craft = cartesian_of(scaled.start, np.array([1.0, 0, 0, 0]))
    between = target_by_kepler(scaled, 0.0) - craft
    return float(np.linalg.norm(between[:3])), float(np.linalg.norm(between[3:]))


def require_rendezvous(problem: object) -> None:
    """Raise TypeError unless `problem` is a `Rendezvous`."""
    if not isinstance(problem, Rendezvous):
        raise ArgumentTypeError(f"problem must be of type Rendezvous, got {problem!r}", "problem")


def require_solvable(problem: Rendezvous) -> None:
    """Raise unless `problem` is a `Rendezvous` whose duration is fixed or has an optimum.

    Raises
    ------
    TypeError
        If `problem` is not a `Rendezvous`.
    Infeasible
        If the duration is free and costs nothing.
    ValueError
        If the duration is free and the craft is with the target at the start.
    """
    require_rendezvous(problem)
    if not problem.free:
        return
    if problem.time_weight == 0:
        raise Infeasible(
            "time_weight must be positive where the duration is free, got 0: a longer flight is always "
            "cheaper then, as the law p(t_k)^2 = alpha1/alpha2 requires no thrust at the meeting, and there "
            "is no best duration; give a duration or a positive time_weight",
            "time_weight",
        )
    _require_gap(problem.scaled)


def _require_gap(scaled: Scaled) -> None:
    """Raise if craft and target are already together at t0.

    Raises
    ------
    ValueError
        If they are at one place with one velocity at t0.
    """
    place, velocity = gap(scaled)
    if max(place, velocity) < TOGETHER:
        raise ArgumentValueError(
            "chaser must not be with the target at t0 where the duration is free, as the meeting is then at "
            f"t0 and costs nothing; got a distance of {place:.3g} and velocities that differ by "
            f"{velocity:.3g}, in units of the target's orbit",
            "chaser",
        )


def orbit_change_duration(scaled: Scaled, ratio: float) -> float:
    """A duration in which thrust of about sqrt(alpha1/alpha2) changes one orbit into the other."""
    radius, radial, areal = scaled.start
    energy_gap = abs(
        math.sqrt(max(2 / radius - radial**2 - (areal / radius) ** 2, 1e-3))
        - math.sqrt(1 - scaled.eccentricity**2)
    )
    tilt = 2 * math.asin(min(1.0, float(np.hypot(*scaled.orientation[1:3]))))
    speed = energy_gap + abs(eccentricity(scaled.start) - scaled.eccentricity) / 2 + tilt
    return min(max(SHORTEST, speed / math.sqrt(ratio)), LONGEST)


def gap_duration(scaled: Scaled, thrust: float) -> float:
    """A duration in which a thrust of this size closes the gap, with gravity neglected."""
    place, velocity = gap(scaled)
    return 2 * math.sqrt(place / thrust) + velocity / thrust


def eccentricity(start: Array) -> float:
    """The eccentricity of the craft's orbit, from r, v1, c in the units of `Scaled`."""
    radius, radial, areal = start
    return math.hypot(areal**2 / radius - 1, areal * radial)
