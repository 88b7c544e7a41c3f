"""Kepler's equation and the anomalies of an elliptic orbit; arrays broadcast, and revolutions are counted.

    M = E - e sin E,    tan(f/2) = sqrt((1 + e)/(1 - e)) tan(E/2)

with the mean anomaly M, the eccentric anomaly E, the true anomaly f and the eccentricity 0 <= e < 1, all
angles in radians. Close to a parabola M and E are small beside f. They are therefore written without
differences of nearly equal numbers, so that f is found to rounding there too:

    M = (1 - e) E + e (E - sin E),    1 - e^2 = (1 - e)(1 + e)
"""

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array

FULL_TURN = 2 * np.pi
ITERATIONS = 100
"""Largest number of Newton steps; a few are needed, or some dozens as e comes close to 1."""

ROUND = 0.9
"""Eccentricity up to which E - e sin E loses at most a digit and is computed as it stands."""


def eccentric_anomaly(mean: ArrayLike, eccentricity: ArrayLike) -> Array:
    """E that solves M = E - e sin E, by Newton's method from the side on which it converges monotonically.

    Between 0 and pi the equation is convex in E, and its root is at most M + e and at most (pi^2 M/e)^(1/3),
    since E - sin E is at least E^3/pi^2 there.

    Examples
    --------
    >>> eccentric_anomaly([0.0, 1.0, 1.0 + 2 * np.pi], 0.1).round(6).tolist()
    [0.0, 1.088598, 7.371783]
    """
    given, e = np.broadcast_arrays(np.asarray(mean, dtype=float), np.asarray(eccentricity, dtype=float))
    turns, part = _revolutions(given)
    size = np.abs(part)
    cubic = np.where(e > 0.1, np.cbrt(np.pi**2 * size / np.maximum(e, 0.1)), np.pi)
    E = np.minimum(np.minimum(size + e, np.pi), cubic)
    for _ in range(ITERATIONS):
        step = (mean_anomaly(E, e) - size) / (1 - e + 2 * e * np.sin(E / 2) ** 2)
        E = E - step
        if np.all(np.abs(step) <= 1e-15 * E):
            break
    return np.asarray(turns + np.copysign(E, part))


def mean_anomaly(eccentric: ArrayLike, eccentricity: ArrayLike) -> Array:
    """M = E - e sin E."""
    E, e = np.asarray(eccentric, dtype=float), np.asarray(eccentricity, dtype=float)
    if np.all(e <= ROUND):
        return np.asarray(E - e * np.sin(E))
    return np.asarray((1 - e) * E + e * _less_its_sine(E))


def _less_its_sine(angle: Array) -> Array:
    """x - sin x, by its series below 1."""
    square = np.minimum(angle * angle, 1.0)
    tail = np.ones_like(square)
    for k in range(18, 2, -2):  # Terms up to x^19/19!.
        tail = 1 - square / (k * (k + 1)) * tail
    return np.asarray(np.where(np.abs(angle) < 1, angle**3 / 6 * tail, angle - np.sin(angle)))


def _revolutions(angle: Array) -> tuple[Array, Array]:
    """Whole revolutions, in radians, and what is left, from -pi to pi."""
    turns = FULL_TURN * np.round(angle / FULL_TURN)
    return turns, angle - turns


def eccentric_of_true(true: ArrayLike, eccentricity: ArrayLike) -> Array:
    """E of the true anomaly f, in the same revolution.

    Examples
    --------
    >>> E = eccentric_of_true([1.0, 1.0 + 2 * np.pi], 0.5)
    >>> true_of_eccentric(E, 0.5).round(12).tolist()
    [1.0, 7.28318530718]
    """
    e = np.asarray(eccentricity, dtype=float)
    return _stretched(np.asarray(true, dtype=float), np.sqrt(1 - e), np.sqrt(1 + e))


def true_of_eccentric(eccentric: ArrayLike, eccentricity: ArrayLike) -> Array:
    """f of the eccentric anomaly E, in the same revolution."""
    e = np.asarray(eccentricity, dtype=float)
    return _stretched(np.asarray(eccentric, dtype=float), np.sqrt(1 + e), np.sqrt(1 - e))


def _stretched(angle: Array, across: Array, along: Array) -> Array:
    """The angle in the same revolution whose half has the tangent across/along tan(angle/2)."""
    turns, part = _revolutions(angle)
    return np.asarray(turns + 2 * np.arctan2(across * np.sin(part / 2), along * np.cos(part / 2)))


def mean_motion(parameter: ArrayLike, eccentricity: ArrayLike, gravity: ArrayLike = 1.0) -> Array:
    """dM/dt of an orbit with the given parameter p = a (1 - e^2), in radians per unit of time."""
    e = np.asarray(eccentricity, dtype=float)
    axis = np.asarray(parameter) / ((1 - e) * (1 + e))
    return np.asarray(np.sqrt(np.asarray(gravity) / axis**3))


def true_anomaly_after(
    true: ArrayLike, time: ArrayLike, parameter: ArrayLike, eccentricity: ArrayLike, gravity: ArrayLike = 1.0
) -> Array:
    """The true anomaly at a given time after the anomaly ``true``, with revolutions counted.

    Examples
    --------
    >>> bool(np.isclose(true_anomaly_after(0.3, 2 * np.pi, 1.0, 0.0), 0.3 + 2 * np.pi))
    True
    """
    turns, part = _revolutions(np.asarray(true, dtype=float))
    begin = mean_anomaly(eccentric_of_true(part, eccentricity), eccentricity)
    mean = begin + mean_motion(parameter, eccentricity, gravity) * np.asarray(time)
    return np.asarray(turns + true_of_eccentric(eccentric_anomaly(mean, eccentricity), eccentricity))
