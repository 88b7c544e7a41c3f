"""The equations of a meeting in Sapunkov's elements, their derivatives, Newton's method and the families.

Unknowns: six costates at the start and phi at the end. Equations: craft and target have one place and one
velocity at the time t(phi), six; the duration, or at a free one the terminal law |n(t_k)|. While A and B
are led from where the craft coasts to the target's, by shares, that goal stands in the target's place.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import takewhile
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import jacobian
from pontryagin.numerics.continuation import Point, by_differences, follow, march, reach
from pontryagin.numerics.newton import ROUNDING
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.elements.arcs import TIME
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
    end_rates,
    fly_elements,
    switching,
    switching_gradient,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.families import Shooting, fine_grid
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.root import Conditions, Root, root, scales
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

Goal = Callable[[float], tuple[Array, Array]]
"""Time to R and V (6,) and their rates (6,)."""

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
PACES = {"duration": (0.1, 0.3, 40), "ratio": (math.log(2) / 4, math.log(2), 60)}
"""Over the logarithm of each number: the first step, the largest, and the most steps tried."""
LEAST_PACE = 1e-3
"""Step of such a logarithm below which a family is given up."""
LOST = "the family of extremals could not be followed"
"""What is said where a family ends."""


@dataclass(frozen=True)
class ElementsSetting:
    """What is solved for, and under which law of thrust; units of `Scaled`.

    Parameters
    ----------
    scaled : Scaled
        The problem.
    law : Law
        The functional, alpha1/alpha2 and the bound.
    duration : float or None
        t_k where fixed.
    goal : function of the time, optional
        What stands in the target's place.
    taylor : bool or None
        As for `pontryagin.numerics.flow.flow`.
    rough : bool
        Whether extremals are flown to 1e-10 only: on the way of a family.
    """

    scaled: Scaled
    law: Law
    duration: float | None = None
    goal: Goal | None = None
    taylor: bool | None = None
    rough: bool = False

    @property
    def ratio(self) -> float:
        """alpha1/alpha2; inf for alpha2 = 0."""
        return self.law.ratio

    @property
    def peak(self) -> float:
        """p_max."""
        return self.law.peak

    @property
    def end_switching(self) -> float:
        """|n(t_k)| by the terminal law."""
        return self.law.end_switching

    def replace(self, **changes: Any) -> "ElementsSetting":
        """The same with some of it changed; "ratio", "peak" and "width" are the law's."""
        of_law = {name: changes.pop(name) for name in ("ratio", "peak", "width") if name in changes}
        return replace(self, law=replace(self.law, **of_law), **changes)


@dataclass(frozen=True)
class ElementsEquations:
    """Residual (7,) and Jacobian (7, 7) at one flight."""

    flight: ElementFlight
    residual: Array
    jacobian: Array


def target(scaled: Scaled) -> Goal:
    """The target by Kepler's equation, and Newton's law for how it moves on."""

    def at(time: float) -> tuple[Array, Array]:
        state = target_by_kepler(scaled, time)
        return state, np.concatenate([state[3:], -state[:3] / np.linalg.norm(state[:3]) ** 3])

    return at


def equations(setting: ElementsSetting, unknowns: Array) -> ElementsEquations:
    """Residuals of a setting and their derivatives.

    Raises
    ------
    NotConverged
        Where the extremal cannot be followed.
    """
    flight = fly_elements(
        setting.scaled, unknowns[:6], float(unknowns[6]), setting.law, setting.taylor, setting.rough
    )
    columns = np.column_stack([flight.slopes, end_rates(flight)])
    values, by_state, by_phi = _place(flight)
    goal, moving = (setting.goal or target(setting.scaled))(flight.duration)
    meeting = by_state @ columns[:8] - np.outer(moving, columns[TIME])
    meeting[:, 6] += by_phi
    if setting.duration is not None:
        last, row = flight.duration / setting.duration - 1, columns[TIME] / setting.duration
    else:
        last, row = _terminal(flight, columns)
    return ElementsEquations(flight, np.append(values - goal, last), np.vstack([meeting, row]))


def _place(flight: ElementFlight) -> tuple[Array, Array, Array]:
    """R and V at the end, their derivatives (6, 8) in A and B, and in phi."""
    inputs = np.append(flight.end[:8], flight.phi)
    values, slopes = jacobian(lambda x: kernels.element_place(*x), inputs)
    return values, slopes[:, :8], slopes[:, 8]


def _terminal(flight: ElementFlight, columns: Array) -> tuple[float, Array]:
    """|n|/|n|_wanted - 1 at the end, and its derivatives in the unknowns."""
    n = switching(flight.end, np.array(flight.phi))
    gradient, by_phi = switching_gradient(flight.end, flight.phi)
    row = gradient @ columns
    row[6] += by_phi
    size, wanted = float(np.linalg.norm(n)), flight.law.end_switching
    return size / wanted - 1, row / (2 * size * wanted)


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
