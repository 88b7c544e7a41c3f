"""The first extremal in the elements: the goal's A, B, phi move from the coasting craft to the target.

The elements of the target and of the coasting craft are constant. The path from one orbit to the other is
therefore a straight line in A and B, and more or fewer revolutions are multiples of pi in phi.
"""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics import kepler
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous.elements.conditions import ElementsSetting, equations
from pontryagin.rendezvous.elements.elements import (
    I1,
    Elements,
    place,
)
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
    fly_elements,
    start_of,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.elements.shooting import SHOOTING, lead, meet
from pontryagin.rendezvous.estimate import orbit_change_duration
from pontryagin.rendezvous.families import freed, stretched
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.root import Root
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

UNBOUNDED = Law("square", 1.0, np.inf)
"""The law of the problem without bound whose duration is fixed."""
SHARES = (1.0, 0.6, 0.4, 0.25)
"""Shares of a fixed duration at which a first extremal is sought, to be stretched to that duration."""


def coasting_angle(orbit: Elements, duration: float) -> float:
    """Growth of phi (half the eccentric anomaly) over a time of coasting, by Kepler's equation; fM = 1."""
    A, B = np.asarray(orbit.u), np.asarray(orbit.w)
    pace = math.sqrt(2 * float(orbit.Q))
    square, other, mixed = float(A @ A), float(B @ B), float(A @ B)
    whole = square + other
    eccentricity = math.hypot(other - square, 2 * mixed) / whole
    begin = math.atan2(2 * mixed, other - square)
    mean = kepler.mean_anomaly(begin, eccentricity) + 4 * duration / (pace * whole)
    return float(kepler.eccentric_anomaly(mean, eccentricity) - begin) / 2


def nearest_elements(orbit: Elements, other: Elements) -> tuple[Array, float]:
    """Of all A and B (8,) that describe another orbit, those nearest to the first; phi of that choice.

    A and B of an orbit are determined up to two angles: a turn of both together and the phase of phi. The
    scalar product of the two sets of elements is bilinear in the cosines and sines of these angles, so that
    the nearest choice belongs to the largest singular value of a 2 by 2 matrix.
    """
    here = np.concatenate([orbit.A, orbit.B])
    u, w = np.asarray(other.u), np.asarray(other.w)
    moved = {
        (turn, phase): np.concatenate([product(I1, x) if turn else x for x in pair])
        for turn in (0, 1)
        for phase, pair in ((0, (u, w)), (1, (w, -u)))
    }
    table = np.array([[here @ moved[turn, phase] for phase in (0, 1)] for turn in (0, 1)])
    left, _, right = np.linalg.svd(table)
    (cos, sin), (cos_phase, sin_phase) = left[:, 0], right[0]
    nearest = sum(
        x * y * moved[turn, phase]
        for turn, x in enumerate((cos, sin))
        for phase, y in enumerate((cos_phase, sin_phase))
    )
    return np.asarray(nearest), -math.atan2(sin_phase, cos_phase)


def unbounded(setting: ElementsSetting, revolutions: int = 0) -> Root[ElementFlight]:
    """The extremal without bound, with the fixed duration or a free one.

    Raises
    ------
    NotConverged
        If it is not reached by any of the families.
    """
    if setting.duration is not None:
        return meet(setting, least_energy(setting.scaled, setting.duration, revolutions).unknowns)
    duration = orbit_change_duration(setting.scaled, setting.ratio)
    return freed(SHOOTING, setting, least_energy(setting.scaled, duration, revolutions))


def cold_start(scaled: Scaled, duration: float, revolutions: int = 0) -> Root[ElementFlight]:
    """The unbounded extremal of alpha1 + alpha2 p^2 for a fixed duration, by continuation from coasting.

    Parameters
    ----------
    scaled : Scaled
        The problem.
    duration : float
        t_k.
    revolutions : int
        Revolutions in addition to the number nearest to that of the coasting craft.

    Raises
    ------
    NotConverged
        If the extremal cannot follow the goal.
    """
    setting = ElementsSetting(scaled, UNBOUNDED, duration)
    phi = coasting_angle(start_of(scaled), duration)
    return lead_goal(setting, np.append(np.zeros(6), phi), revolutions)


def least_energy(scaled: Scaled, duration: float, revolutions: int = 0) -> Root[ElementFlight]:
    """The least-energy extremal of a fixed duration, by `cold_start` or stretched from a shorter duration.

    Raises
    ------
    NotConverged
        If the target is reached from none of the durations tried.
    """
    setting = ElementsSetting(scaled, UNBOUNDED, duration)
    reason: NotConverged | None = None
    for share in SHARES:
        try:
            return stretched(SHOOTING, setting, cold_start(scaled, share * duration, revolutions))
        except NotConverged as failure:
            reason = reason or failure
    raise reason or NotConverged("no extremal was found from which to continue", float("inf"))


def lead_goal(setting: ElementsSetting, unknowns: Array, revolutions: int = 0) -> Root[ElementFlight]:
    """The meeting with the target, by moving the goal from the end of a given extremal to the target.

    A, B and phi of the goal and the duration change along a straight line to those of the meeting.

    Raises
    ------
    NotConverged
        If the extremal cannot follow the goal, or the target would be met before the start.
    """
    scaled, duration = setting.scaled, float(setting.duration or 0)
    flight = fly_elements(scaled, unknowns[:6], float(unknowns[6]), setting.law)
    here, begin = flight.end[:8], flight.duration
    state = target_by_kepler(scaled, 0.0)
    target = Elements.from_state(state[:3], state[3:])
    there, origin = nearest_elements(Elements(here[:4], here[4:]), target)
    phi = origin + coasting_angle(target, duration)
    phi += math.pi * (round((flight.phi - phi) / math.pi) + revolutions)
    if phi <= 0:
        raise NotConverged(
            f"revolutions must be larger, got {revolutions}: the target would be met before the start", 1.0
        )

    def family(share: float) -> ElementsSetting:
        between = here + share * (there - here)
        goal = place(between[:4], between[4:], flight.phi + share * (phi - flight.phi))
        return ElementsSetting(
            scaled,
            setting.law,
            begin + share * (duration - begin),
            lambda _: (goal, np.zeros(6)),
        )

    root = lead(family, Root(unknowns, equations(family(0.0), unknowns)), 0.0, 1.0)
    return meet(setting, root.unknowns)
