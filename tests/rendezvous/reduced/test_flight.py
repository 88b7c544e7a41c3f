"""Single flights: both integrators, both charts, the mode of every arc."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous.reduced.flight import (
    fly,
    switching,
)
from rendezvous_problems import in_units, problem, starts

COSTATES = np.array([0.01, 0.02, 0.05, 0.01, 0.02, 0.03])


@pytest.mark.parametrize("peak", [math.inf, 0.03])
def test_both_integrators_give_the_same_flight(peak):
    taylor, classic = (fly(problem(20).scaled, COSTATES, 8.0, peak, taylor=use) for use in (True, False))
    assert len(taylor.pieces) == len(classic.pieces) == (1 if peak == math.inf else 2)
    assert np.allclose(taylor.switch_times, classic.switch_times, atol=1e-11)
    assert np.allclose(taylor.end, classic.end, atol=1e-10)
    assert np.allclose(taylor.slopes, classic.slopes, atol=1e-8)
    grid = np.linspace(0, 8, 33)
    assert np.allclose(taylor.sample(grid), classic.sample(grid), atol=1e-10)


def test_both_charts_give_the_same_attitude():
    scaled = problem(20).scaled
    above, below = (fly(scaled, COSTATES, 5.0, chart=chart) for chart in (1, -1))
    first, second = above.attitude(above.end), below.attitude(below.end)
    assert np.allclose(first, np.sign(first @ second) * second, atol=1e-12)


def test_the_mode_of_every_arc_is_that_of_the_switching_function():
    """n is that of (9). This holds also for arcs that begin exactly at |n| = 2 alpha2 p_max."""
    given = in_units(peak=0.06)
    for costates in 2 * starts(12) / given.scaled.costate_units:
        alone = fly(given.scaled, costates, given.scaled.duration, given.scaled.peak)
        states = alone.sample(np.linspace(0, alone.duration, 400))
        begins = np.array([piece.begin for piece in alone.pieces])
        which = np.searchsorted(begins, np.linspace(0, alone.duration, 400), side="right") - 1
        on_bound = np.array([piece.mode == "saturated" for piece in alone.pieces])[which]
        excess = np.linalg.norm(switching(states), axis=1) / (2 * alone.peak) - 1
        assert (np.where(on_bound, excess, -excess) > -1e-9).all()
