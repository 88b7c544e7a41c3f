"""Chebyshev series through values at the nodes of panels, and their integrals."""

from functools import cache
from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from pontryagin.arrays import Array

DEGREE = 24
"""Degree of the Chebyshev series on each panel."""

LATE = 1e-13
"""A relative change of values by the rounding of times above this is made up for."""

TOO_LATE = 1e-3
"""Not so where times are rounded by more than this share of half a panel."""


@cache
def chebyshev_fit(degree: int) -> tuple[Array, Array]:
    """Chebyshev nodes in [-1, 1], and the matrix from values there to the coefficients of the series."""
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    return nodes, np.asarray(np.linalg.inv(chebyshev.chebvander(nodes, degree)), dtype=float)


@cache
def _derivatives(degree: int) -> tuple[Array, Array]:
    """The matrices from coefficients of series to their first and second derivatives at the nodes."""
    nodes, _ = chebyshev_fit(degree)
    unit = np.eye(degree + 1)
    first, second = (chebyshev.chebval(nodes, chebyshev.chebder(unit, order)) for order in (1, 2))
    return np.asarray(first), np.asarray(second)


def _product(rows: Array, matrix: Array) -> Array:
    """Rows times a transposed matrix, each alike: BLAS rounds the last digit by the number of rows."""
    return np.asarray(np.einsum("pn,cn->pc", rows, matrix))


def fitted(sample: Array, late: Array) -> Array:
    """Coefficients of series from values (p, degree+1) at nodes that are late by so much, in [-1, 1].

    The series itself tells how much the values change between the nodes and the rounded times, so that
    narrow features keep the digits that the values have.
    """
    _, invert = chebyshev_fit(DEGREE)
    first, second = _derivatives(DEGREE)
    coefficients = _product(sample, invert)
    moved = late * _product(coefficients, first.T)
    most = np.abs(late).max(axis=1, initial=0.0)
    at = np.flatnonzero((np.abs(moved).max(axis=1) > LATE * np.abs(sample).max(axis=1)) & (most < TOO_LATE))
    for _ in range(3 if at.size else 0):
        given = coefficients[at]
        moved = late[at] * (_product(given, first.T) + late[at] / 2 * _product(given, second.T))
        coefficients[at] = _product(sample[at] - moved, invert)
    return coefficients


def panel_integrals(coefficients: Array, x: Array, width: Array) -> Array:
    """g1 and g2 from the left edge of panels (p, degree+1) to the positions x in [-1, 1], (p, 2)."""
    first = chebyshev.chebint(coefficients, 1, lbnd=-1, axis=1)
    second = chebyshev.chebint(coefficients, 2, lbnd=-1, axis=1)
    g2 = chebyshev.chebval(x, first.T, tensor=False) * width / 2
    g1 = chebyshev.chebval(x, second.T, tensor=False) * (width / 2) ** 2
    return np.stack([g1, g2], axis=-1)


def running_integrals(
    first: NDArray[np.intp], owner: NDArray[np.intp], width: Array, coefficients: Array
) -> Array:
    """g1 and g2 from the start of each interval to the left ends of its panels, (p, 2)."""
    over = panel_integrals(coefficients, np.ones(len(width)), width)
    place = np.arange(len(width)) - first[owner]
    order = np.argsort(place, kind="stable")
    bounds = np.searchsorted(place[order], np.arange(1, place.max(initial=0) + 2))
    found = np.zeros_like(over)
    for begin, end in pairwise(bounds):
        here = order[begin:end]
        before = here - 1
        found[here] = found[before] + over[before]
        found[here, 0] += found[before, 1] * width[before]
    return found
