"""Sapunkov's elements: identities of the regularisation, and (1) against Newton's law under thrust."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from pontryagin.numerics import compile as compiler
from pontryagin.rendezvous.derivation import sapunkov
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, pure, vect
from pontryagin.rendezvous.derivation.sapunkov import A, B, Q, epsilon, force, half_anomaly, u, velocity, w

EPSILON = 0.05


def is_zero(matrix):
    return matrix.applyfunc(sp.expand).is_zero_matrix


@pytest.mark.slow
def test_the_spinor_obeys_newton_s_law():
    assert is_zero(sapunkov.place_rate() - sapunkov.radius() * velocity)
    assert sp.expand(sapunkov.place().dot(sapunkov.place()) - sapunkov.radius() ** 2) == 0
    difference = sapunkov.spinor_acceleration() - sapunkov.oscillator()
    assert difference.applyfunc(sp.simplify).is_zero_matrix


def test_the_bilinear_relation_is_preserved():
    assert sp.expand(sapunkov.bilinear(u, sapunkov.spinor_rate())) == 0
    factor = sp.cancel(sp.expand(sapunkov.bilinear_rate()) / sapunkov.bilinear())
    assert sp.denom(factor) == 1
    assert sapunkov.bilinear_rate().subs(dict.fromkeys(force, 0)) == 0


@given(st.tuples(*[st.integers(-4, 4)] * 3).filter(lambda d: d[0] > -np.linalg.norm(d) + 1e-9))
def test_every_direction_but_one_has_a_spinor(direction):
    unit = sp.Matrix(direction) / sp.sqrt(sum(part**2 for part in direction))
    found = sapunkov.place(sapunkov.spinor_of(unit)) - unit
    assert max(abs(complex(part.evalf(20))) for part in found) < 1e-15


def right_hand_side():
    """The derived right-hand side of (1) as a function of A, B, phi, epsilon and p."""
    names = sapunkov.oscillation()
    rates = [part.subs(names, simultaneous=True) for part in sapunkov.element_rates()]
    size = A.dot(A) + B.dot(B)
    outputs = {"A": rates[0].subs(Q, size), "B": rates[1].subs(Q, size)}
    outputs["t"] = sapunkov.time_rate().subs(names, simultaneous=True).subs(Q, size)
    return compiler.function("rates", [*A, *B, half_anomaly, epsilon, *force], outputs)


def state_of(elements, angle):
    """R and V from A, B and phi: R = u~ o i1 o u, V = 2 u~ o i1 o w / (r sqrt(2Q))."""
    swing = product(conjugate(u), sp.Matrix([0, 1, 0, 0]), w)
    speed = 2 * vect(swing) / (sapunkov.radius() * sp.sqrt(2 * (A.dot(A) + B.dot(B))))
    names = sapunkov.oscillation()
    whole = {
        "R": sapunkov.place().subs(names, simultaneous=True),
        "V": speed.subs(names, simultaneous=True),
    }
    found = compiler.function("state", [*A, *B, half_anomaly], whole)(*elements, angle)
    return np.hstack([part[..., 0] for part in found])


def elements_of(position, speed):
    """A and B, which are u and w at phi = 0."""
    r = np.linalg.norm(position)
    h = speed @ speed / 2 - 1 / r
    spinor = sapunkov.spinor_of(sp.Matrix(position / r)) * sp.sqrt(r)
    rate = product(sp.Matrix([0, -1, 0, 0]), spinor, pure(sp.Matrix(speed))) / 2
    both = [*spinor, *(rate / sp.sqrt(-h / 2))]
    return np.array([float(part) for part in both])


def thrust(t):
    return np.array([np.sin(2 * t), 0.7, -np.cos(t)])


@pytest.mark.slow
@pytest.mark.parametrize("speed", [[0.1, 1.0, 0.3], [0.4, 0.3, -0.2]])
def test_1_agrees_with_newton_s_law_under_thrust(speed):
    position = np.array([0.9, -0.2, 0.3])
    rates = right_hand_side()

    def elements(angle, y):
        a, b, clock = rates(*y[:8], angle, EPSILON, *thrust(y[8]))
        return [*a.ravel(), *b.ravel(), float(clock)]

    start = [*elements_of(position, np.array(speed)), 0.0]
    angles = np.linspace(0.0, 4.0, 9)
    options = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}
    path = solve_ivp(elements, (0, 4), start, t_eval=angles, **options).y
    times = path[8]
    assert (np.diff(times) > 0).all()

    def newton(t, y):
        return [*y[3:], *(EPSILON * thrust(t) - y[:3] / np.linalg.norm(y[:3]) ** 3)]

    inertial = solve_ivp(newton, (0, times[-1]), [*position, *speed], t_eval=times, **options).y.T
    assert_allclose(state_of(path[:8], angles), inertial, atol=2e-11)
    u0, w0 = path[:4], path[4:8]
    assert abs(path[:8, -1] - path[:8, 0]).max() > 0.05
    size = (u0**2).sum(0) + (w0**2).sum(0)
    assert_allclose(
        -1 / size, (inertial[:, 3:] ** 2).sum(1) / 2 - 1 / np.linalg.norm(inertial[:, :3], axis=1), atol=1e-11
    )


def test_without_thrust_the_elements_and_q_are_constant():
    no_thrust = dict.fromkeys(force, 0)
    assert all(part.subs(no_thrust).is_zero_matrix for part in sapunkov.element_rates())
    assert sapunkov.size_rate().subs(no_thrust) == 0
