"""Quaternions in numbers, scalar part first, along the last axis."""

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array


def product(a: ArrayLike, b: ArrayLike) -> Array:
    """a o b of quaternions along the last axis."""
    p, q = np.asarray(a), np.asarray(b)
    scalar = p[..., :1] * q[..., :1] - np.sum(p[..., 1:] * q[..., 1:], axis=-1, keepdims=True)
    vector = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
    return np.concatenate([scalar, vector], axis=-1)


def conjugate(a: ArrayLike) -> Array:
    """a~ along the last axis."""
    return np.asarray(a) * np.array([1.0, -1.0, -1.0, -1.0])


def rotated(vector: Array, attitude: Array) -> Array:
    """a o x o a~ of vectors along the last axis."""
    pure = np.concatenate([np.zeros((*vector.shape[:-1], 1)), vector], axis=-1)
    return product(product(attitude, pure), conjugate(attitude))[..., 1:]


def about_third(angle: ArrayLike) -> Array:
    """Turns by angles about the third axis."""
    half = np.asarray(angle, dtype=float) / 2
    still = np.zeros_like(half)
    return np.stack([np.cos(half), still, still, np.sin(half)], axis=-1)
