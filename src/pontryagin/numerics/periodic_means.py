"""Means of 2 pi-periodic functions: trapezoidal rule for smooth ones, Gauss's rule between switches."""

import functools
import itertools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.quadrature import EVERY, Density, Halving, gauss, integrals

Selection = NDArray[np.intp] | slice


class MeanRule(NamedTuple):
    """How means are taken.

    Attributes
    ----------
    trapezoid, gauss : int
        Initial numbers of nodes of the trapezoidal rule and of Gauss's rule.
    start : float
        First node of the trapezoidal rule.
    edges : tuple of float
        Ends of panels of a turn, from 0 to 2 pi, that Gauss's rule is used on in place of both; or none.
    """

    trapezoid: int
    gauss: int
    start: float
    edges: tuple[float, ...] = ()

    def on(self, cells: tuple[float, ...]) -> "MeanRule":
        """The rule for functions that are bounded on complex neighbourhoods of so many cells of a turn.

        A cell's neighbourhood is the disc about its middle whose radius is 1.3 times half its length. The
        trapezoidal rule begins with more nodes where cells are shorter than an eighth of a turn; where it
        would need too many, Gauss's rule is used on the cells.
        """
        if not cells:
            return self
        least = min(b - a for a, b in itertools.pairwise(cells))
        finer = math.ceil(2 * math.pi / PARTS / least - 1e-9)
        if finer > FINEST:
            return self._replace(edges=cells)
        return self._replace(trapezoid=finer * self.trapezoid, gauss=finer * self.gauss)


SOLVING = MeanRule(16, 6, 0.0)
CHECKING = MeanRule(24, 9, 1.0)
"""A rule with other nodes than `SOLVING`, so that a harmonic missed by one of them is seen by the other."""
LAST, GAUSS_LAST = 2**9, 384
"""Largest numbers of nodes of the trapezoidal rule, and of Gauss's rule on one interval."""
HALF_DIGITS, FALL = 1e-8, 1e-2
"""Largest relative change by the last doubling, and ratio of successive changes that shows convergence."""
PARTS = 8
"""Number of panels of a turn before any is halved."""
FINEST = 4
"""The trapezoidal rule is used for cells down to an eighth of a turn over this."""
HALVING = Halving(nodes=16)
ROUNDING = 1e-14
"""Accuracy of a column that cancels to zero, as a share of the largest column."""
LOOK = 128
"""Number of points of a turn at which signs are compared to find switches."""


def mean(density: Density, switches: Array, rule: MeanRule, judged: Selection = EVERY) -> Array:
    """Means (points, columns) of functions that are smooth between switches (points, s), padded with nan.

    Only the `judged` columns decide when a rule is fine enough; the others are their derivatives.
    """
    if rule.edges:
        return panelled_mean(density, switches, rule.edges, judged)
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


def smooth_mean(density: Density, points: int, rule: MeanRule = SOLVING, judged: Selection = EVERY) -> Array:
    """Means of periodic functions by the trapezoidal rule, its nodes doubled until the means settle.

    The first three rules share one call of the density; the third is the earliest that can be accepted.
    Where the trapezoidal rule does not converge (a density that is nearly not smooth), `halved_mean` is
    used. Returns (points, columns); nan where the density is not defined.
    """
    size = 4 * rule.trapezoid

    def begin(active: NDArray[np.intp]) -> tuple[list[Array], Array]:
        values = density(rule.start + 2 * np.pi * np.arange(size)[None] / size, active)
        coarse = np.abs(values[:, ::4])
        return list(np.moveaxis(_nested(size) @ values, -2, 0)), coarse.mean(axis=-2)

    def doubled(active: NDArray[np.intp], total: Array) -> Array:
        nonlocal size
        x = rule.start + 2 * np.pi * (np.arange(size)[None] + 0.5) / size
        halfway: Array = density(x, active).mean(axis=-2)
        size *= 2
        return (total + halfway) / 2

    result = _refined(begin, doubled, points, (LAST // rule.trapezoid).bit_length() - 1, judged)
    rest = np.nonzero(np.isnan(result).any(axis=1))[0]
    if len(rest):
        result[rest] = halved_mean(lambda x, i: density(x, rest[i]), len(rest), judged)
    return result


@functools.cache
def _nested(size: int) -> Array:
    """Weights of the trapezoidal rule on every fourth node, on every second one and on all, (3, size)."""
    weights = np.zeros((3, size))
    for row, step in zip(weights, (4, 2, 1), strict=True):
        row[::step] = step / size
    return weights


def halved_mean(density: Density, points: int, judged: Selection = EVERY) -> Array:
    """Means by `integrals` on halved panels, as (points, columns); nan where they do not converge."""
    edges = 2 * np.pi * np.arange(PARTS + 1) / PARTS
    return panelled_mean(density, np.full((points, 0), np.nan), tuple(edges), judged)


def panelled_mean(
    density: Density, switches: Array, edges: tuple[float, ...], judged: Selection = EVERY
) -> Array:
    """`halved_mean` of functions that are smooth between switches (points, s), on panels with given ends."""
    points = len(switches)
    within = np.where(np.isnan(switches), 2 * np.pi, switches % (2 * np.pi))
    ends = np.sort(np.concatenate([np.broadcast_to(edges, (points, len(edges))), within], axis=1), axis=1)
    member, panel = np.nonzero(np.diff(ends) > 0)
    low, high = ends[member, panel], ends[member, panel + 1]
    values, finished = integrals(density, member, low, high, judged, HALVING)
    return np.where(finished[:, None], values / (2 * np.pi), np.nan)


def split_mean(
    density: Density, switches: Array, first: int = SOLVING.gauss, judged: Selection = EVERY
) -> Array:
    """Means of functions that are smooth between ascending switches (points, s), padded with nan."""
    size = first

    def sums(active: NDArray[np.intp]) -> tuple[Array, Array]:
        x, weights = split_rule(switches[active], size)
        values = density(x, active)
        weights = weights[..., None]
        return (weights * values).sum(axis=1), (weights * np.abs(values)).sum(axis=1)

    def doubled(active: NDArray[np.intp], _: Array) -> Array:
        nonlocal size
        size *= 2
        return sums(active)[0]

    def begin(active: NDArray[np.intp]) -> tuple[list[Array], Array]:
        value, scale = sums(active)
        return [value, doubled(active, value)], scale

    return _refined(begin, doubled, len(switches), (GAUSS_LAST // first).bit_length() - 1, judged)


def _refined(
    begin: Callable[[NDArray[np.intp]], tuple[list[Array], Array]],
    doubled: Callable[[NDArray[np.intp], Array], Array],
    points: int,
    doublings: int,
    judged: Selection,
) -> Array:
    """Means by a rule that is doubled at the points where it has not settled; `begin` gives the first means.

    Each doubling squares the error of a rule that converges geometrically; a change in the second half of
    the digits may therefore be the last. It is accepted if it is much smaller than the change before, which
    shows geometric convergence, or if one of the two changes is rounding. The first change alone proves
    nothing for a density with symmetries.
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


def split_rule(switches: Array, size: int) -> tuple[Array, Array]:
    """Nodes and weights (points, panels * size) of Gauss's rule between consecutive switches of one turn."""
    nodes, weights = gauss(size)
    last = switches[:, :1] + 2 * np.pi
    edges = np.concatenate([np.where(np.isnan(switches), last, switches), last], axis=1)
    lengths = np.diff(edges, axis=1)[..., None]
    flat = (len(switches), -1)
    at = edges[:, :-1, None] + lengths * nodes
    return at.reshape(flat), (lengths * weights / (2 * np.pi)).reshape(flat)


def find_switches(switching: Density, points: int) -> Array:
    """Angles in a turn where switching functions change sign, (points, s), ascending, padded with nan.

    The columns of `switching` are the functions, followed by their derivatives in the angle.
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


def _close_pairs(switching: Density, grid: Array, columns: Array) -> tuple[Array, ...] | None:
    """Brackets of pairs of switches between neighbouring nodes, where an extremum has the other sign.

    Returns lower and upper ends, points, columns and whether the function falls; None if there is no pair.
    """
    count = columns.shape[-1] // 2
    value, slope = columns[..., :count], columns[..., count:]
    towards = value * slope
    near = np.abs(value) < 2 * np.abs(slope) * (grid[1] - grid[0])
    extremum = (towards[:, :-1] < 0) & (towards[:, 1:] > 0) & (value[:, :-1] * value[:, 1:] > 0)
    point, cell, which = np.nonzero(extremum & (near[:, :-1] | near[:, 1:]))
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
    switching: Density,
    low: Array,
    high: Array,
    point: NDArray[np.intp],
    which: NDArray[np.intp],
    falling: NDArray[np.bool_],
) -> Array:
    """Switches within brackets by Newton's method, with bisection where a step would leave the bracket."""
    x: Array = (low + high) / 2
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
