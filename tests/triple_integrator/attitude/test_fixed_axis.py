"""The turn of a rigid body about a fixed axis, with and without feedforward of the gyroscopic torque."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from pontryagin.triple_integrator import (
    Maneuver,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)
from pontryagin.triple_integrator.attitude import RigidBody, turn
from strategies import bodies

BODY = RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
AXIS = np.array([1.0, 2.0, 2.0]) / 3
NORMS = [minimum_energy, minimum_peak, minimum_impulse]
QUARTER = Maneuver([0, 0, 0], [np.pi / 2, 0, 0], tf=2.0)
numbers = st.floats(-2.0, 2.0)
states = st.tuples(numbers, numbers, numbers).map(np.array)
axes = states.filter(lambda v: np.linalg.norm(v) > 0.1)


@pytest.mark.parametrize("solve", NORMS)
@settings(max_examples=6, deadline=None)
@given(body=bodies(), axis=axes, x0=states, xf=states, t0=numbers)
def test_with_feedforward_the_body_reaches_attitude_and_rate(solve, body, axis, x0, xf, t0):
    made = turn(body, axis, solve(Maneuver(x0, xf, tf=t0 + 1.5, t0=t0)))
    assert made.attitude_miss < 1e-10
    assert made.rate_miss < 1e-10
    target = Rotation.from_rotvec(xf[0] * axis / np.linalg.norm(axis))
    reached = Rotation.from_quat(made.attitude(t0 + 1.5)[0], scalar_first=True)
    assert (target.inv() * reached).magnitude() < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize(
    "programme",
    [
        minimum_norm(QUARTER, 4.0),
        minimum_time([0, 0, 0], [1, 0.2, 0], peak=3.0),
        minimum_energy(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0, disturbance=0.3)),
        minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0, disturbance=np.sin)),
        minimum_impulse(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0, disturbance=sp.Symbol("t") ** 2)),
        minimum_impulse(Maneuver([0, 0, 0], [0, 0, 0], tf=2.0)),
    ],
)
def test_other_norms_and_disturbances_reach_the_target_too(programme):
    made = turn(BODY, AXIS, programme)
    assert made.attitude_miss < 1e-9
    assert made.rate_miss < 1e-9


def test_the_angle_and_rate_are_those_planned_while_the_torque_is_fed_forward():
    programme = minimum_impulse(QUARTER)
    made, t = turn(BODY, AXIS, programme), np.linspace(0.0, 2.0, 21)
    assert_allclose(made.angle(t), programme.state(t)[:, 0], atol=1e-10)
    assert_allclose(made.rate(t), programme.state(t)[:, 1:2] * AXIS, atol=1e-10)
    assert_allclose(made.planned_attitude(t), made.attitude(t), atol=1e-10)


def test_the_angle_follows_a_turn_of_more_than_once_around():
    programme = minimum_energy(Maneuver([0, 0, 0], [15.0, 0, 0], tf=2.0))
    made, t = turn(BODY, AXIS, programme), np.linspace(0.0, 2.0, 21)
    assert_allclose(made.angle(t), programme.state(t)[:, 0], atol=1e-9)


@pytest.mark.parametrize("feedforward", [True, False])
@pytest.mark.parametrize("solve", NORMS)
def test_the_torque_changes_the_momentum_by_its_integral(solve, feedforward):
    made = turn(BODY, AXIS, solve(QUARTER), feedforward)
    nodes, weights = np.polynomial.legendre.leggauss(30)

    def inertial(t, vectors):
        return Rotation.from_quat(made.attitude(t), scalar_first=True).apply(vectors)

    impulse = np.zeros(3)
    for low, high in zip(made.motion.edges[:-1], made.motion.edges[1:], strict=True):
        t = (low + high) / 2 + (high - low) / 2 * nodes
        impulse += (high - low) / 2 * weights @ inertial(t, made.torque(t))
    ends = np.array([0.0, 2.0])
    momentum = inertial(ends, made.rate(ends) @ BODY.inertia)
    assert_allclose(impulse, momentum[1] - momentum[0], atol=1e-9)


@pytest.mark.parametrize("solve", NORMS)
@pytest.mark.parametrize("feedforward", [True, False])
def test_the_torque_rate_is_the_derivative_of_the_torque_between_impulses(solve, feedforward):
    made = turn(BODY, AXIS, solve(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0, disturbance=0.2)), feedforward)
    t, step = np.array([0.17, 0.81, 1.39, 1.93]), 1e-5
    change = (made.torque(t + step) - made.torque(t - step)) / (2 * step)
    assert_allclose(made.torque_rate(t), change, atol=1e-7)


def test_the_torque_is_that_of_the_channel_and_the_gyroscopic_part():
    made, t = turn(BODY, AXIS, minimum_peak(QUARTER)), np.linspace(0.0, 2.0, 9)
    assert_allclose(made.torque(t), made.channel_torque(t) + made.gyroscopic_torque(t))
    assert_allclose(made.gyroscopic_torque(t) @ AXIS, 0, atol=1e-14)
    momentum = made.rate(t) @ BODY.inertia
    assert_allclose(made.gyroscopic_torque(t), np.cross(made.rate(t), momentum), atol=1e-9)


# --- without feedforward -----------------------------------------------------------------------------------


@pytest.mark.parametrize("solve", NORMS)
def test_without_feedforward_the_miss_is_of_second_order_in_the_angle(solve):
    angles = np.array([0.01, 0.02])
    misses = [
        turn(BODY, AXIS, solve(Maneuver([0, 0, 0], [angle, 0, 0], tf=2.0)), feedforward=False).attitude_miss
        for angle in angles
    ]
    assert misses[1] / misses[0] == pytest.approx(4.0, abs=0.02)


@pytest.mark.parametrize(("solve", "integral"), [(minimum_energy, 10 / 7), (minimum_impulse, 4 / 3)])
def test_the_leading_miss_is_the_integral_of_the_squared_rate(solve, integral):
    """w' = -J^-1 (e x J e) x2^2, twice integrated: by symmetry half the integral of x2^2, times T."""
    angle = 1e-3
    made = turn(BODY, AXIS, solve(Maneuver([0, 0, 0], [angle, 0, 0], tf=5.0)), feedforward=False)
    gyroscopic = np.linalg.solve(BODY.inertia, np.cross(AXIS, BODY.inertia @ AXIS))
    expected = np.linalg.norm(gyroscopic) * integral / 2 * angle**2
    assert made.attitude_miss == pytest.approx(expected, rel=1e-3)


def test_the_miss_does_not_depend_on_the_duration():
    misses = [
        turn(BODY, AXIS, minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], tf=T)), feedforward=False).attitude_miss
        for T in (1e-2, 1.0, 1e3)
    ]
    assert_allclose(misses, misses[1], rtol=1e-9)
    assert misses[1] > 0.1


def test_about_a_principal_axis_nothing_is_missed():
    _, frame = np.linalg.eigh(BODY.inertia)
    assert turn(BODY, frame[:, 1], minimum_peak(QUARTER), feedforward=False).attitude_miss < 1e-10


# --- invalid arguments -------------------------------------------------------------------------------------


@pytest.mark.parametrize("axis", [[0, 0, 0], [1, 2], [1, np.nan, 0], [[1, 0, 0], [0, 1, 0]]])
def test_what_is_no_axis_is_named(axis):
    with pytest.raises(ValueError, match="axis"):
        turn(BODY, axis, minimum_energy(QUARTER))


def test_a_stack_is_refused():
    stack = minimum_energy(Maneuver(np.zeros((2, 3)), np.ones((2, 3)), tf=1.0))
    with pytest.raises(ValueError, match=r"programme must be .* got a stack of shape \(2,\)"):
        turn(BODY, AXIS, stack)


@pytest.mark.slow
@pytest.mark.parametrize("origin", [0.0, 1e6])
def test_a_pulse_that_is_told_or_known_pushes_the_body(origin):
    """A torque impulse of J e over a millionth of the turn: the programme, which knows it, still arrives."""
    low, high = origin + 0.7, origin + 0.7 + 2e-6

    def pulse(t):
        return np.where((t >= low) & (t < high), 1 / (high - low), 0.0)

    t = sp.Symbol("t")
    known = sp.Piecewise((1 / (high - low), (t >= low) & (t < high)), (0, True))
    for force, edges in ((pulse, [low, high]), (known, ())):
        m = Maneuver([0, 0, 0], [1.5, 0, 0], origin + 2, origin, disturbance=force, edges=edges)
        assert_allclose(m.moments[1], -1.0, rtol=1e-9)
        assert turn(BODY, [1, 2, 2], minimum_peak(m)).attitude_miss < 1e-9
