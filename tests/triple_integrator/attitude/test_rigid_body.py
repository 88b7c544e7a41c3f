"""Rigid bodies: the derived equations, their numeric form, and the integrator of the motion."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from pontryagin.numerics import rotation as kinematics
from pontryagin.triple_integrator.attitude.rigid_body import Commands, RigidBody, simulate
from pontryagin.triple_integrator.derivation import rigid_body as derivation
from strategies import bodies

J, w, a, e, q, phi = (
    derivation.inertia,
    derivation.rate,
    derivation.acceleration,
    derivation.axis,
    derivation.quaternion,
    derivation.rotation_vector,
)
STILL = Commands(np.zeros(0), lambda t, z: z, np.zeros(0))
coordinates = st.floats(-2.0, 2.0)
rotation_vectors = st.tuples(coordinates, coordinates, coordinates).map(np.array)
unit_quaternions = rotation_vectors.map(kinematics.quaternion)


def free(t, attitude, rate, commands):
    return np.zeros(3)


def reduced(entry):
    """Numerator of an expression in phi and theta, modulo theta = |phi| and cos^2 + sin^2 = 1."""
    half = sp.Symbol("h", positive=True)
    entry = entry.subs(derivation.angle, 2 * half)
    entry = sp.expand(sp.expand_trig(entry)).subs(sp.cot(half), sp.cos(half) / sp.sin(half))
    numerator = sp.numer(sp.together(entry))
    numerator = sp.rem(sp.expand(numerator), sp.sin(half) ** 2 + sp.cos(half) ** 2 - 1, sp.sin(half))
    return sp.simplify(sp.rem(numerator, phi.dot(phi) - 4 * half**2, phi[0]))


# --- the derived equations ---------------------------------------------------------------------------------


def test_euler_equations_follow_from_the_momentum_in_the_turning_frame():
    assert (derivation.euler_torque() - (J * a + w.cross(J * w))).expand().is_zero_matrix


def test_a_turn_about_a_fixed_axis_needs_the_channel_torque_and_a_gyroscopic_one():
    channel = J * e * (derivation.x3 + derivation.f)
    gyroscopic = derivation.x2**2 * e.cross(J * e)
    assert (derivation.fixed_axis_torque() - channel - gyroscopic).expand().is_zero_matrix
    assert (derivation.gyroscopic_torque() - gyroscopic).expand().is_zero_matrix


def test_the_gyroscopic_torque_has_no_component_along_the_axis():
    assert sp.expand(derivation.gyroscopic_torque().dot(e)) == 0


def test_the_quaternion_rate_turns_the_rotation_matrix_with_the_body():
    R = derivation.rotation_matrix()
    R_rate = sum(
        (R.diff(x) * v for x, v in zip(q, derivation.quaternion_rate(), strict=True)), sp.zeros(3, 3)
    )
    difference = R_rate - R * derivation.skew(w)
    assert difference.applyfunc(lambda x: sp.rem(sp.expand(x), q.dot(q) - 1, q[0])).is_zero_matrix


def test_the_rotation_vector_rate_has_its_closed_form():
    difference = derivation.rate_matrix() - derivation.rate_matrix_in_closed_form()
    assert difference.applyfunc(reduced).is_zero_matrix


def test_the_closed_forms_are_inverse_to_each_other():
    product = derivation.rate_matrix_in_closed_form() * derivation.inverse_rate_matrix()
    assert (product - sp.eye(3))[:, 0].applyfunc(reduced).is_zero_matrix


# --- the numeric form --------------------------------------------------------------------------------------


@given(unit_quaternions, rotation_vectors)
def test_the_quaternion_rate_is_that_derived(attitude, rate):
    derived = derivation.quaternion_rate().subs(dict(zip([*q, *w], [*attitude, *rate], strict=True)))
    assert_allclose(kinematics.attitude_rate(attitude, rate), np.array(derived, float).ravel(), atol=1e-14)


@given(rotation_vectors)
def test_quaternions_are_those_of_scipy_and_lead_back(vector):
    attitude = kinematics.quaternion(vector)
    assert_allclose(
        attitude, Rotation.from_rotvec(vector).as_quat(scalar_first=True, canonical=False), atol=1e-14
    )
    assert_allclose(kinematics.rotation_vector(attitude), vector, atol=1e-13)


@given(unit_quaternions, unit_quaternions)
def test_the_turn_between_attitudes_is_that_of_scipy(attitude, other):
    first, second = (Rotation.from_quat(x, scalar_first=True) for x in (attitude, other))
    ours = Rotation.from_quat(kinematics.between(attitude, other), scalar_first=True)
    assert_allclose(ours.as_matrix(), (first.inv() * second).as_matrix(), atol=1e-13)


@given(rotation_vectors.filter(lambda v: np.linalg.norm(v) > 1e-2))
def test_the_rate_matrix_is_that_derived(vector):
    numbers = dict(zip(phi, vector, strict=True)) | {derivation.angle: np.linalg.norm(vector)}
    derived = np.array(derivation.inverse_rate_matrix().subs(numbers), float)
    assert_allclose(kinematics.vector_rate_matrix(vector), derived, atol=1e-10)


@pytest.mark.parametrize("size", [0.0, 1e-9, 1e-3, 1.0, 3.0, 6.0, 6.28])
def test_the_rate_matrix_maps_the_body_rate_at_every_size_of_turn(size):
    vector, rate = size * np.array([2.0, -1.0, 2.0]) / 3, np.array([0.3, 0.5, -0.2])
    step = 1e-6
    ahead, behind = (
        kinematics.quaternion(vector + sign * step * (kinematics.vector_rate_matrix(vector) @ rate))
        for sign in (1, -1)
    )
    expected = kinematics.attitude_rate(kinematics.quaternion(vector), rate)
    assert_allclose((ahead - behind) / (2 * step), expected, atol=1e-6 * max(1.0, 1 / (6.2832 - size)))


@given(rotation_vectors, rotation_vectors)
def test_the_drift_is_the_rate_of_the_rate_matrix(vector, rate):
    matrix, step = kinematics.vector_rate_matrix, 1e-5
    along = matrix(vector) @ rate
    change = (matrix(vector + step * along) - matrix(vector - step * along)) / (2 * step)
    assert_allclose(kinematics.vector_acceleration_drift(vector, rate), change @ rate, atol=1e-6)


# --- the integrator ----------------------------------------------------------------------------------------


@settings(max_examples=10, deadline=None)
@given(bodies(), unit_quaternions, rotation_vectors)
def test_without_torque_momentum_and_energy_stay(body, attitude, rate):
    motion = simulate(body, (0.0, 3.0), attitude, rate, STILL, free)
    t = np.linspace(0.0, 3.0, 13)
    turned, rates = Rotation.from_quat(motion.attitude(t), scalar_first=True), motion.rate(t)
    momentum = turned.apply(rates @ body.inertia)
    energy = np.einsum("ki,ij,kj->k", rates, body.inertia, rates)
    assert_allclose(momentum, momentum[[0] * t.size], atol=1e-10)
    assert_allclose(energy, energy[0], atol=1e-10)
    assert_allclose(np.linalg.norm(motion.attitude(t), axis=1), 1.0, atol=1e-11)


def test_a_symmetric_top_precesses_at_its_known_rate():
    body, start = RigidBody(np.diag([2.0, 2.0, 3.0])), np.array([0.3, 0.0, 1.1])
    precession = (3.0 - 2.0) / 2.0 * start[2]
    t = np.linspace(0.0, 7.0, 15)
    rates = simulate(body, (0.0, 7.0), [1, 0, 0, 0], start, STILL, free).rate(t)
    expected = np.stack(
        [0.3 * np.cos(precession * t), 0.3 * np.sin(precession * t), np.full(15, 1.1)], axis=-1
    )
    assert_allclose(rates, expected, atol=1e-11)


def test_commands_jump_at_impulses_and_are_continuous_from_the_right():
    steps = [(0.0, np.array([1.0])), (1.0, np.array([2.0])), (2.0, np.array([4.0]))]
    commands = Commands(np.array([0.5]), lambda t, z: np.zeros(1), np.ones(1), (), steps)
    body = RigidBody(np.eye(3))
    motion = simulate(body, (0.0, 2.0), [1, 0, 0, 0], [0, 0, 0], commands, free)
    assert motion.commands([0.0, 0.5, 1.0, 1.5, 2.0]).ravel().tolist() == [0.5, 1.5, 3.5, 3.5, 7.5]


# --- invalid arguments -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("inertia", "word"),
    [
        (np.eye(2), "shape"),
        ([[2, 1, 0], [0, 2, 0], [0, 0, 2]], "symmetric"),
        (np.diag([1.0, -1.0, 1.0]), "positive definite"),
        (np.diag([1.0, 1.0, 2.5]), "sum of the other two"),
        (np.diag([1.0, np.nan, 1.0]), "finite"),
    ],
)
def test_an_inertia_that_no_body_has_is_named(inertia, word):
    with pytest.raises(ValueError, match=f"inertia.*{word}"):
        RigidBody(inertia)


def test_times_outside_the_motion_are_refused():
    motion = simulate(RigidBody(np.eye(3)), (0.0, 1.0), [1, 0, 0, 0], [0, 0, 0], STILL, free)
    with pytest.raises(ValueError, match=r"t must be .* from 0.0 to 1.0, got 1.5$"):
        motion.rate([0.5, 1.5])
    with pytest.raises(ValueError, match=r"t must be .* from 0.0 to 1.0, got shape \(1, 1\)"):
        motion.rate([[0.5]])
