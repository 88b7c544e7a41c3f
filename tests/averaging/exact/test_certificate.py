"""The certificate of an exact extremal measures each fault that is put into it.

The extremal of the smooth example from 1 to 2 without ripple is known: v' = epsilon u with u = 1, a costate
of 2, a running cost of 2 at each moment, a slow time of 1. With a ripple it is not.
"""

from dataclasses import replace

import numpy as np
import pytest

from pontryagin.averaging import smooth_example

FAULT = 1e-6


@pytest.fixture(scope="module")
def known():
    return smooth_example(1.0, 2.0).exact(0.1)[0].certify


@pytest.fixture(scope="module")
def rippled():
    return smooth_example(1.0, 2.0, ripple=0.5).exact(0.1)[0].certify


def residuals(certify, **factors):
    """The residuals after some parts of the shot are multiplied by factors."""
    problem, shot = certify.args
    wrong = {name: getattr(shot, name) * factor for name, factor in factors.items()}
    found = certify.func(problem, replace(shot, **wrong))
    return [
        float(value) for value in (found.boundary, found.transversality, found.hamiltonian, found.maximality)
    ]


def test_an_extremal_without_fault_has_none(known, rippled):
    assert max(residuals(known)) < 1e-12
    assert max(residuals(rippled)) < 1e-10


def test_another_cost_is_its_share(known):
    boundary, *others = residuals(known, cost=1 + FAULT)
    assert boundary == pytest.approx(FAULT, rel=1e-3) and max(others) < 1e-12


def test_another_duration_misses_target_and_cost(known):
    """v ends at 2 + FAULT, at a cost of 2 (1 + FAULT); the target is measured in units of 2."""
    boundary, *others = residuals(known, duration=1 + FAULT)
    assert boundary == pytest.approx(FAULT, rel=1e-3) and max(others) < 1e-12


def test_another_costate_misses_the_target_and_another_multiplier_the_costate(known):
    """With p = 2 (1 + d) at the start, h0 = p^2/4 - 1 = 2 d there, so that p_x/epsilon = -2 d and p' = 2 d.

    Hence u = p / 2 = 1 + d (1 + tau), J = 2 + 3 d, and p = 2 + 4 d at the end; the unit of both is 2.
    """
    boundary, transversality, *others = residuals(known, unknowns=np.array([[1 + FAULT, 1.0]]))
    assert boundary == pytest.approx(1.5 * FAULT, rel=1e-3)
    assert transversality == pytest.approx(2 * FAULT, rel=1e-3) and max(others) < 1e-11
    boundary, transversality, *others = residuals(known, unknowns=np.array([[1.0, 1 + FAULT]]))
    assert boundary < 1e-12 and transversality == pytest.approx(FAULT, rel=1e-2)


def test_an_extremal_that_does_not_arrive_with_the_phase_at_rest_is_refused(rippled):
    """p_x is not zero at the end of an extremal that stops earlier, where the phase matters."""
    _, transversality, hamiltonian, maximality = residuals(rippled, duration=0.9)
    assert transversality > 1e-3 and max(hamiltonian, maximality) < 1e-9


def test_the_hamiltonian_is_measured_in_units_of_the_running_cost(monkeypatch):
    """A price of 4 gives u = 2 for a time of 1/2: a cost of 4, that is of 8 in a unit of time."""
    known = smooth_example(1.0, 2.0, k=4.0).exact(0.1)[0].certify
    place = "pontryagin.averaging.exact.certificate._along"
    monkeypatch.setattr(place, lambda equations: lambda *given: (np.array([0.5, -2.0]), np.array([4.0, 1.0])))
    _, _, hamiltonian, maximality = residuals(known)
    assert (hamiltonian, maximality) == (pytest.approx(2 / 8), pytest.approx(4 / 8))
