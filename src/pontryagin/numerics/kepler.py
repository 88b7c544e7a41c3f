"""Kepler's equation and the anomalies of an elliptic orbit; arrays broadcast, and revolutions are counted.

    M = E - e sin E,    tan(f/2) = sqrt((1 + e)/(1 - e)) tan(E/2)

with the mean anomaly M, the eccentric anomaly E, the true anomaly f and the eccentricity 0 <= e < 1, all
angles in radians.
"""

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array

FULL_TURN = 2 * np.pi
ITERATIONS = 100
"""Largest number of Newton steps; a few are needed, or some dozens as e comes close to 1."""


def eccentric_anomaly(mean: ArrayLike, eccentricity: ArrayLike) -> Array:
    """E that solves M = E - e sin E, by Newton's method from the side on which it converges monotonically.

    Between 0 and pi the equation is convex in E, and the starting point M + e lies beyond its root.

    Examples
    --------
    >>> eccentric_anomaly([0.0, 1.0, 1.0 + 2 * np.pi], 0.1).round(6).tolist()
    [0.0, 1.088598, 7.371783]
    """
    given, e = np.broadcast_arrays(np.asarray(mean, dtype=float), np.asarray(eccentricity, dtype=float))
    turns = FULL_TURN * np.round(given / FULL_TURN)
    size, sign = np.abs(given - turns), np.sign(given - turns)
    E = np.minimum(size + e, np.pi)
    for _ in range(ITERATIONS):
        step = (E - e * np.sin(E) - size) / (1 - e * np.cos(E))
        E = E - step
        if np.all(np.abs(step) <= 1e-15 * (1 + E)):
            break
    return np.asarray(turns + sign * E)


def mean_anomaly(eccentric: ArrayLike, eccentricity: ArrayLike) -> Array:
    """M = E - e sin E."""
    return np.asarray(eccentric - np.asarray(eccentricity) * np.sin(eccentric))


def eccentric_of_true(true: ArrayLike, eccentricity: ArrayLike) -> Array:
    """E of the true anomaly f, in the same revolution.

    Examples
    --------
    >>> E = eccentric_of_true([1.0, 1.0 + 2 * np.pi], 0.5)
    >>> true_of_eccentric(E, 0.5).round(12).tolist()
    [1.0, 7.28318530718]
    """
    e = np.asarray(eccentricity)
    return np.asarray(true - 2 * np.arctan2(e * np.sin(true), 1 + np.sqrt(1 - e**2) + e * np.cos(true)))


def true_of_eccentric(eccentric: ArrayLike, eccentricity: ArrayLike) -> Array:
    """f of the eccentric anomaly E, in the same revolution."""
    e = np.asarray(eccentricity)
    across, along = e * np.sin(eccentric), 1 + np.sqrt(1 - e**2) - e * np.cos(eccentric)
    return np.asarray(eccentric + 2 * np.arctan2(across, along))


def mean_motion(parameter: ArrayLike, eccentricity: ArrayLike, gravity: ArrayLike = 1.0) -> Array:
    """dM/dt of an orbit with the given parameter p = a (1 - e^2), in radians per unit of time."""
    axis = np.asarray(parameter) / (1 - np.asarray(eccentricity) ** 2)
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
    begin = mean_anomaly(eccentric_of_true(true, eccentricity), eccentricity)
    mean = begin + mean_motion(parameter, eccentricity, gravity) * np.asarray(time)
    return true_of_eccentric(eccentric_anomaly(mean, eccentricity), eccentricity)
