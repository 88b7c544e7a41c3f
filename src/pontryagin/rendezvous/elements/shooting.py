"""Newton's method for the conditions of a meeting in the elements, and families of its solutions."""

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
"""Largest factor by which a step of Newton's method may change phi at the end."""
ITERATIONS, FEW = 25, 8
"""Largest numbers of steps of Newton's method with accurate flights and with rough ones."""
ROUGH = 1e-8
"""Relative correction at which Newton's method with rough flights ends."""
ROUGH_MEETING = 1e-6
"""Largest residual of a meeting that is accepted with rough flights."""
LEAST_STEP = 1 / 128
"""Smallest step of a family, as a share of the interval of its parameter; below it the family is given up."""
FARTHEST = 1.5
"""Largest distance of a curve from the end value of its parameter, in units of the parameter's interval."""
FIRST_ARC, ARCS = 0.01, 100
"""First step and largest number of steps along a curve that is followed round its folds."""
DIFFERENCE = 1e-4
"""Difference of the parameter by which the equations are differentiated; rough flights are good to 1e-10."""
PACES = {"duration": (0.025, 0.1, 160), "ratio": (0.2, 0.3, 80)}
"""First step, largest step and largest number of tries over the logarithm of the duration or the ratio."""
LEAST_PACE = 1e-3
"""Smallest step over the logarithm of the duration or the ratio; below it the family is given up."""
LOST = "the family of extremals could not be followed"
"""Message of the exception where a family ends."""


def meet(setting: ElementsSetting, unknowns: Array) -> Root[ElementFlight]:
    """The meeting that Newton's method reaches; for rough settings with lower accuracy.

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
"""A family of settings: a function of its parameter."""


def _roughly(family: Settings) -> Callable[[float, Array], Point[Conditions[ElementFlight]]]:
    """A function that finds points of a family by rough flights."""

    def at(parameter: float, guess: Array) -> Point[Conditions[ElementFlight]]:
        found = meet(replace(family(parameter), rough=True), guess)
        return Point(found.unknowns, parameter, found.equations)

    return at


def lead(family: Settings, start: Root[ElementFlight], begin: float, end: float) -> Root[ElementFlight]:
    """The solution at the parameter ``end`` of a family of settings, by continuation from that at ``begin``.

    Raises
    ------
    NotConverged
        If the family turns back, or cannot be followed.
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
    """As `lead`, but continued by pseudo-arclength where `lead` would end.

    The family may therefore turn back on the way (a fold: two extremals of one problem meet). It may then end
    at another extremal than a family without folds would.

    Raises
    ------
    NotConverged
        If the continuation by pseudo-arclength ends as well.
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
    """The curve of extremals through a given one as an attribute of the setting changes, by rough flights.

    Parameters
    ----------
    setting : ElementsSetting
        The setting that the start solves.
    start : Root
        An extremal.
    name : "peak", "ratio" or "duration"
        The attribute; the parameter is its logarithm. For "ratio" the costates are extrapolated in units of
        |n(t_k)|.
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
    """Residual of the terminal law at the end of an extremal of a fixed duration."""
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
"""The elements as a formulation for `pontryagin.rendezvous.families`."""
