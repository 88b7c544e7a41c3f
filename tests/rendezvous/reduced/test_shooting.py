"""Meetings of fixed durations form a family along which the cost has a known slope."""

import math
from dataclasses import replace

import pytest

from pontryagin.rendezvous import (
    solve,
)
from pontryagin.rendezvous.families import stretched
from pontryagin.rendezvous.reduced.conditions import Setting, end_thrust
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import SHOOTING, meet
from pontryagin.rendezvous.reduced.start import cold_start
from rendezvous_problems import LEAP, problem


def test_the_slope_of_the_cost_over_the_duration_is_minus_the_square_of_the_end_thrust():
    """dJ/dt_k = alpha1 - alpha2 p(t_k)^2 along the family of extremals of fixed duration."""
    setting, h = Setting(problem(20).scaled, 1.0, math.inf, duration=3.0), 1e-4
    here = cold_start(setting)
    later, sooner = (energy(meet(setting.replace(duration=3.0 + x), here.unknowns).flight) for x in (h, -h))
    assert (later - sooner) / (2 * h) == pytest.approx(-(end_thrust(here.flight) ** 2), rel=1e-6)


@pytest.mark.slow
def test_a_solution_of_a_shorter_duration_is_continued_to_the_longer_one(leap):
    scaled = LEAP.scaled
    setting = Setting(scaled, scaled.ratio, math.inf, duration=scaled.duration)
    short = solve(replace(LEAP, duration=3.0))
    root = stretched(SHOOTING, setting, short.root)
    assert root.flight.duration == scaled.duration and root.residual < 1e-13
