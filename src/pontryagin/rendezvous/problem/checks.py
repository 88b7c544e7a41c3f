"""Checks of the numbers and quaternions that define a rendezvous."""

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.validation import angles, finite, vectors

UNIT_WITHIN = 1e-6
"""Quaternions whose length differs from 1 by at most this, as in single precision, are normalised."""


def number(name: str, value: ArrayLike, least: float | None = None, excluded: bool = False) -> float:
    """`value` as one finite float that is at least `least`, or greater than `least` if it is `excluded`."""
    array = finite(name, value, "a number")
    if array.ndim:
        raise ArgumentValueError(f"{name} must be one number, got an array of shape {array.shape}", name)
    if least is not None and (array < least or (excluded and array == least)):
        relation = "greater than" if excluded else "at least"
        raise ArgumentValueError(f"{name} must be {relation} {least:g}, got {array}", name)
    return float(array)


def angle(name: str, value: ArrayLike) -> float:
    """`value` as one angle in radians that double precision places on the turn."""
    number(name, value)
    return float(angles(name, value, "a number"))


def unit_quaternion(name: str, value: ArrayLike) -> Array:
    """`value` as a unit quaternion, scalar part first, in a new array (4,)."""
    array = vectors(name, value, 4)
    if array.shape != (4,):
        raise ArgumentValueError(
            f"{name} must be one quaternion of shape (4,), got shape {array.shape}", name
        )
    length = float(np.linalg.norm(array))
    if abs(length - 1) > UNIT_WITHIN:
        raise ArgumentValueError(f"{name} must be a unit quaternion, got one of length {length:.12g}", name)
    return array / length
