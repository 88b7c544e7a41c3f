"""Newton's method for the conditions of a meeting in the elements, and the families of its solutions."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import takewhile

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.continuation import Point, by_differences, follow, march, reach
from pontryagin.numerics.newton import ROUNDING
from pontryagin.rendezvous.elements.conditions import ElementsSetting, equations
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
)
from pontryagin.rendezvous.families import Shooting, fine_grid
from pontryagin.rendezvous.root import Conditions, Root, root, scales

WITHIN = 3.0
"""Factor by which a step of Newton's method may change phi at the end."""
ITERATIONS, FEW = 25, 8
"""Most steps of Newton's method, by exact flights and by rough ones."""
ROUGH = 1e-8
"""Relative correction that is left undone where flights are rough."""
ROUGH_MEETING = 1e-6
"""Residual above which Newton's method has not arrived where flights are rough."""
LEAST_STEP = 1 / 128
"""Step below which a family is given up, in shares of the way."""
FARTHEST = 1.5
"""How far from its end a family may lead, in units of the way."""
FIRST_ARC, ARCS = 0.01, 100
"""First step along a curve that is followed round its folds, and the most points."""
DIFFERENCE = 1e-4
"""Difference of the parameter for the slope of the equations; flights there are good to 1e-10."""
PACES = {"duration": (0.025, 0.1, 160), "ratio": (0.2, 0.3, 80)}
"""Over the logarithm of each number: the first step, the largest, and the most steps tried."""
LEAST_PACE = 1e-3
"""Step of such a logarithm below which a family is given up."""
LOST = "the family of extremals could not be followed"
"""What is said where a family ends."""


def meet(setting: ElementsSetting, unknowns: Array) -> Root[ElementFlight]:
    """The meeting that Newton's method reaches; roughly, on the way of a family.

    Raises
    ------
    NotConverged
        If it reaches none.
    """
    return root(
        lambda x: equations(setting, x),
        unknowns,
        within=WITHIN,
        iterations=FEW if setting.rough else ITERATIONS,
        correction=ROUGH if setting.rough else ROUNDING,
        largest=ROUGH_MEETING if setting.rough else None,
    )


Settings = Callable[[float], ElementsSetting]
"""The settings of a family by its parameter."""


def _roughly(family: Settings) -> Callable[[float, Array], Point[Conditions[ElementFlight]]]:
    """The points of a family by rough flights."""

    def at(parameter: float, guess: Array) -> Point[Conditions[ElementFlight]]:
        found = meet(replace(family(parameter), rough=True), guess)
        return Point(found.unknowns, parameter, found.equations)

    return at


def lead(family: Settings, start: Root[ElementFlight], begin: float, end: float) -> Root[ElementFlight]:
    """The solution at ``end`` of a family of settings, over its parameter from that at ``begin``.

    Raises
    ------
    NotConverged
        Where the family turns back, or cannot be followed.
    """
    points = _over(family, start, begin, end)
    return reach(points, end, lambda x: meet(family(end), x), LOST)


def _over(
    family: Settings, start: Root[ElementFlight], begin: float, end: float
) -> Iterator[Point[Conditions[ElementFlight]]]:
    way = abs(end - begin)
    point = Point(start.unknowns, begin, start.equations)
    return march(_roughly(family), point, end, first=way / 4, least=way * LEAST_STEP)


def lead_round(family: Settings, start: Root[ElementFlight], begin: float, end: float) -> Root[ElementFlight]:
    """As `lead`, and where that ends by pseudo-arclength.

    So the family may turn back on the way (a fold: two extremals of one problem meet); it then may end on
    another extremal than a family that does not.

    Raises
    ------
    NotConverged
        Where that ends as well.
    """
    *_, last = _over(family, start, begin, end)
    if last.parameter == end:
        return meet(family(end), last.unknowns)
    rough = by_differences(
        lambda x, parameter: equations(replace(family(parameter), rough=True), x), DIFFERENCE
    )
    points = follow(
        rough,
        last.unknowns,
        last.parameter,
        end - last.parameter,
        scales=scales,
        step=FIRST_ARC,
        steps=ARCS,
    )
    near = takewhile(lambda point: abs(end - point.parameter) <= FARTHEST * abs(end - begin), points)
    return reach(near, end, lambda x: meet(family(end), x), LOST)


def curve(
    setting: ElementsSetting, start: Root[ElementFlight], name: str, end: float
) -> Iterator[Point[Conditions[ElementFlight]]]:
    """The extremals through one as a number of the setting changes, by rough flights.

    Parameters
    ----------
    setting : ElementsSetting
        What the start solves.
    start : Root
        An extremal.
    name : "peak", "ratio" or "duration"
        The parameter is its logarithm. Costates over "ratio" are guessed in units of |n(t_k)|.
    end : float
        The value of the parameter at which the curve ends.
    """
    begin = math.log(start.flight.duration if name == "duration" else getattr(setting, name))

    def family(parameter: float) -> ElementsSetting:
        return setting.replace(**{name: math.exp(parameter)})

    if name == "peak":
        yield from _over(family, start, begin, end)
        return

    def scale(parameter: float) -> Array:
        size = family(parameter).end_switching if name == "ratio" else 1.0
        return np.append(np.full(6, size), 1.0)

    def at(parameter: float, guess: Array) -> Point[Conditions[ElementFlight]]:
        found = _roughly(family)(parameter, guess * scale(parameter))
        return replace(found, unknowns=found.unknowns / scale(parameter))

    point = Point(start.unknowns / scale(begin), begin, start.equations)
    first, largest, tries = PACES[name]
    for found in march(at, point, end, first=first, largest=largest, least=LEAST_PACE, tries=tries):
        yield replace(found, unknowns=found.unknowns * scale(found.parameter))


def _law(setting: ElementsSetting, point: Point[Conditions[ElementFlight]]) -> float:
    """By what the terminal law is missed at the end of an extremal of a fixed duration."""
    return float(equations(setting, point.unknowns).residual[-1])


def _thrust(flight: ElementFlight) -> Array:
    """|p| on a fine grid."""
    grid = fine_grid(flight.phi)
    return np.asarray(np.linalg.norm(flight.thrust(flight.sample(grid), grid), axis=1))


SHOOTING = Shooting(
    meet=meet,
    equations=equations,
    curve=curve,
    released=lambda unknowns, duration: unknowns,
    law=_law,
    thrust=_thrust,
)
"""These equations, as `pontryagin.rendezvous.families` leads their extremals."""
