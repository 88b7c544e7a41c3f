"""Cold starts meet the target in every geometry."""

import math

import pytest

from pontryagin.rendezvous.reduced.certificate import certify
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.start import cold_start
from rendezvous_problems import INCLINATIONS, problem


@pytest.mark.parametrize("degrees", INCLINATIONS)
def test_a_cold_start_meets_the_target_in_every_geometry(degrees):
    """The 16 equations check (6); Newton's law and Kepler's equation check the place."""
    setting = Setting(problem(degrees).scaled, 1.0, math.inf, duration=3.0)
    root = cold_start(setting)
    assert certify(root, (0.0, 1.0), free=False).holds(1e-10)


def test_different_numbers_of_revolutions_give_different_extremals():
    setting = Setting(problem(20).scaled, 1.0, math.inf, duration=12.0)
    costs = {turns: energy(cold_start(setting, turns).flight) for turns in (-1, 0, 1)}
    assert len({round(cost, 6) for cost in costs.values()}) == 3
