"""Cells of slow time along collocated trajectories, and discs that hold the trajectories on them."""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import Trajectories

Index = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Cells:
    """Intervals of tau / duration (c), each within one panel of the mesh of one trajectory.

    Attributes
    ----------
    member, panel : (c) array of int
    low, high : (c) array
    """

    member: Index
    panel: Index
    low: Array
    high: Array

    def __getitem__(self, chosen: Index) -> "Cells":
        return Cells(self.member[chosen], self.panel[chosen], self.low[chosen], self.high[chosen])

    @property
    def lengths(self) -> Array:
        """high - low, (c)."""
        return self.high - self.low

    def halves(self) -> "Cells":
        """Both halves of every cell, next to each other, (2c)."""
        middle = (self.low + self.high) / 2
        low, high = np.stack([self.low, middle], axis=1), np.stack([middle, self.high], axis=1)
        return Cells(np.repeat(self.member, 2), np.repeat(self.panel, 2), low.reshape(-1), high.reshape(-1))


def panels(path: Trajectories) -> Cells:
    """The panels of the mesh as cells, for every trajectory."""
    count, stack = path.mesh.panels, len(path.duration)
    edges = np.array(path.mesh.edges)
    return Cells(
        np.repeat(np.arange(stack), count),
        np.tile(np.arange(count), stack),
        np.tile(edges[:-1], stack),
        np.tile(edges[1:], stack),
    )


def discs(
    path: Trajectories, cells: Cells, reach: float, of_panels: float | None = None
) -> tuple[Array, Array]:
    """Centres and radii (c, 2n) of discs that hold (xi, eta) where tau / duration is near a cell.

    That is, for all complex values within `reach` times half the cell's length of its middle; where the cell
    is a whole panel, within `of_panels` times that.
    """
    edges, degree = np.array(path.mesh.edges), path.mesh.degree
    low, length = edges[cells.panel], np.diff(edges)[cells.panel]
    share = cells.lengths / length
    share = share * np.where(share == 1, reach if of_panels is None else of_panels, reach)
    place = (cells.low + cells.high - 2 * low) / length - 1
    series = path.mesh.series(path.z)[cells.member, cells.panel]
    if (place == 0).all():
        taylor = _taylor(degree, 0.0) @ series
    else:
        places, which = np.unique(place, return_inverse=True)
        taylor = np.stack([_taylor(degree, float(u)) for u in places])[which] @ series
    powers = share[:, None] ** np.arange(1, degree + 1)
    return taylor[:, 0], (powers[:, None] @ np.abs(taylor[:, 1:]))[:, 0]


@functools.lru_cache(maxsize=4096)
def _taylor(degree: int, u: float) -> Array:
    """Taylor coefficients at u of the Chebyshev polynomials, (degree + 1, polynomials)."""
    result = np.zeros((degree + 1, degree + 1))
    result[0, 0], result[0, 1], result[1, 1] = 1, u, 1
    for k in range(2, degree + 1):
        result[:, k] = 2 * u * result[:, k - 1] - result[:, k - 2]
        result[1:, k] += 2 * result[:-1, k - 1]
    return result
