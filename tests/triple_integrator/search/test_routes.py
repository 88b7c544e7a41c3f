"""The paper's numerical routes: their formulas against integrals, and their results against certificates."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad

from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.search import REASONS, ROUTES, multiplier_range, search, survey
from pontryagin.triple_integrator.search.formulas import area_from_zeros, zeros_from_multiplier

few = settings(max_examples=20, deadline=None)
numbers = st.floats(-2, 2, allow_subnormal=False).map(lambda x: round(x, 3))
SCALE = np.array([6.0, 2.0, 1.0])


@pytest.fixture(scope="module")
def found():
    return survey(count=150, seed=1)


@few
@given(st.tuples(numbers, numbers, numbers), st.floats(0.01, 0.98), st.floats(0.01, 0.98), st.floats(0.5, 3))
def test_the_area_is_the_integral_of_the_modulus_and_its_slopes_are_its_derivatives(c, first, second, T):
    t1, t2 = sorted((first * T, second * T))
    c = np.array(c) * [T**3, T**2, T]
    c0 = c @ [1, (t1 + t2) / 2 - T, (T - t1) * (T - t2) / 2]
    if abs(c0) < 1e-3 or t2 - t1 < 1e-3:
        return
    area, slope1, slope2, printed_c0 = (float(x) for x in area_from_zeros()(t1, t2, *c, T))
    modulus = sum(
        quad(lambda t: abs((t - t1) * (t - t2) / (2 * c0)), *ends)[0] for ends in ((0, t1), (t1, t2), (t2, T))
    )
    assert_allclose(printed_c0, c0, rtol=1e-9)
    assert_allclose(area, np.sign(c0) * modulus, rtol=1e-9)
    step = 1e-6
    for slope, dt in ((slope1, (step, 0)), (slope2, (0, step))):
        ahead, behind = (float(area_from_zeros()(t1 + s * dt[0], t2 + s * dt[1], *c, T)[0]) for s in (1, -1))
        assert_allclose(slope, (ahead - behind) / (2 * step), rtol=1e-3, atol=1e-5 * abs(area) / abs(c0))


@few
@given(st.tuples(numbers, numbers, numbers))
def test_the_curve_passes_through_the_optimum(c):
    """At lambda~ = -1/v (3.19) gives the certified switches, and (3.16) gives the multiplier l1 = 2 alpha."""
    m = Maneuver([0, 0, 0], np.array(c) / SCALE, tf=1.0)
    best = minimum_peak(m)
    if best.norm < 0.1 or not np.isfinite(best.switch_times).all() or np.diff(best.switch_times)[0] < 1e-3:
        return
    level = float(best.first_sign * best.norm)
    t1, t2, alpha = (float(x) for x in zeros_from_multiplier()(-1 / level, *m.moments, 1.0))
    assert_allclose([t1, t2], best.switch_times, atol=1e-9)
    assert_allclose(2 * alpha, best.multipliers[0], rtol=1e-7)
    assert_allclose(1 / abs(float(area_from_zeros()(t1, t2, *m.moments, 1.0)[0])), best.norm, rtol=1e-10)
    low, high = multiplier_range(m.moments)
    assert low - 1e-12 <= -1 / level <= high + 1e-12


@pytest.mark.parametrize("route", ROUTES)
def test_example_2(route):
    """u0 = 32 gamma / T^3 with the zeros at T/4 and 3T/4, (3.20); alpha = 1/(2 gamma) by (3.10)."""
    gamma, T = 0.7, 3.0
    result = search(Maneuver([0, 0, 0], [gamma, 0, 0], tf=T + 1, t0=1.0), route)
    assert result.right
    assert_allclose(result.peak, 32 * gamma / T**3, rtol=1e-9)
    assert_allclose(result.switch_times, [1 + T / 4, 1 + 3 * T / 4], atol=1e-6)
    assert_allclose(result.curvature, 1 / (2 * gamma), rtol=1e-9)


def test_in_example_2_the_search_leaves_the_multiplier_open():
    """With c2 = c3 = 0 neither zero depends on lambda~, so that (3.16) does not determine alpha."""
    anywhere = np.array([-0.3, 0.0, 0.01])
    t1, t2, alpha = zeros_from_multiplier()(anywhere, 0.5, 0.0, 0.0, 1.0)
    assert_allclose([t1, t2], [[0.25] * 3, [0.75] * 3])
    assert np.ptp(alpha) > 1


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("gamma", [1e-9, 1e9])
@pytest.mark.parametrize("T", [1e-3, 1e3])
def test_units_do_not_matter(route, gamma, T):
    c = np.array([1.0, -0.2, -0.3])
    plain = search(Maneuver([0, 0, 0], c, tf=1.0), route)
    scaled = search(Maneuver([0, 0, 0], gamma * c / [1, T, T**2], tf=T), route)
    assert plain.reason == scaled.reason
    assert_allclose(scaled.peak, plain.peak * gamma / T**3, rtol=1e-5)
    assert_allclose(scaled.switch_times / T, plain.switch_times, atol=1e-4)
    assert_allclose(scaled.curvature * gamma, plain.curvature, rtol=1e-3)


@pytest.mark.slow
def test_what_is_right_is_the_certified_level(found):
    for results in found.results.values():
        for k, result in zip(found.directions, results, strict=True):
            best = minimum_peak(Maneuver(np.zeros(3), k / SCALE, tf=1.0))
            assert best.certificate.holds(1e-12)
            agrees = abs(result.peak / best.norm - 1) <= 1e-6
            assert agrees or not result.right
            assert result.reason in ("", *REASONS)


def test_within_the_domain_no_zeros_give_more_than_the_least_peak(found):
    """Within the domain |F| is the norm of a dual function, so that 1/|F| is always a lower bound."""
    for results in found.results.values():
        for k, result in zip(found.directions, results, strict=True):
            t1, t2 = result.switch_times
            if 0 <= t1 < t2 <= 1 and result.reason != "singular":
                assert result.peak <= minimum_peak(Maneuver(np.zeros(3), k / SCALE, tf=1.0)).norm * (1 + 1e-9)


def test_both_curvatures_agree_at_the_least_peak(found):
    for result in found.results["multiplier within"]:
        assert_allclose(result.curvature_by_multiplier, result.curvature, rtol=1e-3)


def test_the_global_search_is_always_right_and_the_others_are_not(found):
    assert found.share_right("multiplier within") == 1
    assert 0.9 < found.share_right("multiplier modulus") < 1
    assert 0.9 < found.share_right("zeros within") < 1
    assert 0.7 < found.share_right("zeros") < found.share_right("zeros within")
    assert 0.3 < found.share_right("multiplier") < 0.6


def test_without_the_modulus_the_search_fails_wherever_the_curvature_is_negative_at_first(found):
    """F is then negative and tends to minus infinity; this happens for one of c and -c."""
    for k, result in zip(found.directions, found.results["multiplier"], strict=True):
        c0 = (k / SCALE) @ [1, -1 / 2, 3 / 32]
        assert c0 > 0 or not result.right


def test_opposite_moments_are_searched_alike():
    for route in set(ROUTES) - {"multiplier"}:
        for xf in ([1, -0.2, -0.3], [0.1, 1, 0.3], [0.2, 0.5, 1]):
            there, back = (search(Maneuver([0, 0, 0], s * np.array(xf), tf=1.0), route) for s in (1, -1))
            assert there.reason == back.reason
            assert_allclose(there.peak, back.peak, rtol=1e-8)


@pytest.mark.parametrize(
    ("k", "reason", "low", "high"),
    [((2, 1, -2), "outside", 0.67, 0.69), ((1, 1, 2), "crossed", 1.015, 1.016)],
)
def test_the_free_search_leaves_the_domain_and_is_then_no_bound(k, reason, low, high):
    """If a zero is outside or t1 > t2, the level found is too low for some moments, too high for others."""
    m = Maneuver(np.zeros(3), np.array(k) / SCALE, tf=1.0)
    best, result = minimum_peak(m), search(m, "zeros")
    assert best.certificate.holds(1e-12)
    assert result.reason == reason
    assert low < result.peak / best.norm < high
    t1, t2 = result.switch_times
    assert t1 > t2 if reason == "crossed" else t1 < 0


@few
@given(st.tuples(numbers, numbers, numbers))
def test_without_its_bounds_the_area_has_zeros_whatever_is_asked(c):
    """F vanishes at t1 = 1/2 + d, t2 = 1/2 - d, d > 0, where c0 does not, so that 1/|F| is unbounded."""
    d = -min(np.roots([8, -3, 0, 1 / 4]).real)
    if abs(np.array(c) @ [1, -1 / 2, (1 / 4 - d * d) / 2]) < 1e-3:
        return
    area = area_from_zeros()(0.5 + d, 0.5 - d, *c, 1.0)[0]
    assert abs(area) <= 1e-12
    area_in_order = area_from_zeros()(0.5 - d, 0.5 + d, *c, 1.0)[0]
    assert abs(area_in_order) > 0.01


def test_the_table_adds_up(found):
    table = found.table()
    assert table["route"] == list(ROUTES)
    assert_allclose(np.sum([table[name] for name in ("right", *REASONS)], axis=0), 1)
    assert table["right"] == [found.share_right(route) for route in ROUTES]
    assert all(count >= 1 for count in table["evaluations"])
    again = survey(count=150, seed=1, routes=["zeros"])
    assert again.share_right("zeros") == found.share_right("zeros")


@pytest.mark.parametrize(
    ("maneuver", "route", "says"),
    [
        (Maneuver([0, 0, 0], [1, 0, 0], tf=1.0), "newton", "route must be one of zeros,"),
        (Maneuver([0, 0, 0], [0, 0, 0], tf=1.0), "zeros", "got c = 0"),
        (Maneuver([0, 0, 0], [[1, 0, 0]], tf=1.0), "zeros", "got a stack of shape (1,)"),
    ],
)
def test_wrong_arguments_are_named(maneuver, route, says):
    with pytest.raises(ValueError) as raised:
        search(maneuver, route)
    assert says in str(raised.value)
