"""The reduction to moments: kinematics, propagation and the dual bounds, against independent numerics."""

from functools import cache

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from independent import grid_impulse, grid_peak
from pontryagin.triple_integrator.derivation import channel, duality, model
from pontryagin.triple_integrator.derivation.channel import tau
from pontryagin.triple_integrator.derivation.model import T, s

R = sp.Rational


def integrated(state, duration, program, force):
    """The state of the channel under a control and a disturbance, by SciPy."""
    u, f = sp.lambdify(tau, program), sp.lambdify(tau, force)

    def rates(t, x):
        return [x[1], x[2] + f(t), u(t)]

    return solve_ivp(rates, (0, duration), state, rtol=1e-11, atol=1e-12, max_step=duration / 20).y[:, -1]


@cache
def on_a_grid(moments):
    """Least peak and least total impulse on grids of unit time, by HiGHS."""
    return grid_peak(moments, cells=200), grid_impulse(moments, cells=2000)


def test_a_rotation_keeps_lengths_its_axis_and_composes():
    angle, other = sp.symbols("p q", real=True)
    axis = sp.Matrix([R(2, 3), -R(1, 3), R(2, 3)])
    turn = channel.rotation(angle, axis)
    assert sp.simplify(turn.T * turn) == sp.eye(3)
    assert sp.simplify(turn * axis) == axis
    both = turn * channel.rotation(other, axis) - channel.rotation(angle + other, axis)
    assert both.applyfunc(sp.expand).applyfunc(sp.expand_trig).applyfunc(sp.simplify) == sp.zeros(3)


def test_the_rate_of_rotation_is_the_rate_of_the_angle():
    """(0.1): the angular rate is the rate of the angle."""
    assert channel.rate_of_rotation() == channel.gamma(channel.t).diff(channel.t)


def test_eulers_equation_couples_one_channel_to_the_rates_of_the_others():
    """(0.3): the cross-coupling joins the disturbances."""
    applied, external = sp.symbols("M d")
    j1, j2, j3 = sp.symbols("J_1:4", positive=True)
    w2, w3 = sp.symbols("omega_2:4", real=True)
    expected = (applied + external + (j2 - j3) * w2 * w3) / j1
    assert sp.expand(channel.euler_acceleration(applied, external) - expected) == 0


@pytest.mark.parametrize("program", [sp.S.Zero, sp.Integer(3), 2 - 5 * tau + tau**3])
@pytest.mark.parametrize("force", [sp.S.Zero, R(1, 2) - 3 * tau**2])
def test_driving_is_integrating_the_state_equations(program, force):
    """(0.6) and (1.1) against SciPy's integration."""
    start = sp.Matrix([R(1, 2), -1, 2])
    end = channel.drive(start, R(3, 2), program, force)
    reference = integrated([0.5, -1, 2], 1.5, program + 0 * tau, force + 0 * tau)
    assert_allclose(np.array(end, dtype=float).ravel(), reference, rtol=1e-8)


def test_driving_is_causal_and_stops_where_it_is_taken_up_again():
    program = 1 + tau
    start = sp.Matrix([1, 2, 3])
    halfway = channel.drive(start, R(1, 3), program)
    resumed = channel.drive(halfway, R(2, 3), program.subs(tau, tau + R(1, 3)))
    assert resumed == channel.drive(start, sp.S.One, program)


def test_a_kick_moves_only_the_third_state():
    """(0.4): an impulse of the control is a jump of the torque."""
    state = sp.Matrix(sp.symbols("x y z"))
    assert channel.kick(state, 5) - state == sp.Matrix([0, 0, 5])


def test_the_transition_matrix_composes():
    """(1.4): Phi(a) Phi(b) = Phi(a + b)."""
    a, b = sp.symbols("a b")
    product = model.transition(a) * model.transition(b) - model.transition(a + b)
    assert product.applyfunc(sp.expand) == sp.zeros(3)


def test_the_required_moments_are_those_of_any_control_that_gets_there():
    """(1.6), (1.7), (1.9) and (1.10), and (1.8) for the disturbance."""
    program = sp.symbols("u_0") + sp.symbols("u_1") * tau + sp.symbols("u_2") * tau**4
    force = sp.symbols("f_0") + sp.symbols("f_1") * tau
    end = channel.drive(channel.initial, T, program, force)
    needed = channel.required_moments(force).subs(dict(zip(channel.final, end, strict=True)))
    moments = model.moments_of(program.subs(tau, T - s))
    assert (needed - moments).applyfunc(sp.expand) == sp.zeros(3, 1)


def test_the_transfer_meets_both_ends():
    """(0.2) and (0.5), which are (0.8) and (0.9), as vectors (1.2)."""
    path = channel.transfer(sp.Symbol("f"))
    assert (path.subs(tau, 0) - channel.initial).applyfunc(sp.simplify) == sp.zeros(3, 1)
    assert (path.subs(tau, T) - channel.final).applyfunc(sp.simplify) == sp.zeros(3, 1)


@pytest.mark.parametrize(
    "coefficients", [(1, 0, 0), (2, -1, R(3, 16)), (-3, 1, 1), (0, 2, -1), (0, 0, -2), (4, -5, R(1, 2))]
)
def test_peak_and_area_of_a_quadratic_are_those_of_a_fine_sampling(coefficients):
    """The norms of the dual problems (3.1), (3.2) and (4.1)."""
    h = duality.dual_function_of(sp.Matrix(coefficients))
    grid = np.linspace(0, 1.5, 300_001)
    values = np.abs(np.polyval([float(coefficients[0]) / 2, *map(float, coefficients[1:])], grid))
    assert_allclose(float(duality.peak_of(h, R(3, 2))), values.max(), rtol=1e-9)
    assert_allclose(float(duality.area_of(h, R(3, 2))), np.trapezoid(values, grid), rtol=1e-8)


def test_the_zeros_of_a_dual_function_are_where_they_were_put():
    h = duality.dual_function_of(duality.root_multipliers(R(1, 3), R(3, 4)))
    assert set(sp.real_roots(h)) == {R(1, 3), R(3, 4)}


CASES = [(1, 0, 0), (0, 0, 1), (R(1, 3), -R(1, 5), R(2, 7)), (-1, R(1, 2), 2)]


@pytest.mark.parametrize("moments", CASES)
@pytest.mark.parametrize("multipliers", [(1, -R(1, 2), R(3, 32)), (0, 0, 1), (3, -1, R(1, 7))])
def test_no_dual_function_bounds_more_than_the_best_control_on_a_grid(moments, multipliers):
    """(1.13): no h with l'c = 1 proves more than the least norm."""
    c, l = sp.Matrix(moments), sp.Matrix(multipliers)
    peak, impulse = on_a_grid(tuple(float(m) for m in moments))
    assert float(duality.peak_bound(l, c, sp.S.One)) <= peak + 1e-6
    assert float(duality.impulse_bound(l, c, sp.S.One)) <= impulse + 1e-9


def test_the_bounds_of_the_unit_turn_are_tight():
    assert_allclose(on_a_grid((1.0, 0, 0)), [32, 16], rtol=1e-9)
    turn = sp.Matrix([1, 0, 0])
    assert duality.peak_bound(sp.Matrix([1, -R(1, 2), R(3, 32)]), turn, sp.S.One) == 32
    assert duality.impulse_bound(sp.Matrix([16, -8, 1]), turn, sp.S.One) == 16


@pytest.mark.parametrize("q", [sp.S.One, R(3, 2), sp.S(2), sp.S(3), sp.oo])
def test_the_conjugate_norm_is_the_norm(q):
    """The norms of (1.18), (1.19) and (1.20), and two between them."""
    values = {duality.levels[0]: -2, duality.levels[1]: R(3, 2)}
    values |= {duality.lengths[0]: R(1, 4), duality.lengths[1]: 2}
    u, n = np.array([-2, 1.5]), np.array([0.25, 2])
    expected = np.abs(u).max() if q == sp.oo else (n @ np.abs(u) ** float(q)) ** (1 / float(q))
    assert_allclose(float(duality.conjugate_norm(q).subs(values)), expected, rtol=1e-12)
