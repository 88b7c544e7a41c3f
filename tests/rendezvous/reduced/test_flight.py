"""Single flights: SciPy's integrator, both charts, the mode of every arc."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from pontryagin.rendezvous.reduced.arcs import equations
from pontryagin.rendezvous.reduced.flight import (
    fly,
    switching,
)
from rendezvous_problems import in_units, problem, starts

COSTATES = np.array([0.01, 0.02, 0.05, 0.01, 0.02, 0.03])


@pytest.mark.parametrize("peak", [math.inf, 0.03])
def test_every_arc_is_that_of_scipys_integrator(peak):
    flight = fly(problem(20).scaled, COSTATES, 8.0, peak)
    assert len(flight.pieces) == (1 if peak == math.inf else 2)
    lasts = [*(piece.whole for piece in flight.pieces[1:]), np.append(flight.end, flight.slopes)]
    for piece, end, last in zip(flight.pieces, [*flight.switch_times, 8.0], lasts, strict=True):
        system = equations(piece.mode, False)

        def rates(_, whole, system=system):
            table = system.variational(
                0.0, whole[:12], whole[12:].reshape(12, 7), (flight.scaled.eccentricity, flight.chart)
            )
            return np.append(table[:, 0], table[:, 1:])

        found = solve_ivp(rates, (piece.begin, end), piece.whole, "DOP853", rtol=1e-13, atol=1e-14)
        assert np.allclose(found.y[:12, -1], last[:12], atol=1e-11)
        assert np.allclose(found.y[12:, -1], last[12:], atol=1e-9)


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
