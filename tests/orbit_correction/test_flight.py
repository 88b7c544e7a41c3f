"""Flights on the nonlinear equations: against Cartesian coordinates, quadratic residuals, the closed loop."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from pontryagin import NotConverged
from pontryagin.orbit_correction import correct, flight, printed
from pontryagin.orbit_correction.flight import close_loop, fly, fly_plan, residuals
from strategies import deviations

Z0 = np.array(printed.Z0)


def cartesian_flight(z0, impulses, interval):
    """The flight in Cartesian coordinates, x'' = -x/|x|^3, by SciPy: deviation and angle at the end."""
    position, speed = np.array([1 + z0[0], 0.0]), np.array([z0[1], 1 + z0[2]])
    for radial, transverse in impulses:
        along = position / np.linalg.norm(position)
        across = np.array([-along[1], along[0]])
        start = np.concatenate([position, speed + radial * along + transverse * across])
        end = solve_ivp(
            lambda _, y: np.concatenate([y[2:], -y[:2] / np.linalg.norm(y[:2]) ** 3]),
            (0, interval),
            start,
            method="DOP853",
            rtol=1e-13,
            atol=1e-15,
        ).y[:, -1]
        position, speed = end[:2], end[2:]
    radius = np.linalg.norm(position)
    angle = np.arctan2(position[1], position[0])
    cross = position[0] * speed[1] - position[1] * speed[0]
    return np.array([radius - 1, position @ speed / radius, cross / radius - 1]), angle


@given(
    deviations(),
    st.lists(st.tuples(*[st.floats(-0.01, 0.01)] * 2), min_size=1, max_size=4),
    st.sampled_from([0.25, 0.7]),
)
def test_the_flight_is_that_of_a_point_mass_in_the_plane(z0, impulses, interval):
    expected, angle = cartesian_flight(z0, impulses, interval)
    flown = fly(z0, impulses, interval)
    assert_allclose(flown.states[-1], expected, atol=1e-12)
    assert_allclose(flown.angles[-1], angle, atol=1e-12)


def test_the_path_passes_through_the_states_and_jumps_by_the_impulses():
    flown = fly_plan(correct(Z0))
    times, states, angles = flown.path(5)
    assert len(times) == 1 + 5 * 6 and np.all(np.diff(angles) >= 0)
    assert_allclose(states[::5], flown.states, atol=1e-13)
    jumps = states[1::5] - flown.states[:-1]
    assert_allclose(jumps, np.column_stack([np.zeros(6), flown.impulses]), atol=1e-13)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_what_is_left_is_quadratic_in_the_deviation(thrust):
    sizes, left = residuals(Z0, np.geomspace(1e-3, 1e-1, 5), thrust=thrust)
    slopes = np.diff(np.log(left)) / np.diff(np.log(sizes))
    assert_allclose(slopes, 2, atol=0.01)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_replanning_squares_the_residual_until_rounding(thrust):
    loop = close_loop(Z0, thrust=thrust)
    assert loop.residuals[-1] <= 1e-14
    assert np.all(loop.residuals[1:-1] <= 2 * loop.residuals[:-2] ** 2)
    assert loop.impulse_counts[0] == correct(Z0, thrust=thrust).impulse_count
    for before, after in zip(loop.flights, loop.flights[1:], strict=False):
        assert np.array_equal(before.states[-1], after.states[0])


def test_no_deviation_needs_no_flight():
    loop = close_loop(np.zeros(3))
    assert loop.plans == () and loop.impulse_counts.size == 0 and loop.residuals.size == 0


def test_a_loop_that_does_not_close_ends_with_what_is_left(monkeypatch):
    monkeypatch.setattr(flight, "ROUNDS", 2)
    with pytest.raises(NotConverged, match="2 plans") as raised:
        close_loop(Z0)
    assert raised.value.residual == pytest.approx(close_loop(Z0, tolerance=1e-8).residuals[-1])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: fly(np.zeros((2, 3)), np.zeros((1, 2)), 0.25), "z0 must be"),
        (lambda: fly(Z0, [[0.0, np.nan]], 0.25), "impulses must be"),
        (lambda: fly(Z0, [[0.0, 0.0]], -1.0), "interval must be positive"),
        (lambda: fly_plan(correct([Z0, Z0])), "plan must be that of one state"),
        (lambda: close_loop([Z0, Z0]), "z0 must be"),
        (lambda: close_loop(Z0, tolerance=0.0), "tolerance must be positive"),
    ],
)
def test_what_cannot_be_flown_is_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()
