"""Meetings of fixed durations form a family along which the cost has a known slope."""

import math

import pytest

from pontryagin.rendezvous import (
    solve,
)
from pontryagin.rendezvous.reduced.conditions import Setting, end_thrust
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import meet
from rendezvous_problems import problem


def test_the_slope_of_the_cost_over_the_duration_is_minus_the_square_of_the_end_thrust():
    """dJ/dt_k = alpha1 - alpha2 p(t_k)^2 along the family of extremals of fixed duration."""
    here, h = solve(problem(20, duration=3.0)), 1e-4
    start, duration = here.root.unknowns, here.flight.duration
    later, sooner = (
        energy(meet(Setting(here.problem.scaled, 1.0, math.inf, duration=duration + x), start).flight)
        for x in (h, -h)
    )
    assert (later - sooner) / (2 * h) == pytest.approx(-(end_thrust(here.flight) ** 2), rel=1e-6)
