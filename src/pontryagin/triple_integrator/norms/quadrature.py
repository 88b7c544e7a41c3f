"""Integrals over [0, 1] of functions of a quadratic, accurate also at its zeros and at narrow peaks.

A quadratic is cut at its zeros and its vertex. On each piece it is monotone and of one sign, so that its
Bernstein form has coefficients of one sign and loses no digits next to a zero. Singularities and steep
places lie at the ends of pieces, where both rules crowd their nodes. The solvers use the logistic rule,
their certificates the graded one.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.quadrature import gauss
from pontryagin.value import value_class

Integrand = Callable[[NDArray[np.intp], Array], Array]
"""From the index of each quadratic in its flat stack (m,) and its values (m, n) to the integrand (m, n)."""


class Rule(NamedTuple):
    """Nodes in (0, 1), their distances from 1 to full relative precision, and weights, each (n,)."""

    nodes: Array
    remaining: Array
    weights: Array
    step: float


@cache
def logistic_rule() -> Rule:
    """Trapezoidal rule in x for the node 1/(1 + exp(-x)).

    In the complex plane of x the singularity of a zero beyond an end of the piece, however near, is pi away
    from the real axis, and that of a peak at an end, however narrow, pi/4. One step size therefore gives 15
    digits for all.
    """
    step, reach = 0.14, 264
    x = step * np.arange(-reach, reach + 1)
    nodes, remaining = 1 / (1 + np.exp(-x)), 1 / (1 + np.exp(x))
    return Rule(nodes, remaining, step * nodes * remaining, step)


@cache
def graded_rule() -> Rule:
    """Sixteen Gauss-Legendre nodes on panels that shrink fourfold towards both ends."""
    x, w = gauss(16)
    edges = np.append(0.0, 0.5 * 4.0 ** np.arange(-27.0, 1.0))
    widths = np.diff(edges)
    near = (edges[:-1, None] + widths[:, None] * x).ravel()
    weights = (widths[:, None] * w).ravel()
    return Rule(np.append(near, 1 - near), np.append(1 - near, near), np.append(weights, weights), 0.0)


@value_class
@dataclass(frozen=True, eq=False)
class Quadratic:
    """h(s) = h0 + h1 s + h2 s^2 on [0, 1], or a stack of them.

    Attributes
    ----------
    coefficients : (..., 3) array
        h0, h1, h2.
    discriminant : (...) array
        h1^2 - 4 h0 h2. It is kept beside the coefficients because next to a double zero the rounded
        coefficients do not determine it; the distance of the zeros is its square root over h2.
    """

    coefficients: Array
    discriminant: Array

    @classmethod
    def of(cls, coefficients: ArrayLike) -> "Quadratic":
        """The quadratic with these coefficients and the discriminant computed from them."""
        h = np.asarray(coefficients, dtype=float)
        return cls(h, h[..., 1] ** 2 - 4 * h[..., 0] * h[..., 2])

    def plus(self, change: Array) -> "Quadratic":
        """Sum with the quadratic of given coefficients; the discriminant is updated, not computed anew."""
        (h0, h1, h2), (d0, d1, d2) = np.moveaxis(self.coefficients, -1, 0), np.moveaxis(change, -1, 0)
        linear = 2 * (h1 * d1 - 2 * (h0 * d2 + h2 * d0))
        return Quadratic(self.coefficients + change, self.discriminant + linear + (d1**2 - 4 * d0 * d2))

    def scaled(self, factor: Array) -> "Quadratic":
        """The quadratic times a positive number."""
        return Quadratic(self.coefficients * factor[..., None], self.discriminant * factor**2)

    def reshape(self, *stack: int) -> "Quadratic":
        """The same quadratics as a stack of another shape."""
        return Quadratic(self.coefficients.reshape(*stack, 3), self.discriminant.reshape(stack))

    def __getitem__(self, index: Any) -> "Quadratic":
        return Quadratic(self.coefficients[index], self.discriminant[index])

    @cached_property
    def zeros(self) -> Array:
        """Zeros within (0, 1) at which h changes sign, before and after the vertex, (..., 2); else nan."""
        h0, h1, h2 = np.moveaxis(self.coefficients, -1, 0)
        with np.errstate(all="ignore"):
            larger = -(h1 + np.where(h1 < 0, -1, 1) * self._root) / 2
            pair = np.stack([larger / h2, h0 / larger], axis=-1)
            real = (self.discriminant > 0)[..., None] & (pair > 0) & (pair < 1)
        pair = np.where(real, pair, np.nan)
        low, high = np.fmin(pair[..., 0], pair[..., 1]), np.fmax(pair[..., 0], pair[..., 1])
        left = np.where(low <= self._vertex, low, np.nan)
        right = np.where(high >= self._vertex, high, np.nan)
        return np.stack([left, right], axis=-1)

    @cached_property
    def _root(self) -> Array:
        return np.sqrt(np.maximum(self.discriminant, 0.0))

    @cached_property
    def _vertex(self) -> Array:
        """The zero of h', moved to the nearer end of [0, 1] if it lies outside."""
        _, h1, h2 = np.moveaxis(self.coefficients, -1, 0)
        with np.errstate(all="ignore"):
            vertex = np.where(h2 == 0, 1.0, -h1 / (2 * h2))
        return np.clip(vertex, 0.0, 1.0)

    @cached_property
    def cuts(self) -> tuple[Array, Array, Array]:
        """Positions 0, zero, vertex, zero, 1, and h and h' there, each (..., 5).

        A zero or a vertex that is not inside is put at an end.
        """
        h0, h1, h2 = np.moveaxis(self.coefficients, -1, 0)
        left, right = np.moveaxis(self.zeros, -1, 0)
        vertex, end, end_slope = self._vertex, h0 + h1 + h2, h1 + 2 * h2
        inside = (vertex > 0) & (vertex < 1)
        with np.errstate(all="ignore"):
            extreme = np.where(inside, -self.discriminant / (4 * h2), np.where(vertex == 0, h0, end))
        extreme_slope = np.where(inside, 0.0, np.where(vertex == 0, h1, end_slope))
        rising = np.where(h2 == 0, np.sign(h1), np.sign(h2)) * self._root
        falling = np.where(h2 == 0, rising, -rising)
        no_left, no_right = np.isnan(left), np.isnan(right)
        zero, one = np.zeros_like(h0), np.ones_like(h0)
        positions = [zero, np.where(no_left, 0, left), vertex, np.where(no_right, 1, right), one]
        values = [h0, np.where(no_left, h0, 0), extreme, np.where(no_right, end, 0), end]
        slopes = [
            h1,
            np.where(no_left, h1, falling),
            extreme_slope,
            np.where(no_right, end_slope, rising),
            end_slope,
        ]
        return np.stack(positions, -1), np.stack(values, -1), np.stack(slopes, -1)

    @cached_property
    def bernstein(self) -> Array:
        """Bernstein coefficients of h on the four pieces, (..., 4, 3); those of one piece have one sign."""
        positions, values, slopes = self.cuts
        widths = np.diff(positions, axis=-1)
        first, last = values[..., :-1], values[..., 1:]
        from_first, from_last = first + widths * slopes[..., :-1] / 2, last - widths * slopes[..., 1:] / 2
        middle = np.where(np.abs(first) <= np.abs(last), from_first, from_last)
        middle = np.clip(middle, np.minimum(first, last), np.maximum(first, last))
        return np.stack([first, middle, last], axis=-1)

    def sample(self, rule: Rule) -> tuple[Array, Array, Array]:
        """Nodes, values of h and weights of a rule applied to the four pieces, each (..., 4, n)."""
        positions = self.cuts[0]
        widths = np.diff(positions, axis=-1)[..., None]
        s = positions[..., :-1, None] + widths * rule.nodes
        return s, blend(self.bernstein[..., None, :], rule.nodes, rule.remaining), widths * rule.weights

    def __call__(self, s: Array) -> Array:
        """h at the places s (..., k)."""
        piece, share, remaining = self.locate(s)
        return blend(np.take_along_axis(self.bernstein, piece[..., None], axis=-2), share, remaining)

    def locate(self, s: Array) -> tuple[NDArray[np.intp], Array, Array]:
        """Piece in which each place s (..., k) lies, its share of that piece, and the share that remains."""
        positions = np.broadcast_to(self.cuts[0], (*s.shape[:-1], 5))
        inner = positions[..., None, 1:-1]
        piece = ((s[..., :, None] >= inner) & (inner < 1)).sum(axis=-1)
        start, end = (np.take_along_axis(positions, piece + i, axis=-1) for i in (0, 1))
        width = np.where(end > start, end - start, 1.0)
        return piece, (s - start) / width, (end - s) / width


@cache
def orthonormal() -> Array:
    """A matrix (3, 3) whose rows hold the coefficients of 1, s, s^2 in polynomials orthonormal on [0, 1]."""
    powers = np.arange(3)
    return np.linalg.inv(np.linalg.cholesky(1 / (1 + np.add.outer(powers, powers))))


def basis_at(s: Array) -> Array:
    """The orthonormal polynomials at the nodes s (n, ...), as (n, all nodes, 3)."""
    powers = np.stack([np.ones_like(s), s, s * s], axis=-1)
    return powers.reshape(len(s), -1, 3) @ orthonormal().T


def first_moments(basis: Array, weights: Array) -> Array:
    """Sums of weights times basis functions, (n, 3)."""
    sums: Array = np.einsum("nk,nki->ni", weights.reshape(len(basis), -1), basis)
    return sums


def second_moments(basis: Array, weights: Array) -> Array:
    """Sums of weights times products of two basis functions, (n, 3, 3)."""
    return np.swapaxes(basis * weights.reshape(len(basis), -1, 1), 1, 2) @ basis


def blend(bernstein: Array, share: Array, remaining: Array) -> Array:
    """Value of a Bernstein form (..., 3) at a share of its piece."""
    first, middle, last = bernstein[..., 0], bernstein[..., 1], bernstein[..., 2]
    return first * remaining**2 + 2 * middle * (remaining * share) + last * share**2


def moments_beyond(h: Quadratic, s: Array, function: Integrand, block: int = 4096) -> Array:
    """Integrals from s to 1 of (sigma - s)^j / j! times function(h(sigma)), j = 2, 1, 0.

    Parameters
    ----------
    h : Quadratic
        A stack (...).
    s : (..., k) array
        Where the integrals start.
    function : callable
        From (index into the flat stack (m,), values of h (m, n)) to the integrand (m, n).
    block : int
        How many integrals are evaluated at a time.

    Returns
    -------
    (..., k, 3) array
    """
    rule = logistic_rule()
    flat = h.reshape(-1)
    places = s.reshape(len(flat.discriminant), s.shape[-1])
    owner = np.repeat(np.arange(places.shape[0]), places.shape[1])
    piece, share, remaining = (part.ravel() for part in flat.locate(places))
    positions, forms, whole = flat.cuts[0], flat.bernstein, _whole_pieces(flat, function)
    result = np.empty((places.size, 3))
    for start in range(0, places.size, block):
        part = slice(start, start + block)
        i, j, left = owner[part], piece[part], remaining[part, None]
        width = left * (positions[i, j + 1] - positions[i, j])[:, None]
        inside = blend(forms[i, j][:, None, :], share[part, None] + left * rule.nodes, left * rule.remaining)
        integrand = function(i, inside) * (width * rule.weights)
        result[part] = _taylor(integrand, width * rule.nodes)
        for later in (1, 2, 3):
            gap = np.maximum(positions[i, later] - places.ravel()[part], 0.0)
            result[part] += np.where((j < later)[:, None], _shifted(whole[i, later], gap), 0.0)
    return result.reshape(*s.shape, 3)


def _whole_pieces(flat: Quadratic, function: Integrand) -> Array:
    """The integrals of `moments_beyond` over each whole piece, from the start of that piece, (m, 4, 3)."""
    _, values, weights = flat.sample(logistic_rule())
    widths = np.diff(flat.cuts[0], axis=-1)[..., None]
    owner = np.arange(len(values))
    pieces = [
        _taylor(function(owner, values[:, i]) * weights[:, i], widths[:, i] * logistic_rule().nodes)
        for i in range(4)
    ]
    return np.stack(pieces, axis=1)


def _taylor(integrand: Array, distance: Array) -> Array:
    return np.stack([(integrand * distance**j).sum(axis=-1) / max(j, 1) for j in (2, 1, 0)], axis=-1)


def _shifted(integrals: Array, gap: Array) -> Array:
    """Integrals with the weights (gap + distance)^j / j!, j = 2, 1, 0, from those with a gap of 0."""
    second, first, zeroth = np.moveaxis(integrals, -1, 0)
    return np.stack([second + gap * first + gap**2 / 2 * zeroth, first + gap * zeroth, zeroth], axis=-1)
