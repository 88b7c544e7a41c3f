"""Adaptive Gauss panels against integrals known in closed form."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.numerics.quadrature import Halving, gauss, integral, integrals


@pytest.mark.parametrize(
    ("rate", "edges", "expected"),
    [
        (np.exp, [0.0, 1.0], math.e - 1),
        (lambda x: 1 / (1e-6 + x**2), [-1.0, 0.3, 1.0], 2e3 * math.atan(1e3)),
        (np.sqrt, [0.0, 1.0], 2 / 3),
        (np.abs, [-1.0, 0.0, 2.0], 2.5),
    ],
    ids=["smooth", "peaked", "root", "kink at an edge"],
)
def test_known_integrals(rate, edges, expected):
    value, finished = integral(rate, edges)
    assert value == pytest.approx(expected, rel=1e-13) and finished


def test_a_kink_inside_a_panel_is_closed_in_on():
    value, finished = integral(lambda x: np.abs(x - 1 / 3), [0.0, 1.0])
    assert value == pytest.approx(5 / 18, rel=1e-13) and finished


def test_what_is_not_integrable_is_never_finished():
    _, finished = integral(lambda x: 1 / x, [0.0, 1.0])
    assert not finished


def test_rounding_in_the_density_does_not_halve_for_ever():
    """With noise of 1e-11 no halving satisfies the strict tolerance; the loose one is satisfied."""
    calls = []

    def noisy(x):
        calls.append(len(x))
        return 1 + 1e-11 * np.sin(1e12 * x)

    value, finished = integral(noisy, [0.0, 1.0], Halving(strict=3, most=6))
    assert finished and value == pytest.approx(1, abs=1e-11) and sum(calls) < 1000


def test_members_have_panels_and_columns_of_their_own():
    """Mean and second moment of exp(-k x), k = 1, 2, 3, on different panels."""
    member = np.array([0, 0, 1, 2])
    low, high = np.array([0.0, 1.0, 0.0, 0.0]), np.array([1.0, 2.0, 2.0, 2.0])

    def density(x, which):
        fall = np.exp(-(which + 1)[:, None] * x)
        return np.stack([fall, x * fall], axis=-1)

    values, finished = integrals(density, member, low, high)
    k = np.arange(1, 4)
    expected = [(1 - np.exp(-2 * k)) / k, (1 - (1 + 2 * k) * np.exp(-2 * k)) / k**2]
    assert_allclose(values.T, expected, rtol=1e-14)
    assert finished.all()


def test_only_the_judged_columns_ask_for_panels():
    counted = []

    def density(x, _):
        counted.append(len(x))
        return np.stack([np.ones_like(x), np.sqrt(x)], axis=-1)

    member, low, high = np.zeros(1, dtype=int), np.zeros(1), np.ones(1)
    values, _ = integrals(density, member, low, high, judged=slice(0, 1))
    assert sum(counted) == 3 and values[0, 0] == pytest.approx(1)


def test_the_rule_is_exact_for_polynomials_up_to_its_degree():
    nodes, weights = gauss(5)
    assert_allclose([(weights * nodes**k).sum() for k in range(10)], 1 / np.arange(1, 11), rtol=1e-14)
