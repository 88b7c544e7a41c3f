"""The target's Kepler orbit, (5) and (6), and the target's place on it at the start, (4)."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous.problem.checks import angle, number, unit_quaternion
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Orbit:
    """The Kepler ellipse of the target, (5) and (6), and the target's place on it at the start, (4).

    Parameters
    ----------
    parameter : float
        p*, the semi-latus rectum, in units of length; positive.
    eccentricity : float
        e*, 0 <= e* < 1.
    attitude : (4,) array_like
        Lambda*, the unit quaternion of the orbit's axes (first axis to the pericentre, third along R x V) in
        inertial axes, scalar part first.
    anomaly : float
        True anomaly phi* at t0, in radians.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it.

    Examples
    --------
    >>> Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6).eccentricity
    0.1
    """

    parameter: float
    eccentricity: float
    attitude: Array
    anomaly: float

    if TYPE_CHECKING:

        def __init__(
            self, parameter: float, eccentricity: float, attitude: ArrayLike, anomaly: float
        ) -> None: ...

    def __post_init__(self) -> None:
        checked = {
            "parameter": number("parameter", self.parameter, 0.0, excluded=True),
            "eccentricity": number("eccentricity", self.eccentricity, 0.0),
            "attitude": unit_quaternion("attitude", self.attitude),
            "anomaly": angle("anomaly", self.anomaly),
        }
        if self.eccentricity >= 1:
            raise ArgumentValueError(
                "eccentricity must be less than 1, as the target moves on an ellipse, "
                f"got {self.eccentricity}",
                "eccentricity",
            )
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    @classmethod
    def from_angles(
        cls,
        parameter: float,
        eccentricity: float,
        node: float,
        inclination: float,
        pericentre: float,
        anomaly: float,
    ) -> "Orbit":
        """The orbit with a given node, inclination and argument of the pericentre.

        Parameters
        ----------
        parameter, eccentricity, anomaly : float
            As for `Orbit`.
        node, inclination, pericentre : float
            Longitude of the ascending node, inclination and argument of the pericentre, in radians.

        Raises
        ------
        ValueError, TypeError
            If an argument is not a finite number, or not as for `Orbit`; the message names it.

        Examples
        --------
        >>> Orbit.from_angles(1.5, 0.1, 0.0, 0.0, 0.0, 0.6).attitude
        array([1., 0., 0., 0.])
        """
        given = {"node": node, "inclination": inclination, "pericentre": pericentre}
        quaternion = np.array([1.0, 0, 0, 0])
        for axis, (name, value) in zip((3, 1, 3), given.items(), strict=True):
            half = angle(name, value) / 2
            turn = np.zeros(4)
            turn[[0, axis]] = math.cos(half), math.sin(half)
            quaternion = product(quaternion, turn)
        return cls(parameter, eccentricity, quaternion, anomaly)
