"""Flows by either integrator have the conserved quantities, periods and closed forms of known equations."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.errors import NotConverged
from pontryagin.numerics.flow import flow, has_heyoka
from pontryagin.numerics.lanes import ends

x, v, k, m, t = sp.symbols("x v k m t")
KINDS = [pytest.param(False, id="DOP853"), *([pytest.param(True, id="heyoka")] if has_heyoka() else [])]


@pytest.mark.parametrize("taylor", KINDS)
def test_a_pendulum_keeps_its_energy(taylor):
    swing = flow([x, v], [v, -k * sp.sin(x)], [k], taylor=taylor)
    path = swing([2.0, 0.3], np.linspace(0.0, 20.0, 41), [1.7])
    energy = path[:, 1] ** 2 / 2 - 1.7 * np.cos(path[:, 0])
    assert_allclose(energy, energy[0], rtol=0, atol=2e-12)


@pytest.mark.parametrize("taylor", KINDS)
def test_the_kepler_orbit_closes_after_its_period(taylor):
    px, py, vx, vy = sp.symbols("px py vx vy")
    cube = sp.sqrt(px**2 + py**2) ** 3
    orbit = flow([px, py, vx, vy], [vx, vy, -px / cube, -py / cube], taylor=taylor)
    start = [1.0, 0.0, 0.0, 1.2]
    period = 2 * np.pi / (2.0 - 1.2**2) ** 1.5
    assert_allclose(orbit(start, [0.0, period])[-1], start, atol=1e-11)


@pytest.mark.parametrize("taylor", KINDS)
def test_the_clock_may_stand_in_the_rates(taylor):
    driven = flow([x], [k * sp.cos(t)], [k], taylor=taylor, clock=t)
    grid = np.linspace(1.0, 4.0, 7)
    assert_allclose(driven([0.5], grid, [3.0])[:, 0], 0.5 + 3 * (np.sin(grid) - np.sin(1.0)), atol=1e-13)


@pytest.mark.parametrize("taylor", KINDS)
def test_many_trajectories_reach_the_ends_of_their_own_spans(taylor):
    carry = ends([x, v], [v, -(k**2) * x + sp.sin(t)], [k], clock=t, wrt=[x, v], taylor=taylor)
    rng = np.random.default_rng(3)
    count = 11
    starts, rate = rng.standard_normal((count, 2)), rng.uniform(1.5, 3.0, count)
    begin, span = rng.uniform(-2, 2, count), rng.uniform(-5, 5, count)
    states, slopes = carry(starts, begin, begin + span, rate[:, None])
    c, s = np.cos(rate * span), np.sin(rate * span)
    free = np.array([[c, s / rate], [-rate * s, c]]).transpose(2, 0, 1)

    def forced(time):
        return np.array([np.sin(time), np.cos(time)]).T / (rate**2 - 1)[:, None]

    expected = (free @ (starts - forced(begin))[..., None])[..., 0] + forced(begin + span)
    assert_allclose(slopes, free, atol=1e-11)
    assert_allclose(states, expected, atol=1e-11)


@pytest.mark.parametrize("taylor", KINDS)
def test_derivatives_of_a_nonlinear_flow_are_those_of_its_ends(taylor):
    carry = ends([x, v], [v, -k * sp.sin(x) + sp.cos(t)], [k], clock=t, wrt=[v], taylor=taylor)
    plain = ends([x, v], [v, -k * sp.sin(x) + sp.cos(t)], [k], clock=t, taylor=taylor)
    start, step = np.array([1.0, 0.3]), 1e-5
    _, slopes = carry([start], 0.0, 6.0, [1.3])
    (above, below), empty = plain([start + np.array([0, step]), start - np.array([0, step])], 0.0, 6.0, [1.3])
    assert_allclose(slopes[0, :, 0], (above - below) / (2 * step), rtol=0, atol=2e-8)
    assert empty.shape == (2, 2, 0)


@pytest.mark.parametrize("taylor", KINDS)
def test_a_flow_that_ends_in_a_singularity_is_not_handed_out(taylor):
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        ends([x], [x**2], taylor=taylor)([[1.0]], 0.0, 2.0)


@pytest.mark.parametrize("taylor", KINDS)
def test_fractions_are_taken_as_they_are(taylor):
    grow = ends([x], [x * sp.Rational(1, 3) * k], [k], taylor=taylor)
    assert_allclose(grow([[1.0]], 0.0, 3.0, [2.0])[0], [[np.exp(2.0)]], rtol=1e-13)


def test_bad_systems_are_refused_by_name():
    with pytest.raises(ValueError, match="one rate for each of 2 states, got 1"):
        flow([x, v], [v])
    with pytest.raises(ValueError, match="and the clock, got m"):
        flow([x, v], [v, -m * x], [k])
    with pytest.raises(ValueError, match="and the clock, got t"):
        ends([x], [t * x])


@pytest.mark.parametrize("taylor", KINDS)
def test_parameters_that_the_rates_do_not_hold_change_nothing(taylor):
    grow = ends([x], [x * k], [m, k, v], taylor=taylor)
    assert_allclose(grow([[1.0]], 0.0, 3.0, [9.0, 0.5, 7.0])[0], [[np.exp(1.5)]], rtol=1e-13)
    fall = flow([x], [-x], [k], taylor=taylor)
    assert_allclose(fall([1.0], [0.0, 2.0], [5.0])[-1], [np.exp(-2.0)], rtol=1e-12)
