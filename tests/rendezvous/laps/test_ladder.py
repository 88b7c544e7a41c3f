"""Transfers of free duration on a lap satisfy the terminal law, and no known extremal is missed."""

import math
from functools import partial

import numpy as np
import pytest

from pontryagin.rendezvous.laps import ladder as ladder_module
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.families import least_energy
from pontryagin.rendezvous.laps.hamiltonian import RunningCost, square
from pontryagin.rendezvous.laps.ladder import Ladder, duration_of_thrust, energy, guesses_on, minima
from pontryagin.rendezvous.laps.transcription import switching
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.shooting import meet

SCALED = cases()["mixed"].problem.scaled
PEAK = cases()["mixed-bounded"].problem.scaled.peak
EXTREMALS = {0: [3.954787], 1: [6.985022, 8.175853, 9.153051]}
"""Durations of the extremals by laps, as Newton's method on exact flights finds them along their families."""


def on_lap(laps, peak):
    lap, cost = Lap.of(SCALED, laps), RunningCost(SCALED.ratio, 1.0, peak)
    seeds = [
        duration for _, duration in minima(guesses_on(lap, math.inf, lambda _: math.inf), SCALED.ratio, peak)
    ]
    ladder = Ladder(lap, cost, partial(least_energy, lap))
    return ladder, ladder.transfers(seeds, [])


def flown(path, peak):
    start = np.append(reduced_costates(SCALED, Lap.of(SCALED, 0).axes, path.nodes[:, 0]), path.duration)
    return meet(Setting(SCALED, SCALED.ratio, peak), start).flight


@pytest.mark.parametrize("laps", EXTREMALS)
def test_every_extremal_of_a_lap_is_found(laps):
    _, paths = on_lap(laps, math.inf)
    found = sorted(flown(path, math.inf).duration for path in paths)
    assert found == pytest.approx(EXTREMALS[laps], abs=1e-6)
    ends = [square(path.nodes[:, -1]) / 4 for path in paths]
    assert ends == pytest.approx([SCALED.ratio] * len(paths), rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("step", [0.05, 0.07])
def test_two_extremals_near_each_other_are_told_apart(step, monkeypatch):
    monkeypatch.setattr(ladder_module, "STEPS", (0.05, step, 0.005))
    ladder, paths = on_lap(2, math.inf)
    costs = [ladder.price(path) for path in paths]
    assert costs == pytest.approx([0.280036, 0.284688, 0.284865], rel=5e-3)


def test_a_transfer_under_a_bound_is_found_along_the_curve_under_the_bound():
    ladder, (path,) = on_lap(0, PEAK)
    assert switching(ladder.ends, path).max() > 2 * PEAK
    assert flown(path, PEAK).duration == pytest.approx(path.duration, rel=0.02)
    assert ladder.price(path) == pytest.approx(0.178142, rel=0.02)


def test_a_curve_that_is_not_begun_is_given_up():
    given_up = []
    lap, cost = Lap.of(SCALED, -3), RunningCost(1.0, 1.0, math.inf)
    assert Ladder(lap, cost, partial(least_energy, lap)).transfers([1.0], given_up) == []
    assert given_up == ["from the duration 1: the meeting is not ahead of the craft (residual inf)"]


def test_minima_are_durations_of_which_the_guess_costs_least():
    lap = Lap.of(SCALED, 1)
    guesses = guesses_on(lap, math.inf, lambda _: math.inf)
    (cost, best), *_ = minima(guesses, SCALED.ratio)
    costs = SCALED.ratio * guesses.durations + guesses.energies
    assert cost == costs.min() and best == guesses.durations[costs.argmin()]
    assert energy(lap, guesses.path(int(costs.argmin()))) == pytest.approx(cost - SCALED.ratio * best)


def test_mean_thrust_of_a_guess_falls_to_the_given_one():
    guesses = guesses_on(Lap.of(SCALED, 1), math.inf, lambda _: math.inf)
    thrust = np.sqrt(guesses.energies / guesses.durations)
    duration = duration_of_thrust(guesses, 0.1)
    assert np.interp(duration, guesses.durations, thrust) == pytest.approx(0.1, rel=2e-2)
    assert duration_of_thrust(guesses, thrust.min() / 2) == math.inf
