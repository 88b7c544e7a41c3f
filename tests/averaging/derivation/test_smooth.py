"""The smooth example is a minimum in kappa."""

import numpy as np
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.averaging.claims import smooth as smooth_claims
from pontryagin.averaging.derivation import smooth

SMOOTH = (smooth.gap, smooth.k, smooth.v1, smooth.kappa)


COST = sp.lambdify([*SMOOTH, smooth.T], smooth.cost())


PRINTED_COST = sp.lambdify([*SMOOTH, smooth.T], smooth_claims.COST)


CONDITION = sp.lambdify(
    SMOOTH, sp.Poly(sp.expand(smooth.transversality() * smooth.T**2), smooth.T).all_coeffs()
)


@given(st.floats(0.2, 3), st.floats(0.2, 3), st.floats(0.1, 4), st.integers(-9, 9))
def test_the_smooth_example_is_a_minimum_in_kappa(start, end, price, shift):
    """J0 is least, (2.9), among the roots of the condition (2.12), as (2.15) says near kappa = 0."""
    if abs(start - end) < 0.05:
        return
    gap, kappa = start - end, shift / 40
    least = 2 * np.sqrt(price) * abs(gap)
    assert_allclose(COST(gap, price, end, 0.0, abs(gap) / np.sqrt(price)), least, rtol=1e-12)
    for root in np.roots(CONDITION(gap, price, end, kappa)):
        if abs(root.imag) < 1e-9 * abs(root) and root.real > 0:
            at = gap, price, end, kappa, root.real
            assert COST(*at) >= least * (1 - 1e-9)
            assert_allclose(PRINTED_COST(*at), COST(*at), rtol=1e-5)
