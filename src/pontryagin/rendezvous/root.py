"""Newton's method for the conditions of a rendezvous, and the residual that counts as a meeting.

The first six unknowns are costates, in whatever equations; a seventh is where the flight ends.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.newton import ROUNDING, newton
from pontryagin.value import value_class

F = TypeVar("F", covariant=True)
"""The flight of an extremal."""

MEETING = 1e-10
"""Residual of a meeting where the equations are well conditioned."""
WORST_MEETING = 1e-6
"""Residual above which nothing is a meeting, however badly the equations are conditioned."""
COSTATES = 6
"""How many of the unknowns are costates."""


class Conditions(Protocol[F]):
    """The conditions of a rendezvous at some unknowns."""

    @property
    def flight(self) -> F:
        """The extremal flown."""

    @property
    def residual(self) -> Array:
        """What is zero at a meeting, (n,)."""

    @property
    def jacobian(self) -> Array:
        """Its derivatives in the unknowns, (n, n)."""


@value_class
@dataclass(frozen=True, eq=False)
class Root(Generic[F]):
    """A meeting: the unknowns, and the conditions there."""

    unknowns: Array
    equations: Conditions[F]

    @property
    def flight(self) -> F:
        """The extremal."""
        return self.equations.flight

    @property
    def residual(self) -> float:
        """Largest residual."""
        return float(np.abs(self.equations.residual).max())


def scales(unknowns: Array) -> Array:
    """What the unknowns are measured by: costates by the largest of them, the end of the flight by itself."""
    largest = float(np.abs(unknowns[:COSTATES]).max()) or 1.0
    return np.append(np.full(COSTATES, largest), np.abs(unknowns[COSTATES:]))


def tolerance(jacobian: Array, unknowns: Array) -> float:
    """The residual of a meeting: 1e-10, or what rounding makes of it in worse equations, up to 1e-6."""
    rounding = 100 * float(np.finfo(float).eps) * float(np.linalg.cond(jacobian * scales(unknowns)))
    return min(max(MEETING, rounding), WORST_MEETING)


def root(
    evaluate: Callable[[Array], Conditions[F]],
    unknowns: Array,
    *,
    within: float,
    rough: Callable[[Array], Conditions[F]] | None = None,
    iterations: int = 25,
    halvings: int = 7,
    correction: float = ROUNDING,
    largest: float | None = None,
) -> Root[F]:
    """The meeting that Newton's method reaches.

    Parameters
    ----------
    evaluate : function of unknowns
        The conditions.
    unknowns : (6,) or (7,) array
        Where to begin.
    within : float
        A step changes the end of the flight by less than this factor.
    rough : function of unknowns, optional
        The conditions by a cheaper flight, for the first steps.
    iterations, halvings : int
        As for `pontryagin.numerics.newton.newton`.
    correction : float
        Relative correction that is left undone.
    largest : float, optional
        The residual that is accepted; by default as `tolerance` says.

    Raises
    ------
    NotConverged
        When the residual stays above that.
    """

    def admissible(before: Array, after: Array) -> bool:
        begin, end = before[COSTATES:], after[COSTATES:]
        return bool(np.all((begin / within < end) & (end < within * begin)))

    found = newton(
        evaluate,
        unknowns,
        scales=scales,
        tolerance=correction,
        iterations=iterations,
        halvings=halvings,
        admissible=admissible,
        rough=rough,
    )
    allowed = tolerance(found.equations.jacobian, found.unknowns) if largest is None else largest
    if not found.residual <= allowed:
        raise NotConverged("Newton's method did not reach a meeting", found.residual)
    return Root(found.unknowns, found.equations)
