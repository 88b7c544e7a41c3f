"""Quaternions and rotation vectors as attitudes of a body, and their rates of change.

Quaternions are scalar first and turn body axes into inertial axes; a rotation vector phi is a turn by |phi|
about phi. Angular rates w are in body axes. Every function takes stacks, (..., 3) and (..., 4); the products
take complex numbers too.
"""

import functools
import math

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.validation import vectors

FULL_TURN = 2 * np.pi

_ORDERS = np.arange(1, 28)
"""Orders of the power series in `_curvature`."""


@functools.cache
def _series() -> Array:
    """Coefficients of the power series in `_curvature`, 2 (zeta(2k) - 1)."""
    from scipy.special import zetac  # its import takes 0.2 s, and few of this module's users need it

    return np.asarray(2 * zetac(2 * _ORDERS))


def cross(a: Array, b: Array) -> Array:
    """a x b, several times faster than `numpy.cross` on single vectors."""
    result = np.empty(np.broadcast_shapes(a.shape, b.shape), dtype=np.result_type(a, b))
    result[..., 0] = a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1]
    result[..., 1] = a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2]
    result[..., 2] = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return result


def product(a: ArrayLike, b: ArrayLike) -> Array:
    """a o b of quaternions, (..., 4).

    Examples
    --------
    >>> product([0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]).tolist()
    [0.0, 0.0, 0.0, 1.0]
    """
    p, q = np.asarray(a), np.asarray(b)
    scalar = p[..., :1] * q[..., :1] - np.sum(p[..., 1:] * q[..., 1:], axis=-1, keepdims=True)
    vector = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + cross(p[..., 1:], q[..., 1:])
    return np.concatenate([scalar, vector], axis=-1)


def conjugate(a: ArrayLike) -> Array:
    """a~, the quaternion with the vector part reversed, (..., 4)."""
    return np.asarray(np.asarray(a) * np.array([1.0, -1.0, -1.0, -1.0]))


def pure(vector: ArrayLike) -> Array:
    """The quaternion with a given vector part and zero scalar part, (..., 3) -> (..., 4)."""
    given = np.asarray(vector)
    return np.concatenate([np.zeros_like(given[..., :1]), given], axis=-1)


def rotated(vector: ArrayLike, attitude: ArrayLike) -> Array:
    """a o x o a~: vectors (..., 3) turned by the quaternions (..., 4).

    Examples
    --------
    >>> rotated([1.0, 0.0, 0.0], about_third(np.pi / 2)).round(12).tolist()
    [0.0, 1.0, 0.0]
    """
    return product(product(attitude, pure(vector)), conjugate(attitude))[..., 1:]


def about_third(angle: ArrayLike) -> Array:
    """Quaternions of turns by angles (...) about the third axis, (..., 4)."""
    half = np.asarray(angle, dtype=float) / 2
    still = np.zeros_like(half)
    return np.stack([np.cos(half), still, still, np.sin(half)], axis=-1)


def within_a_turn(angle: ArrayLike) -> Array:
    """The same angles between -pi and pi, to rounding however large they are; those of up to a turn stay.

    Examples
    --------
    >>> within_a_turn([3.0, 1e15]).round(9).tolist()
    [3.0, 2.109698117]
    """
    given = np.asarray(angle, dtype=float)
    reduced = np.arctan2(np.sin(given), np.cos(given))
    return np.asarray(np.where(np.abs(given) <= 2 * np.pi, given, reduced))


def twist(attitude: Array) -> float:
    """The angle about e3, in (-pi, pi], when a turn is split into (turn about an axis normal to e3) o it."""
    angle = 2 * math.atan2(attitude[3], attitude[0])
    return angle - FULL_TURN * round(angle / FULL_TURN)


def attitude_rate(q: Array, w: Array) -> Array:
    """q' = q o w / 2."""
    return product(q, pure(w)) / 2


def quaternion(phi: ArrayLike) -> Array:
    """Unit quaternion of the turn by |phi| about phi, (..., 3) -> (..., 4).

    Examples
    --------
    >>> quaternion([0.0, 0.0, np.pi]).round(12).tolist()
    [0.0, 0.0, 0.0, 1.0]
    """
    phi = vectors("phi", phi, 3)
    half = np.linalg.norm(phi, axis=-1, keepdims=True) / 2
    return np.concatenate([np.cos(half), np.sinc(half / np.pi) * phi / 2], axis=-1)


def rotation_vector(attitude: ArrayLike) -> Array:
    """Rotation vector of a quaternion, (..., 4) -> (..., 3), with 0 <= |phi| <= 2 pi.

    A quaternion and its negative are the same attitude, reached by two different turns; phi distinguishes
    them. Along a motion that starts with a small turn phi is continuous up to a full turn.

    Examples
    --------
    >>> rotation_vector(quaternion([0.0, -5.0, 0.0])).round(12).tolist()
    [0.0, -5.0, 0.0]
    """
    q = vectors("attitude", attitude, 4)
    sine = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, q[..., :1])
    stretch = np.divide(angle, sine, out=np.full_like(sine, 2.0), where=sine > 1e-150)
    return np.asarray(stretch * q[..., 1:])


def between(attitude: ArrayLike, other: ArrayLike) -> Array:
    """Quaternion of the shorter turn from one attitude to the other, in body axes, (..., 4)."""
    p, q = vectors("attitude", attitude, 4), vectors("other", other, 4)
    turn = product(conjugate(p), q)
    return np.where(turn[..., :1] < 0, -1.0, 1.0) * turn


def vector_rate_matrix(phi: Array) -> Array:
    """B^-1 with phi' = B^-1 w, (..., 3) -> (..., 3, 3): 1 + [phi]/2 + g [phi]^2."""
    g, _ = _curvature(phi)
    outer = phi[..., :, None] * phi[..., None, :]
    square = outer - (phi**2).sum(axis=-1)[..., None, None] * np.eye(3)
    return np.asarray(np.eye(3) + _skew(phi) / 2 + g[..., None] * square)


def vector_acceleration_drift(phi: Array, w: Array) -> Array:
    """(B^-1)' w, (..., 3): the part of phi'' = B^-1 w' + (B^-1)' w without the angular acceleration w'."""
    g, slope = _curvature(phi)
    inner = cross(phi, w)
    rate = w + inner / 2 + g * cross(phi, inner)
    stretch = slope * (phi * rate).sum(axis=-1, keepdims=True)
    curved = cross(rate, inner) + cross(phi, cross(rate, w))
    return np.asarray(cross(rate, w) / 2 + stretch * cross(phi, inner) + g * curved)


def _curvature(phi: Array) -> tuple[Array, Array]:
    """g = (1 - (t/2) cot(t/2))/t^2 and (dg/dt)/t at t = |phi|, (..., 1) each.

    By g = sum over k of 2/((2 pi k)^2 - t^2): the first term has the pole at a full turn; the others are a
    power series in r = (t / 2 pi)^2 whose terms fall by a factor of 4 or more for t up to a full turn.
    """
    r = (phi**2).sum(axis=-1, keepdims=True) / FULL_TURN**2
    powers = r[..., None] ** (_ORDERS - 1)
    series = _series()
    g = 2 / (1 - r) + (powers * series).sum(axis=-1)
    slope = 2 / (1 - r) ** 2 + (powers[..., :-1] * (series * (_ORDERS - 1))[1:]).sum(axis=-1)
    return g / FULL_TURN**2, 2 * slope / FULL_TURN**4


def _skew(phi: Array) -> Array:
    x, y, z = np.moveaxis(phi, -1, 0)
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
