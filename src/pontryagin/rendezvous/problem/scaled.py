"""A rendezvous in the solver's units."""

import math
from typing import TYPE_CHECKING

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import derivative
from pontryagin.numerics.rotation import conjugate, product
from pontryagin.rendezvous import kernels

if TYPE_CHECKING:
    from pontryagin.rendezvous.problem.rendezvous import Rendezvous


class Scaled:
    """A problem with p* = c* = fM = 1, in which the craft starts with the attitude 1.

    The cost is in units in which alpha2 = 1, or alpha1 = 1 where alpha2 = 0.

    Attributes
    ----------
    length, time : float
        p* and sqrt(p*^3/fM) in the user's units.
    value : float
        The unit of the cost.
    start : (3,) array
        r, v1, c at t0.
    anomaly, eccentricity : float
        phi* at t0; e*.
    orientation : (4,) array
        lambda0~ o Lambda*.
    ratio : float
        alpha1/alpha2; inf where alpha2 = 0.
    peak : float
        p_max.
    duration : float or None
        t_k where fixed.
    """

    def __init__(self, problem: "Rendezvous") -> None:
        craft, orbit = problem.chaser, problem.target
        self.length = orbit.parameter
        self.time = math.sqrt(self.length**3 / problem.gravity)
        speed = self.length / self.time
        self.start = np.array([craft.r / self.length, craft.v1 / speed, craft.c / (self.length * speed)])
        self.anomaly, self.eccentricity = orbit.anomaly, orbit.eccentricity
        self.orientation = product(conjugate(craft.attitude), orbit.attitude)
        self.acceleration = speed / self.time
        self.peak = problem.peak / self.acceleration
        time_weight, energy_weight = (
            problem.time_weight * self.time,
            problem.energy_weight * self.acceleration**2 * self.time,
        )
        self.ratio = time_weight / energy_weight if energy_weight else math.inf
        self.value = energy_weight or time_weight
        self.duration = None if problem.duration is None else problem.duration / self.time

    @property
    def weights(self) -> tuple[float, float]:
        """alpha1 and alpha2 in these units."""
        return (1.0, 0.0) if self.ratio == math.inf else (self.ratio, 1.0)

    @property
    def costate_units(self) -> Array:
        """User's units of rho, s1, e, nu1, nu2, nu3: those of the cost over those of the state."""
        speed = self.length / self.time
        return self.value / np.array([self.length, speed, self.length * speed, 1.0, 1.0, 1.0])

    def target(self, anomaly: float, orientation: Array | None = None) -> tuple[Array, Array]:
        """r*, v1*, c* and lambda0~ o lambda* (7,), and their rates (7,), at an anomaly."""
        place = self.orientation if orientation is None else orientation
        values, slopes = derivative(
            lambda phi: np.array(kernels.target(phi, 1.0, self.eccentricity, 1.0, *place)), anomaly
        )
        rate = values[3]
        return np.delete(values, 3), np.delete(slopes, 3) * rate
