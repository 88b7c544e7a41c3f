"""The first extremal in the elements, from coasting: A, B and phi of the goal are led to the target's.

The target's elements are constant, as the craft's are where it coasts: so the way from one orbit to another
is a straight line of A and B, and more or fewer revolutions are multiples of pi in phi.
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
"""Parts of a fixed duration from which it is reached."""


def coasting_angle(orbit: Elements, duration: float) -> float:
    """phi gained by coasting for a time, fM = 1: half the eccentric anomaly, by Kepler's equation."""
    A, B = np.asarray(orbit.u), np.asarray(orbit.w)
    pace = math.sqrt(2 * float(orbit.Q))
    square, other, mixed = float(A @ A), float(B @ B), float(A @ B)
    whole = square + other
    eccentricity = math.hypot(other - square, 2 * mixed) / whole
    begin = math.atan2(2 * mixed, other - square)
    mean = kepler.mean_anomaly(begin, eccentricity) + 4 * duration / (pace * whole)
    return float(kepler.eccentric_anomaly(mean, eccentricity) - begin) / 2


def nearest_elements(orbit: Elements, other: Elements) -> tuple[Array, float]:
    """Of all A and B (8,) that stand for another orbit, the nearest to those of one; phi in that phase.

    Both freedoms are angles, and the product of the two sets of elements is bilinear in their cosines and
    sines: the nearest pair is that of the largest singular value of two rows and two columns.
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
    """The extremal without bound, of the fixed duration or of a free one.

    Raises
    ------
    NotConverged
        When the families do not lead to it.
    """
    if setting.duration is not None:
        return meet(setting, least_energy(setting.scaled, setting.duration, revolutions).unknowns)
    duration = orbit_change_duration(setting.scaled, setting.ratio)
    return freed(SHOOTING, setting, least_energy(setting.scaled, duration, revolutions))


def cold_start(
    scaled: Scaled, duration: float, revolutions: int = 0, taylor: bool | None = None
) -> Root[ElementFlight]:
    """The unbounded extremal of alpha1 + alpha2 p^2 and a fixed time that coasting leads to.

    Parameters
    ----------
    scaled : Scaled
        The problem.
    duration : float
        t_k.
    revolutions : int
        How many more than the number nearest to what the craft makes coasting.
    taylor : bool or None
        As for `pontryagin.numerics.flow.flow`.

    Raises
    ------
    NotConverged
        Where the extremal cannot follow the goal.
    """
    setting = ElementsSetting(scaled, UNBOUNDED, duration, taylor=taylor)
    phi = coasting_angle(start_of(scaled), duration)
    return lead_goal(setting, np.append(np.zeros(6), phi), revolutions)


def least_energy(
    scaled: Scaled, duration: float, revolutions: int = 0, taylor: bool | None = None
) -> Root[ElementFlight]:
    """The least-energy extremal of a fixed duration: `cold_start`, or from a shorter duration, stretched.

    Raises
    ------
    NotConverged
        Where none of the durations leads to the target.
    """
    setting = ElementsSetting(scaled, UNBOUNDED, duration, taylor=taylor)
    reason: NotConverged | None = None
    for share in SHARES:
        try:
            return stretched(SHOOTING, setting, cold_start(scaled, share * duration, revolutions, taylor))
        except NotConverged as failure:
            reason = reason or failure
    raise reason or NotConverged("no first extremal was found", float("inf"))


def lead_goal(setting: ElementsSetting, unknowns: Array, revolutions: int = 0) -> Root[ElementFlight]:
    """The meeting with the target, from an extremal whose end the goal starts from.

    A, B and phi of the goal, and the duration, go to those of the target along a straight line.

    Raises
    ------
    NotConverged
        Where the extremal cannot follow the goal, or the target would be met before the start.
    """
    scaled, duration = setting.scaled, float(setting.duration or 0)
    flight = fly_elements(scaled, unknowns[:6], float(unknowns[6]), setting.law, setting.taylor)
    here, begin = flight.end[:8], flight.duration
    state = target_by_kepler(scaled, 0.0)
    target = Elements.from_state(state[:3], state[3:])
    there, origin = nearest_elements(Elements(here[:4], here[4:]), target)
    phi = origin + coasting_angle(target, duration)
    phi += math.pi * (round((flight.phi - phi) / math.pi) + revolutions)
    if phi <= 0:
        raise NotConverged("the target cannot be reached in so few revolutions", 1.0)

    def family(share: float) -> ElementsSetting:
        between = here + share * (there - here)
        goal = place(between[:4], between[4:], flight.phi + share * (phi - flight.phi))
        return ElementsSetting(
            scaled,
            setting.law,
            begin + share * (duration - begin),
            lambda _: (goal, np.zeros(6)),
            setting.taylor,
        )

    root = lead(family, Root(unknowns, equations(family(0.0), unknowns)), 0.0, 1.0)
    return meet(setting, root.unknowns)
