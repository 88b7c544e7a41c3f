"""Least total impulse: the extreme quadratics, and amplitudes that reproduce the moments in every regime."""

import sympy as sp

from pontryagin.triple_integrator.derivation import impulse, model
from pontryagin.triple_integrator.derivation.impulse import m0, m1, m2, sigma, x

MU = sp.Matrix([m0, m1, m2])
T = model.T
c1, c2, c3 = model.c


def moments_of(impulses):
    """Moments of 1, sigma, sigma^2 of amplitudes at places."""
    return sp.Matrix([sum(size * place**i for place, size in impulses) for i in range(3)])


def vanishes(expression):
    """Whether a rational expression is identically zero."""
    return sp.expand(sp.numer(sp.together(expression))) == 0


def same(left, right):
    return all(map(vanishes, sp.Matrix(left) - sp.Matrix(right)))


def test_the_moments_in_sigma():
    assert same(impulse.scaled_moments(), [c3, c2 / T, 2 * c1 / T**2])


def test_the_extreme_quadratics_stay_between_their_bounds():
    """1 - p = 2 x sigma (2 - x sigma) and 1 + p = 2 (1 - x sigma)^2: both positive for 0 <= x sigma <= 2."""
    p = impulse.extreme_quadratic()
    assert sp.expand(1 - p - 2 * x * sigma * (2 - x * sigma)) == 0
    assert sp.expand(1 + p - 2 * (1 - x * sigma) ** 2) == 0


def test_they_touch_where_the_impulses_are():
    p = impulse.extreme_quadratic()
    assert p.subs(sigma, 0) == 1
    assert vanishes(p.subs(sigma, 1 / x) + 1)
    assert p.subs({x: 2, sigma: 1}) == 1


def test_the_pairing_is_linear_in_the_moments_and_exact_for_one_impulse():
    at = sp.Rational(2, 7)
    single = dict(zip((m0, m1, m2), moments_of([(at, 1)]), strict=True))
    p = impulse.extreme_quadratic()
    assert sp.expand(impulse.pairing(p).subs(single) - p.subs(sigma, at)) == 0


def test_reversal_is_an_involution_that_mirrors_the_places():
    once = impulse.reversed_moments()
    twice = once.subs(dict(zip((m0, m1, m2), once, strict=True)), simultaneous=True)
    assert same(twice, MU)
    at = dict(zip((m0, m1, m2), moments_of([(sigma, x)]), strict=True))
    assert same(once.subs(at, simultaneous=True), moments_of([(1 - sigma, x)]))


def test_three_impulses_have_the_moments():
    end, middle, start = impulse.chebyshev_amplitudes()
    assert same(moments_of([(0, end), (sp.Rational(1, 2), middle), (1, start)]), MU)


def test_two_impulses_have_the_moments():
    end, inside = impulse.two_impulses()
    assert same(moments_of([(0, end), (m2 / m1, inside)]), MU)


def test_the_best_touching_point_is_stationary_and_its_bound_is_the_cost_of_two_impulses():
    value = impulse.pairing(impulse.extreme_quadratic())
    best = impulse.best_touching_point()
    assert vanishes(sp.diff(value, x).subs(x, best))
    end, inside = impulse.two_impulses()
    assert vanishes(value.subs(x, best) - (end - inside))


def test_the_table_of_regimes_in_the_paper_s_symbols():
    scaled = dict(zip((m0, m1, m2), (c3, c2 / T, 2 * c1 / T**2), strict=True))
    end, inside = impulse.two_impulses().subs(scaled)
    assert vanishes(end - (c3 - c2**2 / (2 * c1)))
    assert vanishes(inside - c2**2 / (2 * c1))
    assert vanishes(T * (m2 / m1).subs(scaled) - 2 * c1 / c2), "the inner impulse's time to go"
    d2, d1 = T * c3 - c2, T**2 * c3 / 2 - T * c2 + c1
    reverse = dict(zip((m0, m1, m2), impulse.reversed_moments().subs(scaled), strict=True))
    start, inside = impulse.two_impulses().subs(reverse, simultaneous=True)
    assert vanishes(start - (c3 - d2**2 / (2 * d1)))
    assert vanishes(inside - d2**2 / (2 * d1))
    three = impulse.pairing(impulse.extreme_quadratic()).subs(x, 2).subs(scaled)
    assert vanishes(three - (16 * c1 - 8 * T * c2 + T**2 * c3) / T**2)
