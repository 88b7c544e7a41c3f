"""Checks of the arguments that several functions of this paper take."""

from operator import index

from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.validation import angles, positive, require_bare, vectors


def state(z0: ArrayLike) -> Array:
    """One deviation z0 as a new array (3,)."""
    array = vectors("z0", z0, 3)
    if array.ndim != 1:
        raise ArgumentValueError(f"z0 must be an array (3,), got shape {array.shape}", "z0")
    return array


def positive_number(name: str, value: ArrayLike) -> float:
    """One finite number greater than 0."""
    array = positive(name, value)
    if array.ndim:
        raise ArgumentValueError(f"{name} must be a single number, got shape {array.shape}", name)
    return float(array)


def angle(name: str, value: ArrayLike) -> float:
    """One angle in radians."""
    array = angles(name, value, "a number")
    if array.ndim:
        raise ArgumentValueError(f"{name} must be a single number, got shape {array.shape}", name)
    return float(array)


def count(name: str, value: object, least: int = 1) -> int:
    """A whole number of steps, states or impulses, at least `least`."""
    require_bare(name, value, "a whole number")
    try:
        number = -1 if isinstance(value, bool) else index(value)  # type: ignore[arg-type]
    except TypeError:
        number = -1
    if number < least:
        takes = "a positive whole number" if least == 1 else f"a whole number, at least {least}"
        raise ArgumentValueError(f"{name} must be {takes}, got {value!r}", name)
    return number
