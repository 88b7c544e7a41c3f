"""Transfers on laps, continued to bounds and to least time, lead Newton's method to exact extremals."""

import math

import numpy as np
import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.families import bounded, least_energy, least_time, priced
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.transcription import square
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import meet


def posed(name):
    scaled = cases()[name].problem.scaled
    return scaled, Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)


@pytest.mark.parametrize(
    ("name", "laps", "cost"),
    [
        ("circle-energy", 0, 0.028495),
        ("circle-energy", 1, 0.364560),
        ("inclined-energy", 0, 0.294185),
        ("inclined-energy", 1, 0.432990),
        ("inclined-energy", 2, 0.613221),
    ],
)
def test_least_energy_on_each_lap_is_an_exact_extremal_s(name, laps, cost):
    scaled, setting = posed(name)
    path = least_energy(Lap.of(scaled, laps), scaled.duration)
    found = meet(setting, reduced_costates(scaled, path.nodes[:, 0]))
    assert energy(found.flight) == pytest.approx(cost, abs=1e-6)


def test_bounded_thrust_is_at_its_bound_in_the_middle():
    scaled, setting = posed("energy-bounded")
    lap, cost = Lap.of(scaled, 0), RunningCost(0.0, 1.0, scaled.peak)
    path = bounded(lap, least_energy(lap, scaled.duration), cost, scaled.duration)
    found = meet(setting, reduced_costates(scaled, path.nodes[:, 0]))
    assert path.switching().max() > 2 * scaled.peak
    assert [piece.mode for piece in found.flight.pieces].count("saturated") > 0


@pytest.mark.slow
@pytest.mark.parametrize(("laps", "duration"), [(0, 2.190545), (1, 5.050061), (2, 6.453185)])
def test_least_time_on_each_lap_leads_to_an_exact_extremal(laps, duration):
    scaled, setting = posed("circle")
    lap, ratio = Lap.of(scaled, laps), (0.7 * scaled.peak) ** 2
    free = priced(lap, least_energy(lap, 1.5 * duration), ratio)
    assert square(free.nodes[:, -1]) / 4 == pytest.approx(ratio, rel=1e-6)
    limited = bounded(lap, free, RunningCost(ratio, 1.0, scaled.peak), None)
    path = least_time(lap, limited, RunningCost(ratio, 1.0, scaled.peak))
    found = meet(setting, np.append(reduced_costates(scaled, path.nodes[:, 0]), path.duration))
    assert found.flight.duration == pytest.approx(duration, abs=1e-6)
    assert path.duration == pytest.approx(duration, rel=3e-3)


def test_a_lap_that_ends_before_the_start_is_refused():
    scaled, _ = posed("circle-energy")
    with pytest.raises(NotConverged, match="ahead of the craft") as error:
        least_energy(Lap.of(scaled, -3), scaled.duration)
    assert error.value.residual == math.inf
