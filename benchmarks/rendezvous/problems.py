"""The problems that are measured: cases of the report, and neighbouring problems for warm solves."""

import math
from dataclasses import replace
from functools import cache

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous import Chaser, Extremal, Orbit, Rendezvous, solve
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting

SEED = 2014
NEIGHBOUR = 1.02
"""Factor of the duration, or of the bound, by which a neighbouring problem differs from a case."""

FIXED = ("circle-energy", "inclined-energy", "energy-bounded")
LEAST = (
    "circle",
    "ellipse",
    "inclined-1",
    "inclined-10",
    "inclined-30",
    "inclined-60",
    "ellipses",
    "glonass",
)


def leap(degrees: float) -> Rendezvous:
    """From a circle to an ellipse inclined by an angle, with least energy in the time 6 and no bound."""
    target = Orbit.from_angles(1.5, 0.1, 0.0, math.radians(degrees), 0.0, 0.6)
    craft = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
    return Rendezvous(craft, target, time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)


@cache
def solved(name: str) -> Extremal:
    """The best extremal found for a case."""
    return solve(cases()[name].problem)


@cache
def solved_leap(degrees: float) -> Extremal:
    """The best extremal found for a `leap`."""
    return solve(leap(degrees))


def neighbour(name: str) -> Rendezvous:
    """The neighbouring problem of a case, which is solved from the solution of the case."""
    problem = cases()[name].problem
    if problem.duration is None:
        return replace(problem, peak=problem.peak * NEIGHBOUR)
    return replace(problem, duration=problem.duration * NEIGHBOUR)


def setting(problem: Rendezvous) -> Setting:
    """The setting of the problem for the shooting equations."""
    scaled = problem.scaled
    return Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)


def deviations(count: int, spread: float) -> Array:
    """Normally distributed deviations with a standard deviation `spread`, (count, 6)."""
    return spread * np.random.default_rng(SEED).standard_normal((count, 6))
