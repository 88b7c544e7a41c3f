"""The paper's route to the least peak, (3.3) to (3.20): a parabola, its zeros, and one unknown.

paper     here          meaning
--------  ------------  ------------------------------------------------------------
psi_3*    parabola      the dual function in the paper's time tau
t1, t2    t1, t2        its zeros, the switching instants
alpha_m   alpha         half its curvature, alpha_m = l10/2
tau_m     apex          place of its extremum, (t1 + t2)/2
Delta_m   half_width    (t2 - t1)/2
beta_m    depth         minus its value there
lambda~   slope         multiplier of (3.14) over alpha_m; equals -1/(level of the control)
F         signed_area   S1 - S2 + S3, alpha_m times a polynomial
"""

import itertools
from functools import cache

import sympy as sp

from pontryagin.triple_integrator.derivation.channel import tau, tf
from pontryagin.triple_integrator.derivation.model import T, c, dual_function, multipliers, s

t1, t2 = sp.symbols("t_1 t_2", real=True)
alpha, beta, apex = sp.symbols("alpha_m beta_m tau_m", real=True)
half_width = sp.Symbol("Delta_m", positive=True)
slope, price = sp.symbols(r"\tilde{\lambda} lambda", real=True)
lower, upper = sp.symbols("a_k b_k", real=True)
level = sp.Symbol("v", real=True)


def parabola() -> sp.Expr:
    """psi_3(tau) = l' h(t_f - tau), (3.3)."""
    return dual_function().subs(s, tf - tau)


@cache
def multipliers_from_zeros() -> sp.Matrix:
    """l0 of the dual function that vanishes at t1 and t2 and has l'c = 1, (3.5)."""
    conditions = [parabola().subs(tau, t1), parabola().subs(tau, t2), (multipliers.T * c)[0] - 1]
    return multipliers.subs(sp.solve(conditions, list(multipliers), dict=True)[0]).applyfunc(sp.factor)


def piece() -> sp.Expr:
    """S_k, the integral of the parabola from a_k to b_k, (3.7)."""
    return sp.integrate(sp.expand(parabola()), (tau, lower, upper))


def vertex_form() -> sp.Expr:
    """alpha (tau - tau_m)^2 - beta, (3.8)."""
    return alpha * (tau - apex) ** 2 - beta


@cache
def vertex() -> dict[sp.Symbol, sp.Expr]:
    """alpha, tau_m and beta of a parabola given by its multipliers; (3.8), (3.9)."""
    curvature = sp.diff(parabola(), tau, 2)
    place = sp.solve(sp.diff(parabola(), tau), tau)[0]
    return {alpha: curvature / 2, apex: sp.expand(place), beta: sp.simplify(-parabola().subs(tau, place))}


def zeros() -> tuple[sp.Expr, sp.Expr]:
    """The zeros of (3.8) if alpha and beta have the same sign, the earlier one first."""
    ratio = sp.Symbol("r", positive=True)
    roots = sp.solve(vertex_form().subs(beta, alpha * ratio), tau)
    ordered = sorted(roots, key=lambda root: root.subs({apex: 0, ratio: 1}))
    return tuple(root.subs(ratio, beta / alpha) for root in ordered)


@cache
def multipliers_from_vertex() -> sp.Matrix:
    """l0 in terms of alpha, tau_m and beta with t0 = 0, (3.10)."""
    matching = sp.Poly(sp.expand(parabola().subs(tf, T) - vertex_form()), tau).coeffs()
    return multipliers.subs(sp.solve(matching, list(multipliers), dict=True)[0])


def normalisation() -> sp.Expr:
    """l'c, which must be 1, in terms of the vertex; (3.11), and (3.13) with beta = alpha Delta^2."""
    return (multipliers_from_vertex().T * c)[0]


def area(start: sp.Expr, end: sp.Expr) -> sp.Expr:
    """Integral of the parabola with the zeros tau_m -+ Delta_m; (3.12)."""
    factored = vertex_form().subs(beta, alpha * half_width**2)
    return sp.factor(sp.integrate(sp.expand(factored), (tau, start, end)))


@cache
def areas() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """S1, S2 and S3 between 0, the two zeros, and T."""
    cuts = (sp.S.Zero, apex - half_width, apex + half_width, T)
    return tuple(area(a, b) for a, b in itertools.pairwise(cuts))


@cache
def signed_area() -> sp.Expr:
    """F = S1 - S2 + S3."""
    first, second, third = areas()
    return sp.factor(first - second + third)


def lagrangian() -> sp.Expr:
    """F plus lambda times (l'c - 1)/alpha, (3.14)."""
    constraint = (normalisation().subs(beta, alpha * half_width**2) - 1) / alpha
    return signed_area() + price * sp.expand(constraint)


def gradient() -> dict[sp.Symbol, sp.Expr]:
    """Derivatives of (3.14) with respect to tau_m, alpha_m and Delta_m."""
    return {unknown: sp.factor(sp.diff(lagrangian(), unknown)) for unknown in (apex, alpha, half_width)}


@cache
def stationarity() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """The left-hand sides of (3.15), (3.16) and (3.17), which must vanish, with lambda = alpha lambda~."""
    by_apex, by_alpha, by_width = (expr.subs(price, alpha * slope) for expr in gradient().values())
    return (
        sp.cancel(by_apex / alpha),
        sp.cancel(by_alpha),
        sp.cancel(by_width / (2 * half_width * alpha)),
    )


@cache
def curve() -> dict[sp.Symbol, sp.Expr]:
    """tau_m and Delta_m as functions of lambda~, (3.18) and (3.19)."""
    by_apex, _, by_width = stationarity()
    return {apex: sp.solve(by_apex, apex)[0], half_width: sp.solve(by_width, half_width)[0]}


def curvature_on_the_curve() -> sp.Expr:
    """alpha_m from (3.16)."""
    return sp.solve(stationarity()[1], alpha)[0]


@cache
def level_polynomial() -> sp.Expr:
    """The quartic in v = -1/lambda~ that follows from (3.13) and (3.15) to (3.17), with all solutions."""
    bracket = normalisation().subs(beta, alpha * half_width**2) / alpha
    alone = sp.cancel(1 / bracket - curvature_on_the_curve()).subs(curve()).subs(slope, -1 / level)
    factors = sp.factor_list(sp.numer(sp.together(alone)), level)[1]
    quartic = next(factor for factor, _ in factors if sp.degree(factor, level) == 4)
    return sp.expand(quartic)


def objective(zeros_at: tuple[sp.Expr, sp.Expr], moments: sp.Matrix, duration: sp.Expr) -> sp.Expr:
    """S1 - S2 + S3 with alpha from (3.13) for given zeros; (3.6) minimises its modulus."""
    first, second = zeros_at
    values = {apex: (first + second) / 2, half_width: (second - first) / 2, T: duration}
    values.update(zip(c, moments, strict=True))
    scale = 1 / (normalisation().subs(beta, alpha * half_width**2) / alpha).subs(values)
    return sp.nsimplify(signed_area().subs(alpha, scale).subs(values))
