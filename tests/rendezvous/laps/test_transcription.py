"""The transcribed extremal: Newton's step is the derivative's, and its limit is the exact extremal."""

import math

import numpy as np
import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.hamiltonian import RunningCost, hamiltonian
from pontryagin.rendezvous.laps.start import least_energy_guesses
from pontryagin.rendezvous.laps.transcription import Path, Plane, distance, extremal, refined, transcribed
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.shooting import meet

SCALED = cases()["inclined-30"].problem.scaled
LAP = Lap.of(SCALED, 0)
DURATION = 5.0


def guess(rounds=4, per_lap=48):
    return least_energy_guesses(LAP, np.array([DURATION]), rounds, per_lap).path(0)


COSTS = {
    "unbounded": RunningCost(0.1, 1.0, math.inf),
    "bounded": RunningCost(0.1, 1.0, 0.15),
    "least time": RunningCost(1.0, 0.0, 0.15),
}


@pytest.mark.parametrize("duration", [DURATION, None, "plane"], ids=["fixed", "free", "plane"])
@pytest.mark.parametrize("cost", COSTS.values(), ids=COSTS)
def test_newton_s_step_removes_the_residual_to_first_order(cost, duration):
    path = guess(1)
    if duration == "plane":
        duration = Plane(np.random.default_rng(8).standard_normal(path.unknowns.size) / 10, 0.3)
    here = transcribed(LAP, cost, duration, path)
    share = 1e-6
    there = transcribed(LAP, cost, duration, Path.of(path.unknowns + share * here.step))
    change = (there.residual - here.residual) / share
    assert change == pytest.approx(-here.residual, abs=3e-4 * np.abs(here.residual).max())


def test_guess_satisfies_the_conditions_at_both_ends():
    path = guess()
    assert path.nodes[:6, 0] == pytest.approx(LAP.start, abs=1e-12)
    assert path.nodes[:5, -1] == pytest.approx(LAP.goal, abs=1e-12)
    assert path.nodes[5, -1] == LAP.longitude(DURATION)[0]


def test_guesses_of_a_stack_are_those_of_each_duration():
    durations = np.array([3.0, 5.0, 9.0])
    stack = least_energy_guesses(LAP, durations, per_lap=1)
    for index in range(3):
        single = least_energy_guesses(LAP, durations[index : index + 1], per_lap=1)
        assert stack.path(index).unknowns == pytest.approx(single.path(0).unknowns, rel=1e-9)
        assert stack.energies[index] == pytest.approx(single.energies[0], rel=1e-12)


def test_meeting_behind_the_craft_has_no_guess():
    assert least_energy_guesses(Lap.of(SCALED, -3), np.array([DURATION])).durations.size == 0


def test_distance_is_relative_for_costates():
    path = guess()
    nodes = path.nodes.copy()
    nodes[6:] *= 1.25
    assert distance(path, Path(nodes, path.price, path.span, path.duration)) == pytest.approx(0.2)


def test_a_guess_that_is_too_far_off_is_not_converged():
    path = guess()
    nodes = path.nodes.copy()
    nodes[0] *= 3
    with pytest.raises(NotConverged, match="from a guess"):
        extremal(LAP, COSTS["unbounded"], DURATION, Path(nodes, path.price, path.span, path.duration))


def test_the_regularised_hamiltonian_vanishes_along_the_path():
    cost = COSTS["unbounded"]
    path = extremal(LAP, cost, DURATION, guess())
    values = hamiltonian(cost, path.nodes, path.price).value
    assert np.abs(values).max() < 2e-3 * np.abs(path.nodes[6:]).max()


def test_more_nodes_are_nearer_to_the_exact_extremal():
    setting = Setting(SCALED, 1.0, math.inf, duration=DURATION)
    path = extremal(LAP, COSTS["unbounded"], DURATION, guess())
    errors = []
    for doublings in (0, 1, 2):
        finer = refined(LAP, COSTS["unbounded"], DURATION, path, doublings)
        assert finer.nodes.shape[1] - 1 == 2**doublings * (path.nodes.shape[1] - 1)
        start = reduced_costates(SCALED, LAP.axes, finer.nodes[:, 0])
        errors.append(np.abs(start - meet(setting, start).unknowns).max())
    assert np.array(errors[:-1]) / errors[1:] == pytest.approx([4, 4], rel=0.2)


def test_costates_approach_those_of_the_exact_extremal_quadratically():
    cost = RunningCost(0.0, 1.0, math.inf)
    setting = Setting(SCALED, 1.0, math.inf, duration=DURATION)
    errors = []
    for per_lap in (48, 96, 192):
        path = extremal(LAP, cost, DURATION, guess(per_lap=per_lap))
        start = reduced_costates(SCALED, LAP.axes, path.nodes[:, 0])
        errors.append(np.abs(start - meet(setting, start).unknowns).max())
    ratios = np.array(errors[:-1]) / errors[1:]
    assert ratios == pytest.approx([4, 4], rel=0.2) and errors[0] < 0.01
