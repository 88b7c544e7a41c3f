"""Arcs between switches, on problems whose switch times and derivatives are known in closed form."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.errors import NotConverged
from pontryagin.numerics.arcs import Arc, SwitchedFlow, follow, follow_on_grid, places, sample
from pontryagin.numerics.equations import Kernel
from pontryagin.numerics.flow import integrator
from pontryagin.numerics.symbolic import Symbolic

x, v, u = sp.symbols("x v u", real=True)


def relay():
    """x'' = -u with u the sign of x: one system with a parameter that changes its sign at every event."""
    system = Symbolic((x, v), (v, -u), (u,), wrt=(x, v), event_functions=(-u * x,))
    along = integrator(system)
    return SwitchedFlow(lambda sign: Arc(along, (sign,)), lambda sign, _: -sign, jumps=True)


def start(flow, mode, state):
    """A state with the identity of its derivatives."""
    return np.append(state, flow.arc(mode).integrator.equations.identity)


def test_a_relay_oscillator_switches_every_half_period():
    """From rest at x0 the first switch is after sqrt(2 x0), the others every 2 sqrt(2 x0)."""
    flow, x0 = relay(), 0.8
    pieces, last = follow(flow, start(flow, 1.0, [x0, 0.0]), 1.0, 0.0, 10.0)
    quarter = np.sqrt(2 * x0)
    begins = np.array([piece.begin for piece in pieces])
    assert_allclose(begins[1:], quarter * np.arange(1, 2 * len(pieces) - 2, 2), rtol=1e-12)
    assert [piece.mode for piece in pieces] == [(-1.0) ** i for i in range(len(pieces))]
    assert len(pieces) == 1 + int((10.0 / quarter + 1) / 2)

    def end(a):
        """State at time 10 from rest at a, in closed form by the period."""
        q = np.sqrt(2 * a)
        s, sign = (10.0 + q) % (4 * q) - q, 1.0
        if s > q:
            s, sign = s - 2 * q, -1.0
        return sign * np.array([a - s * s / 2, -s])

    assert_allclose(last[:2], end(x0), atol=1e-12)
    step = 1e-6
    by_x0 = (end(x0 + step) - end(x0 - step)) / (2 * step)
    assert_allclose(last[2:].reshape(2, 2)[:, 0], by_x0, atol=1e-8)


def test_both_ways_to_sample_agree_with_the_parabolas():
    flow, x0 = relay(), 0.5
    times = np.linspace(0.0, 4.0, 41)  # the grid holds the switches at 1 and 3
    s = (times + 1) % 4 - 1
    s, sign = np.where(s > 1, s - 2, s), np.where(s > 1, -1.0, 1.0)
    expected = np.stack([sign * (0.5 - s * s / 2), -sign * s], axis=1)
    assert_allclose(follow_on_grid(flow, start(flow, 1.0, [x0, 0.0]), 1.0, times), expected, atol=1e-12)
    pieces, _ = follow(flow, start(flow, 1.0, [x0, 0.0]), 1.0, 0.0, 4.0)
    shuffled = np.random.default_rng(2).permutation(len(times))
    assert_allclose(sample(flow, pieces, times[shuffled]), expected[shuffled], atol=1e-12)
    assert places(pieces, np.array([0.0, 0.9, 1.1, 3.9])).tolist() == [0, 0, 1, 2]


def test_an_oscillator_that_runs_backwards_is_where_it_began():
    flow = relay()
    pieces, last = follow(flow, start(flow, 1.0, [0.8, 0.3]), 1.0, 0.0, 7.0)
    _, back = follow(flow, start(flow, pieces[-1].mode, last[:2]), pieces[-1].mode, 7.0, 0.0)
    assert_allclose(back[:2], [0.8, 0.3], atol=1e-12)
    assert_allclose(back[2:].reshape(2, 2) @ last[2:].reshape(2, 2), np.eye(2), atol=1e-10)


def bang_bang():
    """Least time to rest at 0 for x'' = u, |u| <= 1: u = -1 above the curve x = -v|v|/2, then +1."""
    names = ("x", "v")
    braking = Kernel(names, lambda of, t, z, p: [z[1], -1.0 + 0.0 * z[1]], 0, (0, 1), (curve,))
    final = Kernel(names, lambda of, t, z, p: [z[1], 1.0 + 0.0 * z[1]], 0, (0, 1))
    arcs = {name: Arc(integrator(system), ()) for name, system in (("-", braking), ("+", final))}
    return SwitchedFlow(arcs.__getitem__, lambda mode, event: "+", jumps=True)


def curve(of, t, z, p):
    """Event function v^2/2 - x; it is negative before the switching curve x = v^2/2 with v < 0."""
    return z[1] * z[1] / 2 - z[0]


def test_the_double_integrator_switches_where_the_curve_is_met():
    """From rest at x0 the switch is at sqrt(x0); each mode has a kernel of its own."""
    flow, x0 = bang_bang(), 1.3
    pieces, last = follow(flow, start(flow, "-", [x0, 0.0]), "-", 0.0, 2 * np.sqrt(x0))
    assert [piece.mode for piece in pieces] == ["-", "+"]
    assert_allclose(pieces[1].begin, np.sqrt(x0), rtol=1e-14)
    assert_allclose(last[:2], 0.0, atol=1e-14)
    # With t1 = sqrt(x0): v(T) = T - 2 t1, dx(T)/dx0 = 1 - 2 (T - t1) dt1/dx0, which vanishes at T = 2 t1.
    by_x0 = [0.0, -1.0 / np.sqrt(x0)]
    assert_allclose(last[2:].reshape(2, 2)[:, 0], by_x0, atol=1e-12)


def test_a_tangency_is_no_switch_to_differentiate():
    """x reaches 0 at a speed of 0.14, below the grazing limit of 0.2; short steps do not skip the event."""
    flow = SwitchedFlow(
        lambda mode: Arc(integrator(Kernel(("x", "v"), gravity, 0, (0,), (height,))), (), 0.1),
        lambda mode, event: mode + 1,
        jumps=True,
        grazing=0.2,
    )
    touch = start(flow, 0, [0.49, -1.0])
    with pytest.raises(NotConverged, match="touches zero without crossing"):
        follow(flow, touch, 0, 0.0, 3.0)
    clear = start(flow, 0, [0.5 + 1e-3, -1.0])
    assert len(follow(flow, clear, 0, 0.0, 3.0)[0]) == 1


def gravity(of, t, z, p):
    return [z[1], 1.0 + 0.0 * z[1]]


def height(of, t, z, p):
    return -z[0]


def test_switches_without_end_are_given_up():
    flow = relay()
    few = SwitchedFlow(flow.arc, flow.following, jumps=True, most=5)
    quarter = np.sqrt(2 * 0.01)
    fifth, sixth = 9 * quarter, 11 * quarter
    whole, between = start(flow, 1.0, [0.01, 0.0]), (fifth + sixth) / 2
    assert len(follow(few, whole, 1.0, 0.0, between)[0]) == 6, "five switches are allowed"
    assert follow_on_grid(few, whole, 1.0, np.array([0.0, between])).shape == (2, 2)
    with pytest.raises(NotConverged, match="switches more than 5 times") as held:
        follow(few, start(flow, 1.0, [0.01, 0.0]), 1.0, 0.0, 50.0)
    assert_allclose(held.value.residual, 50 - sixth, rtol=1e-12)
    with pytest.raises(NotConverged, match="switches more than 5 times") as held:
        follow_on_grid(few, start(flow, 1.0, [0.01, 0.0]), 1.0, np.array([0.0, 1e-9, 50.0]))
    assert_allclose(held.value.residual, 50 - sixth, rtol=1e-12)
