"""Switched flows: arcs, switches, and the jumps of the derivatives."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.averaging.exact.arcs import switched_ends, switched_flow
from pontryagin.averaging.exact.modes import modal

x, v, p, q, t = sp.symbols("x v p q t", real=True)


def test_the_least_time_oscillator_is_the_known_one():
    """x'' = -x + sign(sin(t + 1)), whose solution between switches is a circle about +1 or -1."""
    (force,), modes = modal([sp.sign(sp.sin(t + 1))])
    follow = switched_flow(modes, [x, v], [v, -x + force], clock=t)
    grid = np.linspace(0.0, 7.0, 29)
    path = follow([0.3, -0.4], grid)
    z, now, centre = 0.3 + 0.4j, 0.0, 1.0  # x - i v turns by exp(i t)
    expected = []
    switches = np.pi * np.arange(1, 6) - 1
    for time in grid:
        while len(switches) and switches[0] < time:
            z = centre + (z - centre) * np.exp(1j * (switches[0] - now))
            now, centre, switches = switches[0], -centre, switches[1:]
        reached = centre + (z - centre) * np.exp(1j * (time - now))
        expected.append([reached.real, -reached.imag])
    assert_allclose(path, expected, atol=1e-11)


def test_derivatives_jump_at_the_switches():
    rates, modes = modal([v, -x + sp.sign(p), q, -p])
    carry = switched_ends(modes, [x, v, p, q], rates, wrt=[p, q])
    start, step = np.array([1.0, 0.0, 0.7, 0.4]), 1e-6
    _, slopes = carry([start], 0.0, 9.0)
    for i in (2, 3):
        shift = step * np.eye(4)[i]
        (above, below), _ = carry([start + shift, start - shift], 0.0, 9.0)
        assert_allclose(slopes[0, :, i - 2], (above - below) / (2 * step), rtol=0, atol=1e-7)
    assert np.abs(slopes[0, :2]).max() > 0.1


def test_a_bounded_quadratic_control_bends_without_a_jump():
    cut = sp.Piecewise((p / 2, sp.Abs(p) <= 1), (sp.sign(p) / 2, True))
    rates, modes = modal([v, cut, q, -p])
    assert len(modes) == 2
    carry = switched_ends(modes, [x, v, p, q], rates, wrt=[p])
    smooth = switched_flow(modes, [x, v, p, q], rates)
    (ends,), (slopes,) = carry([[0.0, 0.0, 2.0, 0.3]], 0.0, 7.0)
    assert_allclose(smooth([0.0, 0.0, 2.0, 0.3], [0.0, 3.0, 7.0])[-1], ends, atol=1e-11)
    phases, size = np.linspace(0, 7, 100001), np.hypot(2.0, 0.3)
    costate = size * np.cos(phases - np.arctan2(0.3, 2.0))
    assert_allclose(ends[1], np.trapezoid(np.clip(costate / 2, -0.5, 0.5), phases), atol=1e-9)
    inside = np.abs(costate) <= 1
    assert_allclose(slopes[1, 0], np.trapezoid(np.where(inside, np.cos(phases) / 2, 0), phases), atol=1e-4)


def test_modes_reproduce_what_they_replace():
    expressions = [
        sp.Max(x, v, p),
        sp.Min(x, -v),
        sp.Piecewise((x**2, sp.Abs(x) > v), (v**2, True)),
        x / sp.sqrt(x**2 + sp.Abs(v)),
    ]
    rewritten, modes = modal(expressions)
    rng = np.random.default_rng(5)
    for values in rng.standard_normal((20, 3)):
        table = dict(zip((x, v, p), map(sp.Float, values), strict=True))
        signs = {}
        for mode, switching in modes:
            signs[mode] = sp.sign(switching.subs(signs).subs(table))
        for before, after in zip(expressions, rewritten, strict=True):
            assert abs(after.subs(signs).subs(table) - before.subs(table)) < 1e-12


def test_alternatives_of_three_are_refused():
    with pytest.raises(ValueError, match="two branches that one inequality decides"):
        modal([sp.Piecewise((1, x < 0), (2, x < 1), (3, True))])
