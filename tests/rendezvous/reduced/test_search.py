"""Planes of any inclination are met, and extremals that climb to turn their plane are found."""

import math
from functools import cache

import numpy as np
import pytest

from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
from pontryagin.rendezvous.problem.cases import chaser_on

CRAFT = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])


def inclined(degrees, **changes):
    half = math.radians(degrees) / 2
    target = Orbit(1.2, 0.05, [math.cos(half), math.sin(half), 0, 0], 0.5)
    weights = {"time_weight": 0, "energy_weight": 1, "peak": math.inf, "duration": 10.0}
    return Rendezvous(CRAFT, target, **weights | changes)


@cache
def solved(degrees):
    return solve(inclined(degrees))


@pytest.mark.parametrize(
    ("degrees", "costs"),
    [
        (0, [0.001742]),
        pytest.param(60, [0.167648], marks=pytest.mark.slow),
        pytest.param(90, [0.275522, 0.285402], marks=pytest.mark.slow),
        (120, [0.347072, 0.380943, 0.632406]),
        pytest.param(135, [0.371122, 0.414444], marks=pytest.mark.slow),
        (150, [0.387162, 0.432249, 0.856447]),
        pytest.param(179, [0.398268, 0.425320, 1.041394], marks=pytest.mark.slow),
        (180, [1.047148]),
    ],
)
def test_planes_of_any_inclination_are_met(degrees, costs):
    found = solved(degrees)
    values = [each.cost for each in (found, *found.others)]
    assert found.certificate.holds(1e-9)
    assert found.cost == pytest.approx(costs[0], abs=1e-6)
    for cost in costs:
        assert min(abs(value - cost) for value in values) < 1e-6
    assert len(found.searched.revolutions) >= len(values)


FREE = {"duration": None}
LEAST_TIME = {"time_weight": 1, "energy_weight": 0, "peak": 0.1} | FREE
MIXED = {"time_weight": 0.0036} | FREE
BOUNDED = {"time_weight": 0.02, "peak": 0.15} | FREE


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "degrees", "cost"),
    [
        (LEAST_TIME, 80, 15.386650),
        (LEAST_TIME, 120, 15.918294),
        (LEAST_TIME, 150, 16.770861),
        (LEAST_TIME, 170, 16.833901),
        (LEAST_TIME, 179, 16.839180),
        (LEAST_TIME, 179.9, 16.839230),
        (MIXED, 90, 0.156759),
        (MIXED, 150, 0.179686),
        (MIXED, 179, 0.174738),
        (MIXED, 179.9, 0.174729),
        (BOUNDED, 170, 0.46747),
        (BOUNDED, 179.9, 0.46780),
    ],
)
def test_free_durations_are_found_up_to_opposite_planes(kind, degrees, cost):
    found = solve(inclined(degrees, **kind))
    assert found.cost == pytest.approx(cost, rel=2e-5) and found.certificate.holds(1e-9)


def test_a_path_that_moves_radially_is_told():
    """Between planes of opposite senses the cheaper paths stay in the plane, and turn back far out."""
    reasons = solved(180).searched.given_up
    assert any("moves radially" in reason and "solve_in_elements" in reason for reason in reasons)


def test_the_extremal_that_climbs_turns_its_plane_at_the_apex():
    found = solved(120)
    r, v1, c = found.state(np.linspace(0.0, 10.0, 400))[:, :3].T
    apex = r.argmax()
    assert r[apex] > 1.9 and c.min() < 0.45 and abs(v1[apex]) < 0.05
    assert abs(c[apex] - c.min()) < 0.05
    assert 0 in found.searched.revolutions


@pytest.mark.slow
def test_a_bound_is_met_by_an_extremal_that_climbs():
    free = solved(120)
    largest = np.linalg.norm(free.control(np.linspace(0.0, 10.0, 400)), axis=1).max()
    found = solve(inclined(120, peak=0.9 * largest))
    assert found.certificate.holds(1e-8)
    assert "saturated" in found.modes and free.cost < found.cost < 1.02 * free.cost


def random_problem(seed):
    """Orbits of any attitude, with eccentricities up to 0.9, and a duration from 2 to 15."""
    random = np.random.default_rng(seed)

    def orbit(largest):
        attitude = random.standard_normal(4)
        parameter, eccentricity = random.uniform(0.8, largest), random.uniform(0, 0.9)
        attitude /= np.linalg.norm(attitude)
        return Orbit(parameter, eccentricity, attitude, random.uniform(0, 2 * math.pi))

    craft, target = orbit(1.2), orbit(1.6)
    duration = random.uniform(2, 15)
    return Rendezvous(
        chaser_on(craft), target, time_weight=0, energy_weight=1, peak=math.inf, duration=duration
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", [11, 12, 18, 21, 26, 27, 29, 40, 44, 48, 56, 58])
def test_problems_without_an_extremal_on_any_lap_are_solved(seed):
    assert solve(random_problem(seed)).certificate.holds(1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "cost"), [(0, 0.22930), (10, 0.21161), (13, 0.07236), (17, 0.23694)])
def test_descents_find_what_the_laps_miss(seed, cost):
    found = solve(random_problem(seed))
    assert found.cost == pytest.approx(cost, abs=1e-5) and found.certificate.holds(1e-9)


@pytest.mark.slow
def test_least_time_is_found_where_a_lap_opens():
    """A longer duration needs much less thrust than the ones before; 4.21775 is also met in the elements."""
    craft = Chaser(1.0, 0.0, 1.0, [-0.5943884660190438, 0, 0, 0.8041780595511967])
    attitude = [-0.7638871971162817, -0.038797672240023354, 0.09327543603639739, 0.6373937430998259]
    target = Orbit(1.721008309359351, 0.02766577934282216, attitude, 3.700902534648717)
    found = solve(Rendezvous(craft, target, peak=0.3932559370226493))
    assert found.cost == pytest.approx(4.21775104, abs=1e-7) and found.certificate.holds(1e-9)
