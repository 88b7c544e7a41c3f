"""A rendezvous in the solver's units: p* = c* = fM = 1, and the craft starts with the attitude 1."""

import math
from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import derivative
from pontryagin.numerics.rotation import conjugate, product, within_a_turn
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.problem.chaser import Chaser
from pontryagin.rendezvous.problem.orbit import Orbit
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Scaled:
    """The numbers of a rendezvous with p* = c* = fM = 1 and lambda = 1 at t0.

    The cost is in units in which alpha2 = 1, or alpha1 = 1 where alpha2 = 0.

    Attributes
    ----------
    length, time, acceleration : float
        p*, sqrt(p*^3/fM) and fM/p*^2: the solver's units, expressed in those of the user.
    value : float
        The solver's unit of the cost, expressed in that of the user.
    start : (3,) array
        r, v1, c at t0.
    anomaly, eccentricity : float
        phi* at t0, in radians, reduced to within a turn; e*.
    orientation : (4,) array
        lambda0~ o Lambda*, with lambda0 the attitude of the craft at t0.
    ratio : float
        alpha1/alpha2; inf where alpha2 = 0.
    peak : float
        p_max.
    duration : float or None
        t_k if it is prescribed.
    """

    length: float
    time: float
    acceleration: float
    value: float
    start: Array
    anomaly: float
    eccentricity: float
    orientation: Array
    ratio: float
    peak: float
    duration: float | None

    @classmethod
    def of(
        cls,
        chaser: Chaser,
        target: Orbit,
        time_weight: float,
        energy_weight: float,
        peak: float,
        gravity: float,
        duration: float | None,
    ) -> "Scaled":
        """The scaled numbers of a `Rendezvous` with these arguments."""
        length = target.parameter
        time = math.sqrt(length**3 / gravity)
        speed = length / time
        acceleration = speed / time
        time_cost, energy_cost = time_weight * time, energy_weight * acceleration**2 * time
        return cls(
            length=length,
            time=time,
            acceleration=acceleration,
            value=energy_cost or time_cost,
            start=np.array([chaser.r / length, chaser.v1 / speed, chaser.c / (length * speed)]),
            anomaly=float(within_a_turn(target.anomaly)),
            eccentricity=target.eccentricity,
            orientation=product(conjugate(chaser.attitude), target.attitude),
            ratio=time_cost / energy_cost if energy_cost else math.inf,
            peak=peak / acceleration,
            duration=None if duration is None else duration / time,
        )

    @property
    def weights(self) -> tuple[float, float]:
        """alpha1 and alpha2 in these units."""
        return (1.0, 0.0) if self.ratio == math.inf else (self.ratio, 1.0)

    @property
    def costate_units(self) -> Array:
        """The solver's units of the six costates in the user's, (6,): the cost's unit over the state's."""
        speed = self.length / self.time
        return self.value / np.array([self.length, speed, self.length * speed, 1.0, 1.0, 1.0])

    def target(self, anomaly: float, orientation: Array | None = None) -> tuple[Array, Array]:
        """r*, v1*, c* and lambda0~ o lambda* of (5) and (6) at an anomaly, (7,), and their rates, (7,)."""
        place = self.orientation if orientation is None else orientation
        values, slopes = derivative(
            lambda phi: np.array(kernels.target(phi, 1.0, self.eccentricity, 1.0, *place)), anomaly
        )
        return np.delete(values, 3), np.delete(slopes, 3) * values[3]
