"""Continuation: curves of solutions followed by pseudo-arclength (round folds) or in the parameter.

A family is a system of equations with a parameter. `follow` predicts along the tangent of the curve of its
solutions and corrects across it, so that the curve may turn back (a fold: two solutions meet) and give
several solutions at one value of the parameter. `march` steps in the parameter itself, predicts by secants
and ends at a fold. `crossings` finds where on a curve a function vanishes; `reach` finds the first point
with a given value of the parameter and polishes it.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.newton import E, Scales, ones

Family = Callable[[Array, float], tuple[E, Array]]
"""A function of the unknowns (n,) and the parameter.

It returns the equations and the residual's derivative in the parameter, (m,).
"""

CLOSE = 1e-9
"""A point of a curve is accepted after a correction below this size, measured in the scales."""
CLOSE_ENOUGH = 1e-5
"""From the second correction on this size suffices: the error after it is of the order of its square."""
CORRECTIONS = 6
"""Number of corrections after which a step that has not converged is shortened."""
LEAST_STEP = 1e-5
"""Arclength of a step below which a curve is given up."""

R = TypeVar("R")
P = TypeVar("P")


@dataclass(frozen=True)
class Point(Generic[P]):
    """A point of a curve: unknowns (n,), the parameter, and the equations there."""

    unknowns: Array
    parameter: float
    equations: P


def follow(
    family: Family[E],
    unknowns: Array,
    start: float,
    sense: float,
    *,
    scales: Scales = ones,
    step: float = 0.1,
    largest: float = 0.5,
    steps: int = 400,
    rows: int | None = None,
) -> Iterator[Point[E]]:
    """Points of the curve through a solution, by pseudo-arclength.

    Parameters
    ----------
    family : function of unknowns and the parameter
    unknowns : (n,) array
        A solution.
    start : float
        Its value of the parameter.
    sense : float
        Positive if the parameter is to grow at first, negative if it is to fall.
    scales : function of unknowns, optional
        Units of the unknowns; the unit of the parameter is 1.
    step, largest : float
        The first and the largest arclength of a step.
    steps : int
        The largest number of steps.
    rows : int, optional
        If given, the curve satisfies only the first ``rows`` equations, in as many unknowns.

    Yields
    ------
    Point
        The start itself, then further points. The curve ends where the steps become too short or too many.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> def circle(x, p):
    ...     return SimpleNamespace(residual=x**2 + p**2 - 1, jacobian=np.diag(2 * x)), np.array([2 * p])
    >>> points = [point.parameter for point in follow(circle, np.array([1.0]), 0.0, 1.0, steps=30)]
    >>> max(points) > 0.9, min(points) < -0.9
    (True, True)
    """
    values, by_parameter = family(unknowns, start)
    here = Point(unknowns, start, values)
    yield here
    direction = np.append(np.zeros(len(unknowns)), np.sign(sense))
    for _ in range(steps):
        scale = np.append(scales(here.unknowns), 1.0)
        tangent = _tangent(here.equations.jacobian[:rows, :rows], by_parameter, scale, direction)
        while True:
            landed = _land(family, here, scale, tangent, step, rows)
            if landed is not None:
                break
            step /= 2
            if step < LEAST_STEP:
                return
        point, by_parameter, effort = landed
        direction = np.append(point.unknowns - here.unknowns, point.parameter - here.parameter) / scale
        here = point
        yield here
        step = min(largest, step * (2.0 if effort <= 2 else 1.3 if effort == 3 else 0.7))


def _tangent(jacobian: Array, by_parameter: Array, scale: Array, direction: Array) -> Array:
    """The scaled unit tangent of the curve, in the sense that agrees with a given direction."""
    matrix = np.column_stack([jacobian, by_parameter]) * scale
    matrix /= np.linalg.norm(matrix, axis=1, keepdims=True)
    tangent = np.asarray(np.linalg.svd(matrix)[2][-1])
    return tangent if tangent @ direction >= 0 else -tangent


def _land(
    family: Family[E], here: Point[E], scale: Array, tangent: Array, step: float, rows: int | None
) -> tuple[Point[E], Array, int] | None:
    """The next point of the curve, predicted along the tangent and corrected across it; None if that fails.

    Also returned are the residual's derivative in the parameter and the number of corrections.
    """
    start = np.append(here.unknowns, here.parameter)
    y = start + step * scale * tangent
    last = np.inf
    for effort in range(1, CORRECTIONS + 1):
        try:
            values, by_parameter = family(y[:-1], float(y[-1]))
        except (NotConverged, FloatingPointError, OverflowError):
            return None
        across = tangent @ ((y - start) / scale) - step
        matrix = np.vstack([np.column_stack([values.jacobian[:rows, :rows], by_parameter]) * scale, tangent])
        try:
            change = np.linalg.solve(matrix, -np.append(values.residual[:rows], across))
        except np.linalg.LinAlgError:
            return None
        size = float(np.linalg.norm(change))
        if not size < min(max(2 * last, 1e-8), step):
            return None
        y, last = y + scale * change, size
        if size < CLOSE or (size < CLOSE_ENOUGH and effort > 1):
            return Point(y[:-1], float(y[-1]), values), by_parameter, effort
    return None


def between(a: Point[P], b: Point[P], parameter: float) -> Array:
    """Unknowns at a value of the parameter, by the secant through two points."""
    share = (parameter - a.parameter) / (b.parameter - a.parameter)
    return a.unknowns + share * (b.unknowns - a.unknowns)


def crossings(
    points: Iterable[Point[P]], function: Callable[[Point[P]], float]
) -> Iterator[tuple[Array, float]]:
    """Unknowns and parameters, by the secant, where a function changes its sign between points of a curve.

    If the function vanishes at the very first point, that point comes first.
    """
    last: Point[P] | None = None
    before = 0.0
    for point in points:
        here = function(point)
        if last is None:
            if here == 0:
                yield point.unknowns, point.parameter
        elif before * here <= 0 and before != 0:
            share = before / (before - here)
            yield (
                last.unknowns + share * (point.unknowns - last.unknowns),
                last.parameter + share * (point.parameter - last.parameter),
            )
        last, before = point, here


def reach(points: Iterable[Point[P]], parameter: float, polish: Callable[[Array], R], reason: str) -> R:
    """The solution at the first point of a curve with a given value of the parameter.

    Parameters
    ----------
    points : iterable of Point
        The curve; a generator that raises or ends bounds the search.
    parameter : float
        The value.
    polish : function of unknowns
        Newton's method at that value; it starts from unknowns by the secant.
    reason : str
        The message of `NotConverged` if the curve ends before.

    Raises
    ------
    NotConverged
        If the curve does not reach the value; the residual is the distance from it to the nearest point.
    """
    nearest = np.inf

    def missing(point: Point[P]) -> float:
        nonlocal nearest
        nearest = min(nearest, abs(point.parameter - parameter))
        return point.parameter - parameter

    for unknowns, _ in crossings(points, missing):
        return polish(unknowns)
    raise NotConverged(reason, float(nearest))


def march(
    solve_at: Callable[[float, Array], Point[P]],
    start: Point[P],
    end: float,
    *,
    first: float,
    largest: float = np.inf,
    least: float = 0.0,
    growth: float = 1.6,
    tries: int = 60,
) -> Iterator[Point[P]]:
    """Solutions at successive values of the parameter, each guessed by the secant through the two before it.

    Parameters
    ----------
    solve_at : function of the parameter and a guess (n,)
        The solution there. It raises `NotConverged` where the guess is too far off; the step is then halved.
    start : Point
        A solution.
    end : float
        The last value of the parameter.
    first, largest, least : float
        The first step of the parameter, the largest, and the one below which the march is given up.
    growth : float
        Factor by which a step grows after each success.
    tries : int
        The largest number of steps tried.

    Yields
    ------
    Point
        The first is the start itself; the last is at ``end`` if that was reached.

    Examples
    --------
    >>> def root(p, guess):
    ...     return Point(np.sqrt([p]), p, None)
    >>> steps = march(root, Point(np.ones(1), 1.0, None), 4.0, first=1)
    >>> [(round(point.parameter, 3), point.unknowns.round(3).tolist()) for point in steps]
    [(1.0, [1.0]), (2.0, [1.414]), (3.6, [1.897]), (4.0, [2.0])]
    """
    step, here = first, start
    before: Point[P] | None = None
    yield here
    for _ in range(tries):
        left = end - here.parameter
        if left == 0:
            return
        there = end if abs(left) <= step * 1.0001 else here.parameter + np.copysign(step, left)
        guess = here.unknowns if before is None else between(before, here, there)
        try:
            found = solve_at(float(there), guess)
        except NotConverged:
            step /= 2
            if step < least:
                return
            continue
        before, here = here, found
        yield here
        step = min(largest, growth * step)


def by_differences(evaluate: Callable[[Array, float], E], difference: float) -> Family[E]:
    """A family whose derivative in the parameter is taken by central differences."""

    def family(unknowns: Array, parameter: float) -> tuple[E, Array]:
        before, after = (evaluate(unknowns, parameter + shift) for shift in (-difference, difference))
        return evaluate(unknowns, parameter), (after.residual - before.residual) / (2 * difference)

    return family
