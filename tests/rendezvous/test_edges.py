"""Limiting cases of the solvers (beside the target, close to the centre), value semantics, errors."""

import copy
import itertools
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from pontryagin import Infeasible, NotConverged
from pontryagin.rendezvous import (
    Chaser,
    Elements,
    Orbit,
    Rendezvous,
    carry,
    false_meeting,
    least_fuel,
    multistart,
    solve,
    solve_in_elements,
)
from pontryagin.rendezvous.families import stretched
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import SHOOTING
from pontryagin.rendezvous.reduced.solve import KEPT

CRAFT = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
LEAP = Rendezvous(CRAFT, Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6), 0, 1, math.inf, duration=6.0)


def tilted(degrees, **changes):
    orbit = Orbit.from_angles(1.5, 0.1, 0.0, math.radians(degrees), 0.0, 0.6)
    return replace(LEAP, target=orbit, **changes)


def beside(distance, **changes):
    """A problem of free duration whose craft starts above the target at a distance, with its v1 and c."""
    turn = [math.cos(0.3), 0, 0, math.sin(0.3)]
    radius = 1.5 / (1 + 0.1 * math.cos(0.6))
    craft = Chaser(radius + distance, 0.1 * math.sqrt(1 / 1.5) * math.sin(0.6), math.sqrt(1.5), turn)
    return replace(LEAP, chaser=craft, duration=None, **changes)


@pytest.fixture(scope="module")
def leap():
    return solve(LEAP)


@pytest.fixture(scope="module")
def diving():
    """An extremal that comes as close to the centre as r = 0.05."""
    best = solve(tilted(120, duration=12.0))
    return min((best, *best.others), key=lambda one: one.state(np.linspace(0, 12, 2001))[:, 0].min())


def simpson(rate, extremal):
    """The integral of a function of time by Simpson's rule, with a finer mesh near the closest approach."""
    end = extremal.duration
    nearest = end * np.argmin(extremal.state(np.linspace(0, end, 20_001))[:, 0]) / 20_000
    total = 0.0
    for a, b in itertools.pairwise([0.0, *(nearest + np.array([-0.1, -0.01, 0.01, 0.1])), end]):
        values = rate(np.linspace(a, b, 20_001))
        total += (
            (b - a) / 60_000 * (values[[0, -1]].sum() + 4 * values[1:-1:2].sum() + 2 * values[2:-1:2].sum())
        )
    return total


class TestCost:
    @pytest.mark.slow
    def test_the_cost_is_the_integral_of_p_squared_also_close_to_the_centre(self, diving):
        assert diving.state(np.linspace(0, 12, 20_001))[:, 0].min() < 0.06
        assert diving.cost == pytest.approx(
            simpson(lambda t: np.sum(diving.control(t) ** 2, axis=1), diving), rel=1e-9
        )
        assert diving.certificate.cost < 1e-10

    @pytest.mark.slow
    def test_the_revolutions_are_the_integral_of_c_over_r_squared(self, diving):
        angle = simpson(lambda t: diving.state(t)[:, 2] / diving.state(t)[:, 0] ** 2, diving)
        assert diving.revolutions == pytest.approx(angle / (2 * math.pi), rel=1e-9)

    @pytest.mark.slow
    def test_the_certificate_detects_a_wrong_cost(self, leap, monkeypatch):
        monkeypatch.setattr(
            "pontryagin.rendezvous.reduced.certificate.energy", lambda flight: energy(flight) * (1 + 1e-6)
        )
        again = replace(leap)
        assert float(again.certificate.cost) == pytest.approx(1e-6, rel=1e-3)
        assert not again.certificate.holds(1e-9)


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


class TestSearch:
    @pytest.mark.slow
    def test_without_a_bound_all_extremals_are_returned(self):
        best = solve(cases()["ellipse-mixed"].problem)
        assert len(best.others) >= KEPT and not best.searched.given_up
        assert len(best.searched.ends) == 2
        times = [one.duration for one in (best, *best.others)]
        assert len({round(t, 6) for t in times}) == len(times)

    @pytest.mark.slow
    def test_with_a_bound_the_extremals_not_continued_are_counted(self):
        best = solve(replace(cases()["ellipse-mixed"].problem, peak=1.0))
        assert len(best.others) == KEPT - 1
        assert best.searched.given_up[0].startswith(
            "the 4 most costly extremals of the problem without bound"
        )

    def test_the_starts_that_did_not_converge_are_counted(self, leap):
        starts = np.vstack([leap.initial_costate, np.full(6, 40.0)])
        (found, *_) = multistart(LEAP, starts)
        assert found.searched.given_up == ["no meeting was reached from 1 of the 2 starts"]
        assert multistart(LEAP, starts[1:]) == ()

    @pytest.mark.slow
    def test_a_bound_below_every_family_is_infeasible_and_a_failure_is_not_converged(self):
        with pytest.raises(Infeasible, match="the costates grow without limit"):
            solve(replace(LEAP, peak=0.02))
        with pytest.raises(NotConverged):
            solve(replace(LEAP, target=Orbit(1.5, 0.1, [0, 1, 0, 0], 0.6), duration=0.3))

    @pytest.mark.slow
    def test_a_solution_of_a_shorter_duration_is_continued_to_the_longer_one(self, leap):
        scaled = LEAP.scaled
        setting = Setting(scaled, scaled.ratio, math.inf, duration=scaled.duration)
        short = solve(replace(LEAP, duration=3.0))
        root = stretched(SHOOTING, setting, short.root)
        assert root.flight.duration == scaled.duration and root.residual < 1e-13

    def test_a_start_without_a_solution_nearby_does_not_converge(self, leap):
        upside_down = replace(LEAP, target=Orbit(4.0, 0.6, [0, 1, 0, 0], 0.6))
        with pytest.raises(NotConverged):
            solve(upside_down, leap)


class TestValues:
    def test_problems_with_equal_numbers_are_equal_and_have_one_hash(self):
        other = Rendezvous(Chaser(1, 0, 1, (1.0, 0, 0, 0)), replace(LEAP.target), 0, 1, math.inf, duration=6)
        assert other == LEAP and hash(other) == hash(LEAP) and other.target == LEAP.target
        assert replace(LEAP, peak=1.0) != LEAP and LEAP.chaser != LEAP.target
        assert {LEAP: 1}[pickle.loads(pickle.dumps(LEAP))] == 1 == {copy.deepcopy(LEAP): 1}[LEAP]

    def test_attitudes_are_read_only(self):
        for orbit in (LEAP.target, LEAP.chaser):
            with pytest.raises(ValueError, match="read-only"):
                orbit.attitude[:] = 0

    @pytest.mark.slow
    def test_times_may_have_any_shape(self, leap):
        t = np.linspace(0, 6, 6).reshape(2, 3)
        along = solve_in_elements(LEAP)
        for part in (leap.state, leap.costate, leap.control, along.control, along.switching):
            assert_array_equal(part(t), part(t.ravel()).reshape(2, 3, -1))
        assert along.elements(t).A.shape == (2, 3, 4)

    def test_quaternions_in_single_precision_are_normalised(self):
        turn = np.array([np.cos(0.3), 0, 0, np.sin(0.3)], dtype=np.float32)
        assert np.linalg.norm(Orbit(1, 0, turn, 0).attitude) == pytest.approx(1, abs=1e-15)
        assert replace(LEAP, peak=np.float32("inf")).peak == math.inf

    def test_costates_that_are_zero_give_a_coasting_craft(self, leap):
        there = carry(LEAP, np.zeros((2, 6)))
        assert there.reached.all() and np.isfinite(there.slopes).all()
        assert multistart(LEAP, np.zeros((1, 6)))[0].cost == pytest.approx(leap.cost, rel=1e-12)
        assert not carry(LEAP, np.full(6, 1e300)).reached


class TestErrors:
    @pytest.mark.parametrize("run", [solve_in_elements, least_fuel])
    @pytest.mark.parametrize("wrong", ["x", None, 0.5, math.nan, True])
    def test_revolutions_must_be_a_whole_number(self, run, wrong):
        with pytest.raises(TypeError, match="revolutions must be a whole number, got"):
            run(replace(LEAP, peak=0.15), revolutions=wrong)

    def test_a_start_must_be_an_extremal(self):
        for run in (solve, solve_in_elements):
            with pytest.raises(TypeError, match="start must be an Extremal"):
                run(LEAP, "x")
        with pytest.raises(TypeError, match="true must be an Extremal"):
            false_meeting(LEAP, 0.1, "x")

    def test_numbers_beyond_double_precision_are_refused(self):
        with pytest.raises(ValueError, match="r must be a number that double precision holds"):
            Chaser(10**400, 0, 1, [1, 0, 0, 0])
        for orbit in (Orbit(1e150, 0, [1, 0, 0, 0], 0), Orbit(1e-150, 0, [1, 0, 0, 0], 0)):
            with pytest.raises(ValueError, match="must be of sizes that double precision holds"):
                replace(LEAP, target=orbit)
        with pytest.raises(ValueError, match="chaser must start on an ellipse"):
            replace(LEAP, chaser=Chaser(1, 1e200, 1, [1, 0, 0, 0]))

    def test_elements_that_are_no_orbit_are_refused(self):
        with pytest.raises(ValueError, match="A and B must not both be zero"):
            Elements([0] * 4, [0] * 4)
        with pytest.raises(ValueError, match="got -1"):
            Elements([1, 0, 0, 0], [0, 1, 0, 0])
        with pytest.raises(ValueError, match="gravity must be one number"):
            Elements.from_state([1, 0, 0], [0, 1, 0], [1, 1])
        with pytest.raises(ValueError, match="angle must be"):
            Elements.from_state([1, 0, 0], [0, 1, 0]).turned(math.nan)
