"""The terminal law of the solvers is the one that follows from (16) and (17)."""

import math

import pytest
import sympy as sp

from pontryagin.rendezvous.derivation import terminal
from pontryagin.rendezvous.derivation.principle import energy_weight, peak, time_weight
from pontryagin.rendezvous.terminal_law import end_switching

RATIO, PEAK = 0.7, 0.4
LAWS = {
    "unsaturated": (RATIO, 3.0),
    "saturated": (RATIO, PEAK),
    "time-optimal": (math.inf, PEAK),
}


def solved(mode):
    """|n(t_k)| in the mode, from the law that is derived, as a function of alpha1/alpha2 and p_max."""
    weights = {energy_weight: 1} if mode != "time-optimal" else {time_weight: 1}
    law = terminal.law_in_lengths(mode).subs(weights)
    roots = sp.solve(law, terminal.switching_length)
    largest = max(roots, key=lambda root: root.subs({time_weight: 1, peak: 1}))
    return sp.lambdify([time_weight, peak], largest, "numpy")


@pytest.mark.parametrize("mode", LAWS)
def test_length_is_the_derived_one(mode):
    assert end_switching(*LAWS[mode]) == pytest.approx(solved(mode)(*LAWS[mode]), rel=1e-15)
