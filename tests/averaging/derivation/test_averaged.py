"""The averaged system: its integrals, and the order of what it leaves out."""

import pytest
import sympy as sp

from pontryagin.averaging.derivation import averaged, optimum


@pytest.mark.slow
def test_the_averaged_system_keeps_its_integral_and_its_hamiltonian():
    """The integral (2.10) along (2.3), H0 along (2.11)."""
    assert averaged.homogeneity() == 0
    assert set(averaged.mean_and_derivative_commute()) == {0}
    assert averaged.along(averaged.integral(), averaged.standard_rates()) == 0
    assert averaged.along(averaged.averaged_hamiltonian(), averaged.rates()) == 0
    assert averaged.along(averaged.integral(), averaged.rates()) != 0
    forward, backward = averaged.standard_rates()
    flipped = sp.Matrix([-2 * averaged.h0.diff(x) for x in averaged.xi]) - backward
    assert averaged.along(averaged.integral(), (forward, flipped)) != 0


def test_the_main_result_and_what_follows_from_it():
    """(2.14), (2.15) and (2.16)."""
    assert optimum.lagrange_identity() == 0
    assert optimum.cost_by_the_end() == 0
    slope = averaged.kappa * optimum.Psi.diff(averaged.kappa)
    assert optimum.cost_slope() == slope
    assert optimum.second_derivative() == optimum.Psi.diff(averaged.kappa).subs(averaged.kappa, 0)
    assert sp.simplify(optimum.cost_difference().diff(averaged.kappa) - slope) == 0


def test_orders_fall_by_three():
    n = sp.Symbol("n")
    sizes = list(averaged.order(n).values())
    assert sizes[0] - sizes[-1] == 3
    assert averaged.cyclic_costate() == 0
