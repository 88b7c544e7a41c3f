"""The rotating phase: Kepler's mean anomaly, and how thrust changes it (Akulenko 1977, (3.5) and (3.6)).

psi = xi - e sin xi grows by 2 pi a turn; it is a function of the true anomaly x and the eccentricity e.
"""

import functools

import sympy as sp

from pontryagin.averaging.derivation.kepler import (
    anomaly,
    e,
    eccentric,
    eccentric_anomaly,
    mean_motion,
    time_of_flight,
    weight,
)

eccentricity_rate, pericentre_rate = sp.symbols("e^{\\cdot} gamma^{\\cdot}", real=True)


def mean_anomaly() -> sp.Expr:
    """psi = 2 pi/T (t + delta) as a function of e and xi, (3.4) and (3.5)."""
    return sp.expand(sp.simplify(mean_motion() * time_of_flight()))


@functools.cache
def eccentric_sine() -> sp.Expr:
    """sin xi as a function of e and x; its sign is that of sin x, as xi and x pass 0 and pi together."""
    positive = sp.sin(anomaly) / (1 + e * sp.cos(anomaly))
    square = sp.simplify((1 - eccentric_anomaly() ** 2) / positive**2)
    return sp.sqrt(square) * positive


@functools.cache
def eccentric_of_true() -> sp.Expr:
    """xi as a smooth function of e and x for all x: xi - x is periodic and vanishes at the pericentre."""
    root = sp.sqrt(1 - e**2)
    found = anomaly - 2 * sp.atan(e * sp.sin(anomaly) / (1 + root + e * sp.cos(anomaly)))
    slope = -eccentric_anomaly().diff(anomaly) / eccentric_sine()
    if sp.simplify(found.diff(anomaly) - slope) != 0:
        raise ArithmeticError("the smooth branch of xi does not have the slope of cos xi")
    return found


def mean_of_true() -> sp.Expr:
    """psi as a smooth function of e and x for all x."""
    return mean_anomaly().subs({sp.sin(eccentric): eccentric_sine(), eccentric: eccentric_of_true()})


def from_eccentric(expression: sp.Expr) -> sp.Expr:
    """A function of cos xi and sin xi as a function of x."""
    return expression.subs({sp.cos(eccentric): eccentric_anomaly(), sp.sin(eccentric): eccentric_sine()})


@functools.cache
def eccentricity_slope() -> sp.Expr:
    """dpsi/de at fixed x: dxi/de follows from cos xi, then dpsi/de from psi = xi - e sin xi."""
    turn = -eccentric_anomaly().diff(e) / eccentric_sine()
    slope = mean_anomaly().diff(e) + mean_anomaly().diff(eccentric) * turn
    return sp.sqrt(1 - e**2) * sp.factor(sp.simplify(from_eccentric(slope) / sp.sqrt(1 - e**2)))


def mean_anomaly_rate() -> sp.Expr:
    """psi' under thrust, (3.6), in terms of e' and gamma', by x' = phi' - gamma' and the chain rule."""
    return mean_motion() - weight() * pericentre_rate + eccentricity_slope() * eccentricity_rate


@functools.cache
def true_from_eccentric() -> sp.Dict:
    """cos x and sin x as functions of e, cos xi and sin xi."""
    cosine, sine = sp.symbols("c s")
    forward = [eccentric_anomaly() - sp.cos(eccentric), eccentric_sine() - sp.sin(eccentric)]
    forward = [equation.subs({sp.cos(anomaly): cosine, sp.sin(anomaly): sine}) for equation in forward]
    found = sp.solve(forward, [cosine, sine], dict=True)[0]
    return sp.Dict({sp.cos(anomaly): sp.factor(found[cosine]), sp.sin(anomaly): sp.simplify(found[sine])})


def average(quantity: sp.Expr) -> sp.Expr:
    """Mean over psi of a function of e and x, integrated in xi, where dpsi = (1 - e cos xi) dxi.

    The integrand must become a polynomial in cos xi and sin xi; any other is refused.

    Examples
    --------
    >>> average(sp.cos(anomaly))
    -e
    """
    cosine, sine = sp.symbols("c s")
    plain = {sp.cos(eccentric): cosine, sp.sin(eccentric): sine}
    integrand = (sp.expand_trig(quantity).subs(true_from_eccentric()) * mean_anomaly().diff(eccentric)).subs(
        plain
    )
    even = sum(
        (term.subs(sine**2, 1 - cosine**2) for term in sp.Add.make_args(sp.expand(integrand))), sp.S.Zero
    )
    polynomial = sp.Poly(sp.cancel(sp.together(even)), cosine, sine)
    mean = sum(
        coefficient * sp.integrate(sp.cos(eccentric) ** m * sp.sin(eccentric) ** n, (eccentric, 0, 2 * sp.pi))
        for (m, n), coefficient in polynomial.terms()
    )
    return sp.factor(mean / (2 * sp.pi))
