"""Both integrators follow the same equations."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.flow import flow, has_heyoka

x, v, k, m = sp.symbols("x v k m")
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


def test_bad_systems_are_refused_by_name():
    with pytest.raises(ValueError, match="one expression for each of 2 states, got 1"):
        flow([x, v], [v])
    with pytest.raises(ValueError, match="got symbols m"):
        flow([x, v], [v, -m * x], [k])
