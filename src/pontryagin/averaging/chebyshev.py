"""Chebyshev's points and series on [0, 1]: integrals, values and slopes of what is known at the points."""

import functools

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@functools.cache
def points(degree: int) -> Array:
    """The degree + 1 extreme points of Chebyshev's polynomial, ascending from 0 to 1."""
    return np.sin(np.pi * np.arange(degree + 1) / (2 * degree)) ** 2


@functools.cache
def to_coefficients(degree: int) -> Array:
    """Matrix from values at the points to coefficients of T_0, ..., T_degree in 2 s - 1."""
    j = np.arange(degree + 1)
    matrix = 2 / degree * np.cos(np.pi * np.outer(j, degree - j) / degree)
    matrix[:, [0, -1]] /= 2
    matrix[[0, -1]] /= 2
    return matrix


@functools.cache
def integrals(degree: int) -> Array:
    """Matrix from values at the points to integrals from 0 to each point."""
    antiderivative = np.zeros((degree + 2, degree + 1))
    antiderivative[1, 0] = 1 / 2
    for k in range(1, degree + 1):
        antiderivative[k + 1, k] = 1 / (4 * (k + 1))
        antiderivative[k - 1, k] -= 0 if k == 1 else 1 / (4 * (k - 1))
    series = antiderivative @ to_coefficients(degree)
    at = polynomials(points(degree), degree + 1)
    return (at - at[0]) @ series


def polynomials(s: Array, degree: int) -> Array:
    """T_0, ..., T_degree of 2 s - 1 at s (...), as (..., degree + 1)."""
    angle = 2 * np.arcsin(np.sqrt(1 - s))
    return np.cos(angle[..., None] * np.arange(degree + 1))


def slopes(s: Array, degree: int) -> Array:
    """Their derivatives in s, strictly between 0 and 1."""
    angle = 2 * np.arcsin(np.sqrt(1 - s))[..., None]
    k = np.arange(degree + 1)
    return 2 * k * np.sin(k * angle) / np.sin(angle)
