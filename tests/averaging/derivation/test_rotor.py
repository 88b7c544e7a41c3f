"""The rotor's energy follows its average, and may have to fall before it rises."""

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import quad, solve_ivp

from pontryagin.averaging.derivation import rotor

MASS = (1 + sp.cos(rotor.x) / 2) ** 2


POTENTIAL = sp.sin(rotor.x) / 2


FORCE = sp.Rational(1, 4) + sp.cos(rotor.x) / 5


@pytest.mark.slow
def test_a_rotor_follows_the_averaged_energy_with_the_power_of_the_force():
    """The rotor (3.1) is integrated by SciPy."""
    speed = sp.lambdify([rotor.a, rotor.x], rotor.speed(MASS, POTENTIAL))
    acceleration = sp.lambdify(
        [rotor.x, rotor.v, rotor.epsilon, rotor.u], rotor.acceleration(MASS, POTENTIAL, FORCE)
    )
    a0, a1 = 2.0, 6.0

    def omega(a):
        return 2 * np.pi / quad(lambda x: 1 / speed(a, x), 0, 2 * np.pi)[0]

    def mean_over_phase(a):
        return omega(a) / (2 * np.pi) * quad(lambda x: (0.25 + np.cos(x) / 5) / speed(a, x), 0, 2 * np.pi)[0]

    derived = quad(lambda a: 1 / (omega(a) * (1 + 0.25)), a0, a1)[0]
    printed = [
        quad(lambda a, f=f: 1 / (omega(a) + f(a)), a0, a1)[0] for f in (mean_over_phase, lambda a: 0.25)
    ]

    energy = sp.lambdify([rotor.x, rotor.v], rotor.energy(MASS, POTENTIAL))

    def arrived(t, y):
        return energy(*y) - a1

    arrived.terminal = True
    for epsilon in (0.04, 0.01):
        right = lambda t, y, epsilon=epsilon: (y[1], acceleration(y[0], y[1], epsilon, 1.0))  # noqa: E731
        flight = solve_ivp(right, (0, 9 / epsilon), (0, speed(a0, 0)), events=arrived, rtol=1e-9, atol=1e-10)
        time = epsilon * flight.t_events[0][0]
        assert abs(time - derived) < epsilon
    assert all(abs(time - derived) > 0.05 for time in printed)


def braking_time(extra, epsilon, a0, a1, height):
    """Time to reduce a rotor's energy after acceleration over the angle `extra`; m = 1, V = height cos x."""
    top = a0 + epsilon * extra
    turns = (top - a1) / epsilon
    grid = 400

    def passed(first, last, energy):
        edges = np.linspace(first, last, int(abs(last - first) * grid / (2 * np.pi)) + 2)
        nodes, weights = np.polynomial.legendre.leggauss(4)
        half = np.diff(edges)[:, None] / 2
        x = edges[:-1, None] + half * (1 + nodes)
        return float((half * weights / np.sqrt(2 * (energy(x) - height * np.cos(x)))).sum())

    up = passed(0, extra, lambda x: a0 + epsilon * x)
    return up + passed(extra, extra + turns, lambda x: top - epsilon * (x - extra))


def test_lowering_the_energy_may_start_with_acceleration():
    epsilon, a1 = 0.02, 1.1
    a0 = a1 + epsilon * (2 * np.pi * 70 + np.pi)  # plain braking ends over the trough, where x' is large
    plain = braking_time(0.0, epsilon, a0, a1, 1.0)
    better = min(braking_time(extra, epsilon, a0, a1, 1.0) for extra in np.linspace(0.05, 1.0, 20))
    assert better < plain - 0.05
    without_potential = [braking_time(extra, epsilon, a0, a1, 0.0) for extra in (0.0, 0.1, 0.5)]
    assert without_potential == sorted(without_potential)
