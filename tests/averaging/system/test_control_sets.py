"""Support functions compared with maxima over the sets, and invalid sets that are refused."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.averaging import (
    Ball,
    BoundedQuadratic,
    Box,
    Custom,
    Ellipsoid,
    PhaseSystem,
    Quadratic,
    solve_averaged,
)

S = sp.symbols("s_1:4", real=True)
R = sp.Matrix([[2, 1, 0], [1, 3, 0], [0, 0, 1]])
SETS = {
    "quadratic": Quadratic(),
    "weighted": Quadratic(R),
    "ball": Ball(sp.Rational(3, 2)),
    "ellipsoid": Ellipsoid([1, 2, sp.Rational(1, 2)]),
    "box": Box([1, 2, sp.Rational(1, 2)]),
    "bounded": BoundedQuadratic(sp.Rational(3, 2), sp.Rational(1, 2)),
    "cylinder": Custom(lambda s: 2 * sp.sqrt(s[0] ** 2 + s[1] ** 2) + sp.Abs(s[2])),
}
directions = st.lists(st.floats(-4, 4).map(lambda x: round(x, 3)), min_size=3, max_size=3).filter(
    lambda s: min(map(abs, s)) > 0.01
)


def belongs(name, u):
    return {
        "quadratic": True,
        "weighted": True,
        "ball": np.linalg.norm(u) <= 1.5 + 1e-12,
        "ellipsoid": np.sum((u / [1, 2, 0.5]) ** 2) <= 1 + 1e-12,
        "box": bool(np.all(np.abs(u) <= np.array([1, 2, 0.5]) + 1e-12)),
        "bounded": np.linalg.norm(u) <= 1.5 + 1e-12,
        "cylinder": np.hypot(u[0], u[1]) <= 2 + 1e-12 and abs(u[2]) <= 1 + 1e-12,
    }[name]


def price(name, u):
    weight = {"quadratic": np.eye(3), "weighted": np.array(R, dtype=float), "bounded": np.eye(3) / 2}
    return u @ weight[name] @ u if name in weight else 0.0


@pytest.mark.slow
@pytest.mark.parametrize("name", SETS)
@given(s=directions, seed=st.integers(0, 10_000))
def test_the_maximiser_belongs_to_the_set_attains_the_support_and_nothing_does_better(name, s, seed):
    at = dict(zip(S, s, strict=True))
    best = np.array(SETS[name].maximiser(S).subs(at), dtype=float).ravel()
    support = float(SETS[name].support(S).subs(at))
    assert belongs(name, best)
    assert np.dot(s, best) - price(name, best) == pytest.approx(support, rel=1e-12, abs=1e-12)
    others = np.random.default_rng(seed).uniform(-2, 2, (200, 3))
    for u in others:
        if belongs(name, u):
            assert np.dot(s, u) - price(name, u) <= support + 1e-12


@pytest.mark.parametrize("name", SETS)
def test_the_maximiser_is_the_gradient_of_the_support(name):
    gradient = sp.Matrix([SETS[name].support(S)]).jacobian(S).T
    at = dict(zip(S, (sp.Rational(3, 7), sp.Rational(-2, 3), sp.Rational(5, 4)), strict=True))
    difference = (gradient - SETS[name].maximiser(S)).subs(at)
    assert max(abs(sp.N(entry)) for entry in difference) < 1e-14


@pytest.mark.parametrize("name", ["quadratic", "weighted", "bounded"])
def test_the_cost_is_that_of_the_definition(name):
    u = sp.symbols("u_1:4", real=True)
    at = dict(zip(u, (1, -2, 3), strict=True))
    assert float(SETS[name].cost(u).subs(at)) == pytest.approx(price(name, np.array([1.0, -2.0, 3.0])))


@pytest.mark.parametrize("control_set", [Ball(2), Box([2]), Ellipsoid([2])])
def test_on_the_line_all_bounded_sets_are_the_same(control_set):
    s = sp.Symbol("s", real=True)
    assert control_set.support([s]) == 2 * sp.Abs(s)
    assert control_set.maximiser([s])[0] == 2 * sp.sign(s)


def test_a_root_in_a_switching_function_is_of_something_positive():
    a, p = sp.symbols("a p", real=True)
    assert Ball(1).support([p * sp.sqrt(a)]) == sp.sqrt(a) * sp.Abs(p)


def system(control_set, m=1, **numbers):
    a, x = sp.symbols("a x", real=True)
    u = sp.symbols(f"u_1:{m + 1}", real=True)
    return PhaseSystem(
        f=[sum(u)], omega=1, control_set=control_set, slow=[a], control=u, phase=x, target=[a - 1], **numbers
    )


HALF = sp.Symbol("rho", real=True)


@pytest.mark.parametrize(
    ("control_set", "m", "message"),
    [
        (Ball(0), 1, "Ball: radius must be positive"),
        (Ball(-1), 1, "Ball: radius must be positive"),
        (Ball(-1), 1, "Ball: radius must be positive"),
        (Ball(HALF), 1, "unknown symbols rho"),
        (Ellipsoid([1, -1]), 2, "Ellipsoid: semiaxes must be positive"),
        (Ellipsoid([1, 1]), 1, "Ellipsoid: semiaxes must hold one number for each of 1 controls, got 2"),
        (Box([0]), 1, "Box: bounds must be positive"),
        (Box([1, 2, 3]), 2, "Box: bounds must hold one number for each of 2 controls, got 3"),
        (Quadratic(-1), 1, "Quadratic: weight must be positive definite"),
        (Quadratic([[1, 2], [2, 1]]), 2, "Quadratic: weight must be positive definite"),
        (Quadratic([[1, 2], [0, 9]]), 2, "Quadratic: weight must be symmetric"),
        (Quadratic([[1, 0], [0, 1]]), 1, r"Quadratic: weight must be a number or a matrix of shape \(1, 1\)"),
        (BoundedQuadratic(-1), 1, "BoundedQuadratic: radius must be positive"),
        (BoundedQuadratic(1, 0), 1, "BoundedQuadratic: weight must be positive"),
        (Custom(lambda s: sp.Min(s[0], 2 * s[0])), 1, "support function must be convex"),
        (Custom(lambda s: sp.sqrt(sp.Abs(s[0] * s[1]))), 2, "support function must be convex"),
        (Custom(lambda s: s[0] ** 2), 1, "homogeneous of degree one"),
        (Custom(lambda s: HALF * sp.Abs(s[0])), 1, "unknown symbols rho"),
    ],
)
def test_what_is_not_a_convex_set_is_refused_by_name(control_set, m, message):
    with pytest.raises(ValueError, match=message):
        system(control_set, m)


def test_a_stack_of_sets_is_judged_by_its_worst_member():
    system(Ball(HALF), numbers={HALF: [1.0, 2.0]})
    with pytest.raises(ValueError, match="got -2"):
        system(Ball(HALF), numbers={HALF: [1.0, -2.0]})


@pytest.mark.parametrize(
    "support",
    [
        lambda s: sp.Max(s[0], -s[0]),
        lambda s: -sp.Min(s[0], -s[0]),
        lambda s: s[0] * sp.sign(s[0]),
        lambda s: s[0] * (2 * sp.Heaviside(s[0]) - 1),
        lambda s: sp.Piecewise((s[0], s[0] > 0), (-s[0], True)),
    ],
)
def test_a_support_function_may_have_its_kink_written_in_any_way(support):
    a, x, u = sp.symbols("a x u", real=True)
    system = PhaseSystem(
        f=[u * sp.cos(x)],
        omega=1,
        control_set=Custom(support),
        slow=[a],
        control=[u],
        phase=x,
        target=[a - 2],
    )
    solution = solve_averaged(system, start=[1.0])
    assert float(solution.cost) == pytest.approx(np.pi / 2, rel=1e-12)
    assert solution.exact(0.1)[0].cost == pytest.approx(np.pi / 2, rel=1e-9)
