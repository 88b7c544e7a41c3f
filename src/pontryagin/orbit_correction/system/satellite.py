"""The satellite near its circular orbit, section 7: transition, impulses, and the regrouped steps of (12)."""

from math import atan2, cos, pi, sin

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array

LINEAR = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 2.0], [0.0, -1.0, 0.0]])
"""The matrix A of the linearised system z' = A z, z = (dr, dv_R, dv_T)."""


def transition(time: ArrayLike) -> Array:
    """e^{A t} for times (...), as (..., 3, 3): I + sin t A + (1 - cos t) A^2.

    Examples
    --------
    >>> transition(2 * np.pi).round(12) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    time = np.asarray(time, dtype=float)[..., None, None]
    return np.asarray(np.eye(3) + np.sin(time) * LINEAR + 2 * np.sin(time / 2) ** 2 * (LINEAR @ LINEAR))


def phase(interval: float) -> float:
    """The interval minus the nearest number of whole revolutions, between -pi and pi.

    Impulses at multiples of the phase have the same effect as impulses at multiples of the interval. Close to
    whole revolutions the multiples of the phase lose no digits, while those of the interval would.

    Examples
    --------
    >>> phase(0.25), round(phase(2 * np.pi - 1e-9) * 1e9, 5)
    (0.25, -1.0)
    """
    return interval if interval <= pi else atan2(sin(interval), cos(interval))


def impulse_columns(intervals: int, interval: float) -> Array:
    """The effect on the initial state of unit impulses at the starts of the intervals, (intervals, 3, 2).

    Column 0 is a radial and column 1 a transverse impulse, e^{-A j interval} e.
    """
    return transition(-np.arange(intervals) * interval)[:, :, 1:]


def step_factors(steps: int, interval: float) -> Array:
    """G_k of the regrouped steps of (12), three impulse components each, for a peak of 1: (steps, 3, 3)."""
    intervals = -(-3 * steps // 2)
    columns = np.moveaxis(impulse_columns(intervals, interval), 1, 2).reshape(-1, 3)
    return np.moveaxis(columns[: 3 * steps].reshape(steps, 3, 3), 1, 2)


def step_transition(k: int, interval: float) -> Array:
    """A(k) of (12): the transition over two intervals for even k, over one for odd k."""
    return transition((2 if k % 2 == 0 else 1) * interval)


def step_input(k: int, interval: float) -> Array:
    """B(k) of (12), as derived: the three impulse components of step k carried to its end."""
    once = transition(interval)
    radial, transverse = once[:, 1], once[:, 2]
    if k % 2 == 0:
        return np.column_stack([once @ radial, once @ transverse, radial])
    return np.column_stack([once @ transverse, radial, transverse])
