"""Points on the boundary of 0-controllable sets, and a frame in which flat sets can be drawn.

The set X(N - k, k) of (2), of states that the steps from k on bring back, is the sum of the remaining G_i U,
carried along by the free motion: by Corollary 1 each step takes one summand away. By Lemma 5 a boundary point
of a sum is the sum of boundary points with one normal.
"""

from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array


def support_points(factors: Array, normals: Array, square: bool) -> Array:
    """The support points rho(p) of Lemma 2 of the sum of G_k U, for outward normals p (..., 3), as (..., 3).

    U is the unit ball of the components, or for `square` the cube. The support point of a sum is the sum of
    the support points, Lemma 5 and (10).

    Examples
    --------
    >>> support_points(np.eye(3)[None], np.array([0.0, 0.0, 2.0]), square=False).tolist()
    [0.0, 0.0, 1.0]
    """
    along = np.einsum("...i,kij->...kj", normals, factors)
    if square:
        chosen = np.sign(along)
    else:
        size = np.linalg.norm(along, axis=-1, keepdims=True)
        chosen = np.divide(along, size, out=np.zeros_like(along), where=size > 0)
    return np.asarray(np.einsum("kij,...kj->...i", factors, chosen))


@dataclass(frozen=True)
class Frame:
    """Principal axes of a set, with coordinates in units of the set's extents along them.

    Attributes
    ----------
    axes : (3, 3) array
        The axes as unit rows, the longest axis first.
    extents : (3,) array
        Half-widths of the set along the axes, dimensionless.
    """

    axes: Array
    extents: Array

    def points(self, states: Array) -> Array:
        """States (..., 3) in this frame; the set reaches from -1 to 1 along every axis."""
        return np.asarray(states @ self.axes.T / self.extents)

    def normals(self, costates: Array) -> Array:
        """Unit normals (..., 3) in this frame of planes with given normals p: along A^-T p, Lemma 3."""
        carried = costates @ self.axes.T * self.extents
        return np.asarray(carried / np.linalg.norm(carried, axis=-1, keepdims=True))

    def back(self, normals: Array) -> Array:
        """The inverse of `normals`, up to lengths: the costates of normals (..., 3) in this frame."""
        return np.asarray(normals / self.extents @ self.axes)


def frame_of(factors: Array, square: bool) -> Frame:
    """The frame of the sum of G_k U.

    Examples
    --------
    >>> frame_of(np.diag([1.0, 3.0, 2.0])[None], square=False).extents.tolist()
    [3.0, 2.0, 1.0]
    """
    _, axes = np.linalg.eigh(np.einsum("kij,klj->il", factors, factors))
    rows = axes.T[::-1]
    rows = rows * np.sign(rows[np.arange(3), np.abs(rows).argmax(axis=1)])[:, None]
    reached = support_points(factors, rows, square)
    return Frame(rows, np.einsum("ij,ij->i", reached, rows))


def sphere_grid(across: int, around: int) -> Array:
    """Unit vectors on meridians and parallels, (across + 1, around + 1, 3)."""
    polar, turn = np.linspace(0, np.pi, across + 1)[:, None], np.linspace(0, 2 * np.pi, around + 1)
    flat = np.sin(polar)
    return np.stack(np.broadcast_arrays(flat * np.cos(turn), flat * np.sin(turn), np.cos(polar)), axis=-1)
