"""The equations of a meeting in Sapunkov's elements, with their exact derivatives, and Newton's method.

Unknowns: six costates at the start and phi at the end. Equations: craft and target have one place and one
velocity at the time t(phi), six; the duration, or at a free one the terminal law |n(t_k)|. While A and B
are led from where the craft coasts to the target's, by shares, that goal stands in the target's place.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.complex_step import jacobian
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
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.homotopy import (
    EXACT,
    NEAR,
    POLISHED,
    between,
    expected,
    scales,
    tolerance,
)
from pontryagin.rendezvous.reduced.homotopy import follow as arcs
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

Goal = Callable[[float], tuple[Array, Array]]
"""Time to R and V (6,) and their rates (6,)."""

ITERATIONS = 25
TRIES = 60
LEAST_STEP = 1 / 128
"""Of the way that a family is followed, the least step."""
FARTHEST = 1.5
"""How far from its end a family may lead, in units of the way."""
ARCS = 100
"""Points of a curve that is followed round its folds."""
FIRST_ARC = 0.01
DIFFERENCE = 1e-4
"""Of the parameter, for the slope of the equations; flights there are good to 1e-10."""
ROUGH_MEETING = 1e-6
"""Residual above which Newton's method has not arrived, on the way of a family."""


@dataclass(frozen=True)
class Setting:
    """What is solved for: a problem, a law of thrust, the duration where fixed; units of `Scaled`.

    ``rough`` are the points of a family on the way, flown to 1e-10 only.
    """

    scaled: Scaled
    law: Law
    duration: float | None = None
    goal: Goal | None = None
    taylor: bool | None = None
    rough: bool = False


@dataclass(frozen=True)
class Equations:
    """Residual (7,) and Jacobian (7, 7) at one flight."""

    flight: ElementFlight
    residual: Array
    jacobian: Array


@dataclass(frozen=True)
class Root:
    """A solution: the unknowns (7,) and the equations there."""

    unknowns: Array
    equations: Equations

    @property
    def flight(self) -> ElementFlight:
        """The extremal."""
        return self.equations.flight

    @property
    def residual(self) -> float:
        """Largest residual."""
        return float(np.abs(self.equations.residual).max())


def target(scaled: Scaled) -> Goal:
    """The target by Kepler's equation, and Newton's law for how it moves on."""

    def at(time: float) -> tuple[Array, Array]:
        state = target_by_kepler(scaled, time)
        return state, np.concatenate([state[3:], -state[:3] / np.linalg.norm(state[:3]) ** 3])

    return at


def equations(setting: Setting, unknowns: Array) -> Equations:
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
    return Equations(flight, np.append(values - goal, last), np.vstack([meeting, row]))


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


def newton(setting: Setting, unknowns: Array, tries: int = ITERATIONS) -> Root:
    """Newton's method with halved steps; what is handed out could not be improved further.

    Raises
    ------
    NotConverged
        When the residual stays above `homotopy.tolerance`, or 1e-6 where the flights are rough.
    """
    here = equations(setting, unknowns)
    size, correction = float(np.linalg.norm(here.residual)), np.inf
    for _ in range(tries):
        try:
            step = np.asarray(np.linalg.solve(here.jacobian, -here.residual), dtype=float)
        except np.linalg.LinAlgError:
            break
        moved = _damped(setting, unknowns, step, size)
        if moved is None:
            break
        unknowns, here = moved
        size = float(np.linalg.norm(here.residual))
        last, correction = correction, float(np.abs(step / scales(unknowns)).max())
        if expected(correction, last) < (NEAR if setting.rough else EXACT):
            break
    if not size <= (ROUGH_MEETING if setting.rough else tolerance(here.jacobian, unknowns)):
        raise NotConverged("Newton's method did not reach a meeting in the elements", size)
    return Root(unknowns, here)


def _damped(setting: Setting, unknowns: Array, step: Array, size: float) -> tuple[Array, Equations] | None:
    """The longest of the halved steps that makes the residual smaller; None if none does.

    Near the solution only the whole step: what it cannot improve is rounding.
    """
    for halving in range(1 if size < POLISHED else 7):
        trial = unknowns + step / 2**halving
        if not 0.3 * unknowns[6] < trial[6] < 3 * unknowns[6]:
            continue
        try:
            there = equations(setting, trial)
        except NotConverged:
            continue
        if np.linalg.norm(there.residual) < size:
            return trial, there
    return None


def follow(family: Callable[[float], Setting], root: Root, start: float, end: float) -> Root:
    """The solution at ``end`` of a family of settings, from that at ``start``: secants and Newton's method.

    Raises
    ------
    NotConverged
        Where the steps become too short; its residual is the share of the way left.
    """
    at, unknowns = _secants(family, root.unknowns, start, end)
    if at == end:
        return newton(family(end), unknowns)
    raise NotConverged("the family of extremals could not be followed", abs((end - at) / (end - start)))


def follow_round(family: Callable[[float], Setting], root: Root, start: float, end: float) -> Root:
    """As `follow`, and where that ends by pseudo-arclength.

    So the family may turn back on the way (a fold: two extremals of one problem meet); it then may end on
    another extremal than a family that does not.

    Raises
    ------
    NotConverged
        Where that ends as well; its residual is the share of the way left.
    """
    at, unknowns = _secants(family, root.unknowns, start, end)
    if at == end:
        return newton(family(end), unknowns)
    return _around(family, unknowns, at, end, abs(end - start))


def _secants(
    family: Callable[[float], Setting], unknowns: Array, at: float, end: float
) -> tuple[float, Array]:
    """How far the unknowns of a family can be followed as functions of its parameter."""
    last: tuple[float, Array] | None = None
    whole = end - at
    step = whole / 4
    for _ in range(TRIES):
        if at == end:
            break
        there = end if abs(end - at) <= abs(step) * 1.0001 else at + step
        guess = unknowns.copy()
        if last is not None:
            guess += (there - at) / (at - last[0]) * (unknowns - last[1])
        try:
            found = newton(replace(family(there), rough=True), guess, tries=8)
        except NotConverged:
            step /= 2
            if abs(step) < abs(whole) * LEAST_STEP:
                break
            continue
        last, at, unknowns = (at, unknowns), there, found.unknowns
        step *= 1.6
    return at, unknowns


def _around(
    family: Callable[[float], Setting], unknowns: Array, start: float, end: float, way: float
) -> Root:
    """The solution at ``end`` on the curve through a solution, wherever the curve turns."""
    nearest, last = abs(end - start), None
    for point in arcs(_slope(family), unknowns, start, end, step=FIRST_ARC, steps=ARCS):
        if last is not None and (point.parameter - end) * (last.parameter - end) <= 0:
            return newton(family(end), between(last, point, end))
        nearest, last = min(nearest, abs(end - point.parameter)), point
        if abs(end - point.parameter) > FARTHEST * way:
            break
    raise NotConverged("the family of extremals could not be followed", nearest / way)


def _slope(family: Callable[[float], Setting]) -> Callable[[Array, float], tuple[Equations, Array]]:
    """The equations at a parameter and, by differences, how they change with it."""

    def at(unknowns: Array, parameter: float) -> tuple[Equations, Array]:
        here, after, before = (
            equations(replace(family(parameter + shift), rough=True), unknowns)
            for shift in (0.0, DIFFERENCE, -DIFFERENCE)
        )
        return here, (after.residual - before.residual) / (2 * DIFFERENCE)

    return at
