"""Least peak against linear programmes and exact roots, for every kind of control."""

from itertools import pairwise

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import bang_bang_moments, exact_peak, peak_bracket
from pontryagin.triple_integrator import Maneuver, minimum_peak
from strategies import maneuver_with, maneuvers, moments, multipliers, places, signs


def dual_norm(l):
    """Integral of |l1 s^2/2 + l2 s + l3| over [0, 1], between its real zeros."""
    h = np.polynomial.Polynomial([l[2], l[1], l[0] / 2])
    zeros = [z.real for z in h.roots() if abs(z.imag) < 1e-12 and 0 < z.real < 1]
    values = h.integ()(np.array([0.0, *sorted(zeros), 1.0]))
    return np.abs(np.diff(values)).sum()


@settings(max_examples=10)
@given(moments())
def test_it_lies_between_two_linear_programmes(c):
    """The least value of (1.19), which is the least bound u0 of (0.7)."""
    size = np.abs(c * [6, 2, 1]).max()
    c = c / (size or 1.0)
    low, high = peak_bracket(c, 1.0)
    norm = minimum_peak(maneuver_with(c)).norm
    assert low - 1e-6 <= norm <= high + 1e-6
    assert high - low <= 0.02 * max(1.0, high)


@given(moments())
def test_it_is_the_largest_root_of_the_quartic(c):
    assert_allclose(float(minimum_peak(maneuver_with(c)).norm), float(exact_peak(c)), rtol=2e-14)


@given(moments(), multipliers)
def test_no_multipliers_give_a_bound_above_the_norm(c, l):
    norm = minimum_peak(maneuver_with(c)).norm
    assert abs(l @ c) <= norm * dual_norm(l) * (1 + 1e-9) + 1e-12 * np.abs(c).max()


@given(moments())
def test_residual_and_gap_in_fifty_digits(c):
    """The moments of the returned switches and the bound by their dual function, without rounding errors."""
    solution = minimum_peak(maneuver_with(c))
    with mp.workdps(50):
        v, a, b = (mp.mpf(float(x)) for x in (solution.levels, *solution.shares))
        k = [mp.mpf(float(x)) * scale for x, scale in zip(c, (6, 2, 1), strict=True)]
        size = max(map(abs, k)) or mp.mpf(1)
        flown = [v * (1 - 2 * (a**n - b**n)) for n in (3, 2, 1)]
        assert max(abs(x - y) for x, y in zip(k, flown, strict=True)) <= 1e-13 * size
        pieces = [s**3 / 3 - (a + b) * s**2 / 2 + a * b * s for s in (mp.mpf(0), b, a, mp.mpf(1))]
        length = sum(abs(y - x) for x, y in pairwise(pieces))
        proved = abs(k[0] / 3 - (a + b) * k[1] / 2 + a * b * k[2]) / length
        assert abs(abs(v) - proved) <= 1e-13 * abs(v)


@given(signs, places())
def test_a_bang_bang_control_is_its_own_optimum(level, switches):
    solution = minimum_peak(maneuver_with(bang_bang_moments(level, *switches)))
    assert_allclose(solution.norm, 1.0, rtol=1e-13)
    assert solution.certificate.holds(1e-12)


@given(maneuvers())
def test_the_sign_of_the_control_is_that_of_the_third_costate(maneuver):
    """(3.4)."""
    solution = minimum_peak(maneuver)
    edges = np.array([maneuver.t0, *solution.breakpoints, maneuver.tf], dtype=float)
    middle = (edges[1:] + edges[:-1]) / 2
    assert np.sign(solution.costate(middle)[:, 2]).tolist() == np.sign(solution.control(middle)).tolist()
    scale = np.abs(solution.costate(edges)[:, 2]).max()
    assert_allclose(solution.costate(solution.breakpoints)[:, 2], 0.0, atol=1e-12 * scale)
    assert_allclose(solution.multipliers @ maneuver.moments, float(maneuver.moments.any()), rtol=1e-10)


def test_rest_to_rest_switches_at_a_quarter_and_three_quarters():
    solution = minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], 2.0))
    assert_allclose(solution.switch_times, [0.5, 1.5], rtol=1e-14)
    assert_allclose(solution.control([0.0, 0.4, 0.6, 1.4, 1.6, 2.0]), [4, 4, -4, -4, 4, 4], rtol=1e-14)
    assert_allclose(solution.norm, 4.0, rtol=1e-14)
    assert float(solution.first_sign) == 1.0


@pytest.mark.parametrize("level", [2.0, -2.0])
def test_a_constant_control_has_no_switch(level):
    solution = minimum_peak(maneuver_with(level * np.array([1 / 6, 1 / 2, 1])))
    assert float(solution.norm) == 2.0
    assert np.isnan(solution.switch_times).all()
    assert float(solution.first_sign) == np.sign(level)
    assert solution.control([0.0, 0.5, 1.0]).tolist() == [level] * 3
    assert solution.breakpoints.shape == (0,)
    assert np.isinf(solution.switch_condition).all()


@pytest.mark.parametrize("level", [1.0, -1.0])
@pytest.mark.parametrize("share", [0.125, 0.5, 0.75])
def test_one_switch_is_reported_once(level, share):
    """The control is -level at first, and level over the last `share` of the time."""
    solution = minimum_peak(maneuver_with(bang_bang_moments(level, 1.0, share)))
    assert_allclose(solution.switch_times, [1 - share, np.nan], rtol=1e-13)
    assert float(solution.first_sign) == -level
    assert_allclose(solution.norm, 1.0, rtol=1e-14)


@pytest.mark.parametrize(
    "c", [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0], [0.3, 0.7, 0], [0, -0.2, 0.5], [-1, 0, 2.0]]
)
def test_vanishing_moments(c):
    solution = minimum_peak(maneuver_with(np.array(c)))
    assert_allclose(float(solution.norm), float(exact_peak(c)), rtol=1e-14)
    assert solution.certificate.holds(1e-13)


@pytest.mark.parametrize(
    "c", [[0.11, -0.19, -2.03], [-0.21, -0.35, 0.3], [-0.41, -0.36, 2.22], [0.31, 0.74, 0.49]]
)
def test_of_two_levels_of_either_sign_the_larger_is_taken(c):
    """Here the quartic has real roots of both signs beyond |c3|, and the larger is the less usual one."""
    solution = minimum_peak(maneuver_with(np.array(c)))
    assert_allclose(float(solution.norm), float(exact_peak(c)), rtol=1e-14)
    assert solution.certificate.holds(1e-13)


@pytest.mark.parametrize("width", [1e-4, 1e-6, 1e-8, 1e-10, 1e-12])
def test_a_narrow_flip_keeps_the_digits_of_its_width(width):
    """The width follows from c3 alone, up to rounding; the place is as uncertain as its condition says."""
    a, b = 0.25 + width, 0.25
    solution = minimum_peak(maneuver_with(bang_bang_moments(1.0, a, b)))
    found = float(solution.shares[0] - solution.shares[1])
    assert abs(found - width) <= 4e-16
    assert solution.certificate.holds(1e-13)
    assert solution.switch_condition.min() > 0.05 / width
    rounding = np.finfo(float).eps
    assert abs(solution.shares[0] - a) <= 4 * rounding * solution.switch_condition[0]


@given(st.floats(0.05, 0.9), st.floats(0.05, 0.9), st.integers(0, 2))
def test_the_condition_is_the_derivative_of_the_switches(first, second, which):
    """No difference quotient in one of the scaled moments exceeds the condition."""
    if abs(first - second) < 0.05:
        return
    c = bang_bang_moments(1.0, max(first, second), min(first, second))
    base, step = minimum_peak(maneuver_with(c)), 1e-7
    scale = np.array([6, 2, 1])
    changed = c.copy()
    changed[which] += step / scale[which]
    moved = np.abs(minimum_peak(maneuver_with(changed)).shares - base.shares) / step
    assert (moved <= base.switch_condition * (1 + 1e-4) + 1e-4).all()


def test_no_moments_no_control():
    solution = minimum_peak(Maneuver([1, 2, 3], [1 + 2 + 1.5, 2 + 3, 3], 1.0))
    assert float(solution.norm) == 0.0
    assert not solution.control([0.0, 0.5, 1.0]).any()
    assert not solution.multipliers.any()
    assert solution.certificate.holds(0.0)


def test_what_overflows_is_refused():
    with pytest.raises(
        ValueError, match="xf must give with x0 and tf - t0 a control, a norm and a motion within the range"
    ):
        minimum_peak(Maneuver([0, 0, 0], [1e300, 0, 0], 1e-3))


def test_breakpoints_are_those_of_one_manoeuvre():
    with pytest.raises(
        ValueError, match=r"breakpoints are those of one manoeuvre, got a stack of shape \(2,\)"
    ):
        _ = minimum_peak(Maneuver(np.zeros((2, 3)), [1, 0, 0], 1.0)).breakpoints
