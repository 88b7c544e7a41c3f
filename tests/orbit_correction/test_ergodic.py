"""The limit of N alpha(N): against the gauge of many steps, closed forms of means, and symmetry."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.linalg import expm
from scipy.optimize import minimize

from pontryagin import Infeasible
from pontryagin.orbit_correction.ergodic import MODES, approach, limit, mean_support, modes
from pontryagin.orbit_correction.printed import Z0
from pontryagin.orbit_correction.system.satellite import LINEAR
from strategies import deviations

THRUSTS = ("ball", "disc", "box")


@given(st.floats(-7, 7))
def test_in_the_modes_the_motion_is_a_rotation(t):
    moved = MODES @ expm(LINEAR * t) @ np.linalg.inv(MODES)
    turn = np.eye(3)
    turn[:2, :2] = [[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]]
    assert_allclose(np.abs(moved), np.abs(turn), atol=1e-12)
    assert_allclose(moved @ moved.T, np.eye(3), atol=1e-12)


@given(deviations(), st.floats(0, 7))
def test_amplitude_and_constant_part_stay(z0, t):
    assert_allclose(modes(expm(LINEAR * t) @ z0), modes(z0), atol=1e-15)


@given(st.floats(0.1, 3), st.floats(-5, 5))
def test_the_means_of_the_square_are_in_closed_form(rho, c):
    """The mean of |rho cos| is 2 rho / pi; that of |c - 2 rho sin| is |c| or has an arc sine."""
    if abs(c) >= 2 * rho:
        transverse = abs(c)
    else:
        transverse = 2 / np.pi * (c * np.arcsin(c / (2 * rho)) + np.sqrt(4 * rho**2 - c**2))
    # In the dual of `modes` the constant part has the factor 2 in the transverse impulse.
    found = mean_support(rho, c / 2, 0.25, 1.0, "box")
    assert_allclose(found, 2 * rho / np.pi + transverse, rtol=1e-6)


def test_the_mean_of_the_disc_is_an_elliptic_integral():
    rho, c = 0.7, 0.4
    exact = quad(lambda f: np.hypot(rho * np.cos(f), 2 * c - 2 * rho * np.sin(f)), 0, 2 * np.pi, epsabs=1e-13)
    assert_allclose(mean_support(rho, c, 0.25, 1.0, "disc"), exact[0] / (2 * np.pi), rtol=1e-10)


@pytest.mark.parametrize("thrust", THRUSTS)
@pytest.mark.parametrize("interval", [0.25, 1.0])
def test_the_gauge_tends_to_the_limit_like_one_over_the_number(thrust, interval):
    end = limit(Z0, interval, thrust=thrust)
    steps = np.array([50, 500, 5000])
    distance = np.abs(approach(Z0, steps, interval, thrust=thrust) - end)
    assert np.all(distance * steps < 25) and distance[2] < 5e-3


@pytest.mark.parametrize("thrust", THRUSTS)
@pytest.mark.parametrize("interval", [np.pi / 2, np.pi, 2 * np.pi / 7, 6 * np.pi / 5])
def test_where_phases_repeat_the_limit_is_reached_in_whole_periods(thrust, interval):
    end = limit(Z0, interval, thrust=thrust)
    assert_allclose(approach(Z0, [840, 1680], interval, thrust=thrust), end, rtol=1e-9)


@pytest.mark.slow
@given(deviations(least=1e-4), st.floats(0, 6), st.sampled_from(THRUSTS))
def test_it_does_not_matter_where_on_the_orbit_one_begins(z0, t, thrust):
    moved = expm(LINEAR * t) @ z0
    assert_allclose(limit(moved, thrust=thrust), limit(z0, thrust=thrust), rtol=1e-7)


@pytest.mark.parametrize("thrust", THRUSTS)
def test_no_costate_of_the_whole_space_proves_more(thrust):
    phases = np.arange(180) * 2 * np.pi / 180
    impulses = 0.0035 * np.hstack([expm(-LINEAR * 0.25 * j)[:, 1:] for j in range(3)])
    groups = (impulses[:, :3], impulses[:, 3:]) if thrust == "ball" else (impulses[:, :2],)
    turned = [np.array([expm(-LINEAR * phase) @ group for phase in phases]) for group in groups]

    def excess(psi):
        along = [np.einsum("kij,i->kj", group, psi) for group in turned]
        sizes = [np.linalg.norm(part, ord=1 if thrust == "box" else 2, axis=1).mean() for part in along]
        return (np.array(Z0) @ psi) / np.mean(sizes)

    best = min(
        minimize(excess, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}).fun
        for start in (-np.array(Z0) * 100, [0.1, 0.2, -1.0])
    )
    assert_allclose(-best, limit(Z0, thrust=thrust), rtol=1e-4)


def test_nothing_to_correct_and_nothing_to_be_done():
    assert limit(np.zeros(3)) == 0
    with pytest.raises(Infeasible, match="revolution"):
        limit(Z0, interval=2 * np.pi)
    with pytest.raises(ValueError, match="thrust must be"):
        limit(Z0, thrust="cone")
    with pytest.raises(ValueError, match="z0 must be"):
        limit([Z0, Z0])
