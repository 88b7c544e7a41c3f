"""Solutions in every geometry, in every unit, beside the target; problems without a solution."""

import math
from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest

import pontryagin
from pontryagin import Infeasible, NotConverged
from pontryagin.rendezvous import (
    Chaser,
    Orbit,
    Rendezvous,
    false_meeting,
    least_fuel,
    solve,
    solve_in_elements,
)
from pontryagin.rendezvous.problem.cases import cases, chaser_on
from rendezvous_problems import LEAP, beside, problem


@pytest.mark.slow
def test_a_mixed_problem_reaches_the_bound_and_obeys_the_law_at_the_end():
    best = solve(problem(20, time_weight=0.0036, peak=0.08))
    assert all(b.certificate.holds(1e-9) for b in (best, *best.others))
    assert "saturated" in best.modes and best.modes[-1] == "unsaturated"
    thrust = np.linalg.norm(best.control([*best.switch_times, best.duration]), axis=1)
    assert thrust[:-1] == pytest.approx(0.08, rel=1e-12)
    assert thrust[-1] == pytest.approx(math.sqrt(0.0036), rel=1e-10)
    assert [b.cost for b in (best, *best.others)] == sorted(b.cost for b in (best, *best.others))
    assert best.searched.durations and 0 in best.searched.revolutions


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 30])
def test_the_thrust_of_least_time_is_saturated_throughout(degrees):
    best = solve(problem(degrees, time_weight=1, energy_weight=0, peak=0.1))
    assert all(found.certificate.holds(1e-9) for found in (best, *best.others))
    assert best.modes == ("saturated",)


@pytest.mark.slow
def test_the_solution_does_not_depend_on_units_and_on_the_sign_of_quaternions():
    """Lengths are multiplied by 7000, fM is 398600, and -Lambda* takes the place of Lambda*."""
    plain = problem(20, duration=8.0)
    length, gravity = 7000.0, 398600.0
    time = math.sqrt(length**3 / gravity)
    speed = length / time
    target = plain.target
    other = Rendezvous(
        Chaser(length, 0.0, length * speed, [-1, 0, 0, 0]),
        Orbit(1.5 * length, target.eccentricity, -np.asarray(target.attitude), target.anomaly),
        time_weight=0,
        energy_weight=1,
        peak=math.inf,
        gravity=gravity,
        duration=8.0 * time,
    )
    first, second = solve(plain), solve(other)
    assert second.cost * time / speed**2 == pytest.approx(first.cost, rel=1e-11)
    assert second.arrival_anomaly == pytest.approx(first.arrival_anomaly, abs=1e-11)
    assert second.certificate.holds(1e-10)


@pytest.mark.slow
def test_the_solution_of_a_neighbouring_problem_is_a_start():
    first = solve(problem(20, duration=8.0))
    near = solve(problem(20, duration=8.05), start=first)
    assert near.certificate.holds(1e-10) and near.cost < first.cost


def test_least_energy_in_free_time_is_infeasible():
    with pytest.raises(pontryagin.Infeasible, match="longer flight is always cheaper"):
        solve(problem(20))


@pytest.mark.slow
def test_a_bound_too_small_for_the_duration_is_infeasible():
    with pytest.raises(pontryagin.Infeasible, match=r"at least about 0\.\d+ on each lap.*the peak of 0\.04$"):
        solve(problem(20, peak=0.04, duration=4.0))


def test_a_craft_on_its_target_needs_no_thrust():
    target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    together = Rendezvous(
        chaser_on(target), target, time_weight=0, energy_weight=1, peak=math.inf, duration=6.0
    )
    best = solve(together)
    assert best.cost < 1e-28
    assert best.certificate.holds(1e-10)


class TestBesideTheTarget:
    @pytest.mark.slow
    @pytest.mark.parametrize("distance", [1e-3, 1e-6])
    def test_the_least_time_beside_the_target_is_twice_the_root_of_distance_over_peak(self, distance):
        best = solve(beside(distance, time_weight=1, energy_weight=0, peak=0.1))
        assert best.duration == pytest.approx(2 * math.sqrt(distance / 0.1), rel=4e-3)
        assert best.certificate.holds(1e-12)

    @pytest.mark.parametrize("run", [solve, solve_in_elements, least_fuel])
    def test_a_craft_with_the_target_at_t0_is_refused_in_free_time(self, run):
        with pytest.raises(ValueError, match="chaser must not be with the target at t0"):
            run(beside(0.0, time_weight=0.01, energy_weight=1, peak=0.2))

    def test_a_craft_with_the_target_at_t0_costs_nothing_in_fixed_time(self):
        assert solve(replace(beside(0.0), duration=3.0)).cost < 1e-20


@pytest.mark.slow
def test_all_extremals_found_are_returned():
    best = solve(cases()["ellipse-mixed"].problem)
    assert len(best.others) >= 7 and not best.searched.given_up
    assert len(best.searched.ends) == 2
    times = [one.duration for one in (best, *best.others)]
    assert len({round(t, 6) for t in times}) == len(times)


@pytest.mark.slow
def test_a_bound_below_every_mean_thrust_is_infeasible_and_a_failure_is_not_converged():
    with pytest.raises(Infeasible, match="no transfer of this duration keeps the thrust within the peak"):
        solve(replace(LEAP, peak=0.02))
    with pytest.raises(NotConverged):
        solve(replace(LEAP, target=Orbit(1.5, 0.1, [0, 1, 0, 0], 0.6), duration=0.3))


def test_a_start_without_a_solution_nearby_does_not_converge(leap):
    upside_down = replace(LEAP, target=Orbit(4.0, 0.6, [0, 1, 0, 0], 0.6))
    with pytest.raises(NotConverged):
        solve(upside_down, leap)


def test_a_start_must_be_an_extremal():
    for run in (solve, solve_in_elements):
        with pytest.raises(TypeError, match="start must be an Extremal"):
            run(LEAP, "x")
    with pytest.raises(TypeError, match="true must be an Extremal"):
        false_meeting(LEAP, 0.1, "x")


def test_an_anomaly_of_many_turns_is_the_one_within_a_turn():
    with mp.workdps(60):
        within = float(mp.atan2(mp.sin(mp.mpf(1e15)), mp.cos(mp.mpf(1e15))))
    craft = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
    targets = [Orbit(1.2, 0.05, [1, 0, 0, 0], anomaly) for anomaly in (within, 1e15)]
    usual, far = (solve(Rendezvous(craft, target, peak=0.1)) for target in targets)
    np.testing.assert_allclose([far.cost, far.duration], [usual.cost, usual.duration], rtol=1e-9)
    assert far.certificate.holds(1e-9)
    assert abs(far.arrival_anomaly - 1e15 - (usual.arrival_anomaly - within)) <= 0.2
    assert abs(far.state([0.0])[0, 3] - 1e15) <= 0.2


@pytest.mark.parametrize("given", ["anomaly", "node", "inclination", "pericentre"])
def test_an_angle_that_has_no_place_on_the_turn_is_refused(given):
    angles = {"node": 0.1, "inclination": 0.2, "pericentre": 0.3, "anomaly": 0.4} | {given: 1e17}
    with pytest.raises(ValueError, match=rf"^{given} must be a number, at most 9.0e\+15 rad") as caught:
        Orbit.from_angles(1.2, 0.05, **angles)
    assert caught.value.argument == given
