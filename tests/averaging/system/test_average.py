"""The averaged Hamiltonian compared with closed forms and mpmath; its derivatives with differences."""

from functools import cache

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from pontryagin.averaging import Ball, BoundedQuadratic, Box, PhaseSystem, Quadratic, kepler, rotor, spin_down
from pontryagin.averaging.system.average import (
    closed_mean,
    kernel_expressions,
    switching_functions,
)

a, b, x, u, w = sp.symbols("a b x u w", real=True)
SPEED = sp.sqrt(2 * (a + sp.cos(x)))


def pendulum(control_set, arm=1):
    return PhaseSystem(
        f=[SPEED * (u * arm - SPEED / 5)],
        anomaly_rate=SPEED,
        control_set=control_set,
        slow=[a],
        control=[u],
        phase=x,
        target=[a - 5],
    )


KINKED = sp.cos(x) + sp.Rational(1, 2)
SYSTEMS = {
    "quadratic": pendulum(Quadratic()),
    "ball": pendulum(Ball(1)),
    "box": pendulum(Box([1]), KINKED),
    "bounded": pendulum(BoundedQuadratic(sp.Rational(1, 2)), KINKED),
}


@pytest.mark.slow
@given(st.integers(0, 4), st.integers(0, 4))
def test_closed_means_of_powers_are_their_integrals(i, j):
    power = sp.cos(x) ** i * sp.sin(x) ** j
    assert closed_mean(a * power, x) == a * sp.integrate(power, (x, 0, 2 * sp.pi)) / (2 * sp.pi)


def test_closed_means_take_multiples_of_the_angle_and_leave_the_rest():
    assert closed_mean(sp.cos(3 * x) ** 2 + a, x) == a + sp.Rational(1, 2)
    assert closed_mean(sp.sqrt(a + sp.cos(x)), x) is None
    assert closed_mean(1 / (2 + sp.cos(x)), x) is None
    assert closed_mean(x, x) is None


def test_a_trigonometric_polynomial_is_averaged_in_closed_form():
    oscillator = PhaseSystem(
        f=[-u * sp.sin(x) - a * sp.sin(x) ** 2],
        omega=1,
        control_set=Quadratic(),
        slow=[a],
        control=[u],
        phase=x,
        target=[a - 1],
    )
    p = oscillator.costates[0]
    assert kernel_expressions(oscillator)["density"][1] is None
    mean = kernel_expressions(oscillator)["mean"][1]
    assert sp.expand(mean[0] - (p**2 / 8 - a * p / 2 - 1)) == 0


def test_what_is_not_smooth_in_the_anomaly_is_found():
    y = sp.Symbol("y", real=True)
    integrand = sp.Abs(sp.cos(x) - y) + sp.Max(y, sp.sin(x)) + sp.Abs(y) + sp.sqrt(2 + sp.cos(x))
    found = switching_functions(integrand, x)
    kinks = {sp.cos(x) - y, y - sp.sin(x)}
    assert len(found) == 2 and all(kink in kinks or -kink in kinks for kink in found)


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
@settings(max_examples=8)
@given(
    st.floats(1.05, 6).map(lambda z: round(z, 3)),
    st.floats(-3, 3).map(lambda z: round(z, 3)).filter(lambda p: abs(p) > 0.05),
)
def test_means_against_mpmath(name, energy, p):
    system = SYSTEMS[name]
    h, omega = system.model.averaged(np.array([energy, p]), ())
    mp.mp.dps = 20
    at = {a: sp.Float(energy, 20), system.costates[0]: sp.Float(p, 20), system.phase_costate: 0}
    value = sp.lambdify(x, (system.hamiltonian / system.rate).subs(at), "mpmath")
    turn = sp.lambdify(x, (1 / system.rate).subs(at), "mpmath")
    corners = {0, mp.pi, 2 * mp.pi, 2 * mp.pi / 3, 4 * mp.pi / 3}
    if name == "bounded":
        edge = sp.lambdify(x, (sp.Abs(system.switching[0]) - 1).subs(at), "mpmath")
        grid = [2 * mp.pi * i / 400 for i in range(401)]
        signs = [edge(g) > 0 for g in grid]
        corners |= {
            mp.findroot(edge, (grid[i], grid[i + 1]), solver="anderson")
            for i in range(400)
            if signs[i] != signs[i + 1]
        }
    corners = sorted(corners)
    whole = mp.quad(turn, corners)
    assert float(omega.value) == pytest.approx(float(2 * mp.pi / whole), rel=1e-12)
    assert float(h.value) == pytest.approx(float(mp.quad(value, corners) / whole), rel=1e-11, abs=1e-12)


def test_the_pendulums_frequency_is_an_elliptic_integral():
    energy = np.array([1.001, 1.5, 4.0])
    _, omega = SYSTEMS["ball"].model.averaged(np.stack([energy, 0 * energy + 1], axis=-1), ())
    exact = [mp.pi * mp.sqrt((e + 1) / 2) / mp.ellipk(2 / (e + 1)) for e in energy]
    np.testing.assert_allclose(omega.value, np.array(exact, dtype=float), rtol=1e-12)


MOVING = {
    name: PhaseSystem(
        f=[u * (1 + sp.cos(x) / 2) - a * b / 4, w + u * sp.sin(x) + a / 3],
        omega=1 + a**2,
        control_set=control_set,
        slow=[a, b],
        control=[u, w],
        phase=x,
        target=[a - 2],
        weight=1 + sp.cos(x) / 3,
    )
    for name, control_set in {"moving box": Box([2, 1]), "moving bounded": BoundedQuadratic(1)}.items()
}
"""Systems whose switching phases depend on the costates."""

POINTS = {
    **dict.fromkeys(MOVING, ((), [0.8, 0.4, 0.9, -1.1])),
    **dict.fromkeys(SYSTEMS, ((), [1.7, 0.8])),
    "kepler": ((-0.3, 0.1), [-0.4, 0.9, 0.7, -0.2]),
    "body": ((1, 0.7, 0.4, 0.5, -1), [0.7, 1.2, -0.5, 0.3]),
}
"""The numbers of each averaged model, and slow variables with costates."""


@cache
def model_of(name):
    if name == "kepler":
        return kepler(-0.5, 0.8, -0.3, 0.1).model
    if name == "body":
        return spin_down([3, 4, 2], [1, 0.7, 0.4], 0.5).model
    return (MOVING | SYSTEMS)[name].model


@pytest.mark.parametrize("name", POINTS)
def test_gradients_and_hessians_belong_to_the_values(name):
    """They agree with fourth-order differences, also for a box, whose switches contribute to the Hessian."""
    model, (numbers, z) = model_of(name), POINTS[name]
    numbers = tuple(np.array(float(number)) for number in numbers)
    step = 1e-3
    shifts = step * np.eye(len(z))[:, None] * np.array([-2, -1, 1, 2])[:, None]
    weights = np.array([1, -8, 8, -1]) / (12 * step)
    here, around = np.array(z), np.array(z) + shifts
    for jet, moved in zip(model.averaged(here, numbers), model.averaged(around, numbers), strict=True):
        scale = 1 + np.abs(jet.hessian).max()
        np.testing.assert_allclose(weights @ moved.value.T, jet.gradient, atol=2e-9 * scale)
        slopes = np.einsum("j,ijk->ik", weights, moved.gradient)
        np.testing.assert_allclose(slopes, jet.hessian, atol=2e-8 * scale)


@pytest.mark.parametrize("name", ["ball", "box", "body"])
@given(st.floats(0.1, 5))
def test_least_time_makes_h0_homogeneous_of_degree_one(name, factor):
    model, (numbers, z) = model_of(name), POINTS[name]
    numbers = tuple(np.array(float(number)) for number in numbers)
    z = np.array(z)
    half = len(z) // 2
    stretched = np.concatenate([z[:half], factor * z[half:]])
    h, _ = model.averaged(np.stack([z, stretched]), numbers)
    assert h.value[1] + 1 == pytest.approx(factor * (h.value[0] + 1), rel=1e-12)
    assert h.gradient[0, half:] @ z[half:] == pytest.approx(h.value[0] + 1, rel=1e-12)


@pytest.mark.slow
def test_keplers_closed_form_is_the_quadrature_of_its_own_system():
    solution = kepler(-0.5, 0.8, -0.3, 0.1)
    numbers = (np.array(-0.3), np.array(0.1))
    z = np.array([[-0.4, 0.9, 0.7, -0.2], [-0.5, 0.2, -1.0, 2.0], [-0.1, 1.5, 0.0, 1.0]])
    derived, by_quadrature = (m.averaged(z, numbers) for m in (solution.model, solution.system.model))
    for one, other in zip(derived, by_quadrature, strict=True):
        np.testing.assert_allclose(one.value, other.value, rtol=1e-12)
        np.testing.assert_allclose(one.gradient, other.gradient, rtol=1e-11, atol=1e-12)
        np.testing.assert_allclose(one.hessian, other.hessian, rtol=1e-10, atol=1e-10)


def test_a_constant_speed_needs_no_quadrature():
    free = rotor(1.0, 4.0, mass=2, potential=-1, peak=1.0)
    assert free.model.density is None
    assert float(free.frequency(0.0)[0]) == pytest.approx(np.sqrt(2))


def test_stacks_of_numbers_and_points_broadcast():
    model = model_of("kepler")
    z = np.array(POINTS["kepler"][1])
    price = np.array([0.1, 0.2, 0.3])
    h, omega = model.averaged(z, (np.array(-0.3), price))
    assert h.value.shape == omega.value.shape == (3,) and h.hessian.shape == (3, 4, 4)
    np.testing.assert_allclose(np.diff(h.value), -0.1)
