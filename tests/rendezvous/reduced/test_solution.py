"""An extremal in the user's units: its samples, its cost, its revolutions."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from pontryagin.rendezvous import (
    Orbit,
    multistart,
    solve,
    solve_in_elements,
)
from rendezvous_problems import LEAP, problem


@pytest.mark.slow
def test_samples_are_in_the_units_of_the_user():
    given = problem(20, duration=8.0)
    best = solve(given)
    t = np.linspace(0, 8, 9)
    states = best.state(t)
    assert states.shape == (9, 8) and best.costate(t).shape == (9, 6) and best.control(t).shape == (9, 3)
    assert np.allclose(states[0], [1, 0, 1, 0.6, 1, 0, 0, 0], atol=1e-14)
    assert np.allclose(best.costate(0.0)[0], best.initial_costate)
    assert np.allclose(np.linalg.norm(states[:, 4:], axis=1), 1, atol=1e-12)
    with pytest.raises(ValueError, match=r"^t must lie between"):
        best.state(8.1)


def tilted(degrees, **changes):
    orbit = Orbit.from_angles(1.5, 0.1, 0.0, math.radians(degrees), 0.0, 0.6)
    return replace(LEAP, target=orbit, **changes)


@pytest.fixture(scope="module")
def diving():
    """An extremal that comes as close to the centre as r = 0.05."""
    (found,) = multistart(tilted(120, duration=12.0), [[0.2727, -0.0464, -0.6972, 0.2611, -0.0035, -0.1136]])
    return found


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


@pytest.mark.slow
def test_the_cost_is_the_integral_of_p_squared_also_close_to_the_centre(diving):
    assert diving.state(np.linspace(0, 12, 20_001))[:, 0].min() < 0.06
    assert diving.cost == pytest.approx(
        simpson(lambda t: np.sum(diving.control(t) ** 2, axis=1), diving), rel=1e-9
    )
    assert diving.certificate.cost < 1e-10


@pytest.mark.slow
def test_the_revolutions_are_the_integral_of_c_over_r_squared(diving):
    angle = simpson(lambda t: diving.state(t)[:, 2] / diving.state(t)[:, 0] ** 2, diving)
    assert diving.revolutions == pytest.approx(angle / (2 * math.pi), rel=1e-9)


@pytest.mark.slow
def test_times_may_have_any_shape(leap):
    t = np.linspace(0, 6, 6).reshape(2, 3)
    along = solve_in_elements(LEAP)
    for part in (leap.state, leap.costate, leap.control, along.control, along.switching):
        assert_array_equal(part(t), part(t.ravel()).reshape(2, 3, -1))
    assert along.elements(t).A.shape == (2, 3, 4)
