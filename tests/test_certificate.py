"""A certificate holds when residual and gap are small, and never otherwise."""

import numpy as np
import pytest

from pontryagin.certificate import ACCEPTED, Certificate, MaximumPrinciple


def certificate(residual, primal, dual):
    return Certificate(np.array(residual), np.array(primal), np.array(dual))


def test_the_gap_is_relative_to_the_larger_of_both_values():
    gap = certificate([0.0] * 4, [200.0, 0.5, -200.0, 3e-150], [100.0, 1.0, -250.0, 0.0]).gap
    assert gap.tolist() == [0.5, 0.5, 0.2, 1.0]


@pytest.mark.parametrize("unit", [1e-300, 1e-12, 1.0, 1e300])
def test_it_means_the_same_in_every_unit(unit):
    assert certificate(0.0, 1.0 * unit, (1 - 1e-9) * unit).holds()
    assert not certificate(0.0, 1.0 * unit, (1 - 1e-7) * unit).holds()


def test_a_small_value_does_not_hold_against_a_bound_of_zero():
    assert not certificate(0.0, 1e-11, 0.0).holds(0.5)
    assert certificate(0.0, 0.0, 0.0).holds(0.0)


def test_it_holds_for_nothing_that_is_not_small():
    assert certificate(ACCEPTED, 1.0, 1.0).holds()
    more = 10 * ACCEPTED
    assert not certificate(more, 1.0, 1.0).holds()
    assert not certificate(-more, 1.0, 1.0).holds()
    assert not certificate(0.0, 1.0, 1.0 - more).holds()
    assert not certificate(0.0, 1.0, 1.0 + more).holds(), "a bound above the value is as wrong as a low one"


@pytest.mark.parametrize("place", range(3))
def test_nan_never_holds(place):
    values = [0.0, 1.0, 1.0]
    values[place] = np.nan
    assert not certificate(*values).holds(tol=np.inf)


def test_one_bad_problem_spoils_the_stack():
    assert certificate([0.0, 0.0], [1.0, 2.0], [1.0, 2.0]).holds()
    assert not certificate([0.0, 1e-3], [1.0, 2.0], [1.0, 2.0]).holds()


def test_the_tolerance_is_the_largest_value_allowed():
    assert certificate(0.25, 1.0, 0.75).holds(0.25)
    assert not certificate(0.25, 1.0, 0.75).holds(0.24)


def test_a_stack_of_none_holds():
    assert certificate(np.empty(0), np.empty(0), np.empty(0)).holds()


def test_nothing_in_it_can_be_replaced():
    with pytest.raises(AttributeError):
        certificate(0.0, 1.0, 1.0).dual_value = np.array(2.0)


@pytest.mark.parametrize("place", range(4))
def test_a_maximum_principle_holds_as_well_as_its_worst_residual(place):
    values = [np.zeros(2) for _ in range(4)]
    values[place] = np.array([1e-12, 3e-9])
    extremals = MaximumPrinciple(*values)
    assert extremals.residual.tolist() == [1e-12, 3e-9]
    assert extremals.holds(1e-8) and not extremals.holds(1e-9)
    values[place] = np.array([0.0, np.nan])
    assert not MaximumPrinciple(*values).holds(np.inf)
