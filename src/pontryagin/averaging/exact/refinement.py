"""Refinement of a family: members are added near extrema of y1 that may touch zero."""

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.beginning import local_range
from pontryagin.averaging.exact.family import Family
from pontryagin.averaging.exact.members import MemberTable, march, members
from pontryagin.averaging.exact.shooting import Shooting
from pontryagin.averaging.exact.turns import lagrange
from pontryagin.errors import NotConverged

NEAR = 0.2
"""An extremum of y1 nearer to zero than this share of its range is resolved more finely."""
ROUNDS = 6
"""Largest number of times that members are added."""
NODES = 16
"""Largest number of members through which a polynomial is laid."""


def turns_resolved(problem: Shooting, traced: Family) -> Family:
    """Add members at extrema of y1 near zero, until it is clear whether y1 reaches zero there."""
    current = traced
    for _ in range(ROUNDS):
        theta, y = current.theta, current.y
        before, here, after = np.abs(y[:-2]), np.abs(y[1:-1]), np.abs(y[2:])
        one_side = (y[:-2] * y[1:-1] > 0) & (y[2:] * y[1:-1] > 0)
        extremum = one_side & (here <= before) & (here <= after)
        vertex, height = _vertex(theta, y)
        open_ = extremum & (np.abs(height) <= NEAR * local_range(theta, y)[1:-1])
        gap = np.minimum(theta[1:-1] - theta[:-2], theta[2:] - theta[1:-1])
        open_ &= np.abs(vertex - theta[1:-1]) > 0.02 * gap
        open_ &= (np.abs(y[1:-1] - height) > 0.2 * np.abs(height)) | (height * y[1:-1] < 0)
        if not open_.any():
            return current
        try:
            current = with_members(problem, current, vertex[open_])
        except NotConverged:
            current = _as_far_as_found(problem, current, vertex[open_])
    return current


def _as_far_as_found(problem: Shooting, current: Family, theta: Array) -> Family:
    """Add members outwards from the centre; the family is cut off where one is not found."""
    for angle in theta[np.argsort(np.abs(theta - current.centre))]:
        if not current.theta[0] < angle < current.theta[-1]:
            continue
        try:
            current = with_members(problem, current, np.array([angle]))
        except NotConverged:
            above = angle > current.centre
            current = current.cut(-np.inf if above else angle, angle if above else np.inf)
    return current


def crossings(current: Family, at: NDArray[np.intp]) -> tuple[Array, Array, Array]:
    """Zeros of y1, interpolated, just after the members `at`, and the unknowns and derivatives there."""
    low, high = current.theta[at], current.theta[at + 1]
    rising = np.sign(current.y[at + 1] - current.y[at])
    for _ in range(40):
        middle = (low + high) / 2
        above = rising * interpolated(current, current.y, at, middle) > 0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    theta = (low + high) / 2
    unknowns, derivatives = (
        interpolated(current, values, at, theta) for values in (current.unknowns, current.derivatives)
    )
    return theta, unknowns, derivatives


def with_members(problem: Shooting, current: Family, theta: Array) -> Family:
    """The family with the members that end at theta added.

    Raises
    ------
    NotConverged
        If one of them is not found.
    """
    theta = theta[np.abs(theta[:, None] - current.theta).min(axis=1) > 1e-9]
    if len(theta) == 0:
        return current
    left = np.clip(np.searchsorted(current.theta, theta, side="right") - 1, 0, len(current.theta) - 2)
    guess = interpolated(current, current.unknowns, left, theta)
    try:
        found = members(problem, theta, guess)
    except NotConverged:
        parts = [_from_neighbour(problem, current, i, angle) for i, angle in zip(left, theta, strict=True)]
        found = MemberTable.joined(parts)
    joined = MemberTable.joined([current, found])
    return current.with_columns(joined[np.argsort(joined.theta, kind="stable")])


def _from_neighbour(problem: Shooting, current: Family, left: int, angle: float) -> MemberTable:
    near = left if angle - current.theta[left] < current.theta[left + 1] - angle else left + 1
    edge = members(problem, current.theta[[near]], current.unknowns[[near]])
    for reached in march(problem, edge, [angle]):
        if reached.theta[0] == angle:
            return reached
    raise NotConverged(
        f"no solution that ends at the anomaly {angle:.6g} was found between its neighbours in the family",
        float(np.abs(angle)),
    )


def interpolated(current: Family, values: Array, left: NDArray[np.intp], theta: Array) -> Array:
    """Values (s, ...) at theta (k,), by polynomials through the nearest members on either side."""
    size = len(current.theta)
    count = min(NODES, size)
    nodes = np.clip(left - count // 2 + 1, 0, size - count)[:, None] + np.arange(count)
    weights = lagrange(current.theta[nodes], theta)
    shaped = weights.reshape(*weights.shape, *[1] * (values.ndim - 1))
    return np.asarray((shaped * values[nodes]).sum(axis=1))


def _vertex(theta: Array, y: Array) -> tuple[Array, Array]:
    """Place and height of the vertex of the parabola through each three neighbours, kept between them."""
    h0, h1 = theta[:-2] - theta[1:-1], theta[2:] - theta[1:-1]
    d0, d1 = (y[:-2] - y[1:-1]) / h0, (y[2:] - y[1:-1]) / h1
    bend = (d1 - d0) / (h1 - h0)
    slope = d0 - bend * h0
    move = np.divide(-slope, 2 * bend, out=np.zeros_like(bend), where=bend != 0)
    move = np.clip(move, 0.9 * h0, 0.9 * h1)
    return theta[1:-1] + move, y[1:-1] + slope * move + bend * move**2
