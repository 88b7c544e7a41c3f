"""Plans: the worked example of (12) to its printed digits, and the conditions that every plan satisfies."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from linear_flight import fly
from pontryagin import Infeasible
from pontryagin.orbit_correction import DiscreteSystem, correct, gauge, printed
from pontryagin.orbit_correction.plan.thrust import Thrust
from pontryagin.orbit_correction.system.satellite import step_input, step_transition
from strategies import deviations

Z0 = np.array(printed.Z0)


def test_the_printed_tables_to_one_unit_of_the_last_digit():
    plan = correct(Z0)
    assert plan.steps == int(printed.FEWEST_STEPS)
    assert abs(plan.gauge - float(printed.GAUGE)) <= 1e-4
    assert_allclose(plan.states, np.array(printed.STATES, float), rtol=0, atol=1e-7)
    assert_allclose(plan.costates, np.array(printed.COSTATES, float), rtol=0, atol=1e-4)
    assert_allclose(plan.controls, np.array(printed.CONTROLS, float), rtol=0, atol=1e-7)


def test_the_satellite_as_a_general_system_of_ellipsoids():
    """The system (12) in the form of section 6, whose gauge is that of Lemma 9 and Theorem 4."""

    def shape(k):
        inverse = np.linalg.inv(step_input(k, 0.25))
        return inverse.T @ inverse / 0.0035**2

    system = DiscreteSystem(lambda k: step_transition(k, 0.25), shape)
    assert_allclose(gauge(system, Z0, 4).alpha, correct(Z0).gauge, rtol=1e-12)


@pytest.mark.slow
@given(
    deviations(),
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


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
@pytest.mark.parametrize("interval", [2 * np.pi - 1e-7, 2 * np.pi + 1e-7, 1e-7, 1e300])
def test_intervals_next_to_whole_revolutions_and_beyond_all_measure_are_solved(interval, thrust):
    plan = correct(Z0, interval=interval, thrust=thrust)
    assert plan.certificate.holds(1e-9)
    assert plan.gauge <= 1 < plan.shorter_gauge
    assert 4 < plan.steps < 7000


def test_the_steps_on_both_sides_of_whole_revolutions_are_those_of_a_short_interval():
    """Whole revolutions have no effect: 2 pi + d acts like d, and 2 pi - d like d with time reversed."""
    near = [int(correct(Z0, interval=h).steps) for h in (1e-6, 2 * np.pi + 1e-6, 4 * np.pi + 1e-6)]
    assert len(set(near)) == 1 and near[0] > 1000


@pytest.mark.slow
@pytest.mark.parametrize(
    ("thrust", "z0", "interval"), [("ball", [1e300, 0, 0], 0.25), ("disc", Z0, 1e-300), ("box", Z0, 1e-12)]
)
def test_more_than_a_million_steps_are_none_and_the_reason_is_said(thrust, z0, interval):
    with pytest.raises(Infeasible, match=r"is not corrected in 1000000 steps of interval"):
        correct([[0.0, 0.0, 0.0], Z0, z0], interval=interval, thrust=thrust)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
@pytest.mark.parametrize("size", [1e-300, 1e-3, 1e290])
def test_states_and_peaks_of_any_size(size, thrust):
    plan, expected = correct(Z0 * size, peak=0.0035 * size, thrust=thrust), correct(Z0, thrust=thrust)
    assert plan.steps == expected.steps
    assert_allclose(plan.gauge, expected.gauge, rtol=1e-12)
    assert_allclose(plan.impulses / size, expected.impulses, atol=1e-12)
    assert_allclose(plan.initial_costate, expected.initial_costate, atol=1e-9)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
@pytest.mark.parametrize("steps", [2, 3, 7, 40])
def test_a_gauge_of_exactly_one_needs_no_further_step(steps, thrust):
    generator = np.random.default_rng(steps)
    rows = generator.normal(size=(10, 3))
    alpha = Thrust(thrust, 0.25, 0.0035).gauges(rows, np.full(10, steps)).upper[:, None]
    assert (correct(rows / alpha, thrust=thrust).steps == steps).all()
    assert (correct(rows / alpha * (1 + 1e-9), thrust=thrust).steps == steps + 1).all()


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_a_stack_is_its_members_and_may_be_empty(thrust):
    rows = np.random.default_rng(2).normal(size=(2, 3, 3)) * 0.01
    rows[1, 1] = 0
    plan = correct(rows, thrust=thrust)
    for i, j in np.ndindex(2, 3):
        alone = correct(rows[i, j], thrust=thrust)
        assert alone.steps == plan.steps[i, j]
        assert_allclose(alone.gauge, plan.gauge[i, j], rtol=1e-12)
        assert_allclose(plan.impulses[i, j, : alone.impulse_count], alone.impulses, atol=1e-12)
    nobody = correct(np.zeros((2, 0, 3)), thrust=thrust)
    assert nobody.impulses.shape[:2] == nobody.controls.shape[:2] == nobody.steps.shape == (2, 0)


def test_a_large_stack_is_bounded_in_pieces(monkeypatch):
    rows = np.random.default_rng(4).normal(size=(50, 3)) * 0.01
    engine, counts = Thrust("ball", 0.25, 0.0035), np.random.default_rng(4).integers(1, 20, 50)
    whole = engine.bounds(rows, counts)
    monkeypatch.setattr("pontryagin.orbit_correction.plan.thrust.CHUNK", 60)
    assert_allclose(engine.bounds(rows, counts), whole, rtol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"z0": [1.0, 2.0]}, ValueError, "z0 must be an array"),
        ({"z0": [np.nan, 0, 0]}, ValueError, "z0 must be .* finite"),
        ({"z0": None}, TypeError, "z0 must be"),
        ({"peak": -1.0}, ValueError, "peak must be positive, got -1.0"),
        ({"peak": [0.1]}, ValueError, "peak must be a single number"),
        ({"interval": 0.0}, ValueError, "interval must be positive"),
        ({"interval": np.inf}, ValueError, "interval must be .* finite"),
        ({"thrust": "cone"}, ValueError, "thrust must be one of ball, disc, box, got 'cone'"),
    ],
)
def test_bad_arguments_are_refused_by_name(arguments, error, message):
    with pytest.raises(error, match=message):
        correct(**({"z0": Z0} | arguments))


@pytest.mark.parametrize("thrust", ["disc", "box"])
def test_a_deviation_of_the_speed_alone_takes_one_impulse(thrust):
    plan = correct([0, 0, 0.001], thrust=thrust)
    assert int(plan.steps) == int(plan.impulse_count) == len(plan.impulses) == 1
    assert_allclose(plan.impulses, [[0.0, -0.001]], atol=1e-18)
    assert_allclose(plan.gauge, 0.001 / 0.0035, rtol=1e-14)
    assert plan.certificate.holds(1e-14)


def test_the_proof_that_one_impulse_is_too_few_is_finite_where_only_the_speed_deviates():
    plan = correct([0, 0.004343, 0], interval=np.pi / 2, thrust="box")
    assert_allclose(plan.shorter_gauge, 0.004343 / 0.0035, rtol=1e-14)
    assert int(plan.steps) == 2


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_a_stack_with_states_of_one_impulse_has_the_plans_of_its_members(thrust):
    states = np.array([[0, 0, 0], [0, 0, 0.001], [0.01, 0.02, 0.01], [0, 0.001, 0.002], [0, 0.004, 0]])
    stack = correct(states, thrust=thrust)
    for i, state in enumerate(states):
        alone = correct(state, thrust=thrust)
        assert (stack.steps[i], stack.impulse_count[i]) == (alone.steps, alone.impulse_count)
        assert_allclose(stack.impulses[i, : len(alone.impulses)], alone.impulses, atol=1e-15)
        assert_allclose(stack.shorter_gauge[i], alone.shorter_gauge, rtol=1e-12)


def test_impulses_hold_every_instant_and_the_count_those_that_fire():
    plan = correct([0.0, 0.004, 0.0], thrust="ball")
    assert len(plan.impulses) == int(plan.instants)
    assert int(plan.impulse_count) == np.count_nonzero(plan.impulses.any(axis=1))


def test_two_steps_of_the_ball_have_three_instants_and_an_odd_one_two():
    plans = [correct(factor * np.array(printed.Z0)) for factor in (0.5, 1.0, 1.5, 2.0, 3.0)]
    assert {int(plan.steps) % 2 for plan in plans} == {0, 1}
    for plan in plans:
        steps = int(plan.steps)
        assert plan.instants == 3 * (steps // 2) + 2 * (steps % 2) == len(plan.impulses)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_states_and_peaks_of_any_size_have_the_same_plan_or_are_refused(thrust):
    state, peak = np.array([0.001, 0.002, -0.0015]), 0.0035
    usual = correct(state, peak=peak, thrust=thrust)
    for power in (-1000, -600, -300, 300, 600, 1000):
        plan = correct(state * 2.0**power, peak=peak * 2.0**power, thrust=thrust)
        assert plan.steps == usual.steps
        assert_allclose(plan.gauge, usual.gauge, rtol=1e-14)
        assert_allclose(plan.impulses, usual.impulses * 2.0**power, rtol=1e-12, atol=1e-15 * 2.0**power)
    for power in (-1050, -1016):
        with pytest.raises(ValueError, match=r"^z0 must give with interval and peak a plan within") as caught:
            correct(state * 2.0**power, peak=peak * 2.0**power, thrust=thrust)
        assert caught.value.argument == "z0"


@pytest.mark.parametrize("thrust", ["ball", "disc"])
def test_an_empty_stack_has_no_impulses(thrust):
    assert correct(np.empty((0, 3)), thrust=thrust).impulses.shape[::2] == (0, 2)
