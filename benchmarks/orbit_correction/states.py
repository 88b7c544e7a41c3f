"""Seeded random states, the sets of impulses, and the interface of a peer's solver."""

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.orbit_correction import printed, random_states
from pontryagin.orbit_correction.plan.thrust import Thrust

SEED = 2017
INTERVAL, PEAK = float(printed.INTERVAL), float(printed.PEAK)
"""The paper's example: time between impulses in rad, and the bound on them in orbital speeds."""

Solver = Callable[[NDArray], float]
"""A function from a state (3,), in orbital units over the peak, to its gauge, or nan if none is found."""


@dataclass(frozen=True)
class Peer:
    """A peer's method and the number of states it is timed on.

    Attributes
    ----------
    make : callable
        A function from the name of a set and a number of steps to a solver. It builds the matrices and is
        not timed.
    count : int
        Number of states, smaller for slow methods.
    """

    make: Callable[[str, int], Solver]
    count: int


def states(count: int) -> Array:
    """Normal deviations of a hundredth of the radius and the speed, (count, 3)."""
    return random_states(count, seed=SEED)


def thrust(name: str) -> Thrust:
    """One of the three sets of impulses with the paper's interval and peak."""
    return Thrust(name, INTERVAL, PEAK)


def unit_factors(name: str, steps: int) -> Array:
    """G_k for a peak of 1, (steps, 3, components): numbers of order one, which suit every peer best."""
    return Thrust(name, INTERVAL, 1.0).factors(steps)
