"""Flights in the elements: SciPy's integrator, the mode of every arc, no burn missed."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import pontryagin
from pontryagin.rendezvous.elements.arcs import equations
from pontryagin.rendezvous.elements.flight import (
    fly_elements,
    switching,
)
from pontryagin.rendezvous.elements.law import Law
from rendezvous_problems import BOUNDED, problem

COSTATES = np.array([1.5, -0.7, 2.2, -1.3, -2.1, -1.8])


def test_every_arc_is_that_of_scipys_integrator():
    law = Law("fuel", 0.0, 0.3)
    flight = fly_elements(problem(20).scaled, COSTATES, 1.9, law)
    assert len(flight.pieces) > 1
    lasts = [*(piece.whole[:18] for piece in flight.pieces[1:]), flight.end]
    for piece, end, last in zip(flight.pieces, [*flight.switch_angles, flight.phi], lasts, strict=True):
        system, values = equations(piece.mode), law.constants(piece.mode)

        def rates(phi, state, system=system, values=values):
            return system.rates(phi, state, values)

        found = solve_ivp(rates, (piece.begin, end), piece.whole[:18], "DOP853", rtol=1e-13, atol=1e-14)
        assert np.allclose(found.y[:, -1], last, atol=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("law", [Law("fuel", 0.1, 0.1), Law("square", 0.01, 0.3)])
def test_the_mode_of_every_arc_is_that_of_the_switching_function(law):
    random = np.random.default_rng(5)
    level = 1.0 if law.kind == "fuel" else 2 * law.peak
    switches = 0
    for costates in random.normal(size=(40, 6)) * random.choice([0.2, 0.4, 0.8], (40, 1)):
        try:
            flight = fly_elements(BOUNDED.scaled, costates, 4.0, law)
        except pontryagin.NotConverged:
            continue
        ends = [*flight.switch_angles, flight.phi]
        for piece, end in zip(flight.pieces, ends, strict=True):
            inside = np.linspace(piece.begin, end, 202)[1:-1]
            size = np.linalg.norm(switching(flight.sample(inside), inside), axis=1)
            assert np.all((size > level) == (piece.mode == "saturated"))
        switches += len(flight.switch_angles)
    assert switches > 10


@pytest.mark.slow
def test_no_step_of_the_integrator_misses_a_burn_of_a_nearly_discontinuous_thrust():
    law = Law("fuel", 0.0, 0.2, width=0.02)
    random = np.random.default_rng(3)
    compared = 0
    for costates in random.normal(size=(40, 6)) * random.choice([0.2, 0.4, 0.8], (40, 1)):
        try:
            exact, rough = (
                fly_elements(BOUNDED.scaled, costates, 3.0, law, rough=r).end for r in (False, True)
            )
        except pontryagin.NotConverged:
            continue
        assert_allclose(rough, exact, atol=1e-3 * np.abs(exact).max())  # a missed burn: 1 or more
        compared += 1
    assert compared > 20
