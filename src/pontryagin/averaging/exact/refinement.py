"""Refinement of a family: members are added near extrema of y1 that may touch zero."""

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.family import VALUES, Family, local_range
from pontryagin.averaging.exact.members import march, members
from pontryagin.averaging.exact.shooting import Shooting, Shot
from pontryagin.errors import NotConverged

NEAR = 0.2
"""An extremum of y1 nearer to zero than this share of its range is resolved more finely."""
ROUNDS = 6
"""Largest number of times that members are added."""


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


def crossings(current: Family, at: NDArray[np.intp]) -> tuple[Array, Array]:
    """Zeros of y1, interpolated by cubics, just after the members `at`, and the unknowns there."""
    low, high = current.theta[at], current.theta[at + 1]
    rising = np.sign(current.y[at + 1] - current.y[at])
    for _ in range(40):
        middle = (low + high) / 2
        above = rising * interpolated(current, current.y, at, middle) > 0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    theta = (low + high) / 2
    return theta, interpolated(current, current.unknowns, at, theta)


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
        unknowns, shot, _ = members(problem, theta, guess)
    except NotConverged:
        parts = [_from_neighbour(problem, current, i, angle) for i, angle in zip(left, theta, strict=True)]
        unknowns = np.concatenate([w for w, _ in parts])
        shot = Shot.joined([each for _, each in parts])
    order = np.argsort(np.concatenate([current.theta, theta]), kind="stable")
    added = [theta, unknowns, *(getattr(shot, name) for name in VALUES)]
    names = ("theta", "unknowns", *VALUES)
    joined = {
        n: np.concatenate([getattr(current, n), new])[order] for n, new in zip(names, added, strict=True)
    }
    return Family(**joined, centre=current.centre, limits=current.limits)


def _from_neighbour(problem: Shooting, current: Family, left: int, angle: float) -> tuple[Array, Shot]:
    near = left if angle - current.theta[left] < current.theta[left + 1] - angle else left + 1
    edge = members(problem, current.theta[[near]], current.unknowns[[near]])
    for reached, unknowns, shot, _ in march(problem, float(current.theta[near]), edge, [angle]):
        if reached[0] == angle:
            return unknowns, shot
    raise NotConverged(
        f"no solution that ends at the anomaly {angle:.6g} was found between its neighbours in the family",
        float(np.abs(angle)),
    )


def interpolated(current: Family, values: Array, left: NDArray[np.intp], theta: Array) -> Array:
    """Values (s, ...) at theta (k,), by cubics through the two members on either side."""
    size = len(current.theta)
    count = min(4, size)
    nodes = np.clip(left - 1, 0, size - count)[:, None] + np.arange(count)
    weights = _lagrange(current.theta[nodes], theta)
    shaped = weights.reshape(*weights.shape, *[1] * (values.ndim - 1))
    return np.asarray((shaped * values[nodes]).sum(axis=1))


def _lagrange(nodes: Array, at: Array) -> Array:
    """Weights (k, m) of the values at nodes (k, m) in their polynomial's value at (k,)."""
    same = np.eye(nodes.shape[1], dtype=bool)
    differences = np.where(same, 1.0, nodes[:, :, None] - nodes[:, None, :])
    reached = np.where(same, 1.0, at[:, None, None] - nodes[:, None, :])
    return np.asarray((reached / differences).prod(axis=2))


def _vertex(theta: Array, y: Array) -> tuple[Array, Array]:
    """Place and height of the vertex of the parabola through each three neighbours, kept between them."""
    h0, h1 = theta[:-2] - theta[1:-1], theta[2:] - theta[1:-1]
    d0, d1 = (y[:-2] - y[1:-1]) / h0, (y[2:] - y[1:-1]) / h1
    bend = (d1 - d0) / (h1 - h0)
    slope = d0 - bend * h0
    move = np.divide(-slope, 2 * bend, out=np.zeros_like(bend), where=bend != 0)
    move = np.clip(move, 0.9 * h0, 0.9 * h1)
    return theta[1:-1] + move, y[1:-1] + slope * move + bend * move**2
