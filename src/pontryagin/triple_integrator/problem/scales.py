"""The range in which motions, controls and norms keep their digits, whatever the units of the manoeuvre.

The solvers scale the moments by the duration, (c1/T^2, c2/T, c3), which are amplitudes of impulses. In units
of the largest of them every manoeuvre is of size one; the answers are then given in these units.
"""

from math import inf, nan

import numpy as np

from pontryagin.arrays import Array
from pontryagin.validation import TINY, require_digits

ANSWER = "with x0 and tf - t0 a control, a norm and a motion"
"""What the target of a manoeuvre must give within the range of floating-point numbers."""


def in_range(unit: float) -> float:
    """The unit of a result; nan where results in this unit lose digits, so that they are refused.

    Examples
    --------
    >>> in_range(1e-300), in_range(1e-310)
    (1e-300, nan)
    """
    return unit if unit >= TINY else nan


def impulse_unit(size: float, T: float) -> float:
    """The largest modulus of the scaled moments as a unit of impulses; nan where the motion is out of range.

    The angle and the first moment are of the size of the unit times T^2. Where this loses digits, rounding
    may have cut the moment.
    """
    return size if size >= TINY and TINY <= size * T * T < inf else nan


def level_unit(size: float, T: float) -> float:
    """The unit of a control's values, from the largest modulus of the scaled moments."""
    return in_range(impulse_unit(size, T) / T)


def scaled_moments(c: Array, T: Array) -> tuple[Array, Array]:
    """(c1/T^2, c2/T, c3) over their largest modulus, (..., 3), and that modulus, (...)."""
    T = np.asarray(T)[..., None]
    moments = np.concatenate([c[..., :1] / T / T, c[..., 1:2] / T, c[..., 2:]], axis=-1)
    size = np.abs(moments).max(axis=-1)
    return moments / np.where(size == 0, 1.0, size)[..., None], size


def require_levels(c: Array, T: Array) -> None:
    """Refuse moments (..., 3) whose control double precision cannot hold, as `level_unit` does for one."""
    _, size = scaled_moments(c, T)
    with np.errstate(over="ignore"):
        units = size, size * T * T, size / T
    require_digits("xf", ANSWER, (c != 0).any(axis=-1), *units)
