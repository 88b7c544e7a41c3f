"""Newton's method for the conditions of a meeting in the reduced form, and its family over the duration."""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.continuation import Family
from pontryagin.rendezvous.families import fine_grid
from pontryagin.rendezvous.reduced.conditions import ReducedEquations, Setting, equations
from pontryagin.rendezvous.reduced.flight import (
    Flight,
)
from pontryagin.rendezvous.root import Root, root

WITHIN = 5.0
"""Largest factor by which a step of Newton's method may change a free duration."""
ITERATIONS, HALVINGS = 12, 6
"""Largest number of steps of Newton's method, and how many lengths of each are tried."""


def meet(setting: Setting, unknowns: Array) -> Root[Flight]:
    """The meeting that Newton's method reaches; the first steps use rough flights.

    Raises
    ------
    NotConverged
        If it reaches none.
    """
    rough = setting.replace(rough=True)
    return root(
        lambda x: equations(setting, x),
        unknowns,
        within=WITHIN,
        rough=lambda x: equations(rough, x),
        iterations=ITERATIONS,
        halvings=HALVINGS,
    )


def over_duration(setting: Setting) -> Family[ReducedEquations]:
    """The equations as a family over the logarithm of the duration, by rough flights.

    There are six unknowns; the last of the seven equations, the terminal law, is evaluated but not solved.
    """
    rough = setting.replace(rough=True, duration=None)

    def at(unknowns: Array, logarithm: float) -> tuple[ReducedEquations, Array]:
        duration = math.exp(logarithm)
        values = equations(rough, np.append(unknowns, duration))
        return values, values.jacobian[:6, 6] * duration

    return at


def largest_thrust(flight: Flight) -> float:
    """The largest |p| on a fine grid."""
    return float(np.linalg.norm(flight.thrust(fine_grid(flight.duration)), axis=1).max())
