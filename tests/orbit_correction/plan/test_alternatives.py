"""Plans of equal length: each is least in its measure, by its bound and against independent optimisers."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import linprog, minimize

from linear_flight import fly
from pontryagin.orbit_correction import correct
from pontryagin.orbit_correction.plan.alternatives import least_energy, least_fuel, least_peak
from pontryagin.orbit_correction.printed import Z0
from strategies import deviations

THRUSTS = ("ball", "disc", "box")
MEASURES = {"peak": least_peak, "energy": least_energy, "fuel": least_fuel}


states = deviations(0.012, least=1e-4)


@pytest.mark.slow
@given(states, st.sampled_from(THRUSTS), st.sampled_from([0.25, 1.0]))
def test_all_three_reach_the_circle_and_each_is_the_least_of_its_measure(z0, name, interval):
    plan = correct(z0, interval=interval, thrust=name)
    found = {measure: solve(plan) for measure, solve in MEASURES.items()}
    for measure, one in found.items():
        assert one.certificate.holds(1e-9) and one.peak <= 1 + 1e-9
        assert len(one.impulses) == plan.impulse_count
        assert_allclose(
            fly(SimpleNamespace(z0=plan.z0, thrust=plan.thrust, impulses=one.impulses)), 0, atol=1e-11
        )
        for other in found.values():
            assert getattr(one, measure) <= getattr(other, measure) * (1 + 1e-9) + 1e-12


@given(states)
def test_the_least_fuel_of_two_engines_is_the_linear_programme(z0):
    plan = correct(z0, thrust="box")
    columns = np.moveaxis(plan.thrust.factors(int(plan.steps)), 1, 0).reshape(3, -1)
    both = np.hstack([columns, -columns]) / 0.0035
    answer = linprog(np.ones(both.shape[1]), A_eq=both, b_eq=-z0 / 0.0035, bounds=[(0, 1)] * both.shape[1])
    assert_allclose(least_fuel(plan).fuel, answer.fun, rtol=1e-6)


@pytest.mark.parametrize("name", THRUSTS)
def test_the_least_energy_is_that_of_a_general_optimiser(name):
    plan = correct(Z0, thrust=name)
    factors = np.moveaxis(plan.thrust.factors(int(plan.steps)), 1, 0).reshape(3, -1) / 0.0035
    width = plan.step_controls.shape[1]

    def room(u):
        return 1 - u**2 if name == "box" else 1 - (u.reshape(-1, width) ** 2).sum(axis=1)

    answer = minimize(
        lambda u: u @ u,
        plan.step_controls.ravel() / 0.0035,
        jac=lambda u: 2 * u,
        method="SLSQP",
        constraints=[
            {"type": "eq", "fun": lambda u: 100 * (factors @ u + np.array(Z0) / 0.0035)},
            {"type": "ineq", "fun": room},
        ],
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert_allclose(least_energy(plan).energy, answer.fun, rtol=1e-6)


def test_without_bounds_in_the_way_the_least_energy_is_the_closed_form():
    plan = correct([0.001, -0.004, 0.002])
    factors = np.moveaxis(plan.thrust.factors(int(plan.steps)), 1, 0).reshape(3, -1)
    found = least_energy(plan)
    assert found.peak < 1
    assert_allclose(found.step_controls.ravel(), 0.0035 * (np.linalg.pinv(factors) @ -plan.z0), atol=1e-15)


@pytest.mark.parametrize("name", THRUSTS)
def test_the_plan_on_the_boundary_is_the_only_one(name):
    gauge = float(correct(Z0, thrust=name).gauge)
    plan = correct(Z0, peak=0.0035 * gauge * (1 + 1e-12), thrust=name)
    assert_allclose(least_energy(plan).step_controls, plan.step_controls, atol=1e-13)
    plan = correct(Z0, peak=0.0035 * gauge * (1 + 1e-7), thrust=name)
    assert_allclose(least_fuel(plan).step_controls, plan.step_controls, atol=1e-5)


@pytest.mark.parametrize("name", THRUSTS)
@pytest.mark.parametrize("size", [1e-2, 1e-5, 1e-8])
def test_the_gaps_of_small_states_are_relative_to_their_measures(name, size):
    plan = correct(np.multiply(size, Z0), thrust=name)
    for solve in MEASURES.values():
        assert solve(plan).certificate.holds(1e-9)


def test_no_deviation_needs_no_plan():
    for solve in MEASURES.values():
        assert solve(correct([0.0, 0.0, 0.0])).energy == 0


@pytest.mark.parametrize("solve", MEASURES.values())
def test_a_stack_is_refused(solve):
    with pytest.raises(ValueError, match="plan must be that of one state"):
        solve(correct([Z0, Z0]))


def test_an_odd_step_of_the_ball_ends_with_a_radial_impulse_alone():
    """Three components a step, two of an impulse: the last one is filled up with a zero."""
    plans = [correct(factor * np.array(Z0)) for factor in (0.5, 1.0, 1.5, 2.0)]
    assert {int(plan.steps) % 2 for plan in plans} == {0, 1}
    for plan in plans:
        found = least_energy(plan)
        steps, flat = int(plan.steps), found.impulses.ravel()
        assert found.impulses.shape == (3 * (steps // 2) + 2 * (steps % 2), 2)
        assert_allclose(flat[: 3 * steps], found.step_controls.ravel(), rtol=0)
        assert not flat[3 * steps :].any()
