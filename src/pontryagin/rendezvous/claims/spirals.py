"""Slow spirals from circle to circle in closed form: meetings with arbitrarily small energy.

The areal constant is c = 1 + (c* - 1)(3s^2 - 2s^3) with s = t/T, and r = c^2/fM, so that gravity and rotation
balance. The required thrust, r'' along the radius and c'/r across it, is of order 1/T. The durations at which
the target is at the end of the spiral form an unbounded sequence.
"""

import math
from functools import cache

import sympy as sp
from scipy.integrate import quad

from pontryagin.numerics import compile as compiler
from pontryagin.rendezvous.derivation import model
from pontryagin.rendezvous.derivation.model import c, gravity, r, thrust

share, duration = sp.symbols("s T", positive=True)
OUTER = sp.Rational(3, 2)
"""Radius of the target's orbit; that of the craft is 1, and fM = 1."""
LEAD = math.pi / 3
"""Angle by which the target is ahead at t0, in radians."""


def areal() -> sp.Expr:
    """c(s)."""
    return 1 + (sp.sqrt(OUTER) - 1) * (3 * share**2 - 2 * share**3)


def radius() -> sp.Expr:
    """r(s) = c^2/fM at fM = 1."""
    return areal() ** 2


def by_time(expression: sp.Expr) -> sp.Expr:
    """d/dt of a function of s = t/T."""
    return expression.diff(share) / duration


@cache
def needed_thrust() -> tuple[sp.Expr, sp.Expr]:
    """p1 and p2 by (2) along the spiral, where r = c^2."""
    _, speed_rate, areal_rate = model.motion()[0].subs({r: c**2, gravity: 1})
    change = sp.Symbol("change", real=True)
    radial = sp.solve(speed_rate - change, thrust[0])[0].subs(change, by_time(by_time(radius())))
    across = sp.solve(areal_rate - change, thrust[1])[0].subs({change: by_time(areal()), c: areal()})
    return radial, across


def mean(expression: sp.Expr) -> float:
    """The integral of an expression in s over 0 <= s <= 1."""
    value = compiler.function("value", [share], {"value": expression})
    return float(quad(lambda at: float(value(at)[0]), 0, 1, epsabs=0, epsrel=1e-13)[0])


@cache
def sweep() -> float:
    """Angle swept by the craft divided by T, the mean of c/r^2."""
    return mean(areal() / radius() ** 2)


def target_rate() -> float:
    """Angular rate of the target on its circle."""
    return float(OUTER ** sp.Rational(-3, 2))


def duration_of(lap: int) -> float:
    """The duration T after which the craft has gained the target's lead and a number of revolutions."""
    return (LEAD + 2 * math.pi * lap) / (sweep() - target_rate())


@cache
def energies() -> tuple[float, float]:
    """a and b of the energy a/T^3 + b/T, the integral of p^2 dt: the radial and the transverse part."""
    radial, across = (mean(part.subs(duration, 1) ** 2) for part in needed_thrust())
    return radial, across


def energy_of(lap: int) -> float:
    """The integral of p^2 dt of the meeting after a number of revolutions."""
    radial, across = energies()
    time = duration_of(lap)
    return radial / time**3 + across / time
