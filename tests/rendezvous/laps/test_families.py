"""Transfers on laps, continued to bounds and to least time, lead Newton's method to exact extremals."""

import math

import numpy as np
import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.families import (
    bounded,
    least_energy,
    least_energy_by_way_of,
    least_time,
    tilted,
)
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.ladder import duration_of_thrust, guesses_on
from pontryagin.rendezvous.laps.ladder import energy as energy_of
from pontryagin.rendezvous.laps.transcription import switching
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
    lap = Lap.of(scaled, laps)
    path = least_energy(lap, scaled.duration)
    found = meet(setting, reduced_costates(scaled, lap.axes, path.nodes[:, 0]))
    assert energy(found.flight) == pytest.approx(cost, abs=1e-6)


def test_bounded_thrust_is_at_its_bound_in_the_middle():
    scaled, setting = posed("energy-bounded")
    lap, cost = Lap.of(scaled, 0), RunningCost(0.0, 1.0, scaled.peak)
    path = bounded(lap, least_energy(lap, scaled.duration), cost, scaled.duration)
    found = meet(setting, reduced_costates(scaled, lap.axes, path.nodes[:, 0]))
    assert switching(lap, path).max() > 2 * scaled.peak
    assert [piece.mode for piece in found.flight.pieces].count("saturated") > 0


LEAST_TIMES = [
    ("circle", 0, 2.190545),
    ("circle", 1, 5.050061),
    ("ellipse", 0, 3.277713),
    ("ellipse", 2, 6.385067),
    ("inclined-60", 2, 9.156920),
    ("glonass", 0, 5.506520),
]


@pytest.mark.parametrize(("name", "laps", "duration"), LEAST_TIMES)
def test_least_time_on_each_lap_leads_to_an_exact_extremal(name, laps, duration):
    scaled, setting = posed(name)
    lap = Lap.of(scaled, laps)
    start = duration_of_thrust(guesses_on(lap, math.inf, lambda _: math.inf), 0.9 * scaled.peak)
    path = least_time(lap, least_energy(lap, start), scaled.peak)
    found = meet(setting, np.append(reduced_costates(scaled, lap.axes, path.nodes[:, 0]), path.duration))
    assert found.flight.duration == pytest.approx(duration, abs=1e-6)
    assert path.duration == pytest.approx(duration, rel=0.02)
    assert scaled.peak * switching(lap, path)[-1] == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize(("name", "laps", "duration"), LEAST_TIMES)
def test_the_energy_at_the_least_time_is_at_most_that_of_full_thrust(name, laps, duration):
    """So that the duration at which the least energy is that of full thrust is a lower bound."""
    scaled, _ = posed(name)
    lap = Lap.of(scaled, laps)
    assert energy_of(lap, least_energy(lap, duration)) < scaled.peak**2 * duration
    assert duration_of_thrust(guesses_on(lap, math.inf, lambda _: math.inf), scaled.peak) < duration


def test_a_lap_that_ends_before_the_start_is_refused():
    scaled, _ = posed("circle-energy")
    with pytest.raises(NotConverged, match="ahead of the craft") as error:
        least_energy(Lap.of(scaled, -3), scaled.duration)
    assert error.value.residual == math.inf


@pytest.mark.parametrize("share", [0.2, 0.7, 1.0])
def test_a_tilted_lap_has_a_share_of_the_angle_and_the_same_ellipses(share):
    scaled, _ = posed("inclined-60")
    lap = Lap.of(scaled, 1)
    assert lap.inclination == pytest.approx(math.radians(60), rel=1e-12)
    lower = tilted(lap, share)
    assert lower.inclination == pytest.approx(share * lap.inclination, rel=1e-12)
    assert lower.start[[0, 1, 2, 5]].tolist() == lap.start[[0, 1, 2, 5]].tolist()
    assert lower.goal[:3].tolist() == lap.goal[:3].tolist()


def test_another_family_of_a_duration_is_reached_from_a_shorter_one():
    half = math.radians(30)
    target = Orbit(1.2, 0.05, [math.cos(half), math.sin(half), 0, 0], 0.5)
    craft = Chaser(1, 0, 1, [1, 0, 0, 0])
    leap = Rendezvous(craft, target, time_weight=0, energy_weight=1, peak=math.inf, duration=10)
    lap, duration = Lap.of(leap.scaled, 0), leap.scaled.duration
    setting = Setting(leap.scaled, leap.scaled.ratio, math.inf, duration=duration)
    paths = least_energy(lap, duration), least_energy_by_way_of(lap, duration, duration / 2)
    starts = [reduced_costates(leap.scaled, lap.axes, path.nodes[:, 0]) for path in paths]
    flights = [meet(setting, start).flight for start in starts]
    assert [energy(flight) for flight in flights] == pytest.approx([0.30228, 0.26445], abs=1e-5)
