"""Piecewise Chebyshev series are exact on polynomials for any panels."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from pontryagin.numerics.collocation import (
    Mesh,
    derivative,
    evaluate,
)

MESHES = [Mesh((0.0, 1.0), 6), Mesh((0.0, 0.25, 0.3, 1.0), 6), Mesh((0.0, 1e-4, 0.5, 1.0), 7)]
coefficients = st.lists(st.integers(-5, 5), min_size=1, max_size=7)


@pytest.mark.parametrize("mesh", MESHES)
@given(coefficients)
def test_polynomials_are_integrated_evaluated_and_differentiated_exactly(mesh, c):
    p = Polynomial(c)
    values = p(mesh.points)
    primitive = p.integ()
    np.testing.assert_allclose(mesh.integrals @ values, primitive(mesh.points) - primitive(0), atol=3e-15)
    s = np.array([0.0, 0.013, 0.25, 0.27, 0.5, 0.9, 1.0])
    edges, series = np.array(mesh.edges), mesh.series(values[:, None])
    np.testing.assert_allclose(evaluate(edges, series, s)[:, 0], p(s), atol=1e-13)
    inside = s[[1, 3, 5]]
    np.testing.assert_allclose(derivative(edges, series, inside)[:, 0], p.deriv()(inside), atol=1e-11)


def test_halving_panels_keeps_points_of_the_others():
    mesh = MESHES[1].bisected(np.array([False, False, True]))
    assert mesh.edges == pytest.approx((0.0, 0.25, 0.3, 0.65, 1.0))
    assert set(MESHES[1].points[:12]) <= set(mesh.points)


def test_members_of_a_stack_may_have_different_panels():
    coarse, fine = MESHES[0], MESHES[1]
    series = np.zeros((2, 3, 7, 1))
    edges = np.ones((2, 4))
    for i, mesh in enumerate((coarse, fine)):
        series[i, : mesh.panels] = mesh.series((mesh.points**5)[:, None])
        edges[i, : mesh.panels + 1] = mesh.edges
    s = np.linspace(0, 1, 11)
    np.testing.assert_allclose(evaluate(edges, series, s)[..., 0], np.broadcast_to(s**5, (2, 11)), atol=1e-14)
