"""The paper's examples as phase systems, their rates from the derivations."""

import functools
from collections.abc import Mapping

import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.averaging.control_sets import Ball, Ellipsoid, Quadratic
from pontryagin.averaging.derivation import kepler as orbit
from pontryagin.averaging.derivation import rigid_body as body
from pontryagin.averaging.derivation import rotor as turning
from pontryagin.averaging.derivation import smooth as smooth_case
from pontryagin.averaging.system import PhaseSystem

LEVEL = {name: sp.Symbol(name, real=True) for name in ("v1", "a1", "E1", "c1")}
RIPPLE, SIGN = sp.symbols("ripple sense", real=True)
PRICE, PEAK = sp.symbols("k peak", positive=True)
TIME_PRICE = sp.Symbol("l", positive=True)
ENERGY = sp.Symbol("a", real=True)


def smooth(v1: ArrayLike = 2.0, k: ArrayLike = 1.0, ripple: ArrayLike = 0.0) -> PhaseSystem:
    """v' = epsilon (u + ripple cos x), x' = v at the cost k + u^2, to v = v1."""
    v, x = smooth_case.v, smooth_case.x
    speeding = smooth_case.slow_rates(RIPPLE * sp.cos(x))[0]
    return PhaseSystem(
        f=[speeding],
        omega=smooth_case.anomaly_rate(),
        control_set=Quadratic(),
        slow=[v],
        control=[smooth_case.u],
        phase=x,
        target=[v - LEVEL["v1"]],
        running_cost=PRICE,
        numbers={LEVEL["v1"]: v1, PRICE: k, RIPPLE: ripple},
    )


def rotor(
    mass: sp.Expr,
    potential: sp.Expr,
    force: sp.Expr,
    a1: ArrayLike,
    peak: ArrayLike | None = None,
    k: ArrayLike | None = None,
) -> PhaseSystem:
    """(3.1) in the energy a and the angle x, to a = a1: |u| <= peak in the least time, or at k + u^2."""
    real = {turning.a: ENERGY}
    least_time = peak is not None
    numbers = {LEVEL["a1"]: a1, **({PEAK: peak} if peak is not None else {PRICE: k})}
    return PhaseSystem(
        f=[turning.slow_rate(mass, potential, force).subs(real)],
        anomaly_rate=turning.speed(mass, potential).subs(real),
        control_set=Ball(PEAK) if least_time else Quadratic(),
        slow=[ENERGY],
        control=[turning.u],
        phase=turning.x,
        target=[ENERGY - LEVEL["a1"]],
        running_cost=1 if least_time else PRICE,
        numbers=numbers,
    )


@functools.cache
def _orbit_in_eccentric_anomaly() -> tuple[sp.Matrix, sp.Expr, sp.Expr]:
    """Slow rates, weight and phase rate of (3.6) with the eccentric anomaly xi in the place of the true one.

    cos x and sin x follow from the two forms of r in (3.4); xi' from the rate of cos xi along (3.6).
    """
    model = orbit.model()
    (E, K), x, xi = model.slow, model.anomaly, orbit.eccentric
    e = orbit.e
    cosine = sp.Symbol("c")
    of_xi = sp.solve(orbit.eccentric_anomaly().subs(sp.cos(x), cosine) - sp.cos(xi), cosine)[0]
    sine = sp.sqrt(1 - e**2) * sp.sin(xi) / (1 - e * sp.cos(xi))
    there = {sp.cos(x): sp.factor(of_xi), sp.sin(x): sine}

    def seen(expression: sp.Expr) -> sp.Expr:
        plain = sp.expand_trig(expression).subs(there)
        plain = sp.simplify(plain.subs(K, sp.sqrt((1 - e**2) / (-2 * E))))
        return sp.factor(plain.subs(sp.sin(xi) ** 2, 1 - sp.cos(xi) ** 2))

    rates = orbit.element_rates()
    of_x = orbit.eccentric_anomaly()
    turn = of_x.diff(x) * -rates[orbit.gamma] + of_x.diff(e) * rates[orbit.e]
    shift = {
        u: seen((-turn / orbit.epsilon).coeff(u) if False else sp.expand(-turn / orbit.epsilon).coeff(u))
        for u in model.control
    }
    return rates, shift, seen


def kepler(E1: ArrayLike = -0.4, l: ArrayLike = 0.1) -> PhaseSystem:
    """(3.6), (3.7) in energy, angular momentum and the eccentric anomaly, to E = E1."""
    raise NotImplementedError
