"""The closed solution of example 2 compared with quadrature, integration and exact extremals."""

import functools

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.optimize import newton

from pontryagin.averaging.derivation import kepler_optimum as optimum
from pontryagin.averaging.derivation import kepler_principle as principle
from pontryagin.averaging.derivation.kepler import anomaly, e, eccentric, energy, momentum
from pontryagin.averaging.derivation.kepler_optimum import (
    direction,
    duration,
    energy0,
    energy1,
    momentum0,
    rho,
    tau,
)
from pontryagin.averaging.derivation.kepler_principle import costate_energy, costate_momentum, kappa, price

XI = 2 * np.pi * np.arange(32) / 32
levels = st.floats(-2.0, -0.1)
shapes = st.floats(0.05, 0.9)
prices = st.floats(0.05, 5.0)


def mean_hamiltonian(E, K, p, l):
    """<h*> by Cartesian velocity and position on the ellipse, averaged over time by the eccentric anomaly."""
    shape, a = np.sqrt(1 + 2 * E * K**2), -1 / (2 * E)
    density = 1 - shape * np.cos(XI)
    place = a * np.array([np.cos(XI) - shape, np.sqrt(1 - shape**2) * np.sin(XI)])
    speed = np.array([-np.sin(XI), np.sqrt(1 - shape**2) * np.cos(XI)]) / (np.sqrt(a) * density)
    switching = p[0] * speed + p[1] * np.array([-place[1], place[0]])
    return np.mean(density * (switching**2).sum(axis=0)) / 4 - l


def slopes(z, l):
    """Rates of (E, K, p_E, p_K) by Hamilton's equations of <h*>, with fourth-order central differences."""
    gradient = np.empty(4)
    for k, step in enumerate(1e-4 * np.array([-z[0], z[1], 1, 1])):
        shifts = [z + j * step * np.eye(4)[k] for j in (-2, -1, 1, 2)]
        h = [mean_hamiltonian(w[0], w[1], w[2:], l) for w in shifts]
        gradient[k] = (h[0] - 8 * h[1] + 8 * h[2] - h[3]) / (12 * step)
    return np.array([gradient[2], gradient[3], -gradient[0], -gradient[1]])


@functools.cache
def averaged_rates():
    """The derived averaged equations at kappa = 0 as a numeric function."""
    rates = principle.averaged_rates()
    parts = [rates[v].subs(kappa, 0) for v in (energy, momentum, costate_energy, costate_momentum)]
    return sp.lambdify([energy, momentum, costate_energy, costate_momentum], parts)


@functools.cache
def closed_solution():
    """E, K, p_E of the derived solution as a numeric function, with its duration and cost."""
    ending = {rho: optimum.terminal_costate(), duration: optimum.optimal_duration()}
    found = optimum.solution()
    parts = [found[v].subs(rho, ending[rho]).subs(duration, ending[duration]) for v in (energy, momentum)]
    parts += [found[costate_energy].subs(rho, ending[rho]).subs(duration, ending[duration])]
    parts += [ending[duration], optimum.optimal_cost()]
    return sp.lambdify([tau, energy0, momentum0, energy1, price], parts)


def momentum_of(E, shape):
    """K > 0 from E and the eccentricity."""
    return np.sqrt((1 - shape**2) / (-2 * E))


@settings(max_examples=20, deadline=None)
@given(levels, shapes, st.floats(-2, 2), st.floats(-2, 2))
def test_averaged_equations_are_the_gradient_of_the_quadrature(E, shape, p_E, p_K):
    K = momentum_of(E, shape)
    derived = np.array(averaged_rates()(E, K, p_E, p_K))
    assert_allclose(derived, slopes(np.array([E, K, p_E, p_K]), 1.0), atol=1e-6 * (1 + np.abs(derived).max()))


@settings(max_examples=10, deadline=None)
@given(levels, levels, shapes, prices)
def test_the_closed_solution_is_what_the_averaged_system_does(E0, E1, shape, l):
    assume(abs(E1 - E0) > 1e-3)
    K0 = momentum_of(E0, shape)
    start = closed_solution()(0.0, E0, K0, E1, l)
    assert_allclose(start[:2], [E0, K0], rtol=1e-9)
    length, cost = start[3:]
    times = np.linspace(0, length, 5)

    def rates(_, z):
        spent = l + mean_hamiltonian(z[0], z[1], z[2:4], l) + l
        return [*averaged_rates()(*z[:4]), spent]

    path = solve_ivp(
        rates, (0, length), [E0, K0, start[2], 0, 0], t_eval=times, rtol=1e-11, atol=1e-12, method="DOP853"
    ).y
    closed = np.array([closed_solution()(at, E0, K0, E1, l)[:3] for at in times]).T
    assert_allclose(path[:3], closed, rtol=1e-8)
    assert_allclose(path[3], 0, atol=1e-12)
    assert_allclose(path[0, -1], E1, rtol=1e-8)
    assert_allclose(path[4, -1], cost, rtol=1e-8)
    assert_allclose(cost, 2 * l * length, rtol=1e-12)
    assert_allclose(path[0] * path[1] ** 2, E0 * K0**2, rtol=1e-8)


@given(levels, levels, shapes, prices, st.floats(0, 1), st.floats(-3, 3))
@settings(max_examples=20, deadline=None)
def test_the_thrust_depends_on_the_place_only(E0, E1, shape, l, share, x):
    assume(abs(E1 - E0) > 1e-3)
    K0 = momentum_of(E0, shape)
    length = closed_solution()(0.0, E0, K0, E1, l)[3]
    _, K, p = closed_solution()(share * length, E0, K0, E1, l)[:3]
    at = {e: shape, anomaly: x, price: l, direction: np.sign(E1 - E0)}
    derived = np.array(optimum.thrust_on_the_way().subs(at), dtype=float).ravel()
    assert_allclose(derived, p / (2 * K) * np.array([shape * np.sin(x), 1 + shape * np.cos(x)]), atol=1e-8)


@pytest.mark.parametrize(("E0", "E1"), [(-0.5, -0.3), (-0.4, -1.1)])
def test_other_endings_cost_more_and_the_second_derivative_says_how_much(E0, E1):
    l, (low, high) = 0.3, sorted([np.sqrt(-E0), np.sqrt(-E1)])

    def omega(s):
        return (2 * s**2) ** 1.5

    def totals(k):
        def speed(s):
            return np.sqrt((l - k * omega(s)) / 2)

        phase = quad(lambda s: omega(s) / speed(s), low, high)[0]
        return phase, quad(lambda s: (2 * l - k * omega(s)) / speed(s), low, high)[0]

    small = 1e-3 * l
    slope = (totals(small)[0] - totals(-small)[0]) / (2 * small)
    root = sp.Symbol("s", positive=True)
    derived = sp.integrate(optimum.ending_slope().subs(price, l), (root, low, high))
    assert_allclose(float(derived), slope, rtol=1e-4)
    costs = np.array([totals(k)[1] for k in (-small, 0, small)])
    assert costs[1] < min(costs[0], costs[2])
    assert_allclose((costs[0] - 2 * costs[1] + costs[2]) / small**2, slope, rtol=1e-3)
    assert_allclose(costs[1], float(optimum.optimal_cost().subs({energy0: E0, energy1: E1, price: l})))


L, START, MOMENTUM, TARGET = 0.1, -0.5, 0.9, -0.35


def extremal_rates(_, y, eps):
    """Rates of position, velocity, their costates and the cost by the maximum principle in Cartesian axes."""
    q, v, a, b = y[:8].reshape(4, 2)
    r = np.hypot(*q)
    force = -q / r**3 + eps * b / 2
    return np.r_[v, force, b / r**3 - 3 * q * (q @ b) / r**5, -a, eps * (L + b @ b / 4)]


def flown_back(K1, x1, eps):
    """K, xi at the energy E = START, and the cost, of the extremal that ends at K1, x1 with H = 0."""
    shape = np.sqrt(1 + 2 * TARGET * K1**2)
    r = K1**2 / (1 + shape * np.cos(x1))
    q = r * np.array([np.cos(x1), np.sin(x1)])
    v = np.array([-np.sin(x1), shape + np.cos(x1)]) / K1
    costate = np.sign(TARGET - START) * 2 * np.sqrt(L) / np.hypot(*v)
    end = np.r_[q, v, costate * q / r**3, costate * v, 0.0]

    def level(_, y, eps):
        return (y[2] ** 2 + y[3] ** 2) / 2 - 1 / np.hypot(y[0], y[1]) - START

    level.terminal = True
    flight = solve_ivp(
        extremal_rates, (0, -9 / eps), end, args=(eps,), events=level, rtol=1e-10, atol=1e-11, method="DOP853"
    )
    x, y, vx, vy = flight.y[:4, -1]
    K, r = x * vy - y * vx, np.hypot(x, y)
    xi = np.arctan2((x * vx + y * vy) * np.sqrt(-2 * START), 1 + 2 * START * r)
    return K, xi, -flight.y[8, -1]


@pytest.mark.slow
@pytest.mark.parametrize("eps", [0.02, 0.01])
@pytest.mark.parametrize("side", [1, -1])
def test_the_first_correction_leaves_an_error_of_second_order(side, eps):
    shape = np.sqrt(1 + 2 * START * MOMENTUM**2)
    ending = side * 2 * np.arctan(np.sqrt((1 + shape) / (1 - shape)))
    guess = MOMENTUM * np.sqrt(START / TARGET)
    K1 = newton(lambda K: flown_back(K, ending, eps)[0] - MOMENTUM, guess, x1=1.001 * guess, tol=1e-8)
    _, xi, cost = flown_back(K1, ending, eps)
    at = {energy0: START, energy1: TARGET, price: L, e: shape, eccentric: xi}
    first = float(optimum.optimal_cost().subs(at))
    best, worst = (float(optimum.first_correction(kind).subs(at)) for kind in (1, -1))
    assert best < worst
    correction = best if side == 1 else worst
    assert abs(cost - first - eps * correction) < 0.6 * eps**2
    assert abs(cost - first) > 4 * eps**2
