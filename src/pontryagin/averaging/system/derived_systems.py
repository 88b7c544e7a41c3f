"""The paper's examples as phase systems, with the rates and averages that `derivation` finds."""

import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.averaging.derivation import kepler as orbit
from pontryagin.averaging.derivation import kepler_phase, kepler_principle
from pontryagin.averaging.derivation import rigid_body as body
from pontryagin.averaging.derivation import rotor as rotor_case
from pontryagin.averaging.derivation import smooth as smooth_case
from pontryagin.averaging.system.control_sets import Ball, Ellipsoid, Quadratic
from pontryagin.averaging.system.model import Model
from pontryagin.averaging.system.phase_system import PhaseSystem

RIPPLE, SENSE = sp.symbols("ripple sense", real=True)
PRICE, PEAK = sp.symbols("k peak", positive=True)


class DerivedSystem(NamedTuple):
    """A phase system with example values of its numbers, and h0 if a derivation gives it in closed form."""

    system: PhaseSystem
    averaged: sp.Expr | None = None


def final_value(name: str) -> sp.Symbol:
    """The symbol of the value that a slow variable is brought to."""
    return sp.Symbol(name, real=True)


def smooth() -> DerivedSystem:
    """Smooth example of section 3, with a force of mean zero, at the cost rate k + u^2.

    v' = epsilon (u + ripple cos x), x' = v.
    """
    v, x, u = smooth_case.v, smooth_case.x, smooth_case.u
    acceleration, cost_rate = smooth_case.slow_rates(RIPPLE * sp.cos(x))
    system = PhaseSystem(
        f=[acceleration],
        omega=smooth_case.anomaly_rate(),
        control_set=Quadratic(),
        slow=[v],
        control=[u],
        phase=x,
        target=[v - final_value("v1")],
        running_cost=cost_rate.subs(u, 0),
        numbers={final_value("v1"): 2.0, smooth_case.k: 1.0, RIPPLE: 0.0},
    )
    return DerivedSystem(system)


def kepler() -> DerivedSystem:
    """Example 2, (3.6) and (3.7), in energy, angular momentum and the eccentric anomaly.

    The true anomaly of (3.6) is replaced by the eccentric one xi, whose rate follows from that of the mean
    anomaly psi = xi - e sin xi.
    """
    E, K, e, xi = orbit.energy, orbit.momentum, orbit.e, orbit.eccentric
    rates = orbit.element_rates()
    mean_anomaly = kepler_phase.mean_anomaly()
    weight = mean_anomaly.diff(xi)
    phase_rate = kepler_phase.mean_anomaly_rate().subs(
        {kepler_phase.eccentricity_rate: rates[orbit.e], kepler_phase.pericentre_rate: rates[orbit.gamma]}
    )
    eccentric_rate = (phase_rate - orbit.mean_motion() - mean_anomaly.diff(e) * rates[orbit.e]) / weight

    def in_eccentric_anomaly(expression: sp.Expr) -> sp.Expr:
        per_control = [sp.expand(expression).coeff(u) / orbit.epsilon for u in orbit.CONTROL]
        return sum((_substituted(c) * u for c, u in zip(per_control, orbit.CONTROL, strict=True)), sp.S.Zero)

    system = PhaseSystem(
        f=[in_eccentric_anomaly(rates[E]), in_eccentric_anomaly(rates[K])],
        omega=orbit.mean_motion(),
        control_set=Quadratic(),
        slow=[E, K],
        control=list(orbit.CONTROL),
        phase=xi,
        target=[E - final_value("E1")],
        running_cost=kepler_principle.price,
        phase_rate=in_eccentric_anomaly(eccentric_rate),
        weight=orbit.in_slow_variables(weight),
        numbers={final_value("E1"): -0.35, kepler_principle.price: 0.1},
    )
    return DerivedSystem(system, kepler_principle.averaged_hamiltonian())


def _substituted(expression: sp.Expr) -> sp.Expr:
    """A function of K, e and x in terms of E, K and xi; sqrt(1 - e^2) is K sqrt(-2E)."""
    e, K, E, xi = orbit.e, orbit.momentum, orbit.energy, orbit.eccentric
    root, minor = sp.sqrt(1 - e**2), sp.Symbol("b", positive=True)
    result = sp.expand_trig(expression).subs(kepler_phase.true_from_eccentric())
    numerator, denominator = sp.fraction(sp.together(result.subs(K, root / sp.sqrt(-2 * E))))
    numerator = sp.expand(numerator).subs(sp.sin(xi) ** 2, 1 - sp.cos(xi) ** 2)
    result = sp.simplify(sp.factor(numerator) / denominator)
    result = sp.factor(result.subs({root: minor, sp.sqrt(2 - 2 * e**2): sp.sqrt(2) * minor}))
    return orbit.in_slow_variables(result.subs(minor, K * sp.sqrt(-2 * E)))


def spin_down() -> DerivedSystem:
    """Example 3, (3.10), in a = |(w_x, w_y)| and c = w_z: to a = 0, with the control in an ellipsoid.

    The phase is psi, counted in the sense in which it turns: `sense` = sign((d - 1) c).
    """
    mirrored = {sp.sin(body.psi): SENSE * sp.sin(body.psi)}
    a, c = body.a, body.c
    system = PhaseSystem(
        f=list(body.slow_rates().subs(mirrored)),
        omega=SENSE * body.anomaly_rate(),
        control_set=Ellipsoid(list(body.semiaxes)),
        slow=[a, c],
        control=list(body.u),
        phase=body.psi,
        target=[a],
        phase_rate=sp.expand(SENSE * body.phase_rate().subs(mirrored)).subs(SENSE**2, 1),
        numbers={**dict.fromkeys(body.semiaxes, 1.0), body.d: 0.5, SENSE: 1.0},
    )
    return DerivedSystem(system)


EXAMPLES: dict[str, Callable[[], DerivedSystem]] = {
    "smooth": smooth,
    "kepler": kepler,
    "spin_down": spin_down,
}


def rotor(
    mass: sp.Expr, potential: sp.Expr, force: sp.Expr, a1: Array, peak: Array | None, k: Array | None
) -> PhaseSystem:
    """Example 1, (3.1), in energy a and angle x: least time with |u| <= peak, or the cost rate k + u^2."""
    a = sp.Symbol("a", real=True)
    slow_rate, speed = (rate.subs(rotor_case.a, a) for rate in _rotor_rates(mass, potential, force))
    least_time = peak is not None
    values = {name: value for name, value in ((PEAK, peak), (PRICE, k)) if value is not None}
    return PhaseSystem(
        f=[slow_rate],
        anomaly_rate=speed,
        control_set=Ball(PEAK) if least_time else Quadratic(),
        slow=[a],
        control=[rotor_case.u],
        phase=rotor_case.x,
        target=[a - final_value("a1")],
        running_cost=1 if least_time else PRICE,
        numbers={final_value("a1"): a1, **values},
    )


@functools.lru_cache(maxsize=64)
def rotor_model(mass: sp.Expr, potential: sp.Expr, force: sp.Expr, least_time: bool) -> Model:
    """The compiled average of `rotor`, which does not depend on the values of a1 and of peak or k."""
    one = np.ones(())
    return rotor(mass, potential, force, one, one if least_time else None, None if least_time else one).model


@functools.lru_cache(maxsize=64)
def _rotor_rates(mass: sp.Expr, potential: sp.Expr, force: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    return rotor_case.slow_rate(mass, potential, force), rotor_case.speed(mass, potential)
