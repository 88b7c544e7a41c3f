"""The transcribed extremal: Newton's step is the derivative's, and its limit is the exact extremal."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.hamiltonian import RunningCost, hamiltonian
from pontryagin.rendezvous.laps.start import least_energy_guess
from pontryagin.rendezvous.laps.transcription import Path, extremal, transcribed
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.shooting import meet

SCALED = cases()["inclined-30"].problem.scaled
LAP = Lap.of(SCALED, 0)
DURATION = 5.0
COSTS = {
    "unbounded": RunningCost(0.1, 1.0, math.inf),
    "bounded": RunningCost(0.1, 1.0, 0.15),
    "least time": RunningCost(1.0, 0.0, 0.15),
}


@pytest.mark.parametrize("duration", [DURATION, None], ids=["fixed", "free"])
@pytest.mark.parametrize("cost", COSTS.values(), ids=COSTS)
def test_newton_s_step_removes_the_residual_to_first_order(cost, duration):
    guess = least_energy_guess(LAP, DURATION, 1)
    here = transcribed(LAP, cost, duration, guess)
    share = 1e-6
    there = transcribed(LAP, cost, duration, Path.of(guess.unknowns + share * here.step))
    change = (there.residual - here.residual) / share
    assert change == pytest.approx(-here.residual, abs=3e-4 * np.abs(here.residual).max())


def test_guess_satisfies_the_conditions_at_both_ends():
    guess = least_energy_guess(LAP, DURATION, 3)
    assert guess.nodes[:6, 0] == pytest.approx(LAP.start, abs=1e-12)
    assert guess.nodes[:5, -1] == pytest.approx(LAP.goal, abs=1e-12)
    assert guess.nodes[5, -1] == LAP.longitude(DURATION)[0]


def test_meeting_behind_the_craft_has_no_guess():
    assert least_energy_guess(Lap.of(SCALED, -3), DURATION) is None


def test_the_regularised_hamiltonian_vanishes_along_the_path():
    cost = COSTS["unbounded"]
    path = extremal(LAP, cost, DURATION, least_energy_guess(LAP, DURATION))
    values = hamiltonian(cost, path.nodes, path.price).value
    assert np.abs(values).max() < 2e-3 * np.abs(path.nodes[6:]).max()


def test_costates_approach_those_of_the_exact_extremal_quadratically():
    cost = RunningCost(0.0, 1.0, math.inf)
    setting = Setting(SCALED, 1.0, math.inf, duration=DURATION)
    errors = []
    for per_lap in (48, 96, 192):
        path = extremal(LAP, cost, DURATION, least_energy_guess(LAP, DURATION, per_lap=per_lap))
        start = reduced_costates(SCALED, path.nodes[:, 0])
        errors.append(np.abs(start - meet(setting, start).unknowns).max())
    ratios = np.array(errors[:-1]) / errors[1:]
    assert ratios == pytest.approx([4, 4], rel=0.2) and errors[0] < 0.01
