"""Systems that are rational along their costate, and the lens that is no ellipsoid."""

import numpy as np
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.orbit_correction import DiscreteSystem, gauge
from pontryagin.orbit_correction.derivation.exact import (
    LENS_CENTRES,
    LENS_CORNER,
    exact_system,
    lens_level,
    normal_at_lens_corner,
)


@given(st.integers(2, 6), st.integers(1, 3), st.integers(0, 1000))
def test_exact_systems_are_rational_along_their_costate(n, steps, seed):
    system = exact_system(n, steps, seed)
    state, controls = system.boundary_state(), system.controls()
    assert all(part.is_Rational for vector in (state, *controls) for part in vector)
    assert system.fly(state, controls)[-1].is_zero_matrix
    A = np.array([matrix.tolist() for matrix in system.A], dtype=float)
    shapes = np.array([U.shape.tolist() for U in system.U], dtype=float)
    found = gauge(DiscreteSystem(A, shapes), np.array(state.tolist(), dtype=float).ravel(), steps)
    assert_allclose(found.alpha, 1, rtol=1e-9)


@given(st.floats(0, 2 * np.pi), st.floats(0, 1))
def test_the_lens_and_the_cone_at_its_corner(angle, share):
    p = sp.Matrix([np.cos(angle), np.sin(angle)])
    if normal_at_lens_corner(p):
        best = LENS_CORNER
    elif normal_at_lens_corner(-p):
        best = -LENS_CORNER
    else:
        best = next(centre + p for centre in LENS_CENTRES if lens_level(centre + p) <= 1 + 1e-12)
        assert p.dot(best) > p.dot(LENS_CORNER) - 1e-12
    assert lens_level(best) <= 1 + 1e-12
    inside = share * sp.Matrix([np.cos(7 * angle), np.sin(7 * angle)])
    within = [centre + inside for centre in LENS_CENTRES] + [LENS_CORNER, -LENS_CORNER]
    assert all(p.dot(x) <= p.dot(best) + 1e-12 for x in within if lens_level(x) <= 1)
