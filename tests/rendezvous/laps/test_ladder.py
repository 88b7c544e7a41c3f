"""Transfers of free duration on a lap satisfy the terminal law, and no known extremal is missed."""

import numpy as np
import pytest

from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.ladder import energy, free_transfers, price, promising_durations
from pontryagin.rendezvous.laps.start import least_energy_guess
from pontryagin.rendezvous.laps.transcription import square
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.shooting import meet

SCALED = cases()["mixed"].problem.scaled
EXTREMALS = {0: [3.954787], 1: [6.985022, 8.175853, 9.153051]}
"""Durations of the extremals by laps, as Newton's method on exact flights finds them along their families."""


@pytest.mark.slow
@pytest.mark.parametrize("laps", EXTREMALS)
def test_every_extremal_of_a_lap_is_found(laps):
    setting = Setting(SCALED, SCALED.ratio, np.inf)
    paths = free_transfers(Lap.of(SCALED, laps), SCALED.ratio, worse=2.0)
    found = [
        meet(setting, np.append(reduced_costates(SCALED, path.nodes[:, 0]), path.duration)).flight.duration
        for path in paths
    ]
    assert sorted(found) == pytest.approx(EXTREMALS[laps], abs=1e-6)
    ends = [square(path.nodes[:, -1]) / 4 for path in paths]
    assert ends == pytest.approx([SCALED.ratio] * len(paths), rel=1e-5)


def test_promising_durations_are_minima_of_the_guessed_cost():
    lap = Lap.of(SCALED, 1)
    best = promising_durations(lap, SCALED.ratio)[0]
    costs = [price(least_energy_guess(lap, best * share, 2, 20), SCALED.ratio) for share in (0.9, 1.0, 1.1)]
    assert costs[1] == min(costs) and all(cost > 0 for cost in costs)
    assert energy(least_energy_guess(lap, best, 2, 20)) < costs[1]
