"""Two small examples that can be solved exactly, each used by several entries of the ledger.

`Clock` is v' = eps u, s' = eps, b' = eps (k(s) + u^2), v from 0 to 1, omega = 1: no rate depends on the
phase, and the choice of k determines kappa = dJ/dtau_1 as a function of tau_1. The uneven rotor has the mass
r(x)^2 with r = 1 + cos(x)/2 and no potential; it is sped up in least time with |u| <= 1.
"""

from dataclasses import dataclass

import sympy as sp

from pontryagin.averaging.derivation import rotor

R = sp.Rational
T = sp.Symbol("tau_1", positive=True)

THREE = (T - 1) * (T - 2) * (T - 3) * (1 + R(11, 6) * T) / 6
"""tau_1^2 dJ/dtau_1 with three roots: local minima at 1 and 3, a local maximum at 2."""

TOUCHING = (T - 1) ** 2 * (T - 2) * (1 + R(5, 2) * T) / 2
"""tau_1^2 dJ/dtau_1 with a double root at 1 and a local minimum at 2."""


@dataclass(frozen=True)
class Clock:
    """The clock example whose kappa(tau_1) is shape/tau_1^2 - shift.

    The costate of v is constant, u = 1/tau_1, and h* at the end is 1/tau_1^2 - k(tau_1).
    """

    shape: sp.Expr
    shift: sp.Expr = sp.S.Zero

    @property
    def rate(self) -> sp.Expr:
        """k(s) at s = tau_1, a polynomial."""
        return sp.expand(sp.cancel((1 + self.shape) / T**2)) - self.shift

    @property
    def level(self) -> sp.Expr:
        """h* at the end: (p_v/2)^2 - k, where p_v = 2/tau_1 (v = 1 is reached) and p_s = 0."""
        costate = 2 / T
        return sp.expand(costate**2 / 4 - self.rate)

    @property
    def cost(self) -> sp.Expr:
        """J(tau_1): the integral of k(s) + 1/tau_1^2."""
        return sp.integrate(self.rate, (T, 0, T)) + 1 / T

    @property
    def kappa(self) -> sp.Expr:
        """kappa(tau_1) = -h*/omega at the end."""
        return -self.level


ROOT_OF_MASS = 1 + sp.cos(rotor.x) / 2
a0, a1 = sp.symbols("a_0 a_1", positive=True)


def uneven_speed() -> sp.Expr:
    """x'(a, x) = sqrt(2 a)/r."""
    return sp.sqrt(2 * rotor.a) / ROOT_OF_MASS


def uneven_frequency() -> sp.Expr:
    """omega(a): 2 pi over the time of a turn."""
    turn = sp.integrate(sp.expand(1 / uneven_speed()), (rotor.x, 0, 2 * sp.pi))
    return sp.simplify(2 * sp.pi / turn)


def uneven_end_costates() -> tuple[sp.Expr, sp.Expr]:
    """p(t1) of the exact problem, as a function of its final anomaly, and eta(tau_1) of the averaged one.

    h* = p x' - 1 with u = 1; it vanishes at the end, and so does its mean p omega - 1.
    """
    costate = sp.Symbol("p")
    exact = sp.solve(costate * uneven_speed() - 1, costate)[0]
    mean = sp.solve(costate * uneven_frequency() - 1, costate)[0]
    return exact.subs(rotor.a, a1), mean.subs(rotor.a, a1)
