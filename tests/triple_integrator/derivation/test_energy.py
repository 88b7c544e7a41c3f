"""The derivation of the least-energy programme."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import quad_vec

from pontryagin.triple_integrator.derivation import energy
from pontryagin.triple_integrator.derivation.channel import drive, tau
from pontryagin.triple_integrator.derivation.model import T, c, moments_of, multipliers, s


def test_the_programme_has_the_required_moments():
    """(2.2) and (2.3) satisfy the moment equalities (1.9)."""
    assert moments_of(energy.minimum_energy_control()).applyfunc(sp.simplify) == c


def test_the_programme_takes_the_channel_from_rest_to_c():
    """(2.3), flown by (0.6)."""
    end = drive(sp.zeros(3, 1), T, energy.minimum_energy_control().subs(s, T - tau))
    assert end.applyfunc(sp.simplify) == c


def test_the_gramian_is_an_integral_and_obeys_lyapunovs_equation():
    """(2.1) by quadrature."""
    numbers = np.array(energy.gramian().subs(T, 1.7), dtype=float)

    def integrand(x):
        h = np.array([x * x / 2, x, 1.0])
        return np.outer(h, h)

    assert_allclose(numbers, quad_vec(integrand, 0, 1.7)[0], rtol=1e-12)
    assert energy.lyapunov_residual(energy.gramian()) == sp.zeros(3)
    assert energy.lyapunov_residual(energy.gramian() * 2) != sp.zeros(3)


def test_the_multipliers_are_stationary_and_normalised():
    """The multipliers of (2.1), with l'c = 1, (1.16)."""
    price, least = energy.stationary()
    assert (2 * energy.gramian() * least + price * c).applyfunc(sp.simplify) == sp.zeros(3, 1)
    assert sp.simplify((least.T * c)[0]) == 1


@pytest.mark.parametrize("moments", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (2, -3, 5)])
def test_norm_and_dual_norm_are_inverse(moments):
    """(1.13) and (1.14): the least norm is 1/rho_0."""
    at = {T: 2, **dict(zip(c, moments, strict=True))}
    square = sp.integrate(sp.expand(energy.minimum_energy_control().subs(at) ** 2), (s, 0, 2))
    assert sp.simplify(energy.dual_norm().subs(at) ** 2 * square) == 1


@pytest.mark.parametrize("other", [(1, 0, 0), (0, 1, 0), (1, -1, 1), (3, -2, sp.Rational(1, 3))])
def test_no_other_multipliers_bound_more(other):
    at = {T: 1, **dict(zip(c, (2, -3, 5), strict=True))}
    square = sp.integrate(sp.expand(energy.minimum_energy_control().subs(at) ** 2), (s, 0, 1))
    l = sp.Matrix(other)
    bound = (l.T * c.subs(at))[0] ** 2 / (l.T * energy.gramian().subs(T, 1) * l)[0]
    assert bound < square


def test_the_minimal_element_is_in_the_span_with_the_multipliers_found():
    h = energy.minimal_element()
    coefficients = [sp.Poly(h, s).coeff_monomial(s**k) * f for k, f in ((2, 2), (1, 1), (0, 1))]
    assert (sp.Matrix(coefficients) - energy.stationary()[1]).applyfunc(sp.simplify) == sp.zeros(3, 1)
    assert not h.has(*multipliers)
