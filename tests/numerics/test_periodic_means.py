"""Means over a turn against mpmath and closed forms, for densities that are smooth, nearly so, or not."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import ellipe

from pontryagin.numerics.periodic_means import (
    CHECKING,
    SOLVING,
    find_switches,
    halved_mean,
    mean,
    smooth_mean,
    split_mean,
)

RULES = [SOLVING, CHECKING]


def density(function):
    """A maker of densities with one column, function(x, parameter), from the parameters of the points."""

    def make(parameters):
        values = np.atleast_1d(parameters)
        return lambda x, index: function(x, values[index][:, None])[..., None]

    return make


poisson = density(lambda x, r: 1 / (1 - r * np.cos(x)))


@pytest.mark.parametrize("rule", RULES)
@given(st.floats(0, 0.999))
def test_the_trapezoid_is_exact_to_rounding_for_poles_at_any_distance(rule, r):
    value = smooth_mean(poisson(r), 1, rule)[0, 0]
    assert value == pytest.approx(1 / np.sqrt(1 - r * r), rel=3e-12)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("harmonic", [1, 2, 4, 8, 12])
@pytest.mark.parametrize("m", [0.5, 0.99, 1 - 1e-4, 1 - 1e-8, 1 - 1e-12])
def test_densities_with_symmetries_do_not_settle_by_chance(rule, harmonic, m):
    """A short period can make a rule and its double agree on a wrong value, which must not be accepted."""
    repeated = density(lambda x, m: np.sqrt(1 - m * np.sin(harmonic * x) ** 2))
    value = smooth_mean(repeated(m), 1, rule)[0, 0]
    assert value == pytest.approx(2 / np.pi * ellipe(m), rel=1e-9)


@pytest.mark.parametrize("harmonic", [5, 8, 12, 16, 24, 32, 48, 96])
def test_a_harmonic_at_the_number_of_nodes_is_seen_or_told_by_the_other_rule(harmonic):
    wave = density(lambda x, _: 1 + np.cos(harmonic * x))
    one, other = (smooth_mean(wave(0.0), 1, rule)[0, 0] for rule in RULES)
    assert abs(one - 1) < 1e-14 or abs(one - other) > 1e-2


def test_many_points_settle_each_in_its_time():
    r = np.array([0.0, 0.5, 0.99, 0.9999999, 0.3])
    np.testing.assert_allclose(smooth_mean(poisson(r), 5)[:, 0], 1 / np.sqrt(1 - r * r), rtol=1e-9)


def test_what_is_not_defined_is_nan_and_the_rest_is_not():
    root = density(lambda x, c: np.sqrt(np.where(c + np.cos(x) < 0, np.nan, c + np.cos(x))))
    values = smooth_mean(root(np.array([2.0, 0.5])), 2)[:, 0]
    assert np.isfinite(values[0]) and np.isnan(values[1])


@pytest.mark.slow
@given(st.floats(-0.95, 0.95), st.floats(0.0, 0.9))
def test_between_switches_gauss_is_exact_to_rounding(c, r):
    """|cos x - c| / (1 - r cos x) against mpmath, split where it is not smooth."""
    kinked = density(lambda x, _: np.abs(np.cos(x) - c) / (1 - r * np.cos(x)))
    switching = lambda x, i: np.stack([np.cos(x) - c, -np.sin(x)], axis=-1) * np.ones((len(i), 1, 1))  # noqa: E731
    switches = find_switches(switching, 1)
    np.testing.assert_allclose(np.cos(switches), c, atol=1e-14)
    value = split_mean(kinked(0.0), switches, 6)[0, 0]
    mp.mp.dps = 20
    angle = mp.acos(c)
    exact = mp.quad(
        lambda x: abs(mp.cos(x) - c) / (1 - r * mp.cos(x)), [0, angle, mp.pi, 2 * mp.pi - angle, 2 * mp.pi]
    ) / (2 * mp.pi)
    assert value == pytest.approx(float(exact), rel=1e-12)


def test_points_with_and_without_switches_are_told_apart():
    c = np.array([0.3, 2.0, -0.5])
    function = density(lambda x, level: np.abs(np.cos(x) - level))(c)

    def switching(x, index):
        level = c[index][:, None]
        return np.stack([np.cos(x) - level, -np.sin(x) + 0 * level], axis=-1)

    switches = find_switches(switching, 3)
    assert np.isnan(switches).tolist() == [[False, False], [True, True], [False, False]]
    values = mean(function, switches, SOLVING)[:, 0]
    inside = 2 / np.pi * (np.sqrt(1 - np.clip(c, -1, 1) ** 2) + c * np.arcsin(np.clip(c, -1, 1)))
    np.testing.assert_allclose(values, [inside[0], 2.0, inside[2]], atol=1e-14)


def test_halving_finds_a_peak_however_narrow():
    peak = density(lambda x, w: w / (2 * np.sin((x - 1) / 2) ** 2 + w**2 / 2))
    w = np.array([1e-2, 1e-4, 1e-7])
    np.testing.assert_allclose(halved_mean(peak(w), 3)[:, 0], 1 / np.sqrt(1 + w**2 / 4), rtol=1e-9)


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-10])
@pytest.mark.parametrize("sign", [1, -1])
def test_two_switches_however_close_are_found(depth, sign):
    """sign (1 - cos(x - 1) - depth) vanishes at 1 - d and 1 + d only."""

    def switching(x, index):
        return (
            sign * np.stack([1 - np.cos(x - 1) - depth, np.sin(x - 1)], axis=-1) * np.ones((len(index), 1, 1))
        )

    d = np.arccos(1 - depth)
    np.testing.assert_allclose(find_switches(switching, 1), [[1 - d, 1 + d]], atol=1e-7)
    shallower = lambda x, i: switching(x, i) + sign * np.array([2 * depth, 0])  # noqa: E731
    assert find_switches(shallower, 1).shape == (1, 0)


def test_rules_heed_narrow_cells_of_a_turn():
    eighths = tuple(2 * np.pi * np.arange(9) / 8)
    halved = tuple(sorted({*eighths, np.pi / 8}))
    narrow = tuple(sorted({*halved, *(np.pi / 2.0**k for k in range(4, 9))}))
    assert CHECKING.on(()) == CHECKING.on(eighths) == CHECKING
    assert CHECKING.on(halved).trapezoid == 2 * CHECKING.trapezoid and not CHECKING.on(halved).edges
    assert CHECKING.on(narrow).edges == narrow


@pytest.mark.parametrize("rule", RULES)
def test_a_peak_between_all_nodes_is_seen_on_the_cells_that_hold_it(rule):
    """exp(-k (1 - cos(x - p))) has the mean exp(-k) I0(k); a step at a switch is added to it."""
    k, place = 1e6, 1.03
    cells = tuple(sorted({*np.linspace(0, 2 * np.pi, 9), *(place + 0.002 * np.arange(-8, 9))}))
    peak = density(lambda x, h: h * np.exp(-k * (1 - np.cos(x - place))) + (np.mod(x, 2 * np.pi) < 2))
    height = np.array([1.0, 50.0])
    found = mean(peak(height), np.full((2, 2), [0.0, 2.0]), rule.on(cells))[:, 0]
    assert found == pytest.approx(height * float(mp.besseli(0, k) * mp.exp(-k)) + 1 / np.pi, rel=1e-12)
