"""Derivatives by a complex step: f'(x) v = Im f(x + i h v) / h, exact to rounding for analytic functions.

The step h is so small that its square is negligible beside 1, and nothing is subtracted, so that no digit is
lost. The function must be written in operations that take complex numbers; `abs`, comparisons and conjugates
of the inputs spoil the derivative.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array

STEP = 1e-30
"""Size of the imaginary step."""

Columns = Callable[[NDArray[np.complexfloating]], ArrayLike]
"""A function of inputs (n, ...) that returns outputs (m, ...) and broadcasts along the later axes."""


def derivative(
    function: Callable[[NDArray[np.complexfloating]], ArrayLike], point: ArrayLike, direction: ArrayLike = 1.0
) -> tuple[Array, Array]:
    """The value of a function and its derivative along one direction.

    Parameters
    ----------
    function : function of an array of the point's shape
        Analytic in its argument.
    point, direction : array_like
        Where the derivative is taken, and along which direction.

    Examples
    --------
    >>> value, slope = derivative(lambda x: x**3, 2.0)
    >>> float(value), float(slope)
    (8.0, 12.0)
    """
    values = np.asarray(function(np.asarray(point) + 1j * STEP * np.asarray(direction)))
    return values.real, values.imag / STEP


def jacobian(function: Columns, point: ArrayLike, directions: ArrayLike | None = None) -> tuple[Array, Array]:
    """The value of a function of n inputs and its derivatives along d directions, in one call.

    Parameters
    ----------
    function : function of an (n, d, ...) array
        It returns (m, d, ...); inputs and outputs are along the first axis.
    point : (n, ...) array_like
        One point, or a stack of them along the last axes.
    directions : (n, d) array_like, optional
        The directions; by default the n axes, which gives the Jacobian.

    Returns
    -------
    (m, ...) array
        The value.
    (m, d, ...) array
        The derivatives.

    Examples
    --------
    >>> value, slopes = jacobian(lambda x: [x[0] * x[1], x[0] ** 2], [2.0, 3.0])
    >>> value.tolist(), slopes.tolist()
    ([6.0, 4.0], [[3.0, 2.0], [4.0, 0.0]])
    """
    inputs = np.asarray(point)
    along = np.eye(len(inputs)) if directions is None else np.asarray(directions)
    spread = along.reshape(*along.shape, *[1] * (inputs.ndim - 1))
    values = np.asarray(function(inputs[:, None] + 1j * STEP * spread))
    return values[:, 0].real, values.imag / STEP
