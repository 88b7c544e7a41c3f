"""The averaged system, its integral and its end conditions (Akulenko 1977, (2.3) to (2.12)).

h0(xi, eta) is the mean over the phase of h*(xi, psi, eta) = (eta f0*). As a maximum of functions linear in
eta, h* is homogeneous of degree one in eta, and so is h0. Two components stand for any number.

here     meaning
-------  ------------------------------------------------------------
xi, eta  averaged slow variables and costates
h0       an undefined function; `homogeneous` makes it of degree one in eta
kappa    mean of q per epsilon; H0 = omega kappa + h0
"""

from functools import cache

import sympy as sp

from pontryagin.averaging.derivation import principle

tau, kappa, psi = sp.Symbol("tau", real=True), sp.Symbol("kappa", real=True), principle.psi
xi, eta = sp.symbols("xi1:3", real=True), sp.symbols("eta1:3", real=True)
omega = sp.Function("omega", positive=True)(*xi)
h0 = sp.Function("h_0", real=True)(*xi, *eta)
M, g = (sp.Function(name, real=True)(*xi) for name in "Mg")
alpha = principle.alpha


def homogeneous(expression: sp.Expr) -> sp.Expr:
    """An expression with h0 made of degree one in eta: eta2 k(xi, eta1/eta2) with an undefined k."""
    shape = sp.Function("k", real=True)
    inserted = expression.replace(h0.func, lambda x1, x2, y1, y2: y2 * shape(x1, x2, y1 / y2))
    return sp.simplify(inserted.doit())


def homogeneity() -> sp.Expr:
    """eta dh0/deta - h0, Euler's relation: vanishes."""
    return homogeneous(sum(y * h0.diff(y) for y in eta) - h0)


def mean_rates() -> sp.Matrix:
    """f0 = dh0/deta: the mean of f under the maximising control, by the envelope theorem."""
    return sp.Matrix([h0.diff(y) for y in eta])


def mean_and_derivative_commute() -> list[sp.Expr]:
    """d<h*>/d(xi, eta) - <dh*/d(xi, eta)> at fixed psi, for any h*: all vanish."""
    h = sp.Function("h", real=True)(*xi, psi, *eta)

    def mean(k: sp.Expr) -> sp.Expr:
        return sp.Integral(k, (psi, 0, 2 * sp.pi)) / (2 * sp.pi)

    return [sp.simplify(mean(h).diff(x).doit() - mean(h.diff(x))) for x in (*xi, *eta)]


def averaged_hamiltonian() -> sp.Expr:
    """H0 = omega kappa + h0."""
    return omega * kappa + h0


@cache
def rates() -> tuple[sp.Matrix, sp.Matrix]:
    """(dxi/dtau, deta/dtau) of (2.11): Hamilton's equations of H0 with constant kappa."""
    H = averaged_hamiltonian()
    return sp.Matrix([H.diff(y) for y in eta]), sp.Matrix([-H.diff(x) for x in xi])


def integral() -> sp.Expr:
    """kappa solved from H0 = 0, (2.10)."""
    return sp.solve(averaged_hamiltonian(), kappa)[0]


@cache
def standard_rates() -> tuple[sp.Matrix, sp.Matrix]:
    """(dxi/dtau, deta/dtau) of (2.3): the rates of (2.11) with kappa from (2.10)."""
    forward, backward = rates()
    return forward, backward.subs(kappa, integral()).applyfunc(sp.expand)


def along(quantity: sp.Expr, motion: tuple[sp.Matrix, sp.Matrix]) -> sp.Expr:
    """Rate of a function of xi and eta along a motion given by (dxi/dtau, deta/dtau)."""
    pairs = zip((*xi, *eta), (*motion[0], *motion[1]), strict=True)
    return sp.simplify(sum(quantity.diff(x) * rate for x, rate in pairs))


@cache
def end_costates() -> sp.Matrix:
    """eta at tau_1: the end conditions of the maximum principle for p, which averaging does not change."""
    there = dict(zip(principle.a, xi, strict=True))
    return principle.end_conditions()[0][:2, :].subs(there, simultaneous=True).doit()


def cyclic_costate() -> sp.Expr:
    """Rate of eta2 where no rate depends on xi2, for instance where xi2 is the cost or a clock: zero."""
    speed = sp.Function("h", real=True)(xi[0], eta[0] / eta[1])
    frequency = sp.Function("omega", positive=True)(xi[0])
    return -(frequency * kappa + eta[1] * speed).diff(xi[1])


def order(n: int | sp.Expr) -> dict[str, sp.Expr]:
    """Orders of the exact and averaged systems, for n slow variables."""
    size = sp.sympify(n)
    whole = 2 * size + 2
    return {
        "canonical": whole,
        "without q, H = 0": whole - 1,
        "averaged, the phase apart": whole - 2,
        "on h0 = 0": whole - 3,
    }
