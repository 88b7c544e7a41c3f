"""Families are followed around folds, and what does not converge is not handed out."""

from dataclasses import dataclass

import numpy as np
import pytest

import pontryagin
from pontryagin.rendezvous.elements import shooting as elements_shooting
from pontryagin.rendezvous.elements.conditions import ElementsEquations
from pontryagin.rendezvous.root import Root


@dataclass(frozen=True)
class Level:
    """A setting that holds only the value required of a function of the first unknown."""

    value: float
    rough: bool = False


@pytest.fixture
def bent(monkeypatch):
    """Replace the shooting equations: a given function of the first unknown has a value, the others are 1."""

    def bend(function, slope):
        def equations(setting, unknowns):
            residual = np.append(function(unknowns[0]) - setting.value, unknowns[1:] - 1)
            jacobian = np.diag([slope(unknowns[0]), *np.ones(6)])
            return ElementsEquations(None, residual, jacobian)

        monkeypatch.setattr(elements_shooting, "equations", equations)

    return bend


def lying_at(value, x):
    unknowns = np.append(x, np.ones(6))
    return Root(unknowns, elements_shooting.equations(Level(value), unknowns))


def test_a_family_is_followed_around_its_folds(bent):
    """x^3 - x = value: from -1.5 to 1.5 the curve turns back at -1/sqrt(3) and at 1/sqrt(3)."""
    bent(lambda x: x**3 - x, lambda x: 3 * x**2 - 1)
    root = elements_shooting.lead_round(Level, lying_at(-1.875, -1.5), -1.875, 1.875)
    assert root.unknowns[0] == pytest.approx(1.5, abs=1e-12)


def test_a_family_that_does_not_reach_the_value_is_not_converged(bent):
    bent(lambda x: -(x**2), lambda x: -2 * x)
    with pytest.raises(pontryagin.NotConverged, match="could not be followed"):
        elements_shooting.lead_round(Level, lying_at(-1.0, 1.0), -1.0, 1.0)


def test_a_residual_above_1e_6_is_not_converged_however_large_the_condition_number(bent):
    bent(lambda x: x**2 + 0.5, lambda x: 2 * x)
    with pytest.raises(pontryagin.NotConverged):
        elements_shooting.meet(Level(0.0), np.append(1e-9, np.ones(6)))
