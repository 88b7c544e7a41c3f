"""Example 2 in the plane: where the body is and how it thrusts, from its elements along an extremal."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from pontryagin.averaging.extremal import Extremal
from pontryagin.averaging.solution import AveragedSolution

Array = NDArray[np.float64]

PER_TURN = 48


@dataclass(frozen=True)
class Flight:
    """A flight at slow times (k), in fixed axes of which the first points to the first pericentre.

    Attributes
    ----------
    tau : (k,) array
    elements : (k, 2) array
        E and K.
    eccentric : (k,) array
        Eccentric anomaly.
    angle : (k,) array
        Polar angle phi of the body.
    control : (k, 2) array
        u_r and u_phi.
    """

    tau: Array
    elements: Array
    eccentric: Array
    angle: Array
    control: Array

    @property
    def eccentricity(self) -> Array:
        """e, (k,), (3.4)."""
        E, K = self.elements.T
        return np.sqrt(np.maximum(0.0, 1 + 2 * E * K**2))

    @property
    def pericentre(self) -> Array:
        """gamma, (k,): the angle less the true anomaly."""
        return self.angle - true_anomaly(self.eccentricity, self.eccentric)

    @property
    def radius(self) -> Array:
        """r, (k,), (3.4)."""
        return (1 - self.eccentricity * np.cos(self.eccentric)) / (2 * np.abs(self.elements[:, 0]))

    @property
    def position(self) -> Array:
        """Place in the plane, (k, 2)."""
        return self.radius[:, None] * _direction(self.angle)

    @property
    def thrust(self) -> Array:
        """u in the plane, (k, 2)."""
        along = _direction(self.angle)
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        return self.control[:, :1] * along + self.control[:, 1:] * across

    def ellipse(self, count: int = 121) -> Array:
        """The osculating ellipses, (k, count, 2)."""
        eccentric = np.linspace(0, 2 * np.pi, count)
        e, E = self.eccentricity[:, None], self.elements[:, :1]
        radius = (1 - e * np.cos(eccentric)) / (2 * np.abs(E))
        return radius[..., None] * _direction(self.pericentre[:, None] + true_anomaly(e, eccentric))


def fly_exact(extremal: Extremal, per_turn: int = PER_TURN) -> Flight:
    """The flight along an exact extremal of `kepler`; the angle is the integral of K/r^2."""
    tau = np.linspace(0.0, extremal.duration, 1 + max(8, int(np.ceil(extremal.turns * per_turn))))
    elements, eccentric = extremal.slow(tau), extremal.anomaly(tau)
    flown = Flight(tau, elements, eccentric, np.zeros(len(tau)), extremal.control(tau))
    rate = elements[:, 1] / (extremal.epsilon * flown.radius**2)
    begin = true_anomaly(flown.eccentricity[0], eccentric[0])
    angle = begin + CubicSpline(tau, rate).antiderivative()(tau)
    return Flight(tau, elements, eccentric, angle, flown.control)


def fly_averaged(
    solution: AveragedSolution, epsilon: float, phase: float = 0.0, per_turn: int = PER_TURN
) -> Flight:
    """The first approximation flown at a small parameter: the pericentre stays where it is."""
    ends = solution.phase([0.0, float(solution.duration)], epsilon, phase)
    turns = float(ends[1] - ends[0]) / (2 * np.pi)
    tau = np.linspace(0.0, float(solution.duration), 1 + max(8, int(np.ceil(turns * per_turn))))
    elements, eccentric = solution.slow(tau), solution.anomaly(tau, epsilon, phase)
    control = solution.control(tau, eccentric)
    flown = Flight(tau, elements, eccentric, np.zeros(len(tau)), control)
    return Flight(tau, elements, eccentric, true_anomaly(flown.eccentricity, eccentric), control)


def true_anomaly(eccentricity: ArrayLike, eccentric: ArrayLike) -> Array:
    """The true anomaly of an eccentric one, turn for turn.

    Examples
    --------
    >>> true_anomaly(0.3, np.array([0.0, np.pi, 2 * np.pi])) / np.pi
    array([0., 1., 2.])
    """
    e, x = np.asarray(eccentricity, dtype=float), np.asarray(eccentric, dtype=float)
    beta = e / (1 + np.sqrt(1 - e**2))
    return x + 2 * np.arctan2(beta * np.sin(x), 1 - beta * np.cos(x))


def _direction(angle: Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
