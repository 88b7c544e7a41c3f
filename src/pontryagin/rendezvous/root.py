"""Newton's method for the conditions of a rendezvous, and the residual accepted for a meeting.

The first six unknowns are costates in every formulation; a seventh is the end of the flight.
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
"""The type of the flight of an extremal."""

MEETING = 1e-10
"""Largest residual accepted for a meeting where the equations are well conditioned."""
WORST_MEETING = 1e-6
"""Largest residual accepted for a meeting, however badly the equations are conditioned."""
COSTATES = 6
"""Number of the unknowns that are costates."""


class Conditions(Protocol[F]):
    """The conditions of a rendezvous evaluated at given unknowns."""

    @property
    def flight(self) -> F:
        """The flight of these unknowns."""

    @property
    def residual(self) -> Array:
        """Residual of the conditions, zero at a meeting, (n,)."""

    @property
    def jacobian(self) -> Array:
        """Derivatives of the residual in the unknowns, (n, n)."""


@value_class
@dataclass(frozen=True, eq=False)
class Root(Generic[F]):
    """A meeting: the unknowns and the conditions evaluated at them."""

    unknowns: Array
    equations: Conditions[F]

    @property
    def flight(self) -> F:
        """The flight of the extremal."""
        return self.equations.flight

    @property
    def residual(self) -> float:
        """Largest residual of the conditions."""
        return float(np.abs(self.equations.residual).max())


def scales(unknowns: Array) -> Array:
    """Units of the unknowns: the largest costate for all costates, its own size for the end of the flight."""
    largest = float(np.abs(unknowns[:COSTATES]).max()) or 1.0
    return np.append(np.full(COSTATES, largest), np.abs(unknowns[COSTATES:]))


def tolerance(jacobian: Array, unknowns: Array) -> float:
    """Largest residual accepted for a meeting: `MEETING`, or more if the equations are badly conditioned.

    It is then the effect of rounding as estimated from the condition number, but at most `WORST_MEETING`.
    """
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
        Initial guess.
    within : float
        A step changes the end of the flight by less than this factor.
    rough : function of unknowns, optional
        The conditions by a cheaper flight, for the first steps.
    iterations, halvings : int
        As for `pontryagin.numerics.newton.newton`.
    correction : float
        The iteration ends when the next relative correction is expected to be below this.
    largest : float, optional
        The largest residual that is accepted; by default given by `tolerance`.

    Raises
    ------
    NotConverged
        If the residual stays above the accepted one.
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
        raise NotConverged("Newton's method did not converge to a meeting", found.residual)
    return Root(found.unknowns, found.equations)
