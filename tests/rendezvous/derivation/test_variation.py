"""The first variation of the cost."""

import pytest
import sympy as sp

from pontryagin.rendezvous.derivation import (
    model,
    principle,
    variation,
)


@pytest.mark.slow
def test_the_first_variation_consists_of_a_term_at_the_end_and_one_of_the_thrust():
    thrust_slopes = [variation.FAMILY[p].diff(variation.s) for p in model.thrust]
    rest = variation.rest_of_the_variation() + variation.gradient_by_thrust().dot(thrust_slopes)
    assert sp.expand(rest) == 0
    end = variation.of_a_meeting()
    assert sp.expand(end.coeff(variation.delay) + principle.in_nu(principle.hamiltonian())) == 0
