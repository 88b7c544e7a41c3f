"""Invariances of turns of a body: the unit of mass, the names of the axes, other axes, the unit of time."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak
from pontryagin.triple_integrator.attitude import RigidBody, turn
from pontryagin.triple_integrator.coupling import couple
from strategies import bodies, states

ends = states(st.floats(-0.3, 0.3)).filter(lambda angles: np.abs(angles).max() > 0.02)
axes = states(st.floats(-1.0, 1.0)).filter(lambda axis: np.abs(axis).max() > 0.1)
frames = states(st.floats(-2.0, 2.0)).map(lambda vector: Rotation.from_rotvec(vector).as_matrix())
few = settings(max_examples=3)
CYCLE = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]])
"""Axes exchanged, two of them reversed."""


def channels(angles, tf=2.0):
    return [Maneuver([0, 0, 0], [angle, 0, 0], tf) for angle in angles]


def in_axes(body, frame):
    inertia = frame @ np.asarray(body.inertia) @ frame.T
    return RigidBody((inertia + inertia.T) / 2)


def commands(coupled, shares):
    """Controls (times, 3) and rates (times, 3) of a coupled manoeuvre."""
    motion = coupled.motion
    start, end = motion.edges[0], motion.edges[-1]
    t = start + (end - start) * shares
    return coupled.control(t).T, coupled.rate(t)


SHARES = np.array([0.03, 0.31, 0.61, 0.93])


@pytest.mark.slow
@few
@given(bodies(), ends, frames)
def test_least_energy_is_the_same_in_all_axes(body, angles, frame):
    """The programmes are linear in the moments, so that those of the three channels turn like a vector."""
    base = couple(body, channels(angles), minimum_energy)
    other = couple(in_axes(body, frame), channels(frame @ angles), minimum_energy)
    for found, expected in zip(commands(other, SHARES), commands(base, SHARES), strict=True):
        assert_allclose(found, expected @ frame.T, atol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("solve", [minimum_peak, minimum_impulse])
@few
@given(bodies(), ends, st.floats(1e-6, 1e6), st.integers(-6, 6))
def test_exchanged_axes_and_other_units_of_mass_and_time(solve, body, angles, mass, power):
    unit = 2.0**power
    changed = in_axes(RigidBody(mass * np.asarray(body.inertia)), CYCLE)
    base = couple(body, channels(angles), solve)
    other = couple(changed, channels(CYCLE @ angles, 2.0 * unit), solve)
    (controls, rates), (expected, expected_rates) = (commands(one, SHARES) for one in (other, base))
    assert_allclose(rates * unit, expected_rates @ CYCLE.T, atol=1e-7)
    if solve is minimum_peak:
        assert_allclose(np.abs(controls) * unit**3, np.abs(expected @ CYCLE.T), atol=1e-6)


@few
@given(
    bodies(),
    states(st.floats(-1.0, 1.0)).filter(lambda e: np.abs(e).max() > 0.1),
    frames,
    st.floats(0.1, 3.0),
)
def test_a_turn_about_an_axis_is_the_same_in_all_axes(body, axis, frame, angle):
    programme = minimum_energy(Maneuver([0, 0, 0], [angle, 0, 0], 2.0))
    base, other = turn(body, axis, programme), turn(in_axes(body, frame), frame @ axis, programme)
    t = 2.0 * SHARES
    assert_allclose(other.motion.rate(t), base.motion.rate(t) @ frame.T, atol=1e-8)
    assert_allclose(other.torque(t), base.torque(t) @ frame.T, atol=1e-7)
