"""The primer vector obeys its equation of the second order."""

import pytest
import sympy as sp

from pontryagin.rendezvous.derivation import (
    model,
    primer,
    principle,
    reduction,
)


@pytest.mark.slow
def test_the_second_derivative_of_n_is_the_gravity_gradient_times_n():
    n = principle.switching()
    assert (primer.second_rate() - primer.gravity_gradient() * n).applyfunc(sp.simplify).is_zero_matrix
    assert sp.simplify(primer.hamiltonian() - reduction.hamiltonian()) == 0
    assert primer.turning_invariant(-primer.carried(), n) == principle.nu
    costates = primer.costates(-primer.carried(), n)
    assert all(sp.simplify(value - symbol) == 0 for symbol, value in costates.items())
    assert len(costates) == 6


def test_at_a_thrust_not_along_n_the_derivative_of_n_has_an_additional_term():
    n = principle.switching()
    rate = primer.rate_at_any_thrust(n)
    r, c = model.r, model.c
    torque = n.cross(model.thrust)
    extra = (rate - primer.carried()).applyfunc(sp.simplify)
    assert (extra - sp.Matrix([0, 0, r * torque[0] / c])).applyfunc(sp.simplify).is_zero_matrix
