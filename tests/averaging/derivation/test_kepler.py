"""Osculating elements compared with Cartesian trajectories, and the phase with time."""

import functools

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from pontryagin.averaging.derivation import kepler, kepler_orbit, kepler_phase
from pontryagin.averaging.derivation import kepler_principle as principle
from pontryagin.averaging.derivation.kepler import (
    anomaly,
    e,
    eccentric,
    energy,
    epsilon,
    gamma,
    momentum,
    u_radial,
    u_transverse,
)


def fly(state, thrust, times):
    """States (k, 4) by Newton's law in the plane under a constant thrust (radial, transverse)."""

    def rates(_, s):
        radius = np.hypot(*s[:2])
        along = s[:2] / radius
        across = np.array([-along[1], along[0]])
        return [*s[2:], *(-along / radius**2 + thrust[0] * along + thrust[1] * across)]

    span = (0, times[-1])
    return solve_ivp(rates, span, state, t_eval=times, rtol=1e-12, atol=1e-13, method="DOP853").y.T


def elements(states):
    """E, K, e, gamma, true and mean anomaly (6, ...) of Cartesian states, by vector formulas."""
    x, y, vx, vy = np.moveaxis(np.asarray(states), -1, 0)
    r = np.hypot(x, y)
    E, K = (vx**2 + vy**2) / 2 - 1 / r, x * vy - y * vx
    pericentre = (K * vy - x / r) + 1j * (-K * vx - y / r)
    true = np.angle((x + 1j * y) / pericentre)
    semi_major = -1 / (2 * E)
    xi = np.arctan2((x * vx + y * vy) / np.sqrt(semi_major), 1 - r / semi_major)
    mean = xi - np.sin(xi) * np.abs(pericentre)
    return np.array([E, K, np.abs(pericentre), np.angle(pericentre), true, mean])


@functools.cache
def plane():
    """The derived position and velocity as one numeric function of E, K, gamma, x."""
    parts = [*kepler_orbit.position(), *kepler_orbit.velocity()]
    return sp.lambdify([energy, momentum, gamma, anomaly], parts)


def cartesian(E, K, direction, true):
    """The Cartesian state (4, ...) from the elements."""
    return np.array(plane()(E, K, direction, true))


@functools.cache
def derived_rates():
    """The derived rates of E, K, e, gamma, x, psi as a numeric function of E, K, e, x, u_r, u_phi."""
    rates = kepler.element_rates()
    motion = kepler_phase.mean_anomaly_rate().subs(
        {kepler_phase.eccentricity_rate: rates[e], kepler_phase.pericentre_rate: rates[gamma]}
    )
    slow = [rates[key] for key in (energy, momentum, e, gamma)]
    parts = [part.subs(epsilon, 1) for part in (*slow, kepler.anomaly_rate() - rates[gamma], motion)]
    return sp.lambdify([energy, momentum, e, anomaly, u_radial, u_transverse], parts)


orbits = st.tuples(
    st.floats(-2.0, -0.1), st.floats(0.05, 0.9), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)
).map(lambda o: (o[0], np.sqrt((1 - o[1] ** 2) / (-2 * o[0])), o[2], o[3]))
"""Strategy of (E, K, gamma, x) with an eccentricity between 0.05 and 0.9."""
thrusts = st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(orbits, thrusts)
def test_rates_of_the_elements_are_slopes_along_a_flight(orbit, thrust):
    E, K, _, true = orbit
    shape, state = np.sqrt(1 + 2 * E * K**2), cartesian(*orbit)
    step = 1e-3 * K**3 / (1 + shape) ** 2
    ahead, behind = (elements(fly(state, thrust, sign * np.array([0, step, 2 * step]))) for sign in (1, -1))
    path = np.unwrap(np.c_[behind[:, :0:-1], ahead])
    slopes = (path[:, 0] - 8 * path[:, 1] + 8 * path[:, 3] - path[:, 4]) / (12 * step)
    expected = np.array(derived_rates()(E, K, shape, true, *thrust))
    assert_allclose(slopes, expected, atol=1e-6 * (1 + np.abs(expected).max()))


@pytest.mark.parametrize("thrust", [(0.004, 0.0), (0.0, -0.003), (-0.002, 0.005)])
def test_the_model_flies_as_newton_does(thrust):
    model = kepler.model()
    rates = [
        *model.rates,
        model.mean_motion / model.weight + epsilon * model.phase_rate,
        -model.phase_rate * epsilon,
    ]
    rates[:2] = [epsilon * rate for rate in rates[:2]]
    slopes = sp.lambdify([*model.slow, model.anomaly, epsilon, *model.control], rates)
    E, K, direction, true, eps = -0.5, 0.8, 0.4, -1.1, 0.7
    push = np.array(thrust) / eps
    times = np.linspace(0, 25, 6)
    flown = solve_ivp(
        lambda _, s: slopes(*s[:3], eps, *push),
        (0, times[-1]),
        [E, K, true, direction],
        t_eval=times,
        rtol=1e-11,
        atol=1e-12,
        method="DOP853",
    ).y
    truth = fly(cartesian(E, K, direction, true), thrust, times)
    assert flown[2, -1] > 2 * np.pi
    assert_allclose(cartesian(*flown[[0, 1, 3, 2]]).T, truth, atol=1e-8)


def test_the_models_parts_belong_together():
    model = kepler.model()
    assert sp.simplify(model.anomaly_rate - model.mean_motion / model.weight) == 0
    assert all(sp.Poly(part, *model.control).total_degree() == 1 for part in [*model.rates, model.phase_rate])
    free = set().union(*(part.free_symbols for part in [*model.rates, model.phase_rate, model.weight]))
    assert free == {*model.slow, *model.control, model.anomaly}


@pytest.mark.slow
@settings(max_examples=10, deadline=None)
@given(orbits)
def test_the_mean_anomaly_keeps_time_without_thrust(orbit):
    E, K, direction, _ = orbit
    shape = float(np.sqrt(1 + 2 * E * K**2))
    period = float(kepler.period().subs(energy, E))
    times = np.linspace(0, 1.5 * period, 7)
    flight = fly(cartesian(E, K, direction, 0.0), (0, 0), times)
    true = np.unwrap(np.angle((flight[:, 0] + 1j * flight[:, 1]) * np.exp(-1j * direction)), period=2 * np.pi)
    psi = sp.lambdify([e, anomaly], kepler_phase.mean_of_true())(shape, true)
    turns = np.round((2 * np.pi * times / period - psi) / (2 * np.pi))
    assert_allclose(psi + 2 * np.pi * turns, 2 * np.pi * times / period, atol=1e-7)
    xi = sp.lambdify([e, anomaly], kepler_phase.eccentric_of_true())(shape, true + 2 * np.pi * turns)
    clock = sp.lambdify([energy, e, eccentric], kepler.time_of_flight())(E, shape, xi)
    assert_allclose(clock, times, atol=1e-7 * period)
    ring = sp.lambdify([energy, e, eccentric], kepler.ellipse_radius())(E, shape, xi)
    assert_allclose(ring, np.hypot(flight[:, 0], flight[:, 1]), rtol=1e-7)


def test_the_phase_is_smooth_over_many_turns_and_grows_with_the_anomaly():
    turns = np.linspace(-20, 20, 4001)
    for shape in (1e-9, 0.3, 0.97):
        psi = sp.lambdify([e, anomaly], kepler_phase.mean_of_true())(shape, turns)
        assert np.all(np.diff(psi) > 0)
        assert np.abs(psi - turns).max() < np.pi


def test_the_slope_in_the_eccentricity_agrees_with_the_integral_of_the_weight():
    slope = kepler_phase.eccentricity_slope()
    assert sp.simplify(slope.diff(anomaly) - kepler.weight().diff(e)) == 0
    assert slope.subs(anomaly, 0) == 0


@settings(max_examples=20, deadline=None)
@given(orbits)
def test_averages_are_those_of_the_flight(orbit):
    E, K, _, _ = orbit
    shape = np.sqrt(1 + 2 * E * K**2)
    xi = 2 * np.pi * np.arange(64) / 64
    r = -(1 - shape * np.cos(xi)) / (2 * E)
    speed_squared = 2 * (E + 1 / r)
    density = 1 - shape * np.cos(xi)
    expected = [np.mean(q * density) for q in (speed_squared, K + 0 * r, r**2)]
    means = principle.averages()
    derived = [float(means[sp.Symbol(n)].subs({energy: E, momentum: K})) for n in ("v^2", "v_phi r", "r^2")]
    assert_allclose(derived, expected, rtol=1e-10)


def test_an_average_that_is_no_polynomial_is_refused():
    with pytest.raises(sp.PolynomialError):
        kepler_phase.average((1 + e * sp.cos(anomaly)) ** 2)


@settings(max_examples=10, deadline=None)
@given(orbits, thrusts)
def test_place_velocity_and_thrust_in_the_plane(orbit, costates):
    E, K, direction, true = orbit
    state = cartesian(*orbit)
    found = elements(state)
    assert_allclose(found[:3], [E, K, np.sqrt(1 + 2 * E * K**2)], rtol=1e-9)
    assert_allclose(np.exp(1j * np.array(found[3:5])), np.exp(1j * np.array([direction, true])), atol=1e-9)
    at = [energy, momentum, gamma, anomaly, *principle.costates]
    thrust = np.array(sp.lambdify(at, list(kepler_orbit.thrust()))(*orbit, *costates))
    across = np.array([-state[1], state[0]])
    assert_allclose(thrust, (costates[0] * state[2:] + costates[1] * across) / 2, atol=1e-9)
