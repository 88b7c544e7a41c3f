"""The smooth example is a minimum in kappa."""

from functools import cache

import numpy as np
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.averaging.claims import smooth as smooth_claims
from pontryagin.averaging.derivation import smooth

SMOOTH = (smooth.gap, smooth.k, smooth.v1, smooth.kappa)


@cache
def compiled():
    """The derived and the printed cost, and the coefficients of the condition for the duration."""
    condition = sp.Poly(sp.expand(smooth.transversality() * smooth.T**2), smooth.T).all_coeffs()
    costs = (sp.lambdify([*SMOOTH, smooth.T], cost) for cost in (smooth.cost(), smooth_claims.COST))
    return *costs, sp.lambdify(SMOOTH, condition)


@given(st.floats(0.2, 3), st.floats(0.2, 3), st.floats(0.1, 4), st.integers(-9, 9))
def test_the_smooth_example_is_a_minimum_in_kappa(start, end, price, shift):
    """J0 is least, (2.9), among the roots of the condition (2.12), as (2.15) says near kappa = 0."""
    if abs(start - end) < 0.05:
        return
    gap, kappa = start - end, shift / 40
    derived, printed, condition = compiled()
    least = 2 * np.sqrt(price) * abs(gap)
    assert_allclose(derived(gap, price, end, 0.0, abs(gap) / np.sqrt(price)), least, rtol=1e-12)
    for root in np.roots(condition(gap, price, end, kappa)):
        if abs(root.imag) < 1e-9 * abs(root) and root.real > 0:
            at = gap, price, end, kappa, root.real
            assert derived(*at) >= least * (1 - 1e-9)
            assert_allclose(printed(*at), derived(*at), rtol=1e-5)
