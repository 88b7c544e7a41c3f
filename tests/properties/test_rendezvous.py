"""Invariances of meetings: turned, mirrored and reversed, in other units, and from a point on the way."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from pontryagin.numerics.rotation import product
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, carry, least_fuel, solve, solve_in_elements
from pontryagin.rendezvous.problem.cases import chaser_on
from rendezvous_problems import in_units, starts

HALF_TURN = (0.0, 1.0, 0.0, 0.0)
"""About the first axis: turns the second and the third axis of an orbit round, as reversed time does."""
MIRROR = np.array([1.0, -1.0, -1.0, 1.0])
"""The quaternion of axes mirrored in the plane of the first two inertial axes."""
few, fewer = settings(max_examples=5), settings(max_examples=2)
quaternions = st.integers(0, 10_000).map(
    lambda seed: Rotation.random(random_state=seed).as_quat(scalar_first=True)
)
angles = st.floats(-3.0, 3.0)
durations = st.floats(4.0, 8.0)


@st.composite
def orbits(draw, least, most):
    inclination, node, pericentre = draw(st.floats(0.0, 0.7)), draw(angles), draw(angles)
    size, eccentricity = draw(st.floats(least, most)), draw(st.floats(0.0, 0.3))
    return Orbit.from_angles(size, eccentricity, node, inclination, pericentre, draw(angles))


crafts, targets = orbits(0.8, 1.0), orbits(1.2, 1.5)


def meeting(craft, target, duration, **changes):
    """Least energy in a fixed time without a bound, unless it is changed."""
    given = {"time_weight": 0.0, "energy_weight": 1.0, "peak": math.inf} | changes
    return Rendezvous(chaser_on(craft), target, duration=duration, **given)


def replaced(problem, attitude):
    """The problem whose craft and target have other attitudes."""
    chaser, target = problem.chaser, problem.target
    return replace(
        problem,
        chaser=replace(chaser, attitude=attitude(np.asarray(chaser.attitude))),
        target=replace(target, attitude=attitude(np.asarray(target.attitude))),
    )


def turned(problem, turn):
    return replaced(problem, lambda attitude: product(turn, attitude))


def later(orbit, duration):
    """The true anomaly after a time on the orbit, for fM = 1, by Kepler's equation."""
    e = orbit.eccentricity
    ratio = math.sqrt((1 + e) / (1 - e))
    start = 2 * math.atan(math.tan(orbit.anomaly / 2) / ratio)
    mean = start - e * math.sin(start) + duration * ((1 - e * e) / orbit.parameter) ** 1.5
    end = brentq(lambda E: E - e * math.sin(E) - mean, mean - 1, mean + 1, xtol=1e-15, rtol=1e-15)
    return 2 * math.atan(ratio * math.tan(end / 2))


def reversed_in_time(orbit, duration):
    """The orbit flown backwards, from where the body is after a time."""
    return Orbit(
        orbit.parameter,
        orbit.eccentricity,
        product(np.asarray(orbit.attitude), np.array(HALF_TURN)),
        -later(orbit, duration),
    )


@pytest.mark.slow
@few
@given(crafts, targets, durations, quaternions)
def test_a_rotation_of_both_orbits_turns_the_meeting(craft, target, duration, turn):
    problem = meeting(craft, target, duration)
    base, found = solve(problem), solve(turned(problem, turn))
    assert_allclose(
        [x.cost for x in (found, *found.others)], [x.cost for x in (base, *base.others)], rtol=1e-9
    )
    t = np.linspace(0, duration, 5)
    attitudes = product(np.broadcast_to(turn, (5, 4)), base.state(t)[:, 4:])
    assert_allclose(found.state(t)[:, :4], base.state(t)[:, :4], atol=1e-8)
    assert_allclose(np.abs((found.state(t)[:, 4:] * attitudes).sum(axis=1)), 1.0, atol=1e-9)
    assert_allclose(found.control(t), base.control(t), atol=1e-8)


@pytest.mark.slow
@few
@given(crafts, targets, durations)
def test_a_mirror_mirrors_the_meeting(craft, target, duration):
    problem = meeting(craft, target, duration)
    base, found = solve(problem), solve(replaced(problem, lambda attitude: attitude * MIRROR))
    assert found.cost == pytest.approx(base.cost, rel=1e-9)
    t = np.linspace(0, duration, 5)
    assert_allclose(found.control(t), base.control(t) * [1, 1, -1], atol=1e-8)


@fewer
@given(crafts, targets, durations)
def test_the_way_back_costs_the_same(craft, target, duration):
    """In reversed time the craft leaves where they met, and its target coasts on its first orbit."""
    there = solve(meeting(craft, target, duration))
    back = solve(meeting(reversed_in_time(target, duration), reversed_in_time(craft, duration), duration))
    assert back.cost == pytest.approx(there.cost, rel=1e-9)
    t = np.linspace(0, duration, 7)
    sizes = [np.linalg.norm(found.control(t), axis=1) for found in (there, back)]
    assert_allclose(sizes[1][::-1], sizes[0], atol=1e-7)


@pytest.mark.slow
@few
@given(crafts, targets, durations, st.floats(0.1, 0.7))
def test_from_a_point_on_the_way_the_rest_is_best(craft, target, duration, share):
    base = solve(meeting(craft, target, duration))
    t = share * duration
    r, v1, c, anomaly, *attitude = base.state([t])[0]
    rest = replace(
        base.problem,
        chaser=Chaser(r, v1, c, attitude),
        target=replace(target, anomaly=anomaly),
        duration=duration - t,
    )
    found = solve(rest)
    assert_allclose(found.initial_costate, base.costate([t])[0], atol=1e-7)
    assert found.arrival_anomaly == pytest.approx(base.arrival_anomaly, abs=1e-8)


@pytest.mark.slow
@few
@given(crafts, targets, durations, st.floats(0.01, 100.0))
def test_the_cost_is_in_units_of_its_weight(craft, target, duration, weight):
    base = solve(meeting(craft, target, duration))
    dear = solve(meeting(craft, target, duration, energy_weight=weight))
    assert dear.cost == pytest.approx(weight * base.cost, rel=1e-9)
    assert_allclose(dear.initial_costate, weight * base.initial_costate, rtol=1e-7, atol=1e-9 * weight)


@pytest.mark.slow
@few
@given(crafts, targets, durations, st.floats(0.85, 0.99), st.floats(0.85, 1.2))
def test_a_lower_bound_on_the_thrust_costs_no_less(craft, target, duration, share, other):
    free = solve(meeting(craft, target, duration))
    largest = np.linalg.norm(free.control(np.linspace(0, duration, 400)), axis=1).max()
    low, high = (
        solve(meeting(craft, target, duration, peak=largest * part)) for part in sorted([share, other])
    )
    assert low.cost >= high.cost * (1 - 1e-10) >= free.cost * (1 - 2e-10)
    assert "saturated" in low.modes


@pytest.mark.slow
@few
@given(crafts, targets, durations)
def test_one_family_in_the_elements_finds_nothing_cheaper(craft, target, duration):
    problem = meeting(craft, target, duration)
    best, one = solve(problem), solve_in_elements(problem)
    assert one.cost >= best.cost * (1 - 1e-9)


@pytest.mark.parametrize(
    "run",
    [
        solve_in_elements,
        pytest.param(solve, marks=pytest.mark.slow),
        pytest.param(least_fuel, marks=pytest.mark.slow),
    ],
)
@fewer
@given(quaternions, st.floats(0.1, 1e4), st.floats(0.1, 1e6))
def test_meetings_turned_and_in_other_units(run, turn, length, gravity):
    """A unit of length and fM; the unit of time is that in which the motion is the same."""
    time = math.sqrt(length**3 / gravity)
    speed = length / time
    bound = 0.2 if run is least_fuel else math.inf
    plain = in_units(peak=bound)
    moved = turned(in_units(length=length, gravity=gravity, peak=bound), turn)
    base, found = run(plain), run(moved)
    assert found.certificate.holds(1e-9)
    unit = speed if run is least_fuel else speed**2 / time
    assert found.cost / unit == pytest.approx(base.cost, rel=1e-8)
    t = np.linspace(0.03, 0.97, 5) * plain.duration
    expected = base.control(t)
    if run is not solve:
        expected = Rotation.from_quat(turn, scalar_first=True).apply(expected)
    assert_allclose(found.control(t * time) * time / speed, expected, atol=1e-6)


@fewer
@given(crafts, targets, durations, quaternions)
def test_flights_from_given_costates_turn_with_the_orbits_and_are_the_same_alone(
    craft, target, duration, turn
):
    problem = meeting(craft, target, duration, peak=0.1)
    costates = starts(6)
    together = carry(problem, costates)
    moved = carry(turned(problem, turn), costates)
    assert_allclose(moved.miss[:, :3], together.miss[:, :3], atol=1e-9)
    assert_allclose(moved.state[:, :4], together.state[:, :4], atol=1e-9)
    for i in range(6):
        alone = carry(problem, costates[i])
        assert_array_equal(alone.reached, together.reached[i])
        assert_allclose(alone.state, together.state[i], rtol=1e-10, atol=1e-10)
