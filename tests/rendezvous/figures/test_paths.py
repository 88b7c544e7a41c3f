"""Paths lead from the craft to the target and obey gravity and thrust."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures import paths


@pytest.mark.slow
def test_the_path_leads_from_the_craft_to_the_target():
    best = solved("mixed-bounded")
    times, places, thrust = paths.flight_path(best.problem, best.flight, 50)
    assert_allclose(places[0], [1, 0, 0], atol=1e-14)
    assert_allclose(places[-1], paths.target_at(best.problem, best.duration), atol=1e-10)
    assert times[-1] == pytest.approx(best.duration)
    assert_allclose(np.linalg.norm(thrust, axis=1), np.linalg.norm(best.control(times), axis=1))


def test_the_second_differences_of_the_path_are_gravity_and_thrust():
    times, places, thrust = paths.flight_path(
        solved("mixed-bounded").problem, solved("mixed-bounded").flight, 4001
    )
    step = times[1] - times[0]
    gravity = -places / np.linalg.norm(places, axis=1, keepdims=True) ** 3
    acceleration = (places[2:] - 2 * places[1:-1] + places[:-2]) / step**2
    assert np.abs(acceleration - (gravity + thrust)[1:-1]).max() < 1e-4


def test_both_orbits_are_ellipses_about_the_centre():
    problem = Rendezvous(
        Chaser(1.0, 0.2, 1.05, [0.6, 0, 0.8, 0]),
        Orbit.from_angles(1.5, 0.3, 0.4, 0.7, 0.2, 0.6),
        peak=0.1,
    )
    for points, size in (
        (paths.initial_orbit(problem), 1 / (2 - 0.2**2 - 1.05**2)),
        (paths.target_orbit(problem), 1.5 / (1 - 0.3**2)),
    ):
        r = np.linalg.norm(points, axis=1)
        assert r.min() + r.max() == pytest.approx(2 * size, rel=1e-3)
    assert_allclose(paths.target_orbit(problem)[0], paths.target_orbit(problem)[-1], atol=1e-12)
    gap = np.linalg.norm(paths.target_orbit(problem) - paths.target_at(problem, 3.0), axis=1)
    assert gap.min() < 0.03
