"""Solutions compared with fifty-digit arithmetic, in cases that are hard in double precision."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import bang_bang_moments, exact_peak, exactly
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak
from strategies import maneuver_with, moments, states, wide


def exact_moments(x0, xf, T):
    """The moments c in extended precision, from ends given as floats."""
    a, b, T = [exactly(x) for x in x0], [exactly(x) for x in xf], exactly(T)
    return [b[0] - a[0] - T * a[1] - T * T * a[2] / 2, b[1] - a[1] - T * a[2], b[2] - a[2]]


def exact_energy(c, T):
    """sqrt(c' D^-1 c) with D of (2.1), by solving in fifty digits."""
    powers = [2, 1, 0]
    scale = [mp.mpf(1) / 2, 1, 1]
    D = mp.matrix(3, 3)
    for i in range(3):
        for j in range(3):
            n = powers[i] + powers[j] + 1
            D[i, j] = scale[i] * scale[j] * mp.mpf(T) ** n / n
    c = mp.matrix(c)
    return mp.sqrt((c.T * mp.lu_solve(D, c))[0])


def exact_impulse(c, T):
    """Largest p.mu over the extreme quadratics, from the closed form of the theory, in fifty digits."""
    m = [c[2], c[1] / T, 2 * c[0] / T**2]

    def one_side(m0, m1, m2):
        bounds = [abs(m0 - 4 * m1 + 2 * m2), abs(m0 - 8 * m1 + 8 * m2)]
        if m2 != 0 and 1 < m1 / m2 < 2:
            bounds.append(abs(m0 - 2 * m1**2 / m2))
        return max(bounds)

    return max(abs(m[0]), one_side(*m), one_side(m[0], m[0] - m[1], m[0] - 2 * m[1] + m[2]))


@pytest.mark.parametrize(
    ("solve", "exact"),
    [
        (minimum_energy, exact_energy),
        (minimum_impulse, exact_impulse),
        (minimum_peak, lambda c, T: exact_peak_of(c, T)),
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


def exact_peak_of(c, T):
    """The least peak for any T, from the roots of the quartic after scaling to T = 1."""
    scaled = [c[0] / T**3, c[1] / T**2, c[2] / T]
    size = max(map(abs, scaled))
    return size * exact_peak([x / size for x in scaled]) if size else mp.mpf(0)


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
