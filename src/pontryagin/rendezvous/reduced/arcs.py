"""The equations of the reduced form for unsaturated and saturated thrust, and the events between them.

The eleven repaired equations are integrated with their derivatives in the six initial costates and in the
bound: p_max is a twelfth state that does not change. A mode ends where |n| passes 2 alpha2 p_max; the control
is continuous there, so that the derivatives do not jump. Units are those of `Scaled`, alpha2 = 1.
"""

import functools
from collections.abc import Sequence
from typing import Literal

from pontryagin.numerics.equations import Arithmetic, EventFunction, Kernel, Number, RightHandSide
from pontryagin.numerics.flow import ROUGH, TOLERANCE, Integrator, integrator
from pontryagin.rendezvous import kernels

Mode = Literal["unsaturated", "saturated"]
OTHER: dict[Mode, Mode] = {"unsaturated": "saturated", "saturated": "unsaturated"}

STATES = ("r", "v1", "c", "phi", "rho", "s1", "e", "nu1", "nu2", "nu3", "chi", "p_max")
COSTATES = slice(4, 10)
BOUND = 11
COUNT, COLUMNS = 12, 7
"""Number of states, and of the initial values in which they are differentiated."""
WRT = (4, 5, 6, 7, 8, 9, BOUND)  # the initial values in which the states are differentiated
STEPS_PER_UNIT = 800
"""An arc that needs more steps than this per unit of time is taken to run into a singularity."""
ECCENTRICITY, CHART = 0, 1
"""Indices of the parameters."""


def rates(mode: Mode) -> RightHandSide:
    """Rates of the twelve states in a mode."""
    kernel = getattr(kernels, mode)

    def of_mode(of: Arithmetic, _: Number, x: Sequence[Number], p: Sequence[Number]) -> list[Number]:
        scale = 1.0 if mode == "unsaturated" else x[BOUND]
        return [
            *of.lift(kernel)(*x[:BOUND], 1.0, 1.0, p[ECCENTRICITY], 1.0, scale, p[CHART]),
            0.0 * x[BOUND],
        ]

    return of_mode


def saturation(of: Arithmetic, x: Sequence[Number]) -> Number:
    """|n|^2/(2 p_max)^2 - 1: positive where the thrust is saturated."""
    square = of.lift(kernels.switching_square)(x[0], x[2], x[5], x[6], x[7])
    return square / (4.0 * x[BOUND] * x[BOUND]) - 1.0


def leaving(mode: Mode) -> EventFunction:
    """The function that grows through zero where a mode ends."""
    sign = 1.0 if mode == "unsaturated" else -1.0
    return lambda of, _, x, p: sign * saturation(of, x)


@functools.cache
def equations(mode: Mode, ends: bool) -> Kernel:
    """The equations of a mode; without ``ends`` no value of |n| ends it (for alpha2 = 0, or no bound)."""
    events = (leaving(mode),) if ends else ()
    return Kernel(STATES, rates(mode), 2, WRT, events)


@functools.cache
def arc(mode: Mode, ends: bool = True, rough: bool = False) -> Integrator:
    """The integrator of a mode."""
    return integrator(equations(mode, ends), ROUGH if rough else TOLERANCE, STEPS_PER_UNIT)
