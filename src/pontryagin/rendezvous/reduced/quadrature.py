"""Integrals along a flight: the cost, the angle about the centre, the half-anomaly of Sapunkov's elements.

Near the centre of attraction the integrands change fast, so that panels of equal duration would be too coarse
there. Panels are therefore halved where that changes the integral.
"""

from collections.abc import Callable

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.quadrature import Halving, integral
from pontryagin.rendezvous.reduced.flight import Flight

HALVING = Halving(strict=6, most=12, loose=1e-11)
"""Few halvings suffice, since a flight is accurate to about 1e-13 of its size."""


def along(flight: Flight, rate: Callable[[Array], Array]) -> float:
    """The integral over the flight of a rate (k,) of times (k,), smooth between the switches."""
    return integral(rate, edges_of(flight), HALVING)[0]


def edges_of(flight: Flight) -> Array:
    """Ends of panels: at most half a unit of time apart, and at the switches of the thrust."""
    even = np.linspace(0.0, flight.duration, 2 + int(2 * flight.duration))
    return np.unique([*even, *flight.switch_times])


def energy(flight: Flight) -> float:
    """The integral of p^2."""
    return along(flight, lambda times: np.sum(flight.thrust(times) ** 2, axis=1))


def angle(flight: Flight) -> float:
    """The angle through which the craft turns about the centre, in radians: the integral of c/r^2."""

    def rate(times: Array) -> Array:
        r, _, c = flight.sample(times).T[:3]
        return np.asarray(c / r**2)

    return along(flight, rate)


def half_anomaly(flight: Flight) -> float:
    """phi of Sapunkov's elements at the end: the integral of dt/(r sqrt(2Q)), Q = -1/h.

    It is nan if the flight leaves the ellipses, where the energy h is not negative.
    """

    def rate(times: Array) -> Array:
        r, v1, c = flight.sample(times).T[:3]
        energy = (v1**2 + (c / r) ** 2) / 2 - 1 / r
        return np.asarray(np.sqrt(np.where(energy < 0, -energy, np.nan) / 2) / r)

    return along(flight, rate)
