"""Least total impulse against linear programmes, in all regimes and at borders."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import impulse_bracket, response
from pontryagin.triple_integrator import Maneuver, minimum_impulse
from strategies import maneuver_with, moments, multipliers, signs

sizes = st.floats(0.01, 5.0)


def largest_modulus(l):
    """Largest |l1 s^2/2 + l2 s + l3| on [0, 1], which is at an end or where the slope vanishes."""
    places = [0.0, 1.0]
    if l[0] != 0 and 0 < -l[1] / l[0] < 1:
        places.append(-l[1] / l[0])
    return np.abs(response(places) @ l).max()


def of_impulses(places, amplitudes):
    """Moments of impulses at times to go, T = 1."""
    return response(places).T @ np.asarray(amplitudes, dtype=float)


def present(solution):
    keep = ~np.isnan(solution.impulse_times)
    return list(zip(solution.impulse_times[keep].tolist(), solution.impulses[keep].tolist(), strict=True))


@settings(max_examples=10)
@given(moments())
def test_it_lies_between_two_linear_programmes(c):
    """The least value of (1.20)."""
    c = c / (np.abs(c * [2, 1, 1]).max() or 1.0)
    low, high = impulse_bracket(c, 1.0)
    norm = minimum_impulse(maneuver_with(c)).norm
    assert low - 1e-6 <= norm <= high + 1e-6
    assert high - low <= 1e-3 * max(1.0, high)


@given(moments(), multipliers)
def test_no_multipliers_give_a_bound_above_the_norm(c, l):
    norm = minimum_impulse(maneuver_with(c)).norm
    assert abs(l @ c) <= norm * largest_modulus(l) * (1 + 1e-12) + 1e-14 * np.abs(c).max()


@given(moments())
def test_its_own_multipliers_attain_the_norm(c):
    """(4.1), (4.7): R = 1 / max |h0|, and h0 has this modulus, with its sign, where an impulse acts."""
    solution = minimum_impulse(maneuver_with(c))
    if not c.any():
        return
    assert_allclose(solution.multipliers @ c, 1.0, rtol=1e-9)
    assert_allclose(largest_modulus(solution.multipliers) * solution.norm, 1.0, rtol=1e-9)
    for t, amplitude in present(solution):
        h = float(solution.costate(t)[0, 2] * solution.norm)
        assert_allclose(h, np.sign(amplitude), rtol=1e-7)


@given(moments())
def test_impulses_are_ordered_and_add_up_to_the_norm(c):
    """Impulses are in order within the manoeuvre, absent ones last, and their moduli add up to the norm."""
    solution = minimum_impulse(maneuver_with(c))
    count = len(present(solution))
    assert np.isnan(solution.impulse_times[count:]).all()
    assert not solution.impulses[count:].any()
    assert solution.impulses[:count].all()
    assert (np.diff(solution.impulse_times[:count]) > 0).all()
    assert ((solution.impulse_times[:count] >= 0) & (solution.impulse_times[:count] <= 1)).all()
    assert_allclose(np.abs(solution.impulses).sum(), solution.norm, rtol=1e-13)


@given(signs, sizes, sizes, sizes)
def test_regime_chebyshev(sign, first, second, third):
    """The regime of (4.9) and (4.10)."""
    amplitudes = sign * np.array([first, -second, third])
    solution = minimum_impulse(maneuver_with(of_impulses([1.0, 0.5, 0.0], amplitudes)))
    assert solution.regime == "chebyshev"
    assert solution.impulse_times.tolist() == [0.0, 0.5, 1.0]
    assert_allclose(solution.impulses, amplitudes, rtol=1e-11)
    assert solution.unique


@given(signs, sizes, sizes, st.floats(0.51, 0.99))
def test_regime_end_and_its_mirror_start(sign, outer, inner, place):
    """One impulse at the end, an opposite one before the middle; reversed, at the start and after it."""
    end = minimum_impulse(maneuver_with(of_impulses([0.0, place], sign * np.array([outer, -inner]))))
    start = minimum_impulse(maneuver_with(of_impulses([1.0, 1 - place], sign * np.array([outer, -inner]))))
    assert (end.regime, start.regime) == ("end", "start")
    assert_allclose(end.impulse_times, [1 - place, 1.0, np.nan], rtol=1e-9)
    assert_allclose(start.impulse_times, [0.0, place, np.nan], rtol=1e-9)
    assert_allclose(end.impulses, [-sign * inner, sign * outer, 0.0], rtol=1e-8)
    assert_allclose(start.impulses, [sign * outer, -sign * inner, 0.0], rtol=1e-8)
    assert end.unique and start.unique


@given(signs, st.lists(st.tuples(st.floats(0.05, 0.95), sizes), min_size=3, max_size=6))
def test_regime_moment_costs_what_x3_gains_and_is_not_unique(sign, impulses):
    places, amplitudes = np.array(impulses).T
    if np.ptp(places) < 0.1:
        return
    c = of_impulses(places, sign * amplitudes)
    solution = minimum_impulse(maneuver_with(c))
    assert solution.regime == "moment"
    assert not solution.unique
    assert_allclose(solution.norm, abs(c[2]), rtol=1e-13)
    assert (np.sign(solution.impulses[solution.impulses != 0]) == sign).all()


@given(signs, sizes, st.floats(0.0, 1.0))
def test_the_border_of_the_moment_cone_is_one_impulse_and_unique(sign, size, place):
    solution = minimum_impulse(maneuver_with(of_impulses([place], [sign * size])))
    assert_allclose(solution.norm, size, rtol=1e-14)
    assert solution.unique
    assert solution.certificate.holds(1e-13 * max(1, size))


@given(signs, sizes, sizes)
def test_equal_signs_at_both_ends_are_unique_too(sign, first, last):
    solution = minimum_impulse(maneuver_with(of_impulses([1.0, 0.0], sign * np.array([first, last]))))
    assert solution.regime == "moment"
    assert solution.unique
    assert_allclose(solution.impulses, [sign * first, sign * last, 0.0], rtol=1e-11)


@pytest.mark.parametrize("excess", [1e-4, 1e-6, 1e-8, 1e-10, 1e-13])
@pytest.mark.parametrize("side", [-1, 1])
def test_next_to_the_border_of_chebyshev_the_cost_is_exact(excess, side):
    """The inner of two opposite impulses is next to the middle: the bounds of both regimes nearly agree."""
    for places in ([0.0, 0.5 + side * excess], [1.0, 0.5 + side * excess]):
        solution = minimum_impulse(maneuver_with(of_impulses(places, [1.0, -2.0])))
        assert_allclose(np.abs(solution.impulses).sum(), solution.certificate.dual_value, rtol=2e-14)
        assert solution.certificate.holds(1e-13)


@pytest.mark.parametrize(
    "c",
    [
        [1e-20, 0.0, 1.0],
        [-1e-20, 0.0, 1.0],
        [0.0, 1.7e-8, 1.0],
        [1e-20, -1e-20, 1.0],
        [-1e-20, 3e-17, 1.0],
        [-1.574534804084687e-10, -1.7745618437544418e-05, -1.0],
        [0.5, 1.0, 1.0],
        [0.5 + 9.4443706e-9, 1 + 1.25928128e-8, 1.0],
        [0.125, 0.5, 1.0],
    ],
)
def test_corners_of_the_moment_cone(c):
    """Moments of one impulse up to rounding: no division by zero, no place outside [0, 1], no residual."""
    for sign in (1, -1):
        solution = minimum_impulse(maneuver_with(sign * np.array(c)))
        assert solution.certificate.holds(1e-14)
        flown = sum(amplitude * response(1 - t) for t, amplitude in present(solution))
        assert_allclose(flown, sign * np.array(c), atol=2e-14)


def test_nothing_to_do_is_regime_zero():
    solution = minimum_impulse(Maneuver([1, 0, 0], [1, 0, 0], 1.0))
    assert (solution.regime, float(solution.norm), bool(solution.unique)) == ("zero", 0.0, True)
    assert np.isnan(solution.impulse_times).all()
    assert not solution.impulses.any()
    assert not solution.multipliers.any()


def test_the_regimes_of_a_stack_are_an_array():
    c = np.array([[1.0, 0, 0], [0, 0, 0], [0.1, 0.4, 1]])
    solution = minimum_impulse(maneuver_with(c))
    assert solution.regime.tolist() == ["chebyshev", "zero", "moment"]
    assert solution.unique.tolist() == [True, True, False]


def test_the_control_is_zero_and_infinite_at_the_impulses():
    solution = minimum_impulse(Maneuver([0, 0, 0], [1, 0, 0], 2.0))
    assert solution.control([0.0, 0.5, 1.0, 1.5, 2.0]).tolist() == [np.inf, 0.0, -np.inf, 0.0, np.inf]
    assert solution.breakpoints.tolist() == [1.0]


def test_the_state_is_that_before_an_impulse_at_the_start_and_after_any_other():
    solution = minimum_impulse(Maneuver([0, 0, 0], [1, 0, 0], 2.0))
    assert solution.state([0.0, 1e-9, 1.0, 2.0])[:, 2].tolist() == [0.0, 1.0, -1.0, 0.0]
