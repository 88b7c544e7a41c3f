"""Values of a user's function of time, checked to be finite numbers."""

from collections.abc import Callable
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.validation import require_bare


def values(function: Callable[[Any], Any], t: Array) -> Array:
    """f at the times (k,), by one call with an array if f takes it, else by a call for each time.

    Raises
    ------
    TypeError, ValueError
        If f is no function of a time, or a value is no finite number.
    """
    try:
        result = _real(function(t))
    except (TypeError, ValueError):
        result = np.empty(())
    if result.shape == ():
        result = np.asarray([_at(function, float(time)) for time in t])
    if result.shape != t.shape:
        raise ArgumentValueError(
            f"disturbance must return one number for each time: got shape {result.shape} "
            f"for times of shape {t.shape}",
            "disturbance",
        )
    require_finite(t, result)
    return result


def require_finite(t: Array, values: Array) -> None:
    """Raise ValueError at the first of the times (k,) at which a value is not finite."""
    if not np.isfinite(values).all():
        k = int(np.argmin(np.isfinite(values)))
        raise ArgumentValueError(f"disturbance must be finite: f({t[k]:.6g}) = {values[k]}", "disturbance")


def _at(function: Callable[[Any], Any], time: float) -> float:
    try:
        value = _real(function(time))
    except TypeError as error:
        raise ArgumentTypeError(
            f"disturbance must be a function f(t) that takes a time and returns a number: {error}",
            "disturbance",
        ) from error
    if value.shape != ():
        raise ArgumentValueError(
            f"disturbance must return one number for each time: got shape {value.shape} for one time",
            "disturbance",
        )
    return float(value)


def _real(value: object) -> Array:
    require_bare("disturbance", value, "a function of time that returns numbers")
    array = np.asarray(value)
    if array.dtype.kind not in "fiubO":
        raise TypeError(f"got {value!r}")
    return array.astype(float)
