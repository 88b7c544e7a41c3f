"""Means over a turn of the anomaly: the trapezoid where smooth, Gauss's rule between switches."""

import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array

Density = Callable[[Array, NDArray[np.intp]], Array]
"""Anomalies (points or 1, nodes) and the points' indices to columns (points, nodes, columns)."""

Judged = NDArray[np.intp] | slice
EVERY = slice(None)


class Rule(NamedTuple):
    """Nodes to begin with: of the trapezoid, which start somewhere, and of Gauss's rule between switches."""

    trapezoid: int
    gauss: int
    start: float


SOLVING = Rule(16, 6, 0.0)
CHECKING = Rule(24, 9, 1.0)
"""Its nodes are other ones: a harmonic that escapes both rules does so by different amounts."""
LAST, GAUSS_LAST = 2**9, 384
HALF_DIGITS, FALL = 1e-8, 1e-2
PARTS, HALVINGS = 8, 40
ROUNDING = 1e-14
"""A column that cancels to nothing is not asked for more than this share of the largest."""
LOOK = 128
"""How finely a turn is searched for switches."""


def mean(density: Density, switches: Array, rule: Rule, judged: Judged = EVERY) -> Array:
    """Means (points, columns) of functions smooth between switches (points, s), the absent ones nan.

    Only the `judged` columns say when a rule is fine enough: the others are their derivatives.
    """
    plain = np.isnan(switches).all(axis=1)
    if plain.all():
        return smooth_mean(density, len(switches), rule, judged)
    split = np.nonzero(~plain)[0]
    columns = split_mean(lambda x, i: density(x, split[i]), switches[split], rule.gauss, judged)
    result = np.empty((len(switches), columns.shape[-1]))
    result[split] = columns
    if plain.any():
        smooth = np.nonzero(plain)[0]
        result[smooth] = smooth_mean(lambda x, i: density(x, smooth[i]), len(smooth), rule, judged)
    return result


def smooth_mean(density: Density, points: int, rule: Rule = SOLVING, judged: Judged = EVERY) -> Array:
    """Means of periodic functions by the trapezoid, its nodes doubled until nothing changes.

    The first three rules, of which the third is the earliest to be believed, share one call of the density.
    Where it does not settle (a density that is nearly not smooth), `halved_mean` takes its place. Returns
    (points, columns); nan where the density is not defined.
    """
    size = 4 * rule.trapezoid

    def begin(active: NDArray[np.intp]) -> tuple[list[NDArray], NDArray]:
        values = density(rule.start + 2 * np.pi * np.arange(size)[None] / size, active)
        coarse = np.abs(values[:, ::4])
        return list(np.moveaxis(_nested(size) @ values, -2, 0)), coarse.mean(axis=-2)

    def doubled(active: NDArray[np.intp], total: NDArray) -> NDArray:
        nonlocal size
        x = rule.start + 2 * np.pi * (np.arange(size)[None] + 0.5) / size
        halfway = density(x, active).mean(axis=-2)
        size *= 2
        return (total + halfway) / 2

    result = _refined(begin, doubled, points, (LAST // rule.trapezoid).bit_length() - 1, judged)
    rest = np.nonzero(np.isnan(result).any(axis=1))[0]
    if len(rest):
        result[rest] = halved_mean(lambda x, i: density(x, rest[i]), len(rest), judged)
    return result


@functools.cache
def _nested(size: int) -> Array:
    """Weights of the trapezoid on every fourth node, on every other and on all, (3, size)."""
    weights = np.zeros((3, size))
    for row, step in zip(weights, (4, 2, 1), strict=True):
        row[::step] = step / size
    return weights


def halved_mean(density: Density, points: int, judged: Judged = EVERY) -> Array:
    """Means by Gauss's rule on intervals that are halved until nothing changes, as (points, columns).

    Where intervals become so short that the density is known to fewer digits, fewer are asked for.
    """
    nodes, weights = _gauss(16)
    point = np.repeat(np.arange(points), PARTS)
    low = np.tile(np.arange(PARTS) / PARTS, points)
    length = np.full(len(low), 1 / PARTS)

    def integral(point: NDArray, low: NDArray, length: NDArray) -> tuple[NDArray, NDArray]:
        values = density(2 * np.pi * (low[:, None] + length[:, None] * nodes), point)
        scaled = (length[:, None] * weights)[..., None]
        return (scaled * values).sum(axis=1), (scaled * np.abs(values)).sum(axis=1)

    value, size = integral(point, low, length)
    scale = np.zeros((points, size.shape[1]))
    np.add.at(scale, point, size)
    result = np.zeros_like(scale)
    for halving in range(HALVINGS):
        asked = ROUNDING if halving < HALVINGS // 2 else FALL * HALF_DIGITS
        first, _ = integral(point, low, length / 2)
        second, _ = integral(point, low + length / 2, length / 2)
        change = np.abs(first + second - value)[:, judged]
        own = scale[point][:, judged]
        settled = (change <= asked * np.maximum(own, own.max(axis=-1, keepdims=True))).all(axis=-1)
        np.add.at(result, point[settled], (first + second)[settled])
        more = ~settled
        if not more.any():
            return result
        if not np.isfinite(change[more]).all():
            break
        point, low, length = (
            np.concatenate([point[more]] * 2),
            np.concatenate([low[more], low[more] + length[more] / 2]),
            np.concatenate([length[more] / 2] * 2),
        )
        value = np.concatenate([first[more], second[more]])
    result[point] = np.nan
    return result


def split_mean(
    density: Density, switches: Array, first: int = SOLVING.gauss, judged: Judged = EVERY
) -> Array:
    """Means of functions that are smooth between switches (points, s), ascending, the absent ones nan."""
    size = first

    def sums(active: NDArray[np.intp]) -> tuple[NDArray, NDArray]:
        x, weights = split_rule(switches[active], size)
        values = density(x, active)
        weights = weights[..., None]
        return (weights * values).sum(axis=1), (weights * np.abs(values)).sum(axis=1)

    def doubled(active: NDArray[np.intp], _: NDArray) -> NDArray:
        nonlocal size
        size *= 2
        return sums(active)[0]

    def begin(active: NDArray[np.intp]) -> tuple[list[NDArray], NDArray]:
        value, scale = sums(active)
        return [value, doubled(active, value)], scale

    return _refined(begin, doubled, len(switches), (GAUSS_LAST // first).bit_length() - 1, judged)


def _refined(begin, doubled, points: int, doublings: int, judged: Judged) -> Array:
    """Double a rule at the points where it has not settled, after those that `begin` has already.

    The error of a rule that converges geometrically is squared by each doubling: a change below half of all
    digits is the last to be seen, provided that the change before was either much larger, which shows that
    the rule does converge so, or nothing, or that this one is nothing; the first change alone says nothing of
    a density with symmetries.
    """
    active = np.arange(points)
    (coarse, value, *known), scale = begin(active)
    size = scale[:, judged]
    least = ROUNDING * np.maximum(size, size.max(axis=-1, keepdims=True))
    enough = np.maximum(HALF_DIGITS * size, least)
    before = np.abs(value - coarse)[:, judged]
    result = np.full(value.shape, np.nan)
    for _ in range(doublings - 1):
        finer = known.pop(0) if known else doubled(active, value)
        change = np.abs(finer - value)[:, judged]
        convergent = (change <= np.maximum(FALL * before, least)) | (before <= least)
        settled = (convergent & (change <= enough)).all(axis=-1)
        result[active[settled]] = finer[settled]
        more = ~settled & np.isfinite(finer).all(axis=-1)
        if not more.any():
            break
        active, value, before = active[more], finer[more], change[more]
        least, enough, known = least[more], enough[more], [one[more] for one in known]
    return result


def split_rule(switches: Array, size: int) -> tuple[NDArray, NDArray]:
    """Nodes and weights (points, panels * size) of Gauss's rule from switch to switch over one turn."""
    nodes, weights = _gauss(size)
    last = switches[:, :1] + 2 * np.pi
    edges = np.concatenate([np.where(np.isnan(switches), last, switches), last], axis=1)
    lengths = np.diff(edges, axis=1)[..., None]
    flat = (len(switches), -1)
    return (edges[:, :-1, None] + lengths * nodes).reshape(flat), (lengths * weights / (2 * np.pi)).reshape(
        flat
    )


@functools.cache
def _gauss(size: int) -> tuple[Array, Array]:
    nodes, weights = np.polynomial.legendre.leggauss(size)
    return (nodes + 1) / 2, weights / 2


def find_switches(switching: Density, points: int) -> Array:
    """Where the switching functions change sign over a turn, (points, s), ascending, filled up by nan.

    `switching` gives the functions and, as a second half of its columns, their derivatives in the anomaly.
    """
    grid = 2 * np.pi * (np.arange(LOOK + 1) + 0.5) / LOOK
    columns = switching(grid[None], np.arange(points))
    columns = np.broadcast_to(columns, (points, *columns.shape[1:]))
    count = columns.shape[-1] // 2
    positive = columns[..., :count] > 0
    point, cell, which = np.nonzero(positive[:, 1:] != positive[:, :-1])
    low, high, falling = grid[cell], grid[cell + 1], positive[point, cell, which]
    pairs = _close_pairs(switching, grid, columns)
    if pairs is not None:
        low, high = np.concatenate([low, pairs[0]]), np.concatenate([high, pairs[1]])
        point, which = np.concatenate([point, pairs[2]]), np.concatenate([which, pairs[3]])
        falling = np.concatenate([falling, pairs[4]])
    if not len(point):
        return np.full((points, 0), np.nan)
    root = _refine(switching, low, high, point, which, falling)
    order = np.lexsort((root, point))
    point, root = point[order], root[order]
    place = np.arange(len(point)) - np.searchsorted(point, point)
    result = np.full((points, place.max() + 1), np.nan)
    result[point, place] = root
    return result


def _close_pairs(switching: Density, grid: NDArray, columns: NDArray) -> tuple[NDArray, ...] | None:
    """Brackets of two switches between neighbouring nodes: an extremum there that has the other sign."""
    count = columns.shape[-1] // 2
    value, slope = columns[..., :count], columns[..., count:]
    towards = value * slope
    near = np.abs(value) < 2 * np.abs(slope) * (grid[1] - grid[0])
    turning = (towards[:, :-1] < 0) & (towards[:, 1:] > 0) & (value[:, :-1] * value[:, 1:] > 0)
    point, cell, which = np.nonzero(turning & (near[:, :-1] | near[:, 1:]))
    if not len(point):
        return None
    rows = np.arange(len(point))
    low, high = grid[cell], grid[cell + 1]
    rising, above = slope[point, cell, which] > 0, value[point, cell, which] > 0
    for _ in range(50):
        middle = (low + high) / 2
        before = (switching(middle[:, None], point)[rows, 0, which + count] > 0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    crossed = (switching(low[:, None], point)[rows, 0, which] > 0) != above
    point, which, at, above = point[crossed], which[crossed], low[crossed], above[crossed]
    left, right = grid[cell[crossed]], grid[cell[crossed] + 1]
    return (
        np.concatenate([left, at]),
        np.concatenate([at, right]),
        np.concatenate([point, point]),
        np.concatenate([which, which]),
        np.concatenate([above, ~above]),
    )


def _refine(
    switching: Density, low: NDArray, high: NDArray, point: NDArray, which: NDArray, falling: NDArray
) -> Array:
    """Newton's method, bisecting wherever it leaves the bracket."""
    x = (low + high) / 2
    rows = np.arange(len(point))
    for _ in range(60):
        columns = switching(x[:, None], point)[:, 0]
        value, slope = columns[rows, which], columns[rows, which + columns.shape[-1] // 2]
        before = (value > 0) == falling
        low, high = np.where(before, x, low), np.where(before, high, x)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = x - value / slope
        following = np.where((newton >= low) & (newton <= high), newton, (low + high) / 2)
        moved = np.abs(following - x)
        x = following
        if (moved <= 1e-15 * (1 + np.abs(x))).all():
            break
    return x
