"""Solutions compared with fifty-digit arithmetic, in cases that are hard in double precision."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import (
    bang_bang_moments,
    exact_energy,
    exact_impulse,
    exact_moments,
    exact_peak,
    exact_peak_of,
    exactly,
)
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak
from strategies import maneuver_with, moments, states, wide


@pytest.mark.parametrize(
    ("solve", "exact"),
    [
        (minimum_energy, exact_energy),
        (minimum_impulse, exact_impulse),
        (minimum_peak, exact_peak_of),
    ],
)
@given(x0=states(wide()), xf=states(wide()), duration=st.floats(-3, 3).map(lambda e: 10.0**e))
def test_norms_over_six_decades_of_data(solve, exact, x0, xf, duration):
    """The tolerance is relative to the norm plus that of the moduli of the moments' terms, for rounding."""
    with mp.workdps(50):
        expected = exact(exact_moments(x0, xf, duration), exactly(duration))
        sizes = exact_moments(-np.abs(x0), np.abs(xf), duration)
        allowed = exact([abs(s) for s in sizes], exactly(duration)) + expected
    found = solve(Maneuver(x0, xf, duration)).norm
    assert abs(float(found - expected)) <= 2e-14 * float(allowed)


@pytest.mark.parametrize(
    ("solve", "exact", "rtol"),
    [(minimum_impulse, exact_impulse, 1e-14), (minimum_energy, exact_energy, 1e-13)],
)
@given(c=moments())
def test_norms_to_the_last_digits(solve, exact, rtol, c):
    with mp.workdps(50):
        expected = exact([exactly(x) for x in c], mp.mpf(1))
    assert_allclose(float(solve(maneuver_with(c)).norm), float(expected), rtol=rtol, atol=0)


@given(
    width=st.floats(-14, -3).map(lambda e: 10.0**e),
    place=st.floats(0, 1),
    disturb=st.tuples(*[st.integers(-3, 3)] * 3),
)
def test_nearly_constant_controls_perturbed_in_the_last_bits(width, place, disturb):
    """The quartic has a triple root at the constant control, yet the peak keeps all its digits near it."""
    b = place * (1 - width)
    c = bang_bang_moments(1.0, b + width, b)
    c = c + np.spacing(c) * disturb
    solution = minimum_peak(maneuver_with(c))
    assert_allclose(float(solution.norm), float(exact_peak(c, digits=90)), rtol=1e-13)
    assert solution.certificate.holds(1e-12)


@pytest.mark.parametrize("duration", [1e-6, 1e-3, 1e3, 1e6])
@pytest.mark.parametrize("size", [1e-100, 1e-3, 1e3, 1e100])
@pytest.mark.parametrize("solve", [minimum_energy, minimum_peak, minimum_impulse])
def test_extreme_units_are_as_exact_as_usual_ones(solve, duration, size):
    unit = np.array([0.3, -0.2, 0.5])
    usual = solve(Maneuver([0, 0, 0], unit, 1.0))
    extreme = solve(Maneuver([0, 0, 0], unit * size * duration ** np.array([3.0, 2, 1]), duration))
    power = {minimum_energy: 0.5, minimum_peak: 0.0, minimum_impulse: 1.0}[solve]
    assert_allclose(extreme.norm, usual.norm * size * duration**power, rtol=1e-13)
    assert extreme.certificate.primal_residual <= 1e-14
    assert_allclose(extreme.multipliers @ extreme.maneuver.moments, 1.0, rtol=1e-12)
    assert_allclose(extreme.certificate.dual_value, extreme.norm, rtol=1e-13)
