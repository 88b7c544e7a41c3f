"""Exact lower bounds on the norm of every control by dual functions, and the moments of given controls.

For any multipliers l and any control u with the moments c the integral of h u is l'c, so that |l'c| is at
most the norm of h times the conjugate norm of u.
"""

import itertools

import sympy as sp

from pontryagin.triple_integrator.derivation.channel import drive
from pontryagin.triple_integrator.derivation.model import impulse_response, s

levels = sp.symbols("v_1 v_2", real=True)
lengths = sp.symbols("T_1 T_2", positive=True)


def dual_function_of(multipliers: sp.Matrix) -> sp.Expr:
    """h(s) = l' h(s) for given multipliers."""
    return sp.expand((multipliers.T * impulse_response())[0])


def root_multipliers(first: sp.Expr, second: sp.Expr) -> sp.Matrix:
    """Multipliers of h = (s - first)(s - second)."""
    return sp.Matrix([2, -(first + second), first * second])


def _roots(h: sp.Expr) -> list[sp.Expr]:
    return list(dict.fromkeys(sp.real_roots(h))) if h.has(s) else []


def peak_of(h: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """Largest |h| on [0, duration], the norm in (4.1), for a polynomial h with rational coefficients."""
    stationary = [x for x in _roots(sp.diff(h, s)) if 0 < x < duration]
    return sp.Max(*(abs(h.subs(s, x)) for x in [0, duration, *stationary]))


def area_of(h: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """Integral of |h| on [0, duration], the norm in (3.1) and (3.2); h has rational coefficients."""
    roots = [x for x in _roots(h) if 0 < x < duration]
    cuts = [sp.S.Zero, *roots, sp.sympify(duration)]
    primitive = sp.integrate(h, s)
    return sp.nsimplify(
        sum(abs(primitive.subs(s, b) - primitive.subs(s, a)) for a, b in itertools.pairwise(cuts))
    )


def peak_bound(multipliers: sp.Matrix, c: sp.Matrix, duration: sp.Expr) -> sp.Expr:
    """Lower bound on the peak (1.19) of every control with the moments c."""
    return abs((multipliers.T * c)[0]) / area_of(dual_function_of(multipliers), duration)


def impulse_bound(multipliers: sp.Matrix, c: sp.Matrix, duration: sp.Expr) -> sp.Expr:
    """Lower bound on the total impulse (1.20) of every control with the moments c."""
    return abs((multipliers.T * c)[0]) / peak_of(dual_function_of(multipliers), duration)


def piecewise_moments(pieces: list[tuple[sp.Expr, sp.Expr]]) -> sp.Matrix:
    """Moments c of a control of constant pieces (duration, level), by driving the channel from rest."""
    state = sp.zeros(3, 1)
    for duration, level in pieces:
        state = drive(state, duration, sp.sympify(level))
    return state


def conjugate_norm(q: sp.Expr) -> sp.Expr:
    """L_q norm of a control with two levels: its largest pairing with a function h of conjugate norm one.

    For finite q the best h is a multiple of |u|^(q-1) sign u. For q = oo the extreme h are concentrated on
    one of the levels, with either sign.
    """
    sizes = [sp.Abs(v) for v in levels]
    if q == sp.oo:
        return sp.Max(*sizes)
    if q == 1:
        return sum(length * size for length, size in zip(lengths, sizes, strict=True))
    pairing = sum(length * size**q for length, size in zip(lengths, sizes, strict=True))
    # The conjugate exponent is p = q/(q-1), so |h|^p = |u|^q and the norm of h is pairing^(1/p).
    return sp.powsimp(pairing / pairing ** ((q - 1) / q))
