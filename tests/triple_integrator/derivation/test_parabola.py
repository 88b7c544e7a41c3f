"""The paper's route to the least peak: the parabola, its areas, and the quartic for the level."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import tau, tf
from pontryagin.triple_integrator.derivation.duality import piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c, multipliers
from pontryagin.triple_integrator.derivation.parabola import (
    alpha,
    apex,
    beta,
    half_width,
    level,
    slope,
    t1,
    t2,
)

R = sp.Rational


def shares(low, high):
    """Fractions of the unit time, as SymPy's numbers."""
    return st.fractions(low, high, max_denominator=40).map(lambda x: R(x.numerator, x.denominator))


switching = given(
    early=shares(R(1, 20), R(9, 20)),
    late=shares(R(11, 20), R(19, 20)),
    height=st.sampled_from([-3, -1, 2, 5]),
)
few = settings(max_examples=10, deadline=None)


def bang_bang(early, late, height):
    """Moments of the control height, -height, height, in unit time."""
    return piecewise_moments([(early, height), (late - early, -height), (1 - late, height)])


def test_the_multipliers_put_the_zeros_where_they_are_and_are_normalised():
    """The multipliers (3.5) of the parabola (3.3)."""
    found = dict(zip(multipliers, parabola.multipliers_from_zeros(), strict=True))
    h = parabola.parabola().subs(found)
    assert sp.simplify(h.subs(tau, t1)) == sp.simplify(h.subs(tau, t2)) == 0
    assert sp.simplify(sum(l * m for l, m in zip(parabola.multipliers_from_zeros(), c, strict=True))) == 1


def test_vertex_and_multipliers_are_inverse_to_each_other():
    """(3.8) and (3.9) against (3.10)."""
    there = dict(zip(multipliers, parabola.multipliers_from_vertex(), strict=True))
    for symbol, value in parabola.vertex().items():
        assert sp.simplify(value.subs(tf, T).subs(there) - symbol) == 0


def test_the_zeros_are_zeros():
    """The zeros of (3.8)."""
    for zero in parabola.zeros():
        assert sp.simplify(parabola.vertex_form().subs(tau, zero)) == 0


@switching
@few
def test_the_areas_are_integrals(early, late, height):
    """S1 - S2 + S3, by (3.7) in the form (3.12), is the integral of the modulus."""
    numbers = {alpha: height, apex: (early + late) / 2, half_width: (late - early) / 2, T: 1}
    grid = np.linspace(0, 1, 20_001)
    h = float(height) * (grid - float(early)) * (grid - float(late))
    expected = abs(float(parabola.signed_area().subs(numbers)))
    assert_allclose(expected, np.trapezoid(np.abs(h), grid), rtol=1e-6)


@pytest.mark.slow
@switching
@few
def test_the_optimum_solves_all_four_conditions(early, late, height):
    """(3.15), (3.16) and (3.17) on the curve (3.18), (3.19); (3.13) is (3.11) with the zeros."""
    moments = bang_bang(early, late, height)
    at = {T: 1, slope: -R(1, height), **dict(zip(c, moments, strict=True))}
    curve = {key: value.subs(at) for key, value in parabola.curve().items()}
    assert curve == {apex: (early + late) / 2, half_width: (late - early) / 2}
    curvature = parabola.curvature_on_the_curve().subs(at).subs(curve)
    full = {**at, **curve, alpha: curvature, beta: curvature * curve[half_width] ** 2}
    assert all(condition.subs(full) == 0 for condition in parabola.stationarity())
    assert parabola.normalisation().subs(full) == 1
    assert abs(parabola.signed_area().subs(full)) == R(1, abs(height))


@pytest.mark.slow
@switching
@few
def test_the_level_is_the_root_of_largest_modulus(early, late, height):
    at = {T: 1, **dict(zip(c, bang_bang(early, late, height), strict=True))}
    roots = sp.Poly(parabola.level_polynomial().subs(at), level).real_roots()
    assert height in roots
    assert all(abs(root) <= abs(height) for root in roots)


def test_the_gradient_is_a_gradient():
    """The derivatives of (3.14) by difference quotients."""
    point = {alpha: R(2, 3), apex: R(5, 7), half_width: R(3, 11), T: R(13, 9), parabola.price: R(-1, 4)}
    point |= dict(zip(c, (R(1, 2), R(-2, 3), R(4, 5)), strict=True))
    for symbol, derivative in parabola.gradient().items():
        ahead, behind = ({**point, symbol: point[symbol] + step} for step in (R(1, 10**6), -R(1, 10**6)))
        slope_found = (parabola.lagrangian().subs(ahead) - parabola.lagrangian().subs(behind)) * 500_000
        assert_allclose(float(derivative.subs(point)), float(slope_found), rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("places", [(R(1, 5), R(2, 3)), (-R(1, 2), R(1, 3)), (R(1, 4), R(3, 2)), (-2, -1)])
def test_the_objective_never_falls_below_the_optimum(places):
    """(3.6): its least modulus is rho0 of (3.1) and (3.2)."""
    moments = bang_bang(R(1, 6), R(3, 5), 4)
    assert abs(parabola.objective(places, moments, sp.S.One)) > R(1, 4)
    assert abs(parabola.objective((R(1, 6), R(3, 5)), moments, sp.S.One)) == R(1, 4)
