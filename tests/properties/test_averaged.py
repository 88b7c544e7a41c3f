"""Invariances of averaged problems and of their exact extremals: units, origin of the phase, coordinates."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.averaging import (
    PhaseSystem,
    Quadratic,
    kepler,
    rotor,
    smooth_example,
    solve_averaged,
    spin_down,
)

a, b, x, u, v = sp.symbols("a b x u v", real=True)
SHIFT, MONEY, PACE, CLOCK = sp.symbols("shift money pace clock", real=True)
X, V = sp.symbols("x v")
MASS, POTENTIAL, FORCE = 1 + sp.cos(X) / 3, -sp.cos(X + 1) / 2, sp.sin(X) - V / 5
CHANGES = {"exchanged": [[0, 1], [1, 0]], "sheared": [[1, 1], [sp.Rational(-1, 2), 1]]}
EPSILON = 0.1
some, few = settings(max_examples=5), settings(max_examples=2)
positive = st.floats(0.2, 5.0)
begins = st.tuples(st.floats(0.5, 3.0), st.floats(0.5, 3.0)).map(np.array)
phases = st.floats(-3.0, 3.0)


def rates(a, b, x):
    """The rates of both slow variables."""
    return sp.Matrix([u * (2 + sp.cos(x)) - a / 5, v + a / 4 + sp.sin(x) * u])


def pair(shift=0.0, money=1.0, pace=1.0, clock=1.0):
    """A system whose numbers move the origin of the phase and change the units of the cost and of times."""
    return PhaseSystem(
        list(PACE * rates(a, b, x + SHIFT)),
        CLOCK * (1 + a**2 / 9),
        Quadratic(MONEY * PACE),
        slow=[a, b],
        control=[u, v],
        phase=x,
        target=[a - 2, b - sp.Rational(3, 2)],
        running_cost=MONEY * PACE * (1 + b**2 / 8),
        numbers={SHIFT: shift, MONEY: money, PACE: pace, CLOCK: clock},
    )


@cache
def reworded(name):
    """The system of `pair` in other slow variables M (a, b), or with the phase reversed; and M."""
    M = sp.Matrix(CHANGES.get(name, [[1, 0], [0, 1]]))
    first, second = M.inv() * sp.Matrix([a, b])
    system = PhaseSystem(
        list(M * rates(first, second, -x if name == "reversed" else x)),
        1 + first**2 / 9,
        Quadratic(),
        slow=[a, b],
        control=[u, v],
        phase=x,
        target=[first - 2, second - sp.Rational(3, 2)],
        running_cost=1 + second**2 / 8,
    )
    return system, np.array(M, dtype=float)


def ends_of(solution, **given):
    """The costs of the exact extremals."""
    return np.array([one.cost for one in solution.exact(EPSILON, **given)])


@some
@given(begins, phases, positive, positive, positive)
def test_units_of_cost_and_time_and_the_origin_of_the_phase(start, shift, money, pace, clock):
    base = solve_averaged(pair(), start)
    other = solve_averaged(pair(shift, money, pace, clock), start)
    assert base.certificate.holds() and other.certificate.holds()
    assert_allclose(other.cost, money * base.cost, rtol=1e-10, atol=1e-13)
    assert_allclose(other.duration, base.duration / pace, rtol=1e-9, atol=1e-13)
    share = np.array([0.3, 0.8])
    assert_allclose(other.slow(share * other.duration), base.slow(share * base.duration), atol=1e-9)
    assert_allclose(
        other.costate(share * other.duration), money * base.costate(share * base.duration), atol=1e-8 * money
    )


@few
@given(phases, positive, positive)
def test_exact_extremals_in_other_units_and_from_another_origin(shift, money, pace):
    """The phase counts from `shift`; rates that are `pace` as large take an epsilon that is as small."""
    base = solve_averaged(pair(), [1.0, 1.0]).exact(EPSILON, phase=0.4)
    found = solve_averaged(pair(shift, money, pace), [1.0, 1.0]).exact(EPSILON / pace, phase=0.4 - shift)
    assert_allclose([one.cost / money for one in found], [one.cost for one in base], rtol=1e-8)
    assert_allclose([one.duration * pace for one in found], [one.duration for one in base], rtol=1e-6)
    assert [one.kind for one in found] == [one.kind for one in base]


@some
@given(st.floats(1.02, 3.0), st.floats(0.0, 0.9), st.floats(-1.3, 0.0), phases)
def test_exact_extremals_are_minima_and_maxima_in_turn(v1, ripple, decade, phase):
    """J grows without limit as the duration vanishes and as it grows: a minimum is the first extremal."""
    found = smooth_example(1.0, v1, ripple=ripple).exact(10.0**decade, phase=phase)
    in_turn = sorted(found, key=lambda one: one.ending_anomaly)
    assert all(one.certificate.holds() for one in found)
    if found.traced.limits[0] == "start":
        assert in_turn[0].kind == "minimum"
    assert all(one.kind != other.kind for one, other in pairwise(in_turn))
    assert all((one.cost < other.cost) == (one.kind == "minimum") for one, other in pairwise(in_turn))


@few
@given(phases, st.sampled_from([-3, 1, 40]))
def test_whole_turns_of_the_initial_phase_change_nothing(phase, turns):
    base = smooth_example(1.0, 2.0, ripple=0.5)
    assert_allclose(ends_of(base, phase=phase + turns * 2 * np.pi), ends_of(base, phase=phase), rtol=1e-9)


@pytest.mark.parametrize("name", [*CHANGES, "reversed"])
@some
@given(start=begins)
def test_the_names_of_slow_variables_and_the_sense_of_the_phase(name, start):
    system, matrix = reworded(name)
    base, other = solve_averaged(pair(), start), solve_averaged(system, matrix @ start)
    assert_allclose(other.cost, base.cost, rtol=1e-10, atol=1e-13)
    share = np.array([0.0, 0.5, 1.0])
    assert_allclose(
        other.slow(share * other.duration), base.slow(share * base.duration) @ matrix.T, atol=1e-9
    )
    assert_allclose(
        other.costate(share * other.duration) @ matrix, base.costate(share * base.duration), atol=1e-8
    )


@some
@given(begins, st.floats(0.02, 0.98))
def test_the_rest_of_an_extremal_is_an_extremal(start, share):
    """Bellman: from a point on the way the cost is what is left of it."""
    base = solve_averaged(pair(), start)
    tau = share * base.duration
    rest = solve_averaged(pair(), base.slow(tau)[0])
    assert_allclose(rest.duration, base.duration - tau, atol=1e-9)
    assert_allclose(rest.costate(0.0)[0], base.costate(tau)[0], atol=1e-7)


@some
@given(st.lists(st.tuples(begins, positive, positive), min_size=2, max_size=4))
def test_a_stack_is_its_members(members):
    starts, money, pace = (np.array(column) for column in zip(*members, strict=True))
    together = solve_averaged(pair(0.0, money, pace), starts)
    for i, (start, price, rate) in enumerate(members):
        alone = solve_averaged(pair(0.0, price, rate), start)
        assert_allclose(together.cost[i], alone.cost, rtol=1e-11, atol=1e-13)
        assert_allclose(together.costate(np.zeros((len(members), 1)))[i], alone.costate(0.0), atol=1e-8)


@some
@given(
    st.tuples(st.floats(0.1, 2), st.floats(-2, 2), st.floats(0.1, 2)),
    st.tuples(*[st.floats(0.1, 3)] * 3),
    st.floats(0.2, 1.9).filter(lambda d: abs(d - 1) > 0.05),
    positive,
    phases,
)
def test_the_body_stops_alike_in_other_units_turned_exchanged_and_reversed(w, axes, ratio, factor, angle):
    w, axes = np.array(w), np.array(axes)
    base = spin_down(w, axes, ratio)
    turned = [np.cos(angle) * w[0] - np.sin(angle) * w[1], np.sin(angle) * w[0] + np.cos(angle) * w[1], w[2]]
    for other, unit in (
        (spin_down(factor * w, factor**2 * axes, ratio), factor),
        (spin_down(turned, axes, ratio), 1.0),
        (spin_down(w[[1, 0, 2]], axes[[1, 0, 2]], ratio), 1.0),
        (spin_down(w * [1, 1, -1], axes, ratio), 1.0),
    ):
        assert_allclose(other.duration, base.duration / unit, rtol=1e-10)
        assert other.certificate.holds()


@pytest.mark.slow
@settings(max_examples=3)
@given(st.floats(0.5, 2.0))
def test_exact_extremals_of_orbits_and_bodies_scale_with_their_units(s):
    """Energies grow by s, momenta fall by its root, thrust grows by s^2: the cost grows by s^(5/2)."""
    orbit = kepler(-0.5, 0.95, -0.35, 0.1)
    smaller = kepler(-0.5 * s, 0.95 / np.sqrt(s), -0.35 * s, 0.1 * s**4)
    assert_allclose(ends_of(smaller) / s**2.5, ends_of(orbit), rtol=1e-8)
    w, axes = np.array([0.3, 0.4, 1.2]), np.array([1.0, 0.5, 0.4])
    body, faster = (spin_down(k * w, k**2 * axes, 0.6) for k in (1.0, s))
    assert_allclose(ends_of(faster) * s, ends_of(body), rtol=1e-8)


@pytest.mark.slow
@settings(max_examples=3)
@given(st.floats(0.5, 2.0), st.floats(-1.0, 1.0), phases)
def test_a_rotor_in_other_units_from_another_level_and_another_origin(scale, level, shift):
    base = rotor(1.0, 3.0, MASS, POTENTIAL, FORCE, peak=0.8)
    moved = {X: X + shift}
    parts = [scale * e.subs(moved) for e in (MASS, POTENTIAL + level, FORCE)]
    other = rotor(scale * (1.0 + level), scale * (3.0 + level), *parts, peak=0.8 * scale)
    assert_allclose(other.duration, base.duration, rtol=1e-10)
    assert_allclose(
        other.slow(0.5 * other.duration) / scale - level, base.slow(0.5 * base.duration), rtol=1e-9
    )
