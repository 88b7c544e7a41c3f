"""The papers' worked examples: their optima by bounds from both sides, or by a closed form, as balls."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import sympy as sp
from flint import acb, arb

from pontryagin import averaging
from pontryagin.orbit_correction import correct, printed
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from pontryagin.triple_integrator import (
    Maneuver,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)
from studies.enclosures import gauges, norms
from studies.enclosures.ball import Enclosure, exact
from studies.enclosures.least_time import time
from studies.enclosures.powers import integral

X = sp.Symbol("x")
UNIT = Maneuver([0, 0, 0], [1, 0, 0], tf=1.0)
"""Examples 1 and 2 of Gorelov & Morozova with one radian in unit time, from rest to rest."""


def satellite(thrust: str) -> Enclosure:
    """The deviation at the end of section 7 of Ibragimov."""
    interval, peak = float(printed.INTERVAL), float(printed.PEAK)
    return gauges.correction(correct(printed.Z0, interval, peak, thrust))


def speed() -> Enclosure:
    """The cost of a change of speed, 2 sqrt(k) |v1 - v0|, section 3 of Akulenko."""
    found = averaging.smooth_example(1.0, 2.3, k=1.7)
    return closed(found.cost, 2 * exact(1.7).sqrt() * (exact(2.3) - 1))


def orbit() -> Enclosure:
    """The slow time from one Kepler orbit to another, sqrt(2/l) | |E1|^(1/2) - |E0|^(1/2) |, example 2."""
    found = averaging.kepler(-0.5, 0.95, -0.35, 0.1)
    return closed(found.duration, (2 / exact(0.1)).sqrt() * (exact(0.5).sqrt() - exact(0.35).sqrt()))


def even_rotor() -> Enclosure:
    """The slow time of a rotor of constant speed, sqrt(2) (sqrt(a1) - sqrt(a0)) over the peak, example 1."""
    return closed(averaging.rotor(1.0, 4.0, peak=0.7).duration, arb(2).sqrt() / exact(0.7))


def uneven_rotor() -> Enclosure:
    """The slow time of a rotor of varying mass m in a field V.

    It is the mean over x of the integral of sqrt(m / (2 (a - V))) over the energies a, divided by the peak.
    """
    found = averaging.rotor(1.0, 3.0, mass=1 + sp.cos(X) / 3, potential=-sp.cos(X + 1) / 2, peak=0.8)

    def integrand(x: acb, analytic: bool) -> acb:
        mass, potential = 1 + x.cos() / 3, -(x + 1).cos() / 2
        ends = [(a - potential).sqrt(analytic=analytic) for a in (acb(3), acb(1))]
        return (2 * mass).sqrt(analytic=analytic) * (ends[0] - ends[1])

    turn = 2 * arb.pi()
    return closed(found.duration, integral(integrand, arb(0), turn) / turn / exact(0.8))


def body() -> Enclosure:
    """The slow time in which a body loses its precession: a0 over the mean of the ellipse, example 3."""
    found = averaging.spin_down([0.3, 0.4, 1.2], [1.0, 0.5, 0.4], ratio=0.6)
    mean = acb(1 - exact(0.5) ** 2).elliptic_e().real * 2 / arb.pi()
    return closed(found.duration, (exact(0.3) ** 2 + exact(0.4) ** 2).sqrt() / mean)


def closed(value: Any, form: arb) -> Enclosure:
    """A value beside its closed form."""
    return Enclosure(float(value), form, form)


EXAMPLES: Mapping[str, Callable[[], Enclosure | None]] = {
    "turn of one radian, least energy": lambda: norms.energy(minimum_energy(UNIT)),
    "turn of one radian, least norm for q = 3": lambda: norms.power(minimum_norm(UNIT, 3.0)),
    "turn of one radian, least peak": lambda: norms.peak(minimum_peak(UNIT)),
    "turn of one radian, least total impulse": lambda: norms.impulse(minimum_impulse(UNIT)),
    "turn of one radian, least time": lambda: time(minimum_time([0, 0, 0], [1, 0, 0], 32.0)),
    **{f"satellite, gauge for the {thrust}": partial(satellite, thrust) for thrust in THRUSTS},
    "speed, cost": speed,
    "orbit, slow time": orbit,
    "rotor, slow time": even_rotor,
    "uneven rotor, slow time": uneven_rotor,
    "body, slow time": body,
}
"""The rendezvous has none: its problems are not convex, so that no bound on their optima is known."""
