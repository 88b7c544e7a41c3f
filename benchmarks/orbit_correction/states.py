"""Seeded random states, the sets of impulses, and what a peer is asked for."""

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.orbit_correction import random_states
from pontryagin.orbit_correction.plan.thrust import Thrust

SEED = 2017
INTERVAL, PEAK = 0.25, 0.0035
"""The paper's example: time between impulses, rad, and bound on them, orbital speeds."""

Solver = Callable[[NDArray], float]
"""A state (3,), orbital units over the peak -> gauge, nan where the solver gives up."""


@dataclass(frozen=True)
class Peer:
    """A method, made for a set of impulses and a number of steps, and how many states it gets.

    Attributes
    ----------
    make : callable
        Name of the set and number of steps -> solver. Matrices are built here, once, and not timed.
    count : int
        Fewer states where it is slow.
    """

    make: Callable[[str, int], Solver]
    count: int


def states(count: int) -> Array:
    """Normal deviations of a hundredth of the radius and the speed, (count, 3)."""
    return random_states(count, seed=SEED)


def thrust(name: str) -> Thrust:
    """The paper's engine with one of the three sets."""
    return Thrust(name, INTERVAL, PEAK)


def unit_factors(name: str, steps: int) -> Array:
    """G_k for a peak of 1, (steps, 3, components): numbers of order one, as suits every peer best."""
    return Thrust(name, INTERVAL, 1.0).factors(steps)
