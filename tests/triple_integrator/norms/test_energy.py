"""Least energy: the parabola costs less than all other controls, and the bound proves it."""

import numpy as np
from hypothesis import given
from numpy.testing import assert_allclose

from pontryagin.triple_integrator import Maneuver, minimum_energy
from strategies import maneuver_with, maneuvers, moments, multipliers


@given(moments(), multipliers)
def test_any_other_control_with_the_same_moments_costs_more(c, polynomial):
    """(1.18): u + w, w orthogonal to 1, s, s^2, has the energy |u|^2 + |w|^2; Gauss quadrature is exact."""
    solution = minimum_energy(maneuver_with(c))
    nodes, weights = np.polynomial.legendre.leggauss(8)
    t, weights = (nodes + 1) / 2, weights / 2
    other = np.polynomial.Polynomial([*polynomial, 1.0])(t)
    basis = np.vander(t, 3)
    projection = np.linalg.solve(basis.T @ (weights[:, None] * basis), basis.T @ (weights * other))
    w, u = other - basis @ projection, solution.control(t)
    assert_allclose(weights @ u**2, solution.norm**2, rtol=1e-10, atol=1e-25)
    assert_allclose(weights @ (u + w) ** 2, weights @ u**2 + weights @ w**2, rtol=1e-9, atol=1e-12)


@given(moments(), multipliers)
def test_no_multipliers_give_a_bound_above_the_norm(c, l):
    nodes, weights = np.polynomial.legendre.leggauss(4)
    s = (nodes + 1) / 2
    h = l[0] * s**2 / 2 + l[1] * s + l[2]
    length = np.sqrt(weights / 2 @ h**2)
    norm = minimum_energy(maneuver_with(c)).norm
    assert abs(l @ c) <= norm * length * (1 + 1e-9) + 1e-12 * np.abs(c).max()


@given(maneuvers())
def test_the_control_is_the_minimal_element_over_its_square(maneuver):
    """(2.2): u = h0 / rho0^2 with rho0 = 1 / norm, and l'c = 1 unless c = 0."""
    solution = minimum_energy(maneuver)
    t = np.linspace(maneuver.t0, maneuver.tf, 7)
    assert_allclose(solution.multipliers @ maneuver.moments, float(maneuver.moments.any()), rtol=1e-10)
    control = solution.control(t)
    assert_allclose(
        solution.costate(t)[:, 2] * solution.norm**2, control, rtol=1e-8, atol=1e-8 * np.abs(control).max()
    )


def test_rest_to_rest_over_one_radian():
    """(2.5) for the ends (2.4): u = 60 (6 s^2 - 6 s + 1), whose square integrates to 720."""
    solution = minimum_energy(Maneuver([0, 0, 0], [1, 0, 0], 1.0))
    assert_allclose(solution.control([0, 0.5, 1]), [60, -30, 60], rtol=1e-13)
    assert_allclose(solution.norm, np.sqrt(720), rtol=1e-14)
    assert solution.breakpoints.shape == (0,)
