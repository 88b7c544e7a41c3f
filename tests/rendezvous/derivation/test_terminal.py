"""The law for the thrust at the end, and the slope of the cost over the duration."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.optimize import root

from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import flow
from pontryagin.rendezvous.derivation import (
    forms,
    model,
    principle,
    terminal,
    transversality,
    variation,
)
from rendezvous_derived import TARGET, TARGET_SYMBOLS


@pytest.mark.slow
def test_16_and_17_give_the_law_for_the_thrust_at_the_end():
    at_end = terminal.law().subs(transversality.end_values())
    assert sp.simplify(terminal.hamiltonian_at_a_meeting() - at_end) == 0
    assert terminal.end_thrust() == sp.sqrt(principle.time_weight) / sp.sqrt(principle.energy_weight)
    scale = principle.time_weight + principle.energy_weight * principle.peak**2
    assert sp.expand(terminal.scale_of_saturated() - scale) == 0


@pytest.mark.parametrize("mode", principle.MODES)
def test_the_slope_of_the_cost_over_the_duration_vanishes_with_the_law_at_the_end(mode):
    assert sp.expand(terminal.cost_slope(mode) + terminal.law_in_lengths(mode)) == 0
    assert variation.energy_rate(mode) == 0


def test_the_derived_slope_of_the_cost_agrees_with_differences_of_optimal_costs():
    form = forms.with_attitude("unsaturated")
    integrate = flow(form.states, form.rates, form.parameters)
    ends = compiler.function("ends", [*form.states, *TARGET_SYMBOLS], {"ends": model.boundary()})

    def end_of(unknowns, times):
        rho, s1, e, nu3 = unknowns
        return integrate([1, 0, 1, 0.6, rho, s1, e, 0, 0, nu3, 1, 0, 0, 0], times, [*TARGET, 1.0])

    def residual(unknowns, duration):
        y = end_of(unknowns, [0.0, duration])[-1]
        return [*ends(*y, *TARGET)[0].ravel(), np.sin(np.arctan2(y[13], y[10]) - y[3] / 2)]

    def cost_and_length(duration):
        found = root(residual, np.zeros(4), args=(duration,), tol=1e-13)
        assert np.abs(found.fun).max() < 1e-12
        nodes, weights = np.polynomial.legendre.leggauss(40)
        times = np.concatenate([[0.0], (nodes + 1) * duration / 2, [duration]])
        y = end_of(found.x, times)
        square = (y[:, 5] ** 2 + (y[:, 6] * y[:, 0]) ** 2) / 4
        return duration / 2 * weights @ square[1:-1], 2 * np.sqrt(square[-1])

    h = 1e-3
    (before, _), (_, length), (after, _) = (cost_and_length(5 + k * h) for k in (-1, 0, 1))
    slope = terminal.cost_slope("unsaturated").subs(
        {terminal.switching_length: length, principle.time_weight: 0, principle.energy_weight: 1}
    )
    assert_allclose((after - before) / (2 * h), float(slope), rtol=1e-5)
