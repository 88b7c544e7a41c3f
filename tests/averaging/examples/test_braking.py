"""The spin-down simulated under the feedback control of the first approximation."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from pontryagin.averaging import spin_down
from pontryagin.averaging.examples.braking import brake

BODY = ([1.0, 0.4, 2.0], [1.3, 0.55, 0.7], 1.6)


@pytest.fixture(scope="module")
def flight():
    return brake(*BODY, 0.04)


def test_euler_s_equations_lead_through_the_flight(flight):
    ratio, push = BODY[2], CubicSpline(flight.tau / 0.04, flight.control)

    def rate(t, w):
        turning = np.array([(1 - ratio) * w[1] * w[2], (ratio - 1) * w[2] * w[0], 0])
        return turning + 0.04 * push(t)

    most = len(flight.tau) * 19 // 20
    flown = solve_ivp(
        rate,
        (0, flight.tau[most] / 0.04),
        BODY[0],
        "DOP853",
        flight.tau[:most] / 0.04,
        rtol=1e-10,
        atol=1e-11,
    )
    assert_allclose(flown.y.T, flight.rates[:most], atol=1e-5)


def test_the_control_lies_on_its_ellipse_against_the_rates(flight):
    shares = flight.control / np.array(BODY[1])
    assert_allclose((shares**2).sum(axis=1), 1, atol=1e-12)
    assert (np.einsum("ki,ki->k", flight.control[:, :2], flight.rates[:, :2]) < 0).all()
    assert_allclose(flight.control[:, 2], 0)


@pytest.mark.slow
def test_the_body_stops_within_order_epsilon_of_the_averaged_time():
    mean = float(spin_down(*BODY).duration)
    off = [abs(brake(*BODY, epsilon).tau[-1] - mean) for epsilon in (0.08, 0.02)]
    assert off[0] < 0.08 and off[1] < 0.02
    flight = brake(*BODY, 0.02)
    assert flight.transverse[-1] < 1e-5 * flight.transverse[0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"omega0": [1.0, 0.0]}, "omega0 must"),
        ({"omega0": [0.0, 0.0, 1.0]}, "omega0 must have w_x or w_y"),
        ({"omega0": [np.nan, 0.0, 1.0]}, "omega0 must"),
        ({"semiaxes": [1.0, 0.0, 1.0]}, "semiaxes must be positive"),
        ({"ratio": -1.0}, "ratio must be positive"),
        ({"epsilon": 0.0}, "epsilon must be positive"),
    ],
)
def test_bad_input_is_refused_by_name(change, message):
    given = dict(zip(("omega0", "semiaxes", "ratio"), BODY, strict=True)) | {"epsilon": 0.1} | change
    with pytest.raises(ValueError, match=message):
        brake(**given)
