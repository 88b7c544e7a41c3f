"""The first correction: proofs for arbitrary coefficients, and a check by quadrature."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.optimize import brentq

from pontryagin.averaging.derivation import correction as theory
from pontryagin.averaging.derivation.correction import eps, x

a, p = sp.symbols("a p", real=True)
b, q = sp.symbols("b q", real=True)


def coefficient(name, *variables):
    return sp.Function(name)(*variables)


def periodic(name, variables, parity=None):
    """A trigonometric polynomial whose coefficients are undefined functions."""
    even = [coefficient(f"{name}c{j}", *variables) * sp.cos(j * x) for j in (1, 2)]
    odd = [coefficient(f"{name}s{j}", *variables) * sp.sin(j * x) for j in (1, 2)]
    constant = coefficient(f"{name}0", *variables)
    return (
        sum(even, constant)
        if parity == "even"
        else sum(odd)
        if parity == "odd"
        else sum(even + odd, constant)
    )


def test_the_costate_of_the_anomaly_solves_the_condition_to_second_order():
    h, F, r = sp.symbols("h F r", positive=True)
    k1, k2 = theory.anomaly_hamiltonian(h, F, r)
    condition = sp.expand((-(eps * k1 + eps**2 * k2)) * r + eps * (h - F * (eps * k1 + eps**2 * k2)))
    assert sp.simplify(k1 - h / r) == 0
    assert all(sp.simplify(condition.coeff(eps, i)) == 0 for i in (0, 1, 2))


def test_primitives_have_zero_mean_and_the_right_derivative():
    k = periodic("k", (a, p))
    assert sp.simplify(theory.mean(theory.primitive(k))) == 0
    assert sp.simplify(sp.diff(theory.primitive(k), x) - k + theory.mean(k)) == 0


@pytest.mark.slow
def test_the_transformation_removes_the_anomaly_to_second_order():
    """The proof is for one slow variable and arbitrary coefficients."""
    assert sp.simplify(theory.transformed(periodic("k", (a, p)), periodic("m", (a, p)), [a], [p])) == 0


@pytest.mark.slow
def test_the_transformation_removes_the_anomaly_with_two_slow_variables():
    variables = (a, b, p, q)
    k1 = coefficient("c", *variables) * sp.cos(x) + coefficient("s", *variables) * sp.sin(x)
    k1 += coefficient("k", *variables)
    assert sp.simplify(theory.transformed(k1, sp.Integer(0), [a, b], [p, q])) == 0


def test_the_ends_contribute_the_generator_alone():
    S = theory.generator(periodic("k", (a, b, p, q)))
    assert sp.simplify(theory.end_term(S, [a, b], [p, q]) - S) == 0


def test_a_small_hamiltonian_enters_the_cost_by_its_integral():
    assert theory.variation() == -sp.Symbol("dK")


def test_the_least_correction_is_where_the_costate_of_the_phase_vanishes():
    k1 = periodic("k", (a, p))
    slope = theory.ending_slope(k1, [a], [p])
    assert sp.simplify(slope - (theory.mean(k1) - k1)) == 0


def test_the_integral_vanishes_for_reversible_systems():
    k1, k2 = periodic("k", (a, b, p, q), "even"), periodic("m", (a, b, p, q), "odd")
    assert sp.simplify(theory.mean_hamiltonian(k1, k2, [a, b], [p, q])) == 0


def test_the_integral_does_not_vanish_in_general():
    k1 = periodic("k", (a, p))
    assert sp.simplify(theory.mean_hamiltonian(k1, sp.Integer(0), [a], [p])) != 0
    shown = theory.mean_hamiltonian(p * sp.sin(x) + a * sp.cos(x), sp.Integer(0), [a], [p])
    assert shown == sp.Rational(-1, 2)


FORCE, POTENTIAL, ENERGIES = 0.5, 0.6, (2.0, 3.0)


def pace(energy, angle):
    """dt/dx at an energy, in the potential V = 0.6 cos x."""
    return 1 / np.sqrt(2 * (energy - POTENTIAL * np.cos(angle)))


def mean_pace(energy):
    return pace(energy, np.arange(64) * np.pi / 32).mean()


def primitive_of_pace(energy, angle):
    """Zero-mean primitive of the pace minus its mean; odd in the angle, as the pace is even."""
    order = np.arange(1, 32)
    cosines = np.fft.rfft(pace(energy, np.arange(64) * np.pi / 32)).real[1:32] / 32
    return (cosines / order * np.sin(np.multiply.outer(angle, order))).sum(axis=-1)


def second_mean(energy):
    """Mean of the oscillating force times the derivative by energy of `primitive_of_pace`."""
    angles, step = np.arange(64) * np.pi / 32, 1e-5
    above, below = (primitive_of_pace(energy + d, angles) for d in (step, -step))
    return (FORCE * np.sin(angles) * (above - below) / (2 * step)).mean()


def least_time(epsilon, x0):
    """Slow time and anomaly at the end for da/dx = eps (1 + f sin x), dtau/dx = eps pace, by quadrature."""

    def energy(angle):
        return ENERGIES[0] + epsilon * (angle - x0 - FORCE * (np.cos(angle) - np.cos(x0)))

    x1 = brentq(lambda angle: energy(angle) - ENERGIES[1], x0, x0 + 2 / epsilon, xtol=1e-14)
    node, weight = np.polynomial.legendre.leggauss(1000)
    angles = (x1 + x0) / 2 + (x1 - x0) / 2 * node
    return epsilon * (weight * pace(energy(angles), angles)).sum() * (x1 - x0) / 2, x1


def test_least_time_of_an_asymmetric_rotor_by_quadrature():
    """The control is constant here, so that the anomaly at the end is fixed by the motion."""
    v = sp.Function("v", positive=True)(a, x)
    k1, k2 = theory.anomaly_hamiltonian(p * v * (1 + sp.sin(x) / 2) - 1, sp.S.Zero, v)
    assert k2 == 0
    assert sp.simplify(k1 - p * (1 + sp.sin(x) / 2) + 1 / v) == 0

    def end_term(energy, angle):
        return mean_pace(energy) * FORCE * np.cos(angle) + primitive_of_pace(energy, angle)

    x0, epsilons = 1.0, np.array([0.02, 0.01, 0.005])
    times, arrivals = np.array([least_time(e, x0) for e in epsilons]).T
    zeroth, integral = (quad(f, *ENERGIES, epsabs=1e-13)[0] for f in (mean_pace, second_mean))
    short = end_term(ENERGIES[1], arrivals) - end_term(ENERGIES[0], x0)
    complete = np.abs(times - zeroth - epsilons * (short - integral))
    incomplete = np.abs(times - zeroth - epsilons * short)
    assert abs(integral) > 0.005
    assert_allclose(np.log2(incomplete[:-1] / incomplete[1:]), 1.0, atol=0.2)
    assert (complete < 0.3 * epsilons**2).all()
