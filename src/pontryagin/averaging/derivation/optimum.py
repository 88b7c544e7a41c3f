"""The main result: the cost along the averaged family (Akulenko 1977, (2.14) to (2.16)).

Every member of the family has H0 = omega kappa + h0 = 0, the same start, and ends on the target. D is the
derivative along the family at fixed tau; xi, eta, D xi, D eta and kappa are independent symbols here.

here     meaning
-------  ----------------------------------------------------------------------
D xi     `varied` (two components), D eta `varied_costate`
Psi      integral of omega over (0, tau_1): epsilon times the phase passed
"""

from functools import cache

import sympy as sp

from pontryagin.averaging.derivation import averaged, principle
from pontryagin.averaging.derivation.averaged import eta, kappa, omega, tau, xi

varied = sp.Matrix(sp.symbols("Dxi1:3", real=True))
varied_costate = sp.Matrix(sp.symbols("Deta1:3", real=True))
Psi = sp.Function("Psi", real=True)(kappa)
J = sp.Function("J", real=True)(kappa)


def varied_by(quantity: sp.Expr) -> sp.Expr:
    """The derivative D of a function of xi and eta."""
    pairs = zip((*xi, *eta), (*varied, *varied_costate), strict=True)
    return sum(quantity.diff(x) * change for x, change in pairs)


@cache
def lagrange_identity() -> sp.Expr:
    """d(eta D xi)/dtau + kappa D omega: vanishes, as eta dh0/deta = h0."""
    forward, backward = averaged.rates()
    varied_rates = sp.Matrix([varied_by(rate) for rate in forward])
    rate = backward.dot(varied) + sp.Matrix(eta).dot(varied_rates)
    return averaged.homogeneous(rate + kappa * varied_by(omega))


def end_work() -> sp.Expr:
    """eta dxi/dtau on H0 = 0: it equals h0, hence -kappa omega."""
    paired = sp.Matrix(eta).dot(averaged.rates()[0])
    level = sp.solve(averaged.averaged_hamiltonian(), kappa)[0]
    return averaged.homogeneous(paired + omega * level) - kappa * omega


def cost_by_the_end() -> sp.Expr:
    """g' dxi_1 + (eta_1 dxi_1) where M' dxi_1 = 0: vanishes, so that dJ0 = -(eta_1 dxi_1)."""
    gradient = sp.Matrix([averaged.g.diff(x) for x in xi])
    normal = sp.Matrix([averaged.M.diff(x) for x in xi])
    off = gradient.dot(varied) + averaged.end_costates().dot(varied)
    return sp.expand(off.subs(varied[1], sp.solve(normal.dot(varied), varied[1])[0]))


def exact_identity() -> sp.Expr:
    """d(p Da + q Dpsi)/dt along the unaveraged canonical equations: vanishes.

    H* is of degree one in (p, q), and D is the derivative along any family of extremals with a common start.
    With H* = 0 the displacements of the end then satisfy p da_1 + q dpsi_1 = H* dt_1 = 0, and as dJ = -p da_1
    the cost obeys dJ = q_1 dpsi_1: (2.14) before averaging.
    """
    states, costates = (principle.a[0], principle.psi), (principle.p[0], principle.q)
    steps = sp.symbols("Da Dpsi Dp Dq", real=True)
    H = sp.Function("H", real=True)(*states, costates[1] / costates[0]) * costates[0]

    def change(quantity: sp.Expr) -> sp.Expr:
        pairs = zip((*states, *costates), steps, strict=True)
        return sum(quantity.diff(x).doit() * step for x, step in pairs)

    rate = sum(
        -H.diff(x).doit() * step + y * change(H.diff(y).doit())
        for x, y, step in zip(states, costates, steps, strict=False)
    )
    return sp.simplify(rate)


@cache
def cost_slope() -> sp.Expr:
    """dJ0/dkappa in terms of Psi, (2.14).

    dJ0 = -eta_1 dxi_1 and dxi_1 = xi' dtau_1 + D xi: `end_work` gives the product of eta_1 with the first
    term, the integral of `lagrange_identity` that with the second. The factor of kappa is the derivative of
    Psi by Leibniz's rule.
    """
    if any((lagrange_identity(), averaged.homogeneity(), cost_by_the_end())):
        raise ArithmeticError("the variation along the family does not reduce")
    ending, inside = sp.Symbol("dtau_1"), sp.Symbol("integral of D omega")
    slope = -(end_work() * ending + (-kappa) * inside)
    leibniz = sp.solve(sp.Eq(Psi.diff(kappa), omega * ending + inside), inside)[0]
    return sp.expand(slope.subs(inside, leibniz))


def leibniz() -> sp.Expr:
    """d/dkappa of the integral of w(tau, kappa) over (0, T(kappa)); for w = omega that of (2.13)."""
    w, T = sp.Function("w")(tau, kappa), sp.Function("T")(kappa)
    return sp.Integral(w, (tau, 0, T)).diff(kappa)


def second_derivative() -> sp.Expr:
    """d2J0/dkappa2 at kappa = 0, (2.15)."""
    return cost_slope().diff(kappa).subs(kappa, 0).doit()


def cost_difference() -> sp.Expr:
    """J0(kappa) - J0(0) = kappa Psi - integral of Psi, the integral of (2.14) by parts, (2.16)."""
    inner = sp.Symbol("kappa_1", real=True)
    whole = kappa * Psi - sp.Integral(Psi.subs(kappa, inner), (inner, 0, kappa))
    if sp.simplify(whole.diff(kappa) - cost_slope()) != 0 or whole.subs(kappa, 0).doit() != 0:
        raise ArithmeticError("the primitive of (2.14) is another")
    return whole
