"""The paper's route to the least impulse, (4.1) to (4.10): Chebyshev's polynomial and three impulses.

paper     here                meaning
--------  ------------------  ------------------------------------------------------
T_2       chebyshev           2 z^2 - 1, in the paper's time with t0 = 0
rho~_0    signed_norm         s0 rho_0
F         F                   16 c1 - 8 T c2 + T^2 c3
a0 am aT  amplitudes          impulses at 0, T/2, T up to sign; all positive if (4.10) is optimal
"""

from functools import cache

import sympy as sp

from pontryagin.triple_integrator.derivation.channel import drive, initial, kick, t0, tau, tf
from pontryagin.triple_integrator.derivation.model import T, c, dual_function, multipliers, s

signed_norm = sp.Symbol(r"\tilde{\rho}_0", real=True)
sign = sp.Symbol("s_0", real=True)
z = sp.Symbol("z", real=True)
impulses = sp.symbols("a_0 a_m a_T", real=True)


def unit_variable() -> sp.Expr:
    """z, the affine function of tau with z(t0) = -1 and z(tf) = 1."""
    slope, shift = sp.symbols("p q")
    ends = [slope * t0 + shift + 1, slope * tf + shift - 1]
    found = sp.solve(ends, [slope, shift], dict=True)[0]
    return sp.factor((slope * tau + shift).subs(found))


def chebyshev() -> sp.Expr:
    """T_2(z) = cos(2 arccos z)."""
    angle = sp.Symbol("theta", real=True)
    return sp.expand_trig(sp.cos(2 * angle)).subs(sp.cos(angle), z)


def chebyshev_in_time() -> sp.Expr:
    """T_2 on [0, T] as a polynomial in tau, (4.5)."""
    return sp.expand(chebyshev().subs(z, unit_variable().subs({t0: 0, tf: T})))


def dual_in_time() -> sp.Expr:
    """h(tau) with t0 = 0, in powers of tau; (4.4)."""
    return sp.collect(sp.expand(dual_function().subs(s, T - tau)), tau)


@cache
def matching() -> tuple[sp.Expr, ...]:
    """Coefficients of tau^2, tau and 1 in h0 - rho~ T_2, which must vanish; each is scaled to hold -rho~."""
    raw = sp.Poly(dual_in_time() - signed_norm * chebyshev_in_time(), tau).all_coeffs()
    return tuple(
        sp.expand(-coefficient / coefficient.coeff(signed_norm)) for coefficient in map(sp.expand, raw)
    )


@cache
def cramer(rows: tuple[sp.Expr, ...]) -> tuple[dict[str, sp.Expr], sp.Expr]:
    """Cramer's determinants of the matching system with l'c = 1, in the order l10, l20, l30, rho~; (4.6).

    The rows are an argument because determinants depend on how the rows are scaled.
    """
    unknowns = [*multipliers, signed_norm]
    matrix, right = sp.linear_eq_to_matrix([*rows, (multipliers.T * c)[0] - 1], unknowns)
    named = {}
    for column, name in enumerate(("D_1", "D_2", "D_3", r"D_\rho")):
        replaced = matrix.copy()
        replaced[:, column] = right
        named[name] = sp.factor(replaced.det())
    return named, sp.factor(matrix.det())


@cache
def minimal_multipliers() -> dict[sp.Symbol, sp.Expr]:
    """l10, l20, l30 and rho~ of the Chebyshev dual function (4.2) with l'c = 1, (4.3)."""
    equations = [*matching(), (multipliers.T * c)[0] - 1]
    return dict(sp.solve(equations, [*multipliers, signed_norm], dict=True)[0])


def impulse_transfer() -> sp.Matrix:
    """The state at T after the impulses s0 a0, -s0 am, s0 aT of (4.9) at 0, T/2, T, by integrating (0.6)."""
    first, middle, last = impulses
    state = drive(kick(initial, sign * first), T / 2, sp.S.Zero)
    state = drive(kick(state, -sign * middle), T / 2, sp.S.Zero)
    return kick(state, sign * last)


@cache
def amplitudes() -> dict[sp.Symbol, sp.Expr]:
    """a0, am and aT that give the control the moments c, (4.10), with 1/s0 = s0."""
    at_rest = impulse_transfer().subs(dict.fromkeys(initial, 0)) / sign
    equations = [sp.expand(got - sign * wanted) for got, wanted in zip(at_rest, c, strict=True)]
    return {a: sp.factor(value) for a, value in sp.solve(equations, list(impulses), dict=True)[0].items()}


def total() -> sp.Expr:
    """a0 + am + aT: the total impulse in (4.7), if no term is negative."""
    return sp.factor(sum(amplitudes().values()))


def spike(start: sp.Expr, end: sp.Expr, weight: sp.Expr) -> sp.Matrix:
    """Change of the state at T by a pulse of (4.8): a constant control of given integral on [start, end]."""
    state = drive(sp.zeros(3, 1), end - start, weight / (end - start))
    return drive(state, T - end, sp.S.Zero).applyfunc(sp.factor)


def three_impulses(amplitudes: tuple[sp.Expr, sp.Expr, sp.Expr], duration: sp.Expr = sp.S.One) -> sp.Matrix:
    """The state at T after impulses at 0, T/2 and T from rest, by integrating (0.6)."""
    state = drive(kick(sp.zeros(3, 1), amplitudes[0]), duration / 2, sp.S.Zero)
    state = drive(kick(state, amplitudes[1]), duration / 2, sp.S.Zero)
    return kick(state, amplitudes[2])


def impulses_for(moments: sp.Matrix) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """The impulses s0 a0, -s0 am, s0 aT of (4.10) in unit time for given moments; s0 cancels."""
    at = {T: 1, **dict(zip(c, moments, strict=True))}
    first, middle, last = (sp.cancel(amplitudes()[a] / sign).subs(at) for a in impulses)
    return first, -middle, last
