"""A growing power of the thrust leads from least energy to least time."""

import math

import numpy as np
import pytest

from pontryagin.numerics.complex_step import derivative
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.power import SMOOTHING, PowerCost

PEAK, END = 0.1, 1.7
SIZES = np.linspace(0.0, 3.0, 40) / PEAK
"""|n|, up to three times that at the meeting."""


@pytest.mark.parametrize("theta", [0.5, 0.3, 0.1, 0.0])
def test_slopes_are_derivatives_of_the_gain(theta):
    cost = PowerCost(theta, END, PEAK)
    gain = cost.gain(SIZES**2)
    assert gain[0][0] == pytest.approx(0, abs=1e-15)
    for order in (0, 1):
        value, slope = derivative(lambda x, order=order: cost.gain(x)[order], SIZES**2)
        assert gain[order] == pytest.approx(value) and gain[order + 1] == pytest.approx(slope, abs=1e-12)


def test_the_square_of_the_thrust_is_the_energy():
    energy = RunningCost(0.0, 1 / (2 * END * PEAK**2), math.inf)
    power = PowerCost(0.5, END, PEAK)
    for one, other in zip(power.gain(SIZES**2), energy.gain(SIZES**2), strict=True):
        assert one == pytest.approx(other)
    end_thrust = 2 / PEAK * power.gain(np.array(1 / PEAK**2))[1]
    assert end_thrust == pytest.approx(END * PEAK)


def test_the_infinite_power_bounds_the_thrust():
    gain, slope, _ = PowerCost(0.0, END, PEAK).gain(SIZES**2)
    least_time, *_ = RunningCost(1.0, 0.0, PEAK).gain(SIZES[1:] ** 2)
    thrust = 2 * SIZES * slope
    assert np.abs(gain[1:] - least_time).max() <= SMOOTHING
    assert (thrust <= PEAK).all() and thrust[SIZES > 10 * SMOOTHING / PEAK] == pytest.approx(PEAK, rel=1e-2)


@pytest.mark.parametrize("theta", [0.5, 0.3, 0.1])
def test_thrust_grows_with_the_power_of_the_switching_function(theta):
    _, slope, _ = PowerCost(theta, END, PEAK).gain(np.array([1.0, 4.0]) / PEAK**2)
    thrust = 2 / PEAK * np.array([1.0, 2.0]) * slope
    assert thrust[1] / thrust[0] == pytest.approx(2 ** (theta / (1 - theta)), rel=2e-3)
    assert thrust[0] / PEAK == pytest.approx(END ** (theta / (1 - theta)), rel=2e-3)
