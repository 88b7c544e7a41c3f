"""Plans: the paper's worked example to its printed digits, and what every plan must satisfy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from pontryagin import Infeasible
from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.orbit_correction.satellite import LINEAR, step_input, step_transition

Z0 = np.array([-0.37787e-2, -0.39109e-2, 1.41512e-2])
STATES = 1e-2 * np.array(
    [
        [-0.37787, -0.39109, 1.41512],
        [-0.30870, 0.58472, 1.03056],
        [-0.19824, 0.59918, 0.47280],
        [0.00698, 0.35937, 0.07851],
        [0, 0, 0],
    ]
)
COSTATES = [
    [0.1294, 0.2360, -0.9631],
    [0.1500, -0.3167, -0.9219],
    [0.2617, -0.5720, -0.6986],
    [0.6534, -0.9623, 0.0850],
]
CONTROLS = 1e-2 * np.array(
    [
        [-0.04354, -0.24779, -0.27185],
        [-0.08869, -0.40092, -0.35862],
        [-0.17352, -0.52475, -0.01554],
        [-0.10099, -0.38877, 0.01550],
    ]
)


def test_the_printed_tables_to_one_unit_of_the_last_digit():
    plan = correct(Z0)
    assert plan.steps == 4
    assert abs(plan.gauge - 0.9286) <= 1e-4
    assert_allclose(plan.states, STATES, rtol=0, atol=1e-7)
    assert_allclose(plan.costates, COSTATES, rtol=0, atol=1e-4)
    assert_allclose(plan.controls, CONTROLS, rtol=0, atol=1e-7)


def test_the_satellite_as_a_general_system_of_ellipsoids():
    def shape(k):
        inverse = np.linalg.inv(step_input(k, 0.25))
        return inverse.T @ inverse / 0.0035**2

    system = DiscreteSystem(lambda k: step_transition(k, 0.25), shape)
    assert_allclose(gauge(system, Z0, 4).alpha, correct(Z0).gauge, rtol=1e-12)


def fly(plan):
    """The linear flow with a jump of the speeds at the start of each interval, by SciPy."""
    z = plan.z0
    for impulse in plan.impulses:
        kicked = z + np.array([0, *impulse])
        z = solve_ivp(lambda _, x: LINEAR @ x, (0, plan.thrust.interval), kicked, rtol=1e-12, atol=1e-16).y[
            :, -1
        ]
    return z


@given(
    st.tuples(*[st.floats(-0.02, 0.02, allow_subnormal=False)] * 3).map(np.array),
    st.sampled_from([0.25, 1.0, np.pi]),
    st.sampled_from(["ball", "disc", "box"]),
)
def test_a_plan_reaches_the_circle_in_the_fewest_steps(z0, interval, thrust):
    plan = correct(z0, interval=interval, thrust=thrust)
    assert plan.certificate.holds(1e-11)
    assert plan.gauge <= 1 + 1e-12 < plan.shorter_gauge or not z0.any()
    assert_allclose(fly(plan), 0, atol=1e-11)
    assert len(plan.impulses) == plan.impulse_count


def test_no_deviation_needs_no_step():
    plan = correct([0.0, 0.0, 0.0])
    assert plan.steps == plan.impulse_count == 0 and plan.states.shape == (1, 3)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_intervals_of_whole_revolutions_leave_the_radius_out_of_reach(thrust):
    with pytest.raises(Infeasible, match="revolution"):
        correct(Z0, interval=2 * np.pi, thrust=thrust)
    plan = correct([0.0, 0.004, -0.003], interval=2 * np.pi, thrust=thrust)
    assert plan.certificate.holds(1e-10)
    assert_allclose(fly(plan), 0, atol=1e-11)
