"""Curves of solutions on textbook problems: a circle, a cubic, Bratu's fold."""

import itertools
from collections import namedtuple

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, between, by_differences, crossings, follow, march, reach
from pontryagin.numerics.newton import newton

Equations = namedtuple("Equations", ["residual", "jacobian"])


def circle(x, p):
    return Equations(x**2 + p**2 - 1, np.diag(2 * x)), np.array([2 * p])


def cubic(x, p):
    """x^3 - x = p: folds at x = -1/sqrt(3) and 1/sqrt(3)."""
    return Equations(x**3 - x - p, np.diag(3 * x**2 - 1)), np.array([-1.0])


def bratu(u, rate, inner=40):
    """u'' + rate exp(u) = 0, u(0) = u(1) = 0, by second-order differences."""
    h = 1 / (inner + 1)
    laplace = (np.diag(np.full(inner - 1, 1.0), 1) + np.diag(np.full(inner - 1, 1.0), -1)) - 2 * np.eye(inner)
    grown = np.exp(u)
    return Equations(laplace @ u / h**2 + rate * grown, laplace / h**2 + rate * np.diag(grown)), grown


def polish(family, parameter):
    return lambda guess: newton(lambda x: family(x, parameter)[0], guess).unknowns


def test_a_circle_is_gone_round_over_both_folds():
    points = list(itertools.islice(follow(circle, np.array([1.0]), 0.0, 1.0, largest=0.3), 40))
    assert all(abs(p.unknowns[0] ** 2 + p.parameter**2 - 1) < 1e-9 for p in points)
    angles = np.unwrap([np.arctan2(p.parameter, p.unknowns[0]) for p in points])
    assert (np.diff(angles) > 0).all() and angles[-1] > 2 * np.pi


def test_the_sense_is_that_of_the_parameter_at_first():
    for sense in (1.0, -1.0):
        _, second, *_ = itertools.islice(follow(circle, np.array([1.0]), 0.0, sense), 3)
        assert np.sign(second.parameter) == sense


def test_scales_make_units_of_the_unknowns_irrelevant():
    def scaled(x, p):
        equations, slope = cubic(x / 1e6, p)
        return Equations(equations.residual, equations.jacobian / 1e6), slope

    plain = list(itertools.islice(follow(cubic, np.array([-1.5]), -1.875, 1.0), 20))
    large = itertools.islice(
        follow(scaled, np.array([-1.5e6]), -1.875, 1.0, scales=lambda x: 1e6 + 0 * x), 20
    )
    for a, b in zip(plain, large, strict=True):
        assert a.parameter == pytest.approx(b.parameter, rel=1e-9)


def test_a_value_is_reached_round_the_folds():
    points = follow(cubic, np.array([-1.5]), -1.875, 1.0)
    assert reach(points, 1.875, polish(cubic, 1.875), "not reached") == pytest.approx(1.5, abs=1e-14)


def test_a_value_that_the_curve_never_has_is_not_reached():
    with pytest.raises(NotConverged, match="not reached") as caught:
        reach(follow(circle, np.array([1.0]), 0.0, 1.0, steps=60), 2.0, polish(circle, 2.0), "not reached")
    assert caught.value.residual == pytest.approx(1, abs=0.1)


def test_all_solutions_at_one_parameter_are_crossed():
    points = itertools.takewhile(
        lambda p: p.parameter < 2, follow(cubic, np.array([-1.5]), -1.875, 1.0, largest=0.2)
    )
    found = [polish(cubic, 0.1)(x)[0] for x, _ in crossings(points, lambda p: p.parameter - 0.1)]
    assert_allclose(found, np.sort(np.roots([1, 0, -1, -0.1])), atol=1e-13)


def test_a_zero_at_the_first_point_is_a_crossing():
    (unknowns, parameter), *_ = crossings(follow(circle, np.array([1.0]), 0.0, 1.0), lambda p: p.parameter)
    assert unknowns[0] == 1 and parameter == 0


def test_bratus_fold():
    """The largest rate with a solution is 3.5138; the solution on the upper branch at rate 1 is Kubicek's."""
    points = follow(bratu, np.zeros(40), 0.0, 1.0, scales=lambda u: np.full_like(u, 1 + np.abs(u).max()))
    path = list(itertools.takewhile(lambda p: not (p.parameter < 1 and p.unknowns.max() > 1), points))
    assert max(p.parameter for p in path) == pytest.approx(3.5138, abs=0.05)
    upper = reach(
        itertools.chain(path[-1:], follow(bratu, path[-1].unknowns, path[-1].parameter, -1.0)),
        1.0,
        polish(bratu, 1.0),
        "not reached",
    )
    assert upper.max() == pytest.approx(4.0911, abs=0.02)


def test_only_the_first_rows_need_hold():
    """The first equation defines the circle; the second, x = p, is only evaluated to find a crossing."""

    def both(x, p):
        equations, slope = circle(x, p)
        residual = np.append(equations.residual, x[0] - p)
        return Equations(residual, np.array([[2 * x[0], 2 * p], [1.0, -1.0]])), slope

    points = follow(both, np.array([1.0]), 0.0, 1.0, rows=1, largest=0.05)
    unknowns, parameter = next(crossings(points, lambda p: p.equations.residual[1]))
    assert [*unknowns, parameter] == pytest.approx([np.sqrt(0.5)] * 2, abs=1e-3)


def test_the_secant_between_two_points():
    a, b = Point(np.array([1.0]), 1.0, None), Point(np.array([3.0]), 2.0, None)
    assert between(a, b, 1.25) == pytest.approx(1.5)


def on_the_circle(parameter, guess):
    found = newton(lambda x: circle(x, parameter)[0], guess)
    if found.outcome == "singular" or found.residual > 1e-12:
        raise NotConverged("off the circle", found.residual)
    return Point(found.unknowns, parameter, found.equations)


def test_a_march_over_the_parameter_ends_at_its_value_or_before_a_fold():
    start = Point(np.array([1.0]), 0.0, circle(np.array([1.0]), 0.0)[0])
    *_, last = march(on_the_circle, start, 0.9, first=0.2)
    assert last.parameter == 0.9 and last.unknowns[0] == pytest.approx(np.sqrt(0.19))
    *_, last = march(on_the_circle, start, -2.0, first=0.5, least=1e-3)
    assert -1 <= last.parameter < -0.9
    assert list(march(on_the_circle, start, 0.0, first=0.5)) == [start]


def test_a_march_makes_no_step_larger_than_the_largest():
    start = Point(np.array([1.0]), 0.0, None)
    points = list(march(on_the_circle, start, 0.9, first=0.01, largest=0.1, growth=2.0))
    assert np.diff([p.parameter for p in points]).max() <= 0.1 * 1.001
    assert len(list(march(on_the_circle, start, 0.9, first=0.01, tries=3))) == 4


def test_slopes_by_differences():
    family = by_differences(lambda x, p: circle(x, p)[0], 1e-5)
    for parameter in (0.0, 0.6):
        _, slope = family(np.array([0.8]), parameter)
        assert slope[0] == pytest.approx(2 * parameter, abs=1e-10)


def test_steps_are_halved_down_to_the_least_one_itself():
    seen = []

    def never(parameter, guess):
        seen.append(parameter)
        raise NotConverged("none here", 1.0)

    points = list(march(never, Point(np.ones(1), 0.0, None), 4.0, first=1.0, least=0.25))
    assert seen == [1.0, 0.5, 0.25] and len(points) == 1


def test_what_a_curve_misses_is_the_distance_of_its_nearest_point():
    points = list(itertools.islice(follow(circle, np.array([1.0]), 0.0, 1.0, largest=0.3), 40))
    with pytest.raises(NotConverged, match="not reached") as held:
        reach(points, 2.0, polish(circle, 2.0), "not reached")
    assert held.value.residual == 2.0 - max(point.parameter for point in points)
