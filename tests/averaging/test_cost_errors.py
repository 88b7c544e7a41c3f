"""Orders in epsilon of the errors of the averaged cost and of the corrected cost."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.averaging import rotor, smooth_example
from pontryagin.averaging.cost_errors import (
    CostErrors,
    errors,
    least_between,
    measured,
    problems,
)
from pontryagin.averaging.exact.count import window

X = sp.Symbol("x", real=True)
EPSILONS = (0.08, 0.04, 0.02, 0.01)


def test_the_first_correction_takes_the_error_from_the_first_order_to_the_second():
    solution = smooth_example(1, 2, k=1.0, ripple=0.5)
    found = measured(solution, EPSILONS)
    assert found.slope(found.averaged) == pytest.approx(1, abs=0.1)
    bound = np.pi**2 / 2 / window(solution).authority  # the phase at the end is off by half a turn at most
    assert (found.corrected < 1.1 * bound * found.epsilon**2).all()
    assert (
        np.abs(found.exact - found.first - found.epsilon * found.correction) < bound * found.epsilon**2
    ).all()
    assert found.averaged[-1] > 50 * found.corrected[-1]


@pytest.mark.slow
def test_without_the_way_between_the_ends_a_lopsided_rotor_stays_at_the_first_order():
    found = measured(problems()["lopsided rotor"][0](), EPSILONS)
    assert found.slope(found.ends) == pytest.approx(1, abs=0.25)
    assert found.slope(found.corrected) == pytest.approx(2, abs=0.3)
    assert_allclose(found.correction, sum(found.terms.values()))


def test_least_time_is_corrected_for_the_anomaly_that_it_ends_at():
    found = measured(rotor(2.0, 5.0, potential=sp.cos(X), peak=1.0), EPSILONS)
    assert found.correction.shape == (4,)
    assert found.slope(found.corrected) == pytest.approx(2, abs=0.3)
    assert found.corrected[-1] < 0.1 * found.averaged[-1]


def test_a_slope_is_that_of_a_power():
    epsilon = np.array([0.1, 0.03, 0.01])
    known = CostErrors("", epsilon, epsilon, 1 + 3 * epsilon**2, 1.0, {"start": np.float64(0)})
    assert known.slope(known.averaged) == pytest.approx(2)


def test_the_least_cost_between_minima_is_no_more_than_the_best():
    found = smooth_example(1, 2, k=1.0, ripple=0.5).exact(0.02)
    between = least_between(found)
    assert found[0].cost - 5e-3 < between <= found[0].cost
    assert least_between(found[:1]) == found[0].cost


def test_only_known_problems_are_measured():
    with pytest.raises(ValueError, match="name: got 'top'"):
        errors("top")
