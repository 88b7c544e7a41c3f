"""The papers' worked examples: their optima by bounds from both sides, or by a closed form, as balls."""

from collections.abc import Mapping
from typing import Any

import sympy as sp
from flint import acb, arb

from pontryagin import averaging
from pontryagin.orbit_correction import correct, printed
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


def turn() -> Mapping[str, Enclosure | None]:
    """Examples 1 and 2 of Gorelov & Morozova: one radian in unit time, from rest to rest."""
    unit = Maneuver([0, 0, 0], [1, 0, 0], tf=1.0)
    return {
        "turn of one radian: least energy": norms.energy(minimum_energy(unit)),
        "turn of one radian: least peak": norms.peak(minimum_peak(unit)),
        "turn of one radian: least total impulse": norms.impulse(minimum_impulse(unit)),
        "turn of one radian: least norm, q = 3": norms.power(minimum_norm(unit, 3.0)),
        "turn of one radian: least time": time(minimum_time([0, 0, 0], [1, 0, 0], 32.0)),
    }


def satellite() -> Mapping[str, Enclosure | None]:
    """The deviation at the end of section 7 of Ibragimov, for each set of impulses."""
    given: dict[str, Any] = {"interval": float(printed.INTERVAL), "peak": float(printed.PEAK)}
    return {
        f"satellite of section 7: {thrust}": gauges.correction(correct(printed.Z0, thrust=thrust, **given))
        for thrust in ("ball", "disc", "box")
    }


def averaged() -> Mapping[str, Enclosure | None]:
    """Closed forms of Akulenko's examples: speed, orbit, rotor, body."""
    flywheel = averaging.smooth_example(1.0, 2.3, k=1.7)
    orbit = averaging.kepler(-0.5, 0.95, -0.35, 0.1)
    even = averaging.rotor(1.0, 4.0, peak=0.7)
    uneven = averaging.rotor(1.0, 3.0, mass=1 + sp.cos(X) / 3, potential=-sp.cos(X + 1) / 2, peak=0.8)
    body = averaging.spin_down([0.3, 0.4, 1.2], [1.0, 0.5, 0.4], ratio=0.6)
    spent = exact(2.3) - 1
    paid = (2 / exact(0.1)).sqrt() * (exact(0.5).sqrt() - exact(0.35).sqrt())
    slope = arb(2).sqrt() / exact(0.7)
    size = (exact(0.3) ** 2 + exact(0.4) ** 2).sqrt()
    mean = acb(1 - exact(0.5) ** 2).elliptic_e().real * 2 / arb.pi()
    return {
        "speed, section 3: cost": closed(flywheel.cost, 2 * exact(1.7).sqrt() * spent),
        "orbit, example 2: slow time": closed(orbit.duration, paid),
        "orbit, example 2: cost": closed(orbit.cost, 2 * exact(0.1) * paid),
        "rotor, example 1: slow time": closed(even.duration, slope),
        "rotor of uneven mass in a field: slow time": closed(uneven.duration, _uneven()),
        "body, example 3: slow time": closed(body.duration, size / mean),
    }


def closed(value: Any, form: arb) -> Enclosure:
    """A value beside its closed form."""
    return Enclosure(float(value), form, form)


def _uneven() -> arb:
    """The mean over x of the integral of sqrt(m / (2 (a - V))) over the energies a, divided by the peak."""

    def integrand(x: acb, analytic: bool) -> acb:
        mass, potential = 1 + x.cos() / 3, -(x + 1).cos() / 2
        ends = [(a - potential).sqrt(analytic=analytic) for a in (acb(3), acb(1))]
        return (2 * mass).sqrt(analytic=analytic) * (ends[0] - ends[1])

    turn = 2 * arb.pi()
    return integral(integrand, arb(0), turn) / turn / exact(0.8)


def worked() -> dict[str, Enclosure | None]:
    """All of them. The rendezvous has none: its problems are not convex, so that no bound is known."""
    return {**turn(), **satellite(), **averaged()}
