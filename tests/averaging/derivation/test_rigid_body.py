"""The braking of a rigid body: averages, controls on the ellipsoid and on the cylinder."""

from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.special import ellipe

from pontryagin.averaging.claims import rigid_ellipsoid
from pontryagin.averaging.derivation import rigid_body

AXES = st.floats(0.2, 5.0)


LX, LY = 1.0, 0.5


RATE = 0.7709822125950  # (2/pi) E, the complete elliptic integral, at the parameter 3/4


def body(ratio, control, epsilon, inertia=None):
    """Right-hand side of Euler's equations, from the derivation; control is a function of (w, t)."""
    moments = dict(zip(rigid_body.moments, inertia or (1, 1, ratio), strict=True))
    rates = rigid_body.euler_rates().subs(moments).subs(rigid_body.epsilon, epsilon)
    compiled = sp.lambdify([list(rigid_body.w), list(rigid_body.u)], list(rates))
    return lambda t, w: compiled(w, control(w, t))


def time_to_stop(ratio, control, epsilon, start, level, inertia=None, limit=5.0):
    """Slow time at which the variable a first falls to a level."""

    def low(t, w):
        return np.hypot(w[0], w[1]) - level

    low.terminal = True
    right = body(ratio, control, epsilon, inertia)
    flight = solve_ivp(right, (0, limit / epsilon), start, events=low, rtol=1e-9, atol=1e-11)
    assert flight.t_events[0].size == 1
    return epsilon * flight.t_events[0][0]


def braking(lx, ly, power=2):
    """The braking control as a feedback on w; power 1 gives the printed one."""

    def control(w, t):
        r = np.hypot(lx * w[0], ly * w[1])
        return -(lx**power) * w[0] / r, -(ly**power) * w[1] / r, 0.0

    return control


@pytest.mark.parametrize(
    ("lx", "ly"), [(1.0, 1.0), (1.0, 0.5), (0.7, 3.1), (2.5, 2.4), (0.2, 5.0), (5.0, 0.2)]
)
def test_mean_deceleration_is_the_quadrature_of_its_definition(lx, ly):
    values = {rigid_body.lx: lx, rigid_body.ly: ly}
    R = sp.lambdify(rigid_body.psi, rigid_body.deceleration().subs(values))
    expected = quad(R, 0, np.pi / 2, epsabs=1e-12, epsrel=1e-12)[0] * 2 / np.pi
    for form in (rigid_body.mean_deceleration(), rigid_body.mean_deceleration_turned()):
        assert_allclose(float(sp.re(form.subs(values).evalf())), expected, rtol=1e-10)
    k = 1 - ly**2 / lx**2
    printed = ellipe(k) if k >= 0 else np.sqrt(1 - k) * ellipe(k / (k - 1))
    assert_allclose(2 * lx / np.pi * printed, expected, rtol=1e-10)


@given(AXES, AXES, AXES, st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))
def test_the_maximiser_on_the_ellipsoid_beats_its_other_points(lx, ly, lz, x, y, z):
    s = sp.Matrix([x, y, z])
    if s.norm() < 1e-3:
        return
    values = dict(zip(rigid_body.semiaxes, (lx, ly, lz), strict=True))
    best = rigid_body.ellipsoid_maximiser(s).subs(values)
    support = float(rigid_body.ellipsoid_support(s).subs(values))
    assert_allclose(float(rigid_body.in_ellipsoid(best).subs(values)), 1, rtol=1e-12)
    assert_allclose(float(best.dot(s)), support, rtol=1e-12)
    directions = np.random.default_rng(0).normal(size=(50, 3))
    others = directions / np.linalg.norm(directions, axis=1)[:, None] * [lx, ly, lz]
    assert (others @ [x, y, z] <= support * (1 + 1e-12)).all()


def test_braking_takes_the_averaged_time_within_order_epsilon_and_the_printed_control_does_not():
    errors = []
    for epsilon in (0.04, 0.01):
        time = time_to_stop(1.6, braking(LX, LY), epsilon, [0.6, 0.8, 2.0], 0.05)
        errors.append(abs(time - (1 - 0.05) / RATE))
        assert errors[-1] < epsilon
    printed = time_to_stop(1.6, braking(LX, LY, power=1), 0.01, [0.6, 0.8, 2.0], 0.05)
    # The printed control leaves the ellipsoid where w is along y, and so is faster than any admissible one.
    w = np.array([0.0, 1.0, 2.0])
    assert sum((np.array(braking(LX, LY, power=1)(w, 0))[:2] / [LX, LY]) ** 2) == pytest.approx(4)
    assert printed < (1 - 0.05) / RATE - 0.2


@pytest.mark.parametrize("epsilon", [0.3, 0.05])
def test_the_cylinder_solution_is_exact_for_every_epsilon(epsilon):
    l, h, (a0, a1), (c0, c1) = 2.0, 0.5, (1.0, 2.5), (0.25, -0.25)
    times = abs(a1 - a0) / l, abs(c1 - c0) / h
    tau1 = max(times)
    jump = (tau1 + (a1 - a0) / l) / 2

    def control(w, t):
        size = np.hypot(w[0], w[1])
        sign = 1 if epsilon * t < jump else -1
        return l * sign * w[0] / size, l * sign * w[1] / size, -h

    w = np.array([a0 * 0.6, a0 * 0.8, c0])
    for stretch in ((0, jump), (jump, tau1)):
        span = np.array(stretch) / epsilon
        inner = lambda state, t, span=span: control(state, min(t, np.nextafter(span[1], 0)))  # noqa: E731
        w = solve_ivp(body(0.7, inner, epsilon), span, w, rtol=1e-11, atol=1e-12).y[:, -1]
    assert times == (0.75, 1.0)
    assert_allclose([np.hypot(w[0], w[1]), w[2]], [a1, c1], atol=1e-8)


@cache
def slow_rates():
    return sp.lambdify([*rigid_body.u, rigid_body.psi], list(rigid_body.slow_rates()))


@given(st.floats(0, 1), st.floats(0, 2 * np.pi), st.floats(0, 2 * np.pi), AXES, AXES)
def test_no_control_of_the_cylinder_moves_a_or_c_faster(share, heading, phase, l, h):
    control = l * share * np.cos(heading), l * share * np.sin(heading), h * (2 * share - 1)
    rate_a, rate_c = slow_rates()(*control, phase)
    assert abs(rate_a) <= l * (1 + 1e-12) and abs(rate_c) <= h * (1 + 1e-12)
    best = l * np.cos(phase), l * np.sin(phase), -h
    assert_allclose(slow_rates()(*best, phase), [l, -h])


def test_a_nearly_symmetric_body_follows_the_averages_within_order_epsilon():
    errors = []
    for epsilon in (0.08, 0.02):
        inertia = (1 + epsilon, 1 - epsilon, 1.6)
        time = time_to_stop(1.6, braking(LX, LY), epsilon, [0.6, 0.8, 2.0], 0.2, inertia)
        errors.append(abs(time - 0.8 / RATE))
        assert errors[-1] < 2 * epsilon
    fixed = [
        time_to_stop(None, braking(1.0, 1.0), epsilon, [0.1, 0.0, 1.0], 1e-3, (1, 1.2, 0.5))
        for epsilon in (4e-3, 1e-3)
    ]
    assert_allclose(fixed, 0.0871, atol=0.004)
    assert max(fixed) < 0.1 * 0.95


def test_the_printed_synthesis_leaves_the_ellipsoid_on_either_side():
    inside = rigid_body.in_ellipsoid(rigid_ellipsoid.BRAKING).subs({rigid_body.w[0]: 1, rigid_body.w[1]: 0})
    assert inside == 1 / rigid_body.lx**2
