"""The rendezvous as posed: the target's orbit, the craft's start, the functional, the bound. All checked."""

import math
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.validation import finite, vectors

UNIT_WITHIN = 1e-6
"""A quaternion this close to the unit length, as single precision is, is normalised; others are refused."""


def number(name: str, value: ArrayLike, least: float | None = None, excluded: bool = False) -> float:
    """`value` as one finite float, at least `least`, or above it where that is `excluded`."""
    array = finite(name, value, "a number")
    if array.ndim:
        raise ValueError(f"{name} must be one number, got an array of shape {array.shape}")
    if least is not None and (array < least or (excluded and array == least)):
        raise ValueError(
            f"{name} must be {'greater than' if excluded else 'at least'} {least:g}, got {array}"
        )
    return float(array)


def unit_quaternion(name: str, value: ArrayLike) -> Array:
    """`value` as a unit quaternion, scalar part first."""
    array = vectors(name, value, 4)
    if array.shape != (4,):
        raise ValueError(f"{name} must be one quaternion of shape (4,), got shape {array.shape}")
    length = float(np.linalg.norm(array))
    if abs(length - 1) > UNIT_WITHIN:
        raise ValueError(f"{name} must be a unit quaternion, got one of length {length:.12g}")
    unit = array / length
    unit.flags.writeable = False
    return unit


def by_value(one: object) -> tuple:
    """The fields of a dataclass, arrays as tuples: what two of them are compared by."""
    values = (getattr(one, field.name) for field in fields(one))  # type: ignore[arg-type]
    return tuple(tuple(x.tolist()) if isinstance(x, np.ndarray) else x for x in values)


@dataclass(frozen=True, eq=False)
class Orbit:
    """The target's Kepler ellipse, (5), and its place on it at the start, (4).

    Parameters
    ----------
    parameter : float
        p*, in units of length.
    eccentricity : float
        e*, 0 <= e* < 1.
    attitude : (4,) array_like
        Unit quaternion Lambda* of the orbit (first axis to the pericentre, third along R x V) in inertial
        axes, scalar part first.
    anomaly : float
        True anomaly phi* at t0, in radians.

    Raises
    ------
    ValueError, TypeError
        Naming the argument that is not as above.

    Examples
    --------
    >>> Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6).eccentricity
    0.1
    """

    parameter: float
    eccentricity: float
    attitude: ArrayLike
    anomaly: float

    def __post_init__(self) -> None:
        checked = {
            "parameter": number("parameter", self.parameter, 0.0, excluded=True),
            "eccentricity": number("eccentricity", self.eccentricity, 0.0),
            "attitude": unit_quaternion("attitude", self.attitude),
            "anomaly": number("anomaly", self.anomaly),
        }
        if self.eccentricity >= 1:
            raise ValueError(
                f"eccentricity must be less than 1: the target goes round, got {self.eccentricity}"
            )
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Orbit) and by_value(self) == by_value(other)

    def __hash__(self) -> int:
        return hash(by_value(self))

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
        """The orbit whose node, inclination and pericentre's argument are given.

        Parameters
        ----------
        parameter, eccentricity, anomaly : float
            As for `Orbit`.
        node, inclination, pericentre : float
            Longitude of the node, inclination, and the pericentre's argument, in radians.

        Raises
        ------
        ValueError, TypeError
            Naming the argument that is not a finite number, or not as for `Orbit`.

        Examples
        --------
        >>> Orbit.from_angles(1.5, 0.1, 0.0, 0.0, 0.0, 0.6).attitude
        array([1., 0., 0., 0.])
        """
        angles = {"node": node, "inclination": inclination, "pericentre": pericentre}
        quaternion = np.array([1.0, 0, 0, 0])
        for axis, (name, angle) in zip((3, 1, 3), angles.items(), strict=True):
            half = number(name, angle) / 2
            turn = np.zeros(4)
            turn[[0, axis]] = math.cos(half), math.sin(half)
            quaternion = product(quaternion, turn)
        return cls(parameter, eccentricity, quaternion, anomaly)


@dataclass(frozen=True, eq=False)
class Chaser:
    """Where the craft is at t0 and how it moves, (4).

    Parameters
    ----------
    r : float
        Distance from the centre of attraction, in units of length.
    v1 : float
        Radial velocity.
    c : float
        Areal constant |R x V|, positive.
    attitude : (4,) array_like
        Unit quaternion lambda of the axes eta (first along R, third along R x V) in inertial axes, scalar
        part first.

    Raises
    ------
    ValueError, TypeError
        Naming the argument that is not as above.

    Examples
    --------
    >>> Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]).r
    1.0
    """

    r: float
    v1: float
    c: float
    attitude: ArrayLike

    def __post_init__(self) -> None:
        checked = {
            "r": number("r", self.r, 0.0, excluded=True),
            "v1": number("v1", self.v1),
            "c": number("c", self.c, 0.0, excluded=True),
            "attitude": unit_quaternion("attitude", self.attitude),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Chaser) and by_value(self) == by_value(other)

    def __hash__(self) -> int:
        return hash(by_value(self))


@dataclass(frozen=True)
class Rendezvous:
    """Meet the target, (5), (6), with the least integral (7) of alpha1 + alpha2 p^2 under |p| <= p_max, (1).

    Parameters
    ----------
    chaser, target : Chaser, Orbit
        The craft and what it is to meet, at t0 = 0.
    time_weight, energy_weight : float
        alpha1 and alpha2, not negative and not both zero. With ``energy_weight=0`` the time is least.
    peak : float
        p_max, in units of acceleration; ``math.inf`` for no bound, if ``energy_weight`` is positive.
    gravity : float
        fM, in the units of the lengths and times given.
    duration : float, optional
        t_k, where it is fixed. By default it is free.

    Raises
    ------
    ValueError, TypeError
        Naming the argument that is not as above.

    Examples
    --------
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, peak=0.05).free
    True
    """

    chaser: Chaser
    target: Orbit
    time_weight: float = 1.0
    energy_weight: float = 0.0
    peak: float = 0.1
    gravity: float = 1.0
    duration: float | None = None

    def __post_init__(self) -> None:
        for name, kind in (("chaser", Chaser), ("target", Orbit)):
            if not isinstance(getattr(self, name), kind):
                raise TypeError(f"{name} must be of type {kind.__name__}, got {getattr(self, name)!r}")
        unbounded = isinstance(self.peak, float | np.floating) and self.peak == math.inf
        checked = {
            "time_weight": number("time_weight", self.time_weight, 0.0),
            "energy_weight": number("energy_weight", self.energy_weight, 0.0),
            "peak": math.inf if unbounded else number("peak", self.peak, 0.0, excluded=True),
            "gravity": number("gravity", self.gravity, 0.0, excluded=True),
        }
        if self.duration is not None:
            checked["duration"] = number("duration", self.duration, 0.0, excluded=True)
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        self._require_sense()
        self._require_measure()

    def _require_sense(self) -> None:
        """Weights, bound and duration must belong together, and the craft must start on an ellipse."""
        if self.time_weight == 0 and self.energy_weight == 0:
            raise ValueError("time_weight and energy_weight must not both be 0: nothing would be minimised")
        if self.energy_weight == 0 and self.peak == math.inf:
            raise ValueError("peak must be finite where energy_weight is 0, got inf")
        if self.energy_weight == 0 and self.duration is not None:
            raise ValueError(
                "duration must be left free where energy_weight is 0, "
                f"got {self.duration:g}: every control would cost the same"
            )
        craft = self.chaser
        with np.errstate(over="ignore"):
            energy = (np.square(craft.v1) + np.square(craft.c / craft.r)) / 2 - self.gravity / craft.r
        if energy >= 0:
            raise ValueError(
                "chaser must start on an ellipse: v1^2/2 + c^2/(2 r^2) - gravity/r must be negative, "
                f"got {energy:.6g}"
            )

    def _require_measure(self) -> None:
        """What the numbers come to in units of the target's orbit must be numbers as well."""
        try:
            scaled = self.scaled
            units = [scaled.time, scaled.acceleration, scaled.value, *scaled.start, scaled.duration or 1.0]
            sound = all(0 < abs(x) < math.inf or x == self.chaser.v1 == 0 for x in units)
        except (OverflowError, ZeroDivisionError):
            sound = False
        if not sound:
            raise ValueError(
                "parameter, gravity, the weights, the start and the duration must be of sizes that double "
                f"precision holds in units of the target's orbit, got parameter {self.target.parameter:g}, "
                f"gravity {self.gravity:g}, r {self.chaser.r:g}, v1 {self.chaser.v1:g}, c {self.chaser.c:g}"
            )

    @property
    def free(self) -> bool:
        """Whether the duration is free."""
        return self.duration is None

    @cached_property
    def scaled(self) -> Scaled:
        """The same problem in the solver's units."""
        return Scaled(self)
