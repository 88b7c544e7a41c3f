"""Continuation of extremals from a problem without a bound on the thrust to the given problem.

The duration is changed to a fixed value, or until the terminal law holds. The bound is lowered from the
largest thrust to p_max. For least time alpha1/alpha2 is raised until the thrust is saturated throughout; then
alpha2 = 0. The equations are an argument; those in Sapunkov's elements are solved in this way.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, Self, TypeVar

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.numerics.continuation import Point, crossings, reach
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.root import COSTATES, Conditions, Root

END_SHARES = (2.5, 1.5, 0.7)
"""Final thrust, in units of p_max, of the unbounded problems from which least time is sought.

There are several, since the curve from a single one may turn back before the thrust is saturated, or lead to
a slower extremal.
"""
RUNAWAY = 1e4
"""Factor of growth of the costates at which the bound reached counts as the least for the duration."""
STEEPEST = 1e12
"""Largest alpha1/alpha2, in units of p_max^2, up to which the thrust must become saturated throughout."""
LONGEST = 10.0
"""Largest logarithm of the factor by which a duration is changed in search of the terminal law."""
ROOM = 1.001
"""First value of a bound that is lowered, in units of the largest thrust without a bound."""


class Flown(Protocol):
    """The attributes of a flight that this module needs."""

    @property
    def duration(self) -> float:
        """Time at the end of the flight."""

    @property
    def pieces(self) -> Sequence[Any]:
        """The arcs of the flight, each with a ``mode``."""


class Posed(Protocol):
    """The attributes of a setting (a problem and its constants) that this module needs."""

    @property
    def scaled(self) -> Scaled:
        """The problem."""

    @property
    def ratio(self) -> float:
        """alpha1/alpha2; inf for alpha2 = 0."""

    @property
    def peak(self) -> float:
        """p_max; inf without a bound."""

    @property
    def duration(self) -> float | None:
        """t_k if it is fixed, otherwise None."""

    @property
    def end_switching(self) -> float:
        """|n(t_k)| by the terminal law."""

    def replace(self, **changes: Any) -> Self:
        """A copy with some attributes changed."""


S = TypeVar("S", bound=Posed)
F = TypeVar("F", bound=Flown)


@dataclass(frozen=True)
class Shooting(Generic[S, F]):
    """A formulation of the shooting problem: its equations and how they are solved and followed.

    Attributes
    ----------
    meet : function of a setting and unknowns
        Newton's method from the given unknowns.
    equations : function of a setting and unknowns
        The conditions of the meeting.
    curve : function of a setting, a root, a name and a value
        Points of the family through the root over the logarithm of "peak", "ratio" or "duration", towards
        the value of that logarithm.
    released : function of unknowns of a fixed duration and that duration
        Unknowns of the problem with a free duration.
    law : function of a setting and a point of the curve over "duration"
        Relative residual of the terminal law.
    thrust : function of a flight
        |p| on a fine grid.
    """

    meet: Callable[[S, Array], Root[F]]
    equations: Callable[[S, Array], Conditions[F]]
    curve: Callable[[S, Root[F], str, float], Iterator[Point[Any]]]
    released: Callable[[Array, float], Array]
    law: Callable[[S, Point[Any]], float]
    thrust: Callable[[F], Array]


def fine_grid(end: float) -> Array:
    """Values of a flight's independent variable, from 0 to its end, at which the thrust is evaluated."""
    return np.linspace(0.0, end, 200 + int(40 * end))


def stretched(shooting: Shooting[S, F], setting: S, root: Root[F]) -> Root[F]:
    """The extremal of the setting's fixed duration, on the family through a root of another duration.

    Raises
    ------
    NotConverged
        If the family ends before that duration.
    """
    wanted = float(setting.duration or 0.0)
    if root.flight.duration == wanted:
        return root
    end = math.log(wanted)
    points = shooting.curve(setting, root, "duration", end)
    reason = f"the family of extremals ends before the duration {wanted * setting.scaled.time:.6g}"
    return reach(points, end, lambda unknowns: shooting.meet(setting, unknowns), reason)


def freed(shooting: Shooting[S, F], setting: S, root: Root[F]) -> Root[F]:
    """The extremal of free duration (the terminal law holds) on the family through one of fixed duration.

    Raises
    ------
    NotConverged
        If the terminal law holds for none of the durations tried.
    """
    duration = root.flight.duration
    start = shooting.released(root.unknowns, duration)
    missed = float(shooting.equations(setting, start).residual[-1])
    towards = math.log(duration) + math.copysign(LONGEST, missed)
    points = shooting.curve(setting, root, "duration", towards)
    for unknowns, logarithm in crossings(points, lambda point: shooting.law(setting, point)):
        return shooting.meet(setting, shooting.released(unknowns, math.exp(logarithm)))
    raise NotConverged("the law at the meeting holds for none of the durations that were tried", abs(missed))


def bounded(shooting: Shooting[S, F], setting: S, loose: S, root: Root[F]) -> Root[F]:
    """The extremal of a setting, under its bound and with alpha2 = 0 if so posed, from one without bound.

    Parameters
    ----------
    shooting : Shooting
        The formulation in which extremals are found and followed.
    setting : Setting
        The setting to be solved.
    loose : Setting
        The setting that the root solves: no bound, and a finite alpha1/alpha2.
    root : Root
        The extremal without bound.

    Raises
    ------
    Infeasible
        If the costates grow without limit: the bound reached is then the least for which this family has an
        extremal of its duration.
    NotConverged
        If the family turns back, or cannot be followed.
    """
    under = _lowered(shooting, loose, root, setting.peak)
    if setting.ratio < math.inf:
        return under
    return _least_time(shooting, loose.replace(peak=setting.peak), under)


def _lowered(shooting: Shooting[S, F], loose: S, root: Root[F], peak: float) -> Root[F]:
    """The extremal after the bound is lowered from the largest thrust to p_max."""
    if peak == math.inf:
        return root
    wanted, highest = loose.replace(peak=peak), ROOM * float(shooting.thrust(root.flight).max())
    if highest < peak:
        return shooting.meet(wanted, root.unknowns)
    start, end = math.log(highest), math.log(peak)
    least = start

    def reached() -> str:
        bounds = (math.exp(x) * loose.scaled.acceleration for x in (least, end))
        return "the bound on the thrust could be lowered to {:.6g}, but not to {:.6g}".format(*bounds)

    def falling() -> Iterator[Point[Any]]:
        nonlocal least
        for point in shooting.curve(loose.replace(peak=highest), root, "peak", end):
            yield point
            if _largest_costate(point.unknowns) > RUNAWAY * _largest_costate(root.unknowns):
                raise Infeasible(f"{reached()}: the costates grow without limit")
            if point.parameter > start:
                return
            least = min(least, point.parameter)

    for unknowns, _ in crossings(falling(), lambda point: point.parameter - end):
        return shooting.meet(wanted, unknowns)
    raise NotConverged(f"{reached()}: the family of extremals turns back or ends", least - end)


def _largest_costate(unknowns: Array) -> float:
    return float(np.abs(unknowns[:COSTATES]).max())


def _least_time(shooting: Shooting[S, F], setting: S, root: Root[F]) -> Root[F]:
    """The extremal of least time: alpha1/alpha2 is raised until the thrust is saturated, then alpha2 = 0.

    If the curve ends before, alpha2 = 0 is tried from its last point. Costates are in units of alpha2 before
    the last step and of alpha1 after it; the ratio of the two values of |n(t_k)| converts them.
    """
    start, end = math.log(setting.ratio), math.log(STEEPEST * setting.peak**2)
    reason = "alpha1/alpha2 could not be raised until the thrust is saturated throughout"
    unknowns, reached = root.unknowns, start
    for point in shooting.curve(setting, root, "ratio", end):
        unknowns, reached = point.unknowns, point.parameter
        if [piece.mode for piece in point.equations.flight.pieces] == ["saturated"]:
            break
        if reached > end:
            reason = (
                "alpha1/alpha2 was raised to its largest value, but the thrust still vanishes at some time"
            )
            break
        if reached < start:
            reason = "the family of extremals turns back as alpha1/alpha2 is raised"
            break
    bang = setting.replace(ratio=math.inf)
    change = bang.end_switching / setting.replace(ratio=math.exp(reached)).end_switching
    try:
        return shooting.meet(bang, np.append(change * unknowns[:COSTATES], unknowns[COSTATES:]))
    except NotConverged as failure:
        raise NotConverged(reason, failure.residual) from failure


def loose_ratios(ratio: float, peak: float) -> list[float]:
    """Values of alpha1/alpha2 of the unbounded problems that are solved first; several for least time."""
    return [(share * peak) ** 2 for share in END_SHARES] if ratio == math.inf else [ratio]
