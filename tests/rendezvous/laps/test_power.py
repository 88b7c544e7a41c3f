"""A growing power of the thrust leads from least energy to least time."""

import math

import numpy as np
import pytest

from pontryagin.numerics.complex_step import derivative
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.laps.families import least_energy
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.power import SMOOTHING, PowerCost
from pontryagin.rendezvous.laps.transcription import Path, extremal
from pontryagin.rendezvous.problem.cases import cases

PEAK = 0.1
SIZES = np.linspace(0.0, 3.0, 40) / PEAK
"""|n|, up to three times 1/p_max."""


@pytest.mark.parametrize("theta", [0.5, 0.3, 0.1, 0.0])
def test_slopes_are_derivatives_of_the_gain(theta):
    cost = PowerCost(theta, PEAK)
    gain = cost.gain(SIZES**2)
    assert gain[0][0] == pytest.approx(0, abs=1e-15)
    for order in (0, 1):
        value, slope = derivative(lambda x, order=order: cost.gain(x)[order], SIZES**2)
        assert gain[order] == pytest.approx(value) and gain[order + 1] == pytest.approx(slope, abs=1e-12)


def test_the_square_of_the_thrust_is_the_energy():
    energy = RunningCost(0.0, 1 / (2 * PEAK**2), math.inf)
    for one, other in zip(PowerCost(0.5, PEAK).gain(SIZES**2), energy.gain(SIZES**2), strict=True):
        assert one == pytest.approx(other)


def test_the_infinite_power_bounds_the_thrust():
    gain, slope, _ = PowerCost(0.0, PEAK).gain(SIZES**2)
    least_time, *_ = RunningCost(1.0, 0.0, PEAK).gain(SIZES[1:] ** 2)
    thrust = 2 * SIZES * slope
    assert np.abs(gain[1:] - least_time).max() <= SMOOTHING
    assert (thrust <= PEAK).all() and thrust[SIZES > 10 * SMOOTHING / PEAK] == pytest.approx(PEAK, rel=1e-2)


@pytest.mark.parametrize("theta", [0.5, 0.3, 0.1])
def test_thrust_is_the_best_for_the_cost(theta):
    sizes = SIZES[SIZES > 10 * SMOOTHING / PEAK]
    gain, slope, _ = PowerCost(theta, PEAK).gain(sizes**2)
    thrust = 2 * sizes * slope
    for share in (0.9, 1.0, 1.1):
        value = share * thrust * sizes - theta * (share * thrust / PEAK) ** (1 / theta)
        assert (value <= gain + SMOOTHING).all()
    best = thrust * sizes - theta * (thrust / PEAK) ** (1 / theta)
    assert best == pytest.approx(gain, abs=SMOOTHING)


def test_free_time_ends_at_the_given_size():
    cost = PowerCost(0.3, PEAK, 1.3)
    assert cost.time_weight == cost.gain(np.array([1.3**2]))[0][0]


@pytest.mark.parametrize("theta", [0.5, 0.3])
def test_mean_thrust_falls_with_the_duration_at_its_slope(theta):
    scaled = cases()["circle"].problem.scaled
    lap, cost, duration, step = Lap.of(scaled, 0), PowerCost(theta, scaled.peak), 2.5, 1e-3
    start = least_energy(lap, duration)
    nodes = start.nodes.copy()
    nodes[6:] /= 2 * scaled.peak**2
    start = Path(nodes, start.price / (2 * scaled.peak**2), start.span, start.duration)
    near = [extremal(lap, cost, duration * math.exp(shift), start) for shift in (-step, 0.0, step)]
    means = [cost.mean_thrust(lap, path) for path in near]
    assert (means[2][0] - means[0][0]) / (2 * step) == pytest.approx(means[1][1], rel=0.02)
