"""Flows have the conserved quantities, periods and closed forms of known equations."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.numerics.flow import flow
from pontryagin.numerics.lanes import ends

x, v, k, m, t = sp.symbols("x v k m t")


def test_a_pendulum_keeps_its_energy():
    swing = flow([x, v], [v, -k * sp.sin(x)], [k])
    path = swing([2.0, 0.3], np.linspace(0.0, 20.0, 41), [1.7])
    energy = path[:, 1] ** 2 / 2 - 1.7 * np.cos(path[:, 0])
    assert_allclose(energy, energy[0], rtol=0, atol=2e-12)


def test_the_kepler_orbit_closes_after_its_period():
    px, py, vx, vy = sp.symbols("px py vx vy")
    cube = sp.sqrt(px**2 + py**2) ** 3
    orbit = flow([px, py, vx, vy], [vx, vy, -px / cube, -py / cube])
    start = [1.0, 0.0, 0.0, 1.2]
    period = 2 * np.pi / (2.0 - 1.2**2) ** 1.5
    assert_allclose(orbit(start, [0.0, period])[-1], start, atol=1e-11)


def test_the_clock_may_stand_in_the_rates():
    driven = flow([x], [k * sp.cos(t)], [k], clock=t)
    grid = np.linspace(1.0, 4.0, 7)
    assert_allclose(driven([0.5], grid, [3.0])[:, 0], 0.5 + 3 * (np.sin(grid) - np.sin(1.0)), atol=1e-13)


def test_bad_systems_are_refused_by_name():
    with pytest.raises(ValueError, match="one rate for each of 2 states, got 1"):
        flow([x, v], [v])
    with pytest.raises(ValueError, match="and the clock, got m"):
        flow([x, v], [v, -m * x], [k])
    with pytest.raises(ValueError, match="and the clock, got t"):
        ends([x], [t * x])


def test_parameters_that_the_rates_do_not_hold_change_nothing():
    grow = ends([x], [x * k], [m, k, v])
    assert_allclose(grow([[1.0]], 0.0, 3.0, [9.0, 0.5, 7.0])[0], [[np.exp(1.5)]], rtol=1e-13)
    fall = flow([x], [-x], [k])
    assert_allclose(fall([1.0], [0.0, 2.0], [5.0])[-1], [np.exp(-2.0)], rtol=1e-12)
