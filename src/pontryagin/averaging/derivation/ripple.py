"""The smooth example with a ripple, v' = eps (u + c cos x): its averaged family in closed form.

The ripple has zero mean, so the averaged problem is the paper's smooth example (3.2); here it is solved by
its first integral. The member kappa of the family has eta^2/4 = k - kappa xi, and is expressed by

    A0 = sqrt(k - kappa v0),  A1 = sqrt(k - kappa v1),

half the costate at the start and at the end; v rises from v0 to v1 or, with `rise` = -1, falls.
"""

from functools import cache

import sympy as sp

from pontryagin.averaging.derivation import smooth
from pontryagin.averaging.derivation.smooth import eta, k, kappa, v, v0, v1, x

c = sp.Symbol("c", positive=True)
rise = sp.Symbol("s", real=True)
A0, A1 = sp.symbols("A_0 A_1", positive=True)
ROOTS = {A0: sp.sqrt(k - kappa * v0), A1: sp.sqrt(k - kappa * v1)}


def maximum() -> sp.Expr:
    """h*(v, x, eta) of the example with the ripple."""
    return smooth.maximum(c * sp.cos(x))


@cache
def costate() -> sp.Expr:
    """eta at the speed v: the root of kappa v + h0 = 0 with the sign of the rise."""
    found = sp.solve(kappa * v + smooth.averaged_hamiltonian(), eta)
    return rise * next(root for root in found if not root.could_extract_minus_sign())


def _over_speed(quantity: sp.Expr) -> sp.Expr:
    """Integral over slow time of a function of v, written as an integral over A = |eta|/2 from A0 to A1.

    dtau = dv/(eta/2), and v = (k - A^2)/kappa.
    """
    A = sp.Symbol("A", positive=True)
    speed = (k - A**2) / kappa
    force = smooth.averaged_hamiltonian().diff(eta).subs(eta, costate().subs(v, speed))
    if sp.simplify(force - rise * A) != 0:
        raise ArithmeticError("the mean force is not the rise times A")
    integrand = quantity.subs(v, speed) * speed.diff(A) / (rise * A)
    whole = sp.integrate(sp.expand(integrand), (A, A0, A1))
    return sp.simplify(whole.subs({1 / rise: rise}))


@cache
def duration() -> sp.Expr:
    """tau_1(kappa) in terms of A0 and A1, regular at kappa = 0: 2 s (v1 - v0)/(A0 + A1), s = `rise`."""
    return _regular(_over_speed(sp.S.One))


@cache
def turned() -> sp.Expr:
    """Psi(kappa), the integral of v over (0, tau_1), in terms of A0 and A1."""
    return _regular(_over_speed(v))


@cache
def cost() -> sp.Expr:
    """J_0(kappa), the integral of k + u^2, in terms of A0 and A1."""
    control = smooth.maximiser().subs(eta, costate())
    return _regular(_over_speed(sp.expand(k + control**2).subs(rise**2, 1)))


def _regular(expression: sp.Expr) -> sp.Expr:
    """An expression in terms of A0 and A1 in place of kappa and k: kappa in denominators cancels."""
    rates = sp.solve([A0**2 - k + kappa * v0, A1**2 - k + kappa * v1], [k, kappa], dict=True)[0]
    return sp.factor(sp.cancel(sp.together(expression.subs(rates))))


def of_kappa(expression: sp.Expr) -> sp.Expr:
    """A function of A0 and A1 as a function of kappa and k."""
    return expression.subs(ROOTS)


@cache
def window() -> tuple[sp.Expr, sp.Expr]:
    """kappa' and kappa'', at which h* at the end, -kappa v1 + c eta_1 cos x, touches zero at one phase."""
    level = sp.Symbol("y", real=True)
    swing = sp.expand(maximum() - smooth.averaged_hamiltonian()).coeff(sp.cos(x))
    size = sp.expand((swing.subs(eta, costate()) ** 2).subs(rise**2, 1)).subs(kappa, level / v)
    found = sp.solve(sp.Eq(level**2, sp.simplify(size)), level)
    low, high = sorted(found, key=lambda root: root.subs({c: 1, k: 1}).evalf())
    return low / v1, high / v1


@cache
def roots_in_the_window() -> sp.Expr:
    """epsilon times the number of extremals, two per turn of the phase: (Psi(kappa'') - Psi(kappa'))/pi."""
    psi = of_kappa(turned())
    low, high = window()
    return (psi.subs(kappa, high) - psi.subs(kappa, low)) / sp.pi
