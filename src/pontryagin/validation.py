"""Checks of what users pass in: each names the argument, what it got and what it takes."""

from math import isfinite
from operator import index

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array


def finite(name: str, value: ArrayLike, takes: str) -> Array:
    """`value` as a new array of finite floats.

    Raises
    ------
    TypeError
        If it does not hold real numbers.
    ValueError
        If it holds nan or infinity, or is ragged.

    Examples
    --------
    >>> finite("x0", [0, 1, 2], "three numbers")
    array([0., 1., 2.])
    """
    try:
        array = np.array(value)
    except ValueError:
        raise ValueError(f"{name} must be {takes}, got a ragged sequence {value!r}") from None
    if array.dtype.kind not in "fiu":
        if array.dtype.kind == "O":
            array = _from_objects(name, array, takes)
        else:
            raise TypeError(f"{name} must be {takes}, got {value!r} of type {array.dtype}")
    array = array.astype(float, copy=False)
    if array.size < 4 and all(map(isfinite, array.ravel().tolist())):
        return array
    if not np.isfinite(array).all():
        bad = array[~np.isfinite(array)].flat[0]
        where = (
            ""
            if array.ndim == 0
            else f" at index {tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])}"
        )
        raise ValueError(f"{name} must be {takes} and finite, got {bad}{where}")
    return array


def _from_objects(name: str, array: NDArray, takes: str) -> Array:
    """Numbers that NumPy does not know as such (fractions, SymPy numbers)."""
    try:
        if any(entry is None for entry in array.flat):
            raise TypeError
        return array.astype(float)
    except OverflowError:
        raise ValueError(f"{name} must be {takes} that double precision holds, got more") from None
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be {takes}, got {array.tolist()!r}") from None


def vectors(name: str, value: ArrayLike, length: int) -> Array:
    """`value` as finite vectors of the given length along the last axis."""
    array = finite(name, value, f"an array (..., {length})")
    if array.ndim == 0 or array.shape[-1] != length:
        raise ValueError(f"{name} must be an array (..., {length}), got shape {array.shape}")
    return array


def integer(name: str, value: object) -> int:
    """`value` as an integer, of whichever sign.

    Raises
    ------
    TypeError
        If it is none.
    """
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        return index(value)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"{name} must be a whole number, got {value!r}") from None


def positive(name: str, value: ArrayLike) -> Array:
    """`value` as finite numbers greater than zero."""
    array = finite(name, value, "a positive number or an array of them")
    few = array.size < 4
    if not (all(number > 0 for number in array.ravel().tolist()) if few else (array > 0).all()):
        raise ValueError(f"{name} must be positive, got {array[~(array > 0)].flat[0]}")
    return array


def times(name: str, value: ArrayLike, start: NDArray, end: NDArray) -> Array:
    """`value` (k,) or (..., k) broadcast against the intervals [start, end] (...), as (..., k).

    Times outside by no more than rounding are moved to the end of the interval; others are refused.
    """
    array = np.atleast_1d(finite(name, value, "a number or an array (k,) of times"))
    start, end = start[..., None], end[..., None]
    try:
        inside = np.clip(array, start, end)
    except ValueError:
        raise ValueError(
            f"{name} must be an array (k,) or (..., k) of times, got shape {array.shape} "
            f"for a stack of shape {start.shape[:-1]}"
        ) from None
    allowance = 1e-12 * (end - start) + 1e-15 * (np.abs(start) + np.abs(end))
    outside = np.abs(array - inside) > allowance
    if outside.any():
        bad = np.broadcast_to(array, outside.shape)[outside].flat[0]
        raise ValueError(f"{name} must lie between the start and the end of the manoeuvre, got {bad}")
    return inside


def common_shape(**shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The shape that the named leading shapes broadcast to."""
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise ValueError(f"leading shapes do not broadcast: {listed}") from None
