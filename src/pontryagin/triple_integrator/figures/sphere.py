"""Equal-area map of the directions of (6 c1, 2 c2, c3), T = 1: half the sphere as a disc.

The direction of a constant control lies at the centre. The directions of an impulse at the start and at the
end lie to its left and right. Opposite directions have opposite programmes, so that half the sphere suffices.
"""

from functools import cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.display.plotting import INK
from pontryagin.triple_integrator.problem.maneuver import Maneuver

SCALES = np.array([6.0, 2.0, 1.0])


def unit_impulse(sigma: Array) -> Array:
    """(6 c1, 2 c2, c3) of a unit impulse at the share sigma of T to go, (...) -> (..., 3)."""
    return np.stack([3 * sigma**2, 2 * sigma, np.ones_like(sigma)], axis=-1)


@cache
def frame() -> Array:
    """Unit vectors that the disc shows to the right, upwards and at its centre, as rows (3, 3)."""
    centre = np.ones(3) / np.sqrt(3)
    start, end = unit_impulse(np.array([1.0, 0.0]))
    right = end / np.linalg.norm(end) - start / np.linalg.norm(start)
    right -= centre * (right @ centre)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(centre, right), centre])


def to_disc(directions: Array) -> Array:
    """Lambert's equal-area projection of directions (..., 3); the rim of the half sphere has radius 1."""
    x, y, z = np.moveaxis(directions / np.linalg.norm(directions, axis=-1, keepdims=True) @ frame().T, -1, 0)
    return np.asarray(np.stack([x, y], axis=-1) / np.sqrt(1 + z)[..., None])


def from_disc(points: Array) -> Array:
    """Unit vectors (..., 3) of points (..., 2) of the disc."""
    squared = (points**2).sum(axis=-1, keepdims=True)
    parts = [points * np.sqrt(2 - squared), 1 - squared]
    return np.concatenate(parts, axis=-1) @ frame()


def grid(size: int) -> tuple[Array, NDArray[np.bool_]]:
    """Centres of size x size cells over the disc as directions (size, size, 3), and which lie in it."""
    line = (np.arange(size) + 0.5) / size * 2 - 1
    points = np.stack(np.meshgrid(line, line), axis=-1)
    inside = (points**2).sum(axis=-1) <= 1
    return from_disc(np.where(inside[..., None], points, 0.0)), inside


def maneuvers(directions: Array) -> Maneuver:
    """Manoeuvres from rest at zero whose moments have these directions, T = 1."""
    return Maneuver([0, 0, 0], directions / SCALES, 1.0)


def arc(first: Array, last: Array, count: int = 200) -> Array:
    """Great circle between two directions less than half a turn apart, (count, 3)."""
    share = np.linspace(0, 1, count)[:, None]
    a, b = first / np.linalg.norm(first), last / np.linalg.norm(last)
    chord = a * (1 - share) + b * share
    return np.asarray(chord / np.linalg.norm(chord, axis=1, keepdims=True))


def draw(ax: Axes, directions: Array, **style: Any) -> None:
    """Draw the parts of a curve of directions (k, 3) and of its mirror image that lie in the disc."""
    for curve in (directions, -directions):
        visible = curve @ frame()[2] >= -1e-9
        points = to_disc(np.where(visible[:, None], curve, frame()[2]))
        ax.plot(*np.where(visible[:, None], points, np.nan).T, **style)


def prepare(ax: Axes) -> None:
    """Prepare an empty disc with its rim."""
    ax.add_patch(Circle((0, 0), 1, facecolor="none", edgecolor=INK, linewidth=0.8, zorder=3))
    ax.set(xlim=(-1.03, 1.03), ylim=(-1.03, 1.03), aspect="equal")
    ax.axis("off")
