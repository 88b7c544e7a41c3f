"""Solutions in the elements are those in the axes eta; wrong arguments are refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

import pontryagin
from pontryagin.numerics.rotation import rotated
from pontryagin.rendezvous import (
    Chaser,
    Orbit,
    Rendezvous,
    least_fuel,
    solve,
    solve_in_elements,
)
from rendezvous_problems import LEAP, problem


@pytest.mark.slow
@pytest.mark.parametrize(
    ("degrees", "changes"),
    [
        (0, {"duration": 6.0}),
        (60, {"duration": 4.0}),
        (20, {"time_weight": 0.01, "peak": 0.12}),
    ],
)
def test_the_solution_in_the_elements_is_an_extremal_found_in_the_axes_eta(degrees, changes):
    """Both solutions are found from cold starts, independently of each other."""
    given = problem(degrees, **changes)
    mine = solve_in_elements(given)
    other = solve(given)
    same = min(
        [other, *other.others], key=lambda x: abs(x.duration - mine.duration) + abs(x.cost - mine.cost)
    )
    assert mine.cost == pytest.approx(same.cost, rel=1e-10)
    assert mine.duration == pytest.approx(same.duration, rel=1e-10)
    assert mine.certificate.holds(1e-10)
    t = np.linspace(0, mine.duration, 7)
    attitude = same.state(np.clip(t, 0, same.duration))[:, 4:]
    assert np.allclose(
        mine.control(t), rotated(same.control(np.clip(t, 0, same.duration)), attitude), atol=1e-9
    )
    assert np.allclose(
        np.linalg.norm(mine.elements(t).position, axis=1), same.state(t.clip(0, same.duration))[:, 0]
    )


def test_the_transformed_costates_of_a_solution_are_a_solution_in_the_elements():
    """The ellipses are inclined, the units km and s, and the craft's attitude is not the unit quaternion."""
    craft = Chaser(7000.0, 0.3, 54000.0, [0.6, 0, 0.8, 0])
    target = Orbit.from_angles(9000.0, 0.2, 0.3, 1.3, 0.5, 0.6)
    given = Rendezvous(craft, target, 0.0, 1.0, math.inf, gravity=398600.0, duration=5000.0)
    best = solve(given)
    mine = solve_in_elements(given, start=best)
    assert mine.cost == pytest.approx(best.cost, rel=1e-11)
    assert mine.certificate.holds(1e-9)
    start = mine.elements(0.0)
    attitude = np.array([0.6, 0, 0.8, 0])
    assert np.allclose(start.position[0], rotated(np.array([7000.0, 0, 0]), attitude), rtol=1e-12)
    assert np.allclose(start.velocity[0], rotated(np.array([0.3, 54000 / 7000, 0]), attitude), atol=1e-11)


def test_least_energy_or_fuel_in_free_time_is_infeasible():
    for solver in (solve_in_elements, least_fuel):
        with pytest.raises(pontryagin.Infeasible, match="longer flight is always cheaper"):
            solver(problem(20, peak=0.2))
        with pytest.raises(TypeError, match="problem must be of type Rendezvous"):
            solver(None)


@pytest.mark.parametrize("run", [solve_in_elements, least_fuel])
@pytest.mark.parametrize("wrong", ["x", None, 0.5, math.nan, True])
def test_revolutions_must_be_a_whole_number(run, wrong):
    with pytest.raises(TypeError, match="revolutions must be a whole number, got"):
        run(replace(LEAP, peak=0.15), revolutions=wrong)
