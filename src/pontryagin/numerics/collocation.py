"""Collocation on panels of [0, 1]: piecewise Chebyshev series and their integration matrix.

A boundary value problem z' = f(z) becomes z - z(0) = integrals @ f(z) at the points of a `Mesh`.
"""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array


@dataclass(frozen=True)
class Mesh:
    """Panels of [0, 1], each with degree + 1 points; the last point of a panel is the first of the next.

    Parameters
    ----------
    edges : tuple of float
        Ends of the panels, ascending from 0 to 1.
    degree : int
        Degree of the series on each panel.
    """

    edges: tuple[float, ...]
    degree: int

    @property
    def panels(self) -> int:
        """Number of panels."""
        return len(self.edges) - 1

    @functools.cached_property
    def points(self) -> Array:
        """All points, ascending, (panels * degree + 1)."""
        low, high = np.array(self.edges[:-1]), np.array(self.edges[1:])
        inside = low[:, None] + (high - low)[:, None] * _points(self.degree)[:-1]
        return np.append(inside.reshape(-1), 1.0)

    @functools.cached_property
    def integrals(self) -> Array:
        """Matrix from values at the points to integrals from 0 to each point."""
        count = len(self.points)
        result = np.zeros((count, count))
        for p, length in enumerate(np.diff(self.edges)):
            own = slice(p * self.degree, (p + 1) * self.degree + 1)
            part = length * _integrals(self.degree)
            result[own, own] += part
            result[own.stop :, own] += part[-1]
        return result

    @functools.cached_property
    def panel_integrals(self) -> Array:
        """Matrix from values at the points to integrals from the start of each point's panel."""
        count = len(self.points)
        result = np.zeros((count, count))
        for p, length in enumerate(np.diff(self.edges)):
            own = slice(p * self.degree, (p + 1) * self.degree + 1)
            result[own.start + 1 : own.stop, own] = length * _integrals(self.degree)[1:]
        return result

    @functools.cached_property
    def starts(self) -> NDArray[np.intp]:
        """Which point the panel of each point starts at; edges belong to the panel that ends there."""
        index = np.arange(len(self.points))
        return np.maximum((index - 1) // self.degree * self.degree, 0)

    def series(self, values: Array) -> Array:
        """Chebyshev coefficients (..., panels, degree + 1, w) of values (..., points, w)."""
        starts = np.arange(self.panels)[:, None] * self.degree
        return _to_coefficients(self.degree) @ values[..., starts + np.arange(self.degree + 1), :]

    def bisected(self, chosen: NDArray[np.bool_]) -> "Mesh":
        """The mesh with the chosen panels (panels) halved."""
        middles = [
            (a + b) / 2 for a, b, split in zip(self.edges, self.edges[1:], chosen, strict=False) if split
        ]
        return Mesh(tuple(sorted((*self.edges, *middles))), self.degree)


def evaluate(edges: Array, series: Array, s: Array) -> Array:
    """Values (..., k, w) at s (..., k) of series (..., panels, degree + 1, w), edges (..., panels + 1).

    Leading axes broadcast; panels of no length at the end are ignored.
    """
    own, share, _ = _located(edges, series, s)
    return np.asarray((polynomials(share, series.shape[-2] - 1)[..., None, :] @ own)[..., 0, :])


def derivative(edges: Array, series: Array, s: Array) -> Array:
    """Derivatives in s of the series of `evaluate`, at arguments that are not edges."""
    own, share, length = _located(edges, series, s)
    return (_slopes(share, series.shape[-2] - 1)[..., None, :] @ own)[..., 0, :] / length[..., None]


def _located(edges: Array, series: Array, s: Array) -> tuple[Array, Array, Array]:
    """For each s: the coefficients (..., k, degree + 1, w) of its panel, where s lies in it, its length.

    The place within the panel runs from 0 to 1.
    """
    if series.shape[-3] == 1:
        low, length = edges[..., :1], edges[..., 1:] - edges[..., :1]
        return series, np.clip((s - low) / length, 0.0, 1.0), length
    lead = np.broadcast_shapes(edges.shape[:-1], s.shape[:-1], series.shape[:-3])
    edges = np.broadcast_to(edges, (*lead, edges.shape[-1]))
    s = np.broadcast_to(s, (*lead, s.shape[-1]))
    series = np.broadcast_to(series, (*lead, *series.shape[-3:]))
    inner = edges[..., None, 1:-1]
    panel = ((s[..., None] >= inner) & (inner < 1)).sum(axis=-1)
    low = np.take_along_axis(edges, panel, axis=-1)
    length = np.take_along_axis(np.diff(edges), panel, axis=-1)
    own = np.take_along_axis(series, panel[..., None, None], axis=-3)
    return own, np.clip((s - low) / length, 0.0, 1.0), length


def polynomials(s: Array, degree: int) -> Array:
    """T_0, ..., T_degree of 2 s - 1 at s (...), as (..., degree + 1)."""
    angle = 2 * np.arcsin(np.sqrt(1 - s))
    return np.cos(angle[..., None] * np.arange(degree + 1))


def _slopes(s: Array, degree: int) -> Array:
    angle = 2 * np.arcsin(np.sqrt(1 - s))[..., None]
    k = np.arange(degree + 1)
    return np.asarray(2 * k * np.sin(k * angle) / np.sin(angle))


@functools.cache
def _points(degree: int) -> Array:
    return np.sin(np.pi * np.arange(degree + 1) / (2 * degree)) ** 2


@functools.cache
def _to_coefficients(degree: int) -> Array:
    j = np.arange(degree + 1)
    matrix = 2 / degree * np.cos(np.pi * np.outer(j, degree - j) / degree)
    matrix[:, [0, -1]] /= 2
    matrix[[0, -1]] /= 2
    return matrix


@functools.cache
def _integrals(degree: int) -> Array:
    antiderivative = np.zeros((degree + 2, degree + 1))
    antiderivative[1, 0] = 1 / 2
    for k in range(1, degree + 1):
        antiderivative[k + 1, k] = 1 / (4 * (k + 1))
        antiderivative[k - 1, k] -= 0 if k == 1 else 1 / (4 * (k - 1))
    at = polynomials(_points(degree), degree + 1)
    return np.asarray(at - at[0]) @ antiderivative @ _to_coefficients(degree)
