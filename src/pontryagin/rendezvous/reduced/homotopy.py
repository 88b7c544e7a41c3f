"""Solving and following: Newton's method, and curves of solutions by pseudo-arclength.

A curve is followed by its tangent and corrected across it, so that it may turn back (a fold: two extremals
of one problem meet) and give several solutions at one value of the parameter.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.shooting import (
    Equations,
    Setting,
    equations,
)

Family = Callable[[Array, float], tuple[Equations, Array]]
"""Unknowns and the parameter to the equations and their derivative in the parameter."""


class Linearised(Protocol):
    """Equations at some unknowns."""

    @property
    def residual(self) -> Array:
        """What is zero at a solution, (m,)."""

    @property
    def jacobian(self) -> Array:
        """Its derivatives in the unknowns, (m, n)."""


E = TypeVar("E", bound=Linearised)

ITERATIONS = 12
EXACT = 1e-15
"""Relative correction to be expected, by quadratic convergence, of a step that is left undone."""
NEAR = 1e-8
"""The same where flights are rough."""
POLISHED = 1e-9
"""Residual below which Newton's method converges quadratically, or stands at rounding."""
MEETING = 1e-10
"""Residual of a meeting, where its conditioning allows; and where it does not:"""
FARTHEST = 1e-6
CLOSE = 1e-9
"""Relative size of a correction after which a point of a curve is taken."""
STEPS = 400
LEAST_STEP = 1e-5


@dataclass(frozen=True)
class Root:
    """A solution: the unknowns, the equations there, the last relative correction."""

    unknowns: Array
    equations: Equations
    correction: float

    @property
    def flight(self) -> Flight:
        """The extremal."""
        return self.equations.flight

    @property
    def residual(self) -> float:
        """Largest residual."""
        return float(np.abs(self.equations.residual).max())


def scales(unknowns: Array) -> Array:
    """What the unknowns are measured by: the largest costate, and the duration itself."""
    largest = float(np.abs(unknowns[:6]).max()) or 1.0
    return np.array([largest] * 6 + list(np.abs(unknowns[6:])))


def newton(setting: Setting, unknowns: Array) -> Root:
    """Newton's method with halved steps; what is handed out could not be improved further.

    Raises
    ------
    NotConverged
        When the residual stays above `tolerance`.
    """
    unknowns, correction = _approach(setting.but(rough=True), unknowns)
    here = equations(setting, unknowns)
    size = float(np.linalg.norm(here.residual))
    for _ in range(ITERATIONS):
        step, last = step_of(here), correction
        correction = float(np.abs(step / scales(unknowns)).max())
        moved = _damped(setting, unknowns, step, size)
        if moved is None:
            break
        unknowns, here = moved
        size = float(np.linalg.norm(here.residual))
        if expected(correction, last) < EXACT:
            break
    if not size <= tolerance(here.jacobian, unknowns):
        raise NotConverged("Newton's method did not reach a meeting", float(size))
    return Root(unknowns, here, correction)


def tolerance(jacobian: Array, unknowns: Array) -> float:
    """The residual of a meeting: 1e-10, or up to 1e-6 what rounding makes of it in worse equations."""
    rounding = 100 * float(np.finfo(float).eps) * float(np.linalg.cond(jacobian * scales(unknowns)))
    return min(max(MEETING, rounding), FARTHEST)


def _approach(rough: Setting, unknowns: Array) -> tuple[Array, float]:
    """The first steps, flown roughly, until an exact one is worth it; the last correction."""
    here = equations(rough, unknowns)
    correction = np.inf
    for _ in range(ITERATIONS):
        step, last = step_of(here), correction
        correction = float(np.abs(step / scales(unknowns)).max())
        if expected(correction, last) < NEAR:
            return unknowns + step, correction
        moved = _damped(rough, unknowns, step, float(np.linalg.norm(here.residual)))
        if moved is None:
            return unknowns, np.inf
        unknowns, here = moved
    return unknowns, np.inf


def step_of(here: Equations) -> Array:
    """Newton's step.

    Raises
    ------
    NotConverged
        Where there is none.
    """
    try:
        return np.asarray(np.linalg.solve(here.jacobian, -here.residual), dtype=float)
    except np.linalg.LinAlgError:
        raise NotConverged("the equations are singular", float(np.abs(here.residual).max())) from None


def expected(correction: float, last: float) -> float:
    """The correction after two of quadratic convergence; after one, itself."""
    return correction * min(1.0, (correction / last) ** 2) if last < np.inf else correction


def _damped(setting: Setting, unknowns: Array, step: Array, size: float) -> tuple[Array, Equations] | None:
    """The longest of the halved steps that makes the residual smaller; None if none does.

    Near the solution only the whole step: what it cannot improve is rounding.
    """
    for halving in range(1 if size < POLISHED else 6):
        trial = unknowns + step / 2**halving
        if setting.free and not 0.2 * unknowns[6] < trial[6] < 5 * unknowns[6]:
            continue
        try:
            there = equations(setting, trial)
        except NotConverged:
            continue
        if np.linalg.norm(there.residual) < size:
            return trial, there
    return None


@dataclass(frozen=True)
class Point(Generic[E]):
    """A point of a curve."""

    unknowns: Array
    parameter: float
    equations: E


def follow(
    family: Callable[[Array, float], tuple[E, Array]],
    unknowns: Array,
    start: float,
    towards: float,
    step: float = 0.1,
    steps: int = STEPS,
    largest: float = 0.5,
    rows: int | None = None,
) -> Iterator[Point[E]]:
    """Points of the curve through a solution, from ``start`` first in the direction of ``towards``.

    Yields `Point`; the first is the start itself. It ends where the steps become too short or too many: the
    caller looks at the points and stops when it has what it wants. Only the first ``rows`` equations hold
    along the curve, in as many unknowns; the others are looked at by the caller.
    """
    values, by_parameter = family(unknowns, start)
    here = Point(unknowns, start, values)
    yield here
    direction = np.append(np.zeros(len(unknowns)), np.sign(towards - start))
    for _ in range(steps):
        scale = np.append(scales(here.unknowns), 1.0)
        kept = here.equations.jacobian[:rows, :rows]
        tangent = _tangent(kept, by_parameter, scale, direction)
        while True:
            landed = _land(family, here, scale, tangent, step, rows)
            if landed is not None:
                break
            step /= 2
            if step < LEAST_STEP:
                return
        point, by_parameter, effort = landed
        direction = np.append((point.unknowns - here.unknowns), point.parameter - here.parameter) / scale
        here = point
        yield here
        step = min(largest, step * (2.0 if effort <= 2 else 1.3 if effort == 3 else 0.7))


def _tangent(jacobian: Array, by_parameter: Array, scale: Array, direction: Array) -> Array:
    """The scaled unit tangent that goes on in a direction."""
    whole = np.column_stack([jacobian, by_parameter]) * scale
    whole /= np.linalg.norm(whole, axis=1, keepdims=True)
    tangent = np.linalg.svd(whole)[2][-1]
    return tangent if tangent @ direction >= 0 else -tangent


def _land(
    family: Callable[[Array, float], tuple[E, Array]],
    here: Point[E],
    scale: Array,
    tangent: Array,
    step: float,
    rows: int | None,
) -> tuple[Point[E], Array, int] | None:
    """Predict along the tangent, correct across it: the new point, its slope in the parameter, the effort."""
    start = np.append(here.unknowns, here.parameter)
    y = start + step * scale * tangent
    last = np.inf
    for effort in range(1, 7):
        try:
            values, by_parameter = family(y[:-1], float(y[-1]))
        except (NotConverged, FloatingPointError, OverflowError):
            return None
        across = tangent @ ((y - start) / scale) - step
        matrix = np.vstack([np.column_stack([values.jacobian[:rows, :rows], by_parameter]) * scale, tangent])
        try:
            change = np.linalg.solve(matrix, -np.append(values.residual[:rows], across))
        except np.linalg.LinAlgError:
            return None
        size = float(np.linalg.norm(change))
        if not size < min(max(2 * last, 1e-8), step):
            return None
        y, last = y + scale * change, size
        if size < CLOSE or (size < 1e-5 and effort > 1):
            return Point(y[:-1], float(y[-1]), values), by_parameter, effort
    return None


def between(a: Point, b: Point, parameter: float) -> Array:
    """Unknowns by the secant at a value of the parameter between two points."""
    share = (parameter - a.parameter) / (b.parameter - a.parameter)
    return a.unknowns + share * (b.unknowns - a.unknowns)
