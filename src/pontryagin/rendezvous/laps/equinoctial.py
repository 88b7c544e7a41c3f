"""Modified equinoctial elements of craft and target, and costates of these elements in the reduced form."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.numerics import kepler
from pontryagin.numerics.complex_step import jacobian
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps import cartesian
from pontryagin.rendezvous.laps.hamiltonian import Cost, Hamiltonian, hamiltonian, square
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import cartesian_of, target_by_kepler

TAU = 2 * math.pi
THINNEST, ROUNDEST = 0.02, 0.98
"""Smallest parameter, in units of p*, and largest square of the eccentricity, on the way of an iteration."""
OPPOSITE = 1e-12
"""Size of the sum of two normals below which these count as opposite."""


def elements_of(state: Array) -> Array:
    """p, f, g, h, k, L (6,) of R and V (6,), fM = 1, for inclinations below 180 degrees."""
    position, velocity = state[:3], state[3:]
    momentum = np.cross(position, velocity)
    parameter = momentum @ momentum
    normal = momentum / math.sqrt(parameter)
    h, k = -normal[1] / (1 + normal[2]), normal[0] / (1 + normal[2])
    size = 1 + h**2 + k**2
    first = np.array([1 + h**2 - k**2, 2 * h * k, -2 * k]) / size
    second = np.array([2 * h * k, 1 - h**2 + k**2, 2 * h]) / size
    apsis = np.cross(velocity, momentum) - position / np.linalg.norm(position)
    longitude = math.atan2(position @ second, position @ first)
    return np.array([parameter, apsis @ first, apsis @ second, h, k, longitude])


def axes_between(craft: Array, target: Array) -> Array:
    """Axes (3, 3), as rows, between the planes of two states (6,), which are inclined by at most 90 degrees.

    The first axis is such that the craft's longitude is 0.
    """
    normals = [np.cross(state[:3], state[3:]) for state in (craft, target)]
    first, second = (normal / np.linalg.norm(normal) for normal in normals)
    between = first + second
    if np.linalg.norm(between) < OPPOSITE:
        between = np.cross(first, craft[:3])  # so that the craft may turn its plane from where it is
    third = between / np.linalg.norm(between)
    along = np.cross(np.eye(3)[np.argmin(np.abs(third))], third)
    along /= np.linalg.norm(along)
    axes = np.array([along, np.cross(third, along), third])
    longitude = elements_of(seen(axes, craft))[5]
    c, s = math.cos(longitude), math.sin(longitude)
    return np.asarray(np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) @ axes)


def seen(axes: Array, state: Array) -> Array:
    """Two vectors side by side (6,) in other axes (3, 3)."""
    return np.asarray((state.reshape(2, 3) @ axes.T).ravel())


@dataclass(frozen=True, eq=False)
class Lap:
    """The ends of a transfer that makes a given number of laps, in the units of `Scaled`.

    Attributes
    ----------
    start : (6,) array
        Elements of the craft at t0, in axes in which L is 0.
    goal : (5,) array
        p, f, g, h and k of the target.
    axes : (3, 3) array
        These axes, as rows, in the axes eta of t0.
    begin : float
        The target's longitude at t0.
    anomaly, eccentricity : float
        The target's true anomaly at t0, and its eccentricity; its parameter is 1.
    laps : int
        Turns that are added to the target's longitude.
    end : float or None
        A longitude at which the target is held; None for the moving target.
    """

    start: Array
    goal: Array
    axes: Array
    begin: float
    anomaly: float
    eccentricity: float
    laps: int
    end: float | None = None

    @classmethod
    def of(cls, scaled: Scaled, laps: int) -> "Lap":
        """The transfer of a problem on a lap."""
        craft = cartesian_of(scaled.start, np.array([1.0, 0, 0, 0]))
        met = target_by_kepler(scaled, 0.0)
        axes = axes_between(craft, met)
        start, target = (elements_of(seen(axes, state)) for state in (craft, met))
        start[5] = 0.0
        return cls(start, target[:5], axes, float(target[5]), scaled.anomaly, scaled.eccentricity, laps)

    @property
    def inclination(self) -> float:
        """The angle between the two planes, which are inclined by half of it against the axes."""
        return 4 * math.atan(float(np.hypot(*self.start[3:5])))

    def longitude(self, time: ArrayLike) -> tuple[Array, Array]:
        """The longitude of the meeting at given times, and its rate."""
        if self.end is not None:
            return np.full(np.shape(time), self.end), np.zeros(np.shape(time))
        anomaly = kepler.true_anomaly_after(self.anomaly, time, 1.0, self.eccentricity)
        longitude = self.begin + anomaly - self.anomaly + TAU * self.laps
        return longitude, (1 + self.eccentricity * np.cos(anomaly)) ** 2

    def meeting(self, duration: float) -> tuple[Array, Array]:
        """p, f, g, h, k and L of the target after a time, (6,), and their rates, (6,)."""
        longitude, pace = self.longitude(duration)
        return np.append(self.goal, longitude), np.append(np.zeros(5), pace)

    def hamiltonian(self, cost: Cost, nodes: Array, price: float) -> Hamiltonian:
        """K and its derivatives at elements and costates (12, n), for the price c of time."""
        return hamiltonian(cost, nodes, price)

    def square(self, nodes: Array) -> Array:
        """|n|^2 at elements and costates (12, ...)."""
        return square(nodes)

    def weight(self, nodes: Array) -> Array:
        """dt/ds at elements and costates (12, ...)."""
        return np.asarray(kernels.equinoctial_weight(*[*nodes[:3], nodes[5]]))

    def admissible(self, nodes: Array) -> bool:
        """Whether a path keeps to ellipses."""
        p, f, g = nodes[:3]
        return bool((p > THINNEST).all() and (f**2 + g**2 < ROUNDEST).all())


def reduced_costates(scaled: Scaled, axes: Array, node: Array) -> Array:
    """rho, s1, e, nu1, nu2, nu3 (6,) at t0 of the elements and their costates there, (12,), in some axes."""
    _, slopes = jacobian(lambda x: kernels.equinoctial_place(*x), node[:6])
    in_space = seen(axes.T, np.asarray(np.linalg.solve(slopes.T, node[6:]), dtype=float))
    return cartesian.reduced_costates(scaled, in_space)


def laps_of(scaled: Scaled, states: Array, attitude: Array, duration: float) -> int:
    """The lap of a flight to the target, from its states (k, ...) and attitudes (k, 4) at ascending times.

    It is the nearest number, as the longitude is not defined where the plane is opposite to that of the axes.
    """
    lap = Lap.of(scaled, 0)
    places = cartesian_of(states, attitude)
    longitude = np.unwrap([elements_of(seen(lap.axes, place))[5] for place in places])
    return round(float(longitude[-1] - longitude[0] - lap.longitude(duration)[0]) / TAU)
