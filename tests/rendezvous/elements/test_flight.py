"""Flights in the elements: both integrators, the mode of every arc, no burn missed."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pontryagin
from pontryagin.rendezvous.elements.flight import (
    fly_elements,
    switching,
)
from pontryagin.rendezvous.elements.law import Law
from rendezvous_problems import BOUNDED, problem

COSTATES = np.array([1.5, -0.7, 2.2, -1.3, -2.1, -1.8])


def test_both_integrators_give_the_same_flight():
    law = Law("fuel", 0.0, 0.3)
    taylor, classic = (fly_elements(problem(20).scaled, COSTATES, 1.9, law, use) for use in (True, False))
    assert len(taylor.pieces) == len(classic.pieces) > 1
    assert np.allclose(taylor.switch_angles, classic.switch_angles, atol=1e-10)
    assert np.allclose(taylor.end, classic.end, atol=1e-9)
    assert np.allclose(taylor.slopes, classic.slopes, rtol=1e-7, atol=1e-7)


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
