"""Checks of the numbers and quaternions that a rendezvous is posed with."""

from dataclasses import fields

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.validation import finite, vectors

UNIT_WITHIN = 1e-6
"""A quaternion whose length differs from 1 by at most this, as in single precision, is normalised."""


def number(name: str, value: ArrayLike, least: float | None = None, excluded: bool = False) -> float:
    """`value` as one finite float, at least `least`, or above it where that is `excluded`."""
    array = finite(name, value, "a number")
    if array.ndim:
        raise ValueError(f"{name} must be one number, got an array of shape {array.shape}")
    if least is not None and (array < least or (excluded and array == least)):
        raise ValueError(
            f"{name} must be {'greater than' if excluded else 'at least'} {least:g}, got {array}"
        )
    return float(array)


def unit_quaternion(name: str, value: ArrayLike) -> Array:
    """`value` as a unit quaternion, scalar part first, in a read-only array (4,)."""
    array = vectors(name, value, 4)
    if array.shape != (4,):
        raise ValueError(f"{name} must be one quaternion of shape (4,), got shape {array.shape}")
    length = float(np.linalg.norm(array))
    if abs(length - 1) > UNIT_WITHIN:
        raise ValueError(f"{name} must be a unit quaternion, got one of length {length:.12g}")
    unit = array / length
    unit.flags.writeable = False
    return unit


def by_value(one: object) -> tuple[object, ...]:
    """The fields of a dataclass with arrays as tuples: two instances are equal where these are."""
    values = (getattr(one, field.name) for field in fields(one))  # type: ignore[arg-type]
    return tuple(tuple(x.tolist()) if isinstance(x, np.ndarray) else x for x in values)
