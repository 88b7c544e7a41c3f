"""First extremals in the elements: A, B and phi of the goal are led to the target's, by shares.

The target's elements are constant, as the craft's are where it coasts: so the way from one orbit to another
is a straight line of A and B, and more or fewer revolutions are multiples of pi in phi.
"""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics import kepler
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous.elements.elements import (
    I1,
    Elements,
    place,
)
from pontryagin.rendezvous.elements.flight import (
    fly_elements,
    start_of,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.elements.shooting import (
    Root,
    Setting,
    equations,
    follow,
    newton,
)
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

UNBOUNDED = Law("square", 1.0, np.inf)
SHARES = (1.0, 0.6, 0.4, 0.25)
"""Parts of the duration from which it is reached."""


def coasted(orbit: Elements, duration: float) -> float:
    """phi gained by coasting for a time, fM = 1: half the eccentric anomaly, by Kepler's equation."""
    A, B = np.asarray(orbit.u), np.asarray(orbit.w)
    pace = math.sqrt(2 * float(orbit.Q))
    square, other, mixed = float(A @ A), float(B @ B), float(A @ B)
    whole = square + other
    eccentricity = math.hypot(other - square, 2 * mixed) / whole
    begin = math.atan2(2 * mixed, other - square)
    mean = kepler.mean_anomaly(begin, eccentricity) + 4 * duration / (pace * whole)
    return float(kepler.eccentric_anomaly(mean, eccentricity) - begin) / 2


def aligned(orbit: Elements, other: Elements) -> tuple[Array, float]:
    """A and B (8,) of another orbit, turned and in the phase in which they come nearest; its phi there.

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


def cold(scaled: Scaled, duration: float, revolutions: int = 0, taylor: bool | None = None) -> Root:
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
        When the goal gets no farther with the extremal behind it.
    """
    setting = Setting(scaled, UNBOUNDED, duration, taylor=taylor)
    phi = coasted(start_of(scaled), duration)
    return led(setting, np.append(np.zeros(6), phi), revolutions)


def energy(scaled: Scaled, duration: float, revolutions: int = 0, taylor: bool | None = None) -> Root:
    """`cold`, or where that fails at a shorter duration, which is then stretched.

    Raises
    ------
    NotConverged
        When neither reaches the target.
    """

    def stretched(share: float) -> Setting:
        return Setting(scaled, UNBOUNDED, share * duration, taylor=taylor)

    reason: NotConverged | None = None
    for share in SHARES:
        try:
            root = cold(scaled, share * duration, revolutions, taylor)
            return follow(stretched, root, share, 1.0)
        except NotConverged as failure:
            reason = reason or failure
    raise reason or NotConverged("no first extremal was found", float("inf"))


def led(setting: Setting, unknowns: Array, revolutions: int = 0) -> Root:
    """The meeting to which the goal is led from where an extremal ends, the duration along with it."""
    scaled, duration = setting.scaled, float(setting.duration or 0)
    flight = fly_elements(scaled, unknowns[:6], float(unknowns[6]), setting.law, setting.taylor)
    here, begin = flight.end[:8], flight.duration
    state = target_by_kepler(scaled, 0.0)
    target = Elements.from_state(state[:3], state[3:])
    there, origin = aligned(Elements(here[:4], here[4:]), target)
    phi = origin + coasted(target, duration)
    phi += math.pi * (round((flight.phi - phi) / math.pi) + revolutions)
    if phi <= 0:
        raise NotConverged("the target cannot be reached in so few revolutions", 1.0)

    def family(share: float) -> Setting:
        between = here + share * (there - here)
        goal = place(between[:4], between[4:], flight.phi + share * (phi - flight.phi))
        return Setting(
            scaled,
            setting.law,
            begin + share * (duration - begin),
            lambda _: (goal, np.zeros(6)),
            setting.taylor,
        )

    root = follow(family, Root(unknowns, equations(family(0.0), unknowns)), 0.0, 1.0)
    return newton(setting, root.unknowns)


def marched(scaled: Scaled, law: Law, root: Root, taylor: bool | None = None) -> Root:
    """The duration changed until the terminal law holds.

    Raises
    ------
    NotConverged
        Where it does not within the durations looked at.
    """

    def family(logarithm: float) -> Setting:
        return Setting(scaled, law, math.exp(logarithm), taylor=taylor)

    def law_at(root: Root) -> float:
        free = Setting(scaled, law, taylor=taylor)
        return float(equations(free, root.unknowns).residual[-1])

    at = math.log(root.flight.duration)
    value = law_at(root)
    sense, step = math.copysign(1.0, value), 0.1
    for _ in range(40):
        try:
            there = follow(family, root, at, at + sense * step)
        except NotConverged:
            step /= 4
            if step < 1e-3:
                break
            continue
        following = law_at(there)
        if following * value <= 0:
            share = value / (value - following)
            guess = root.unknowns + share * (there.unknowns - root.unknowns)
            return newton(Setting(scaled, law, taylor=taylor), guess)
        root, at, value = there, at + sense * step, following
        step = min(0.3, 1.5 * step)
    raise NotConverged("the terminal law was not met along the durations", abs(value))
