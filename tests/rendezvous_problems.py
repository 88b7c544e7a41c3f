"""Problems of rendezvous for tests: a craft on the unit circle, a target on an inclined ellipse."""

import math
from dataclasses import replace

import numpy as np

from pontryagin.rendezvous import Chaser, Orbit, Rendezvous

CRAFT = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
LEAP = Rendezvous(CRAFT, Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6), 0, 1, math.inf, duration=6.0)
INCLINATIONS = (0, 1, 60, 150)


def orbit(degrees: float, eccentricity: float = 0.1) -> Orbit:
    """The target's orbit, inclined by an angle."""
    return Orbit.from_angles(1.5, eccentricity, 0.3, math.radians(degrees), 0.5, 0.6)


def problem(degrees: float, **changes) -> Rendezvous:
    """Least energy without a bound in free time, unless it is changed."""
    given = {"time_weight": 0, "energy_weight": 1, "peak": math.inf} | changes
    return Rendezvous(CRAFT, orbit(degrees), **given)


def in_units(degrees: float = 20, length: float = 1.0, gravity: float = 1.0, **changes) -> Rendezvous:
    """A problem scaled by `length`, with times scaled so that the motion is the same for every `gravity`."""
    time = math.sqrt(length**3 / gravity)
    given = {"time_weight": 0, "energy_weight": 1, "peak": math.inf, "duration": 6.0} | changes
    given["duration"] = given["duration"] and given["duration"] * time
    given["peak"] *= length / time**2
    target = Orbit.from_angles(1.5 * length, 0.1, 0.3, math.radians(degrees), 0.5, 0.6)
    craft = Chaser(length, 0.0, length**2 / time, [1, 0, 0, 0])
    return Rendezvous(craft, target, gravity=gravity, **given)


def beside(distance, **changes):
    """A problem of free duration whose craft starts above the target at a distance, with its v1 and c."""
    turn = [math.cos(0.3), 0, 0, math.sin(0.3)]
    radius = 1.5 / (1 + 0.1 * math.cos(0.6))
    craft = Chaser(radius + distance, 0.1 * math.sqrt(1 / 1.5) * math.sin(0.6), math.sqrt(1.5), turn)
    return replace(LEAP, chaser=craft, duration=None, **changes)


def starts(count: int) -> np.ndarray:
    """Random costates at t0, (count, 6)."""
    return 0.05 * np.random.default_rng(5).standard_normal((count, 6))


BOUNDED = problem(20, peak=0.2, duration=6.0)
FALLING = np.array([0.02, -0.04, 0.01, 0.19, 0.05, -0.16])
"""Costates with which the craft falls into the centre of attraction."""
