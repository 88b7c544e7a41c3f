"""Checks of arguments; their errors name the argument, what it accepts and what was given."""

from math import isfinite
from operator import index
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError

BARE = frozenset({float, int, bool, str, type(None), np.float64, np.float32, np.int64})
"""Types without a unit and a mask, which need no closer look."""

TINY = 2.0**-1022
"""The smallest number with all digits of double precision. Smaller ones are multiples of 2^-1074."""

LARGEST_ANGLE = 2.0**53
"""Neighbouring numbers beyond this are two radians or more apart, so that they say little of a phase."""

FEW = 16
"""Up to so many numbers are checked faster one by one than by NumPy."""


def finite(name: str, value: ArrayLike, takes: str) -> Array:
    """`value` as a new array of finite floats.

    Raises
    ------
    TypeError
        If `value` does not hold real numbers, or carries a unit.
    ValueError
        If `value` holds nan or infinity, has masked entries, or is ragged.

    Examples
    --------
    >>> finite("x0", [0, 1, 2], "three numbers")
    array([0., 1., 2.])
    """
    require_bare(name, value, takes)
    try:
        array = np.array(value)
    except ValueError:
        raise ArgumentValueError(f"{name} must be {takes}, got a ragged sequence {value!r}", name) from None
    if array.dtype.kind not in "fiu":
        if array.dtype.kind == "O":
            array = _from_objects(name, array, takes)
        else:
            raise ArgumentTypeError(f"{name} must be {takes}, got {value!r} of type {array.dtype}", name)
    array = array.astype(float, copy=False)
    if array.size <= FEW and all(map(isfinite, array.ravel().tolist())):
        return array
    if not np.isfinite(array).all():
        bad = array[~np.isfinite(array)].flat[0]
        where = (
            ""
            if array.ndim == 0
            else f" at index {tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])}"
        )
        raise ArgumentValueError(f"{name} must be {takes} and finite, got {bad}{where}", name)
    return array


def require_bare(name: str, value: object, takes: str) -> None:
    """Refuse what NumPy would strip in silence: a unit of measurement, and the mask of an array.

    Raises
    ------
    TypeError
        If `value`, or an entry of it, carries a unit, as quantities of astropy and pint do.
    ValueError
        If `value`, or an entry of it, is masked.

    Examples
    --------
    >>> require_bare("tf", 2.0, "a number")
    >>> try:
    ...     require_bare("tf", np.ma.array([1.0, 2.0], mask=[False, True]), "an array")
    ... except ValueError as error:
    ...     print(error)
    tf must be an array, got masked entries
    """
    kind: Any = type(value)
    if kind in BARE:
        return
    if kind is list or kind is tuple:
        if not BARE.issuperset(map(type, value)):  # type: ignore[call-overload]
            for entry in value:  # type: ignore[attr-defined]
                require_bare(name, entry, takes)
    elif np.ma.isMaskedArray(value):
        if np.ma.getmaskarray(value).any():
            raise ArgumentValueError(f"{name} must be {takes}, got masked entries", name)
    elif any(hasattr(value, mark) for mark in ("unit", "units")) and not hasattr(value, "free_symbols"):
        unit = getattr(value, "unit", None) or getattr(value, "units", None)
        message = f"{name} must be {takes} without a unit, got {kind.__name__} in {str(unit) or 'units of 1'}"
        raise ArgumentTypeError(message, name)
    elif isinstance(value, np.ndarray) and value.dtype.kind == "O":
        require_bare(name, value.ravel().tolist(), takes)


def _from_objects(name: str, array: NDArray[np.object_], takes: str) -> Array:
    """Floats from an array of Python objects that are numbers (fractions, SymPy numbers)."""
    try:
        if any(entry is None for entry in array.flat):
            raise TypeError
        return array.astype(float)
    except OverflowError:
        raise ArgumentValueError(
            f"{name} must be {takes} that double precision holds, got more", name
        ) from None
    except (TypeError, ValueError):
        raise ArgumentTypeError(f"{name} must be {takes}, got {array.tolist()!r}", name) from None


def vectors(name: str, value: ArrayLike, length: int) -> Array:
    """`value` as finite vectors of the given length along the last axis."""
    array = finite(name, value, f"an array (..., {length})")
    if array.ndim == 0 or array.shape[-1] != length:
        raise ArgumentValueError(f"{name} must be an array (..., {length}), got shape {array.shape}", name)
    return array


def integer(name: str, value: object) -> int:
    """`value` as an integer, positive, zero or negative.

    Raises
    ------
    TypeError
        If `value` is not an integer.
    """
    try:
        require_bare(name, value, "a whole number")
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        return index(value)  # type: ignore[arg-type]
    except ArgumentTypeError:
        raise
    except TypeError:
        raise ArgumentTypeError(f"{name} must be a whole number, got {value!r}", name) from None


def positive(name: str, value: ArrayLike) -> Array:
    """`value` as finite numbers greater than zero."""
    array = finite(name, value, "a positive number or an array of them")
    few = array.size < 4
    if not (all(number > 0 for number in array.ravel().tolist()) if few else (array > 0).all()):
        raise ArgumentValueError(f"{name} must be positive, got {array[~(array > 0)].flat[0]}", name)
    return array


def angles(name: str, value: ArrayLike, takes: str) -> Array:
    """`value` as finite angles in radians.

    Raises
    ------
    ValueError
        If an angle is so large that double precision does not hold its place on the turn.

    Examples
    --------
    >>> angles("anomaly", 0.5, "a number")
    array(0.5)
    """
    array = finite(name, value, takes)
    large = np.abs(array) > LARGEST_ANGLE
    if large.any():
        message = (
            f"{name} must be {takes}, at most {LARGEST_ANGLE:.1e} rad, beyond which neighbouring numbers are "
            f"2 rad or more apart, got {array[large].flat[0]}"
        )
        raise ArgumentValueError(message, name)
    return array


def times(name: str, value: ArrayLike, start: Array, end: Array) -> Array:
    """`value` (k,) or (..., k) broadcast against the intervals [start, end] (...), as (..., k).

    Times that lie outside by no more than rounding are moved to the nearer end; others raise ValueError.
    """
    array = np.atleast_1d(finite(name, value, "a number or an array (k,) of times"))
    start, end = start[..., None], end[..., None]
    try:
        inside = np.clip(array, start, end)
    except ValueError:
        raise ArgumentValueError(
            f"{name} must be an array (k,) or (..., k) of times, got shape {array.shape} "
            f"for a stack of shape {start.shape[:-1]}",
            name,
        ) from None
    allowance = 1e-12 * (end - start) + 1e-15 * (np.abs(start) + np.abs(end))
    outside = np.abs(array - inside) > allowance
    if outside.any():
        bad = np.broadcast_to(array, outside.shape)[outside].flat[0]
        raise ArgumentValueError(
            f"{name} must lie between the start and the end of the manoeuvre, got {bad}", name
        )
    return inside


def members_of(fault: NDArray[np.bool_]) -> tuple[int, ...]:
    """Which problems of a stack are at fault, as errors carry it: their places in the flattened stack.

    Examples
    --------
    >>> members_of(np.array([[False, True], [False, True]]))
    (1, 3)
    """
    return tuple(np.flatnonzero(fault).tolist()) if fault.ndim else ()


def common_shape(**shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The shape that the leading shapes of the named arguments broadcast to.

    Raises
    ------
    ValueError
        If they do not broadcast; the error names the first argument that does not fit those before it.
    """
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
    common: tuple[int, ...] = ()
    for name, shape in shapes.items():
        try:
            common = np.broadcast_shapes(common, shape)
        except ValueError:
            raise ArgumentValueError(f"{name}: the leading shapes do not broadcast: {listed}", name) from None
    return common


def require_digits(name: str, gives: str, moving: ArrayLike, *units: ArrayLike) -> None:
    """Refuse an argument whose answer is too large or too small for double precision.

    Parameters
    ----------
    name, gives : str
        The argument, and what it must give within the range of floating-point numbers.
    moving : (...) array_like of bool
        Where the answer is not zero.
    units : (...) array_likes
        The sizes of the answer's parts.

    Raises
    ------
    ValueError
        If one of the sizes is not a number with all digits.

    Examples
    --------
    >>> require_digits("x0", "a norm", True, 1e-300)
    """
    for unit in units:
        size = np.asarray(unit)
        lost = np.asarray(moving) & ~((size >= TINY) & (size < np.inf))
        if lost.any():
            raise beyond_range(name, gives, lost)


def beyond_range(name: str, gives: str, lost: NDArray[np.bool_]) -> ArgumentValueError:
    """The error for an argument whose answer, where a stack is `lost`, double precision cannot hold."""
    index = np.argwhere(lost)[0].tolist()
    where = f" at index {index}" if index else ""
    message = (
        f"{name} must give {gives} within the range of floating-point numbers, {TINY:.1e} to "
        f"{np.finfo(float).max:.1e} in modulus, got one beyond it{where}"
    )
    return ArgumentValueError(message, name, members_of(lost))
