"""The equations in Sapunkov's elements: modes of thrust along n, and the events that end them.

The independent variable is phi. The states are A, B, their costates a, b, the time, and the integral of the
running cost L without alpha1. Their derivatives in six unknown costates at the start are integrated with
them. There are four modes of thrust along n:

unsaturated  n/2                                      alpha1 + alpha2 p^2, below the peak
saturated    p_max n/|n|                              any functional
coast        0                                        alpha1 + alpha2 |p|
smoothed     p_max n/|n| (1 + tanh(S/width))/2        alpha1 + alpha2 |p|, jump at S = |n| - 1 = 0 smoothed

The rates at any thrust are those of `kernels`. Units are those of `Scaled`, alpha2 = 1.
"""

import functools
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from pontryagin.numerics.equations import (
    Arithmetic,
    EventFunction,
    Kernel,
    Number,
    RightHandSide,
)
from pontryagin.numerics.flow import ROUGH, TOLERANCE, Integrator, integrator
from pontryagin.rendezvous import kernels

Mode = Literal["unsaturated", "saturated", "coast", "smoothed"]

OTHER: dict[tuple[str, Mode], Mode] = {
    ("square", "saturated"): "unsaturated",
    ("square", "unsaturated"): "saturated",
    ("fuel", "saturated"): "coast",
    ("fuel", "coast"): "saturated",
}
"""The mode after a switch, by the functional and the mode before."""
RISING = {"unsaturated": 1.0, "saturated": -1.0, "coast": 1.0, "smoothed": 1.0}
"""The sense, +1 rising and -1 falling, in which |n| passes its level at the end of an arc of each mode."""

ELEMENTS, COSTATES, TIME, SPENT = slice(0, 8), slice(8, 16), 16, 17
COUNT, COLUMNS = 18, 6
"""Number of states, and of the unknown costates in which they are differentiated."""
NAMES = (*(f"{group}{i}" for group in ("A", "B", "a", "b") for i in range(4)), "t", "spent")
STRIDE = 8.0
"""Longest step of phi under a smoothed jump, in units of its width.

A smoothed coast is a straight line to rounding; steps of unlimited length would skip the burn after it.
"""
STEPS_PER_UNIT = 640
"""An arc that needs more steps than this per unit of phi is taken to run into a singularity."""


class Constants(NamedTuple):
    """Parameters of a mode: p_max, L at p_max, |n| at which the arc ends, width of the smoothed jump."""

    peak: float = 1.0
    charge: float = 0.0
    level: float = 1e30
    width: float = 1.0


def thrust_of(
    mode: Mode, of: Arithmetic, n: Sequence[Number], p: Sequence[Number]
) -> tuple[list[Number], Number]:
    """Thrust along n in a mode with the `Constants` p, and its running cost L without alpha1."""
    peak, charge, _, width = p
    square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2]
    if mode == "coast":
        return [0.0 * part for part in n], 0.0 * square
    if mode == "unsaturated":
        return [0.5 * part for part in n], 0.25 * square
    size = of.sqrt(square)
    if mode == "saturated":
        return [peak * part / size for part in n], charge + 0.0 * square
    share = 0.5 + 0.5 * of.tanh((size - 1.0) / width)
    return [peak * share * part / size for part in n], charge * share


def rates(mode: Mode) -> RightHandSide:
    """Derivatives of the 18 states in phi in a mode."""

    def of_mode(of: Arithmetic, phi: Number, x: Sequence[Number], p: Sequence[Number]) -> list[Number]:
        n = of.lift(kernels.element_switching)(*x[:16], phi)
        thrust, cost = thrust_of(mode, of, n, p)
        *moving, clock = of.lift(kernels.element_rates)(*x[:16], phi, *thrust)
        return [*moving, clock, clock * cost]

    return of_mode


def leaving(mode: Mode) -> EventFunction:
    """|n|^2/level^2 - 1, or its negative: the function that grows through zero where a mode ends."""

    def of_mode(of: Arithmetic, phi: Number, x: Sequence[Number], p: Sequence[Number]) -> Number:
        n = of.lift(kernels.element_switching)(*x[:16], phi)
        level = p[2]
        return RISING[mode] * ((n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / (level * level) - 1.0)

    return of_mode


@functools.cache
def equations(mode: Mode) -> Kernel:
    """The equations of a mode, with columns for six derivatives whose initial values the flight sets."""
    return Kernel(NAMES, rates(mode), len(Constants._fields), tuple(range(8, 14)), (leaving(mode),))


@functools.cache
def arc(mode: Mode, rough: bool = False) -> Integrator:
    """The integrator of a mode."""
    return integrator(equations(mode), ROUGH if rough else TOLERANCE, STEPS_PER_UNIT)


def longest_step(mode: Mode, constants: Constants) -> float:
    """Longest step of phi allowed in a mode."""
    return STRIDE * constants.width if mode == "smoothed" else np.inf
