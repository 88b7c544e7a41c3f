"""Least peak: the derived formulas are identities, convex, and agree with the quartic."""

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from pontryagin.triple_integrator.derivation import model, peak
from pontryagin.triple_integrator.derivation.peak import a, b, d, e2, k1, k2, k3, m, t, v, w, y

c1, c2, c3 = sp.symbols("c1 c2 c3", real=True)
SCALED = {k1: 6 * c1, k2: 2 * c2, k3: c3}
QUARTIC = (
    3 * v**4
    + (48 * c2 - 96 * c1 - 12 * c3) * v**3
    + (96 * c1 * c3 - 48 * c2**2 - 6 * c3**2) * v**2
    + 4 * c3**3 * v
    - c3**4
)


def vanishes(expression):
    """Whether a rational expression is identically zero."""
    return sp.expand(sp.numer(sp.together(expression))) == 0


def test_moments_are_scaled_so_that_a_constant_has_all_three_equal():
    assert peak.scaled_moments([(v, 0, 1)]) == sp.Matrix([v, v, v])


def test_bang_bang_moments_by_integrating_each_power():
    level = sp.Piecewise((v, model.s < sp.Rational(1, 5)), (-v, model.s < sp.Rational(3, 4)), (v, True))
    powers = sp.Matrix([3 * model.s**2, 2 * model.s, 1])
    integrals = powers.applyfunc(lambda p: sp.integrate(p * level, (model.s, 0, 1)))
    at = {b: sp.Rational(1, 5), a: sp.Rational(3, 4)}
    assert peak.bang_bang_moments().subs(at).expand() == integrals.expand()


def test_centred_moments_are_those_of_the_theory():
    first, second, third = peak.centred_moments()
    assert vanishes(first - v * (1 - 2 * d * (3 * m**2 + d**2) / 4))
    assert vanishes(second - v * (1 - 2 * m * d))
    assert vanishes(third - v * (1 - 2 * d))


def test_width_and_place_from_the_level():
    solution = peak.switches()
    assert vanishes(solution[d] - (1 - k3 / v) / 2)
    assert vanishes(solution[m] - (v - k2) / (v - k3))


def test_every_bang_bang_control_solves_the_level_equation():
    moments = dict(zip((k1, k2, k3), peak.bang_bang_moments(), strict=True))
    assert vanishes(peak.level_equation().subs(moments).subs(t, 1 / v))


def test_the_level_equation_is_negative_at_zero():
    assert peak.level_equation().subs(t, 0) == -sp.Rational(3, 16)


def test_the_level_equation_is_convex_where_its_denominator_is_positive():
    """G'' = 3 (k2 - k3)^2 / (2 q^3) + 3 k3^2 q / 8 with q = 1 - k3 t: a sum of squares over q > 0."""
    q = 1 - k3 * t
    squares = sp.Rational(3, 2) * (k2 - k3) ** 2 / q**3 + sp.Rational(3, 8) * k3**2 * q
    assert vanishes(sp.diff(peak.level_equation(), t, 2) - squares)
    assert vanishes(peak.second_derivative() - squares)


def test_the_level_equation_times_its_denominator_is_the_quartic():
    scaled = peak.level_equation().subs(SCALED).subs(t, 1 / v)
    assert vanishes(sp.cancel(16 * scaled * v**3 * (c3 - v)) - QUARTIC)
    assert vanishes(peak.quartic().subs(SCALED) - QUARTIC)


def test_the_near_constant_form_is_the_same_equation():
    same = peak.near_constant_equation().subs({y: 1 - k3 * t, e2: k2 - k3})
    same = same.subs(w, k1 - k3 - sp.Rational(3, 2) * (k2 - k3))
    assert vanishes(same - peak.level_equation())


def test_the_stable_form_of_the_theory_is_the_quartic():
    """4 v^2 (delta^2 + 12 (E2 - 2 E1) delta - 12 E2^2) = delta^4 with delta = v - c3."""
    delta, first, second = v - c3, c1 - c3 / 6, c2 - c3 / 2
    stable = 4 * v**2 * (delta**2 + 12 * (second - 2 * first) * delta - 12 * second**2) - delta**4
    assert vanishes(stable - QUARTIC)


@pytest.mark.slow
def test_the_start_solves_the_equation_without_its_cube():
    truncated = peak.near_constant_equation().subs(t, 1 / k3) - y**3 / 16
    at = {w: sp.Rational(1, 7), e2: sp.Rational(2, 5), k3: sp.Rational(3, 4)}
    start = peak.near_constant_start().subs(at)
    assert start > 0
    assert sp.expand(sp.radsimp((truncated * y).subs(at).subs(y, start))) == 0


def test_the_dual_function_proves_the_level_of_its_own_control():
    moments = dict(zip((k1, k2, k3), peak.bang_bang_moments(), strict=True))
    assert vanishes(peak.dual_bound().subs(moments) - v)


@given(st.fractions(0, 1, max_denominator=50), st.fractions(0, 1, max_denominator=50))
def test_the_integral_of_the_modulus(p, q):
    high, low = max(p, q), min(p, q)
    exact = float(peak.absolute_integral().subs({a: high, b: low}))
    numeric, _ = quad(lambda s: abs((s - high) * (s - low)), 0, 1, points=[float(low), float(high)])
    assert abs(exact - numeric) < 1e-12


@pytest.mark.slow
@given(
    st.sampled_from([-2, -1, 1, 3]),
    st.fractions(0, 1, max_denominator=40),
    st.fractions(0, 1, max_denominator=40),
)
def test_no_real_root_is_larger_than_the_level(level, p, q):
    """By Sturm's exact count P has no real root beyond +-|v| and one distinct root at v."""
    at = {a: max(p, q), b: min(p, q), v: level}
    k = peak.bang_bang_moments().subs(at)
    values = dict(zip((c1, c2, c3), (k[0] / 6, k[1] / 2, k[2]), strict=True))
    polynomial = sp.Poly(QUARTIC.subs(values), v)
    assert polynomial.eval(level) == 0
    beyond = sp.Poly(sp.quo(polynomial, sp.Poly(v - level, v)), v)
    while not beyond.is_zero and beyond.eval(level) == 0:
        beyond = sp.Poly(sp.quo(beyond, sp.Poly(v - level, v)), v)
    assert beyond.count_roots(abs(level), None) - int(beyond.eval(abs(level)) == 0) == 0
    assert beyond.count_roots(None, -abs(level)) - int(beyond.eval(-abs(level)) == 0) == 0
