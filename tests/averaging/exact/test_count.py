"""The window of the averaged family, and the number of extremals that it predicts."""

from functools import cache, partial

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import quad

from pontryagin.averaging import kepler, rotor, smooth_example, spin_down
from pontryagin.averaging.exact.count import window

X = sp.Symbol("x", real=True)


@cache
def rippled():
    return smooth_example(1, 2, k=1.0, ripple=0.5)


def turned(kappa, k=1.0, v0=1.0, v1=2.0):
    """Psi of the averaged smooth example: v' = p/2 with p^2/4 = k - kappa v, from H0 = 0."""
    return quad(lambda v: v / np.sqrt(k - kappa * v), v0, v1, epsabs=1e-12)[0]


def test_the_window_of_the_rippled_example_is_known_in_closed_form():
    """h* = -2 kappa + (p/2) cos x at v1 = 2 with p/2 = sqrt(1 - 2 kappa): 4 kappa^2 = 1 - 2 kappa."""
    found = window(rippled())
    golden = np.sqrt(5)
    assert_allclose(found.kappa, [-(golden + 1) / 4, (golden - 1) / 4], atol=1e-9)
    assert_allclose(found.turned, [turned(kappa) for kappa in found.kappa], rtol=1e-8)
    assert found.roots == pytest.approx(2)
    assert found.limits == ("no further root", "no further root")
    step = 1e-4
    assert found.authority == pytest.approx((turned(step) - turned(-step)) / (2 * step), rel=1e-5)


@pytest.mark.parametrize("epsilon", [0.1, 0.03, 0.01])
def test_as_many_extremals_are_found_as_the_window_predicts(epsilon):
    """Extremals lie near all members kappa of the window, (2.13), not only near that of (2.7)."""
    expected = window(rippled()).count(epsilon)
    found = rippled().exact(epsilon)
    assert abs(len(found) - expected) < 2
    assert abs(sum(one.kind == "minimum" for one in found) - len(found) / 2) <= 0.5


@pytest.mark.slow
def test_a_rotor_without_symmetry_has_the_extremals_predicted():
    solution = rotor(1.6, 4, potential=sp.cos(X), force=sp.sin(X), k=1.0)
    assert abs(len(solution.exact(0.05)) - window(solution).count(0.05)) < 2


@pytest.mark.slow
def test_the_precession_of_a_body_meets_four_roots_a_turn():
    found = window(spin_down([1.0, 0.4, 2.0], [1.0, 0.5, 0.7], 1.6))
    assert found.roots == pytest.approx(4)
    assert found.kappa[0] < 0 < found.kappa[1]


@pytest.mark.slow
def test_where_the_averaged_problem_ends_before_the_roots_do_it_says_so():
    found = window(kepler(-0.5, 0.9, -0.3, 0.1))
    assert found.limits == ("no further root", "no solution")
    assert found.kappa[1] == pytest.approx(0.1, rel=0.01)  # l / omega(E0), where the cost rate vanishes


@pytest.mark.parametrize(
    ("solution", "message"),
    [
        (partial(smooth_example, [1.0, 1.2], 2.0, ripple=0.5), "that of one problem"),
        (partial(rotor, 2.0, 4.0, peak=1.0, potential=sp.cos(X)), "leave the control a choice of the end"),
        (partial(smooth_example, 1.0, 2.0), "depends on the phase"),
    ],
)
def test_what_has_no_window_is_refused_by_name(solution, message):
    with pytest.raises(ValueError, match=f"solution must .*{message}"):
        window(solution())


@pytest.mark.parametrize("epsilon", [0.0, -0.1, float("nan")])
def test_a_count_asks_for_a_positive_epsilon(epsilon):
    with pytest.raises(ValueError, match="epsilon"):
        window(rippled()).count(epsilon)
