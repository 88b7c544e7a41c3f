"""Kepler's equation against its definition, Kepler's second law and textbook values."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.numerics import kepler

TAU = 2 * np.pi


@given(st.floats(-50, 50), st.floats(0, 0.999))
def test_the_equation_holds(mean, eccentricity):
    E = kepler.eccentric_anomaly(mean, eccentricity)
    assert kepler.mean_anomaly(E, eccentricity) == pytest.approx(mean, abs=1e-13)


def motion_of_many_digits(true, time, eccentricity):
    """The true anomaly, of absolute value below pi, on the orbit of parameter and gravity 1, by bisection."""
    with mp.workdps(60):
        f, t, e = (mp.mpf(float(value)) for value in (true, time, eccentricity))
        stretch = mp.sqrt((1 + e) / (1 - e))
        E = 2 * mp.atan(mp.tan(f / 2) / stretch)
        mean = E - e * mp.sin(E) + t * ((1 - e) * (1 + e)) ** mp.mpf(1.5)
        below, above = -mp.pi, mp.pi
        for _ in range(190):
            middle = (below + above) / 2
            below, above = (below, middle) if middle - e * mp.sin(middle) > mean else (middle, above)
        return float(2 * mp.atan(stretch * mp.tan(below / 2)))


@pytest.mark.parametrize("defect", [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_the_motion_is_exact_to_rounding_up_to_a_parabola(defect):
    rng = np.random.default_rng(5)
    for true, time in zip(rng.uniform(-2.4, 2.4, 12), rng.uniform(-1, 1, 12), strict=True):
        after = kepler.true_anomaly_after(true, time, 1.0, 1 - defect)
        assert after == pytest.approx(motion_of_many_digits(true, time, 1 - defect), abs=3e-15)


def test_the_apocentre_is_opposite_the_pericentre():
    for e in (0.0, 0.3, 0.9, 0.999, 1 - 1e-12):
        assert kepler.true_of_eccentric(kepler.eccentric_anomaly(np.pi, e), e) == pytest.approx(
            np.pi, abs=1e-9
        )


def test_a_textbook_value():
    """Meeus, Astronomical Algorithms, chapter 30: e = 0.1, M = 5 degrees."""
    assert np.degrees(kepler.eccentric_anomaly(np.radians(5.0), 0.1)) == pytest.approx(5.554589, abs=1e-6)


def test_arrays_broadcast_and_revolutions_are_counted():
    mean, eccentricity = np.array([0.4, -0.4, 0.4 + 3 * TAU])[:, None], np.array([0.0, 0.3, 0.9])
    E = kepler.eccentric_anomaly(mean, eccentricity)
    assert E.shape == (3, 3)
    assert_allclose(E[1], -E[0], atol=1e-15)
    assert_allclose(E[2], E[0] + 3 * TAU, atol=1e-14)
    assert_allclose(E[:, 0], mean[:, 0])


@given(st.floats(-20, 20), st.floats(0, 0.95))
def test_anomalies_come_back(true, eccentricity):
    E = kepler.eccentric_of_true(true, eccentricity)
    assert kepler.true_of_eccentric(E, eccentricity) == pytest.approx(true, abs=1e-12)
    assert abs(E - true) < np.pi
    wide = np.sqrt((1 + eccentricity) / (1 - eccentricity)) * np.sin(E / 2) * np.cos(true / 2)
    assert np.sin(true / 2) * np.cos(E / 2) == pytest.approx(wide, abs=1e-11)


def test_the_radius_sweeps_equal_areas():
    """r^2 df/dt = sqrt(mu p)."""
    times = np.linspace(0, 30, 7)
    parameter, e, gravity, h = 1.4, 0.6, 2.5, 1e-5
    after = [kepler.true_anomaly_after(0.8, times + s, parameter, e, gravity) for s in (-h, 0, h)]
    radius = parameter / (1 + e * np.cos(after[1]))
    assert_allclose(radius**2 * (after[2] - after[0]) / (2 * h), np.sqrt(gravity * parameter), rtol=1e-8)
    period = TAU / kepler.mean_motion(parameter, e, gravity)
    assert kepler.true_anomaly_after(0.8, 4 * period, parameter, e, gravity) == pytest.approx(0.8 + 4 * TAU)
