"""Integrals along a flight: Gauss's rule on panels, each halved until both halves say what it says.

Near the centre of attraction everything is fast, so that even panels in time would be blind there.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.rendezvous.reduced.flight import Flight

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
AGREED = 1e-14
"""Difference at which a panel is taken, in units of the whole integral."""
HALVINGS = 12
SEEN = 6
"""Halvings after which a panel that does not gain by another is taken to be at rounding."""


def integral(rate: Callable[[Array], Array], edges: ArrayLike) -> float:
    """The integral of a rate (k,) of times (k,), smooth between the edges."""
    corners = np.asarray(edges, dtype=float)
    low, high = corners[:-1], corners[1:]
    coarse, done = _panels(rate, low, high), 0.0
    last = np.full(len(low), np.inf)
    for halving in range(HALVINGS):
        middle = (low + high) / 2
        low, high = np.stack([low, middle], axis=1), np.stack([middle, high], axis=1)
        halves = _panels(rate, low.ravel(), high.ravel()).reshape(-1, 2)
        fine = halves.sum(axis=1)
        apart = np.abs(fine - coarse)
        gaining = (apart < last / 2) | (halving < SEEN)
        open_ones = (apart > AGREED * (abs(done) + np.abs(fine).sum())) & gaining
        done += float(fine[~open_ones].sum())
        if not open_ones.any():
            return done
        low, high, coarse = (x[open_ones].ravel() for x in (low, high, halves))
        last = np.repeat(apart[open_ones], 2)
    return done + float(coarse.sum())


def _panels(rate: Callable[[Array], Array], low: Array, high: Array) -> Array:
    half = (high - low)[:, None] / 2
    times = low[:, None] + half * (1 + NODES)
    return np.asarray(np.sum(half * WEIGHTS * rate(times.ravel()).reshape(times.shape), axis=1))


def edges_of(flight: Flight) -> Array:
    """Half a unit of time apart at most, and at the switches of the thrust."""
    even = np.linspace(0.0, flight.duration, 2 + int(2 * flight.duration))
    return np.unique([*even, *flight.switch_times])


def energy(flight: Flight) -> float:
    """The integral of p^2."""
    return integral(lambda times: np.sum(flight.thrust(times) ** 2, axis=1), edges_of(flight))


def turned(flight: Flight) -> float:
    """The angle that the craft turns about the centre, in radians: the integral of c/r^2."""

    def rate(times: Array) -> Array:
        r, _, c = flight.sample(times).T[:3]
        return np.asarray(c / r**2)

    return integral(rate, edges_of(flight))


def half_anomaly(flight: Flight) -> float:
    """phi of Sapunkov's elements at the end: the integral of dt/(r sqrt(2Q)), Q = -1/h; nan on no ellipse."""

    def rate(times: Array) -> Array:
        r, v1, c = flight.sample(times).T[:3]
        energy = (v1**2 + (c / r) ** 2) / 2 - 1 / r
        return np.asarray(np.sqrt(np.where(energy < 0, -energy, np.nan) / 2) / r)

    return integral(rate, edges_of(flight))
