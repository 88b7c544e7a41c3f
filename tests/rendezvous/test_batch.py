"""Stacks of flights: each member has the same result as if integrated alone."""

import math

import numpy as np
import pytest

from pontryagin.errors import NotConverged
from pontryagin.rendezvous import Chaser, Extremal, Orbit, Rendezvous, carry, multistart
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import (
    fly,
    switching,
)
from pontryagin.rendezvous.reduced.lanes import fly_all
from pontryagin.rendezvous.reduced.start import cold_start

ONE = [1, 0, 0, 0]
KINDS = [(math.inf, False), (0.05, False), (0.05, True)]
FALLING = np.array([0.02, -0.04, 0.01, 0.19, 0.05, -0.16])
"""Costates with which the craft falls into the centre of attraction."""


def problem(degrees: float = 20, length: float = 1.0, gravity: float = 1.0, **changes) -> Rendezvous:
    """A problem scaled by `length`, with times scaled so that the motion is the same for every `gravity`."""
    time = math.sqrt(length**3 / gravity)
    given = {"time_weight": 0, "energy_weight": 1, "peak": math.inf, "duration": 6.0} | changes
    given["duration"] = given["duration"] and given["duration"] * time
    given["peak"] *= length / time**2
    target = Orbit.from_angles(1.5 * length, 0.1, 0.3, math.radians(degrees), 0.5, 0.6)
    craft = Chaser(length, 0.0, length**2 / time, ONE)
    return Rendezvous(craft, target, gravity=gravity, **given)


@pytest.fixture(scope="module")
def best():
    """The extremal found by continuation from coasting, without random starts."""
    given = problem()
    scaled = given.scaled
    return Extremal(given, cold_start(Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)))


def starts(count: int) -> np.ndarray:
    return 0.05 * np.random.default_rng(5).standard_normal((count, 6))


@pytest.mark.parametrize(("peak", "bang"), KINDS)
def test_each_flight_of_a_stack_ends_as_if_integrated_alone(peak, bang):
    """There are more flights than lanes, with different durations and switches, in both charts."""
    scaled, costates = problem().scaled, starts(19)
    durations = np.linspace(0.5, 4.0, 19)
    together = fly_all(scaled, costates, durations, peak, bang)
    plain = fly_all(scaled, costates, durations, peak, bang, slopes=False)
    assert together.reached.all() and plain.reached.all() and plain.slopes is None
    assert set(together.charts) == {1, -1}
    for i in range(19):
        alone = fly(scaled, costates[i], durations[i], peak, bang)
        assert together.switches[i] == plain.switches[i] == len(alone.pieces) - 1
        np.testing.assert_allclose(together.ends[i], alone.end, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(plain.ends[i], alone.end, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(together.slopes[i], alone.slopes, rtol=1e-10, atol=1e-10)
    assert bool(together.switches.any()) == (peak < math.inf and not bang)


def test_a_flight_that_fails_does_not_change_the_others():
    scaled, costates = problem().scaled, starts(11)
    whole = fly_all(scaled, costates, 3.0)
    with pytest.raises(NotConverged):
        fly(scaled, FALLING, 5.0)
    mixed = fly_all(
        scaled, np.insert(costates, [0, 4], FALLING, axis=0), np.insert(np.full(11, 3.0), [0, 4], 5.0)
    )
    assert np.flatnonzero(~mixed.reached).tolist() == [0, 5]
    assert np.isnan(mixed.ends[[0, 5]]).all()
    np.testing.assert_allclose(mixed.ends[mixed.reached], whole.ends, rtol=1e-12, atol=1e-13)


def test_without_heyoka_the_flights_have_the_same_ends():
    scaled, costates = problem().scaled, starts(3)
    both = [fly_all(scaled, costates, 2.0, 0.05, taylor=use) for use in (True, False)]
    for name in ("reached", "switches"):
        np.testing.assert_array_equal(*(getattr(flights, name) for flights in both))
    np.testing.assert_allclose(*(flights.ends for flights in both), atol=1e-9)
    np.testing.assert_allclose(*(flights.slopes for flights in both), atol=1e-7)


def test_the_mode_of_every_arc_is_that_of_the_switching_function():
    """n is that of (9). This holds also for arcs that begin exactly at |n| = 2 alpha2 p_max."""
    given = problem(peak=0.06)
    for costates in 2 * starts(12) / given.scaled.costate_units:
        alone = fly(given.scaled, costates, given.scaled.duration, given.scaled.peak)
        states = alone.sample(np.linspace(0, alone.duration, 400))
        begins = np.array([piece.begin for piece in alone.pieces])
        which = np.searchsorted(begins, np.linspace(0, alone.duration, 400), side="right") - 1
        on_bound = np.array([piece.mode == "saturated" for piece in alone.pieces])[which]
        excess = np.linalg.norm(switching(states), axis=1) / (2 * alone.peak) - 1
        assert (np.where(on_bound, excess, -excess) > -1e-9).all()


def test_an_empty_stack_of_flights_is_empty():
    assert fly_all(problem().scaled, np.empty((0, 6)), 1.0).ends.shape == (0, 12)


@pytest.mark.parametrize("peak", [math.inf, 0.06])
def test_the_slopes_are_the_derivatives_of_the_miss(peak):
    given, h = problem(peak=peak), 1e-6
    start = starts(3)[:, None, :]
    exact = carry(given, start[:, 0])
    there, back = (carry(given, start + x * np.eye(6)).miss for x in (h, -h))
    slopes = np.moveaxis((there - back) / (2 * h), 1, 2)
    np.testing.assert_allclose(exact.slopes, slopes, rtol=1e-5, atol=1e-5)


def test_the_costates_of_a_solution_lead_to_the_target(best):
    given = best.problem
    there = carry(given, best.initial_costate)
    assert there.reached and there.miss.shape == (6,) and there.slopes.shape == (6, 6)
    assert np.abs(there.miss).max() < 1e-12
    np.testing.assert_allclose(there.state, best.state([best.duration])[0], atol=1e-12)
    np.testing.assert_allclose(there.costate, best.costate([best.duration])[0], atol=1e-12)
    assert np.abs(carry(given, best.initial_costate + 1e-6).miss).max() > 1e-7


def test_the_flights_do_not_depend_on_the_units():
    here, far = problem(), problem(length=7000.0, gravity=398600.0)
    costates = starts(4)
    durations = np.array([1.0, 2.0, 3.0, 4.0])
    units = far.scaled.costate_units / here.scaled.costate_units
    ours = carry(here, costates, durations)
    theirs = carry(far, costates * units, durations * far.scaled.time / here.scaled.time)
    np.testing.assert_allclose(theirs.miss, ours.miss, atol=1e-12)
    np.testing.assert_allclose(theirs.state[:, 0], 7000 * ours.state[:, 0], rtol=1e-12)
    np.testing.assert_allclose(theirs.costate, ours.costate * units, rtol=1e-10)


@pytest.mark.slow
def test_newton_s_method_from_many_starts_finds_the_extremal_found_from_coasting(best):
    found, *others = multistart(best.problem, starts(8))
    assert found.cost <= best.cost * (1 + 1e-10)
    assert any(x.cost == pytest.approx(best.cost, rel=1e-10) for x in (found, *others))
    assert found.others == tuple(others) and others
    assert [x.cost for x in others] == sorted(x.cost for x in others)
    assert all(x.certificate.holds(1e-9) for x in (found, *others))


def test_starts_that_fail_give_no_extremals():
    assert multistart(problem(), FALLING[None]) == ()


@pytest.mark.parametrize(
    ("call", "error", "match"),
    [
        (lambda: carry("leap", starts(1)), TypeError, "problem must be of type Rendezvous, got 'leap'"),
        (lambda: carry(problem(), np.zeros(5)), ValueError, r"costates must be an array \(..., 6\)"),
        (lambda: carry(problem(), np.full(6, np.nan)), ValueError, "costates .* got nan"),
        (lambda: carry(problem(), starts(2), -1.0), ValueError, "durations must be positive, got -1"),
        (lambda: carry(problem(), starts(2), [1.0, 2.0, 3.0]), ValueError, "durations must be one number or"),
        (lambda: carry(problem(duration=None), starts(2)), ValueError, "durations must be given"),
        (lambda: multistart(problem(duration=None), starts(2)), ValueError, "problem must have a fixed dur"),
        (lambda: multistart(problem(), np.zeros(6)), ValueError, r"costates must be an array \(k, 6\)"),
        (lambda: multistart(None, starts(2)), TypeError, "problem must be of type Rendezvous, got None"),
    ],
)
def test_the_error_of_a_wrong_argument_names_it(call, error, match):
    with pytest.raises(error, match=match):
        call()
