"""The curve of false meetings: solutions of conditions (5), (15), (16) and (17) that violate (6).

Where lambda(t_k) satisfies (15), every lambda(t_k) rotated about nu* does so too: the angle of that rotation
is free, so the conditions as printed have a curve of solutions. It passes through true meetings at whole
turns; in between, craft and target do not meet. In the plane the rotation turns the target's orbit within
that plane.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, NotConverged
from pontryagin.numerics.continuation import Point, between, follow
from pontryagin.rendezvous.false_meetings.meeting import RotatedMeeting
from pontryagin.rendezvous.false_meetings.printed_conditions import printed_jacobian
from pontryagin.rendezvous.false_meetings.rotated_target import newton_at_angle, rotated_target_family
from pontryagin.rendezvous.problem.checks import number
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.conditions import ReducedEquations
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.solution import Extremal, require_extremal
from pontryagin.rendezvous.reduced.solve import solve
from pontryagin.rendezvous.root import Root, scales
from pontryagin.validation import finite
from pontryagin.value import value_class

LARGEST = 0.6
"""Longest step along the curve, with unknowns relative to their scales and the angle in radians."""


@value_class
@dataclass(frozen=True, eq=False)
class FalseFamily:
    """Solutions of the printed conditions on the curve through a true meeting.

    Attributes
    ----------
    solution : Extremal
        The true meeting that the curve starts from.
    members : tuple of RotatedMeeting
        The solutions, in the order of the angles that were given.
    """

    solution: Extremal
    members: tuple[RotatedMeeting, ...] = field(repr=False)

    def _each(self, name: str) -> Array:
        return np.array([getattr(member, name) for member in self.members])

    @property
    def angles(self) -> Array:
        """Angles of the members in radians, (k,); see `RotatedMeeting.angle`."""
        return self._each("angle")

    @property
    def durations(self) -> Array:
        """Durations t_k, (k,), in the user's unit of time."""
        return self._each("duration")

    @property
    def costs(self) -> Array:
        """Costs J, (k,)."""
        return self._each("cost")

    @property
    def printed(self) -> Array:
        """Largest residuals of the printed conditions, (k,); see `RotatedMeeting.printed`."""
        return self._each("printed")

    @property
    def mismatches(self) -> Array:
        """Angles between lambda(t_k) and lambda* of (6), (k,), in radians; see `RotatedMeeting.mismatch`."""
        return self._each("mismatch")

    @property
    def distances(self) -> Array:
        """Distances from the target at t_k, (k,), in the user's unit of length."""
        return self._each("distance")

    @cached_property
    def printed_singular_values(self) -> Array:
        """Singular values of the printed Jacobian at the true meeting, (8,), descending; the last is 0."""
        return _singular_values(printed_jacobian(self.solution.flight))

    @cached_property
    def repaired_singular_values(self) -> Array:
        """Singular values of the repaired conditions' Jacobian at the true meeting, (7,), descending."""
        return _singular_values(self.solution.root.equations.jacobian)


def _singular_values(matrix: Array) -> Array:
    return np.asarray(np.linalg.svd(matrix, compute_uv=False), dtype=float)


def false_meeting(problem: Rendezvous, angle: float, true: Extremal | None = None) -> Extremal:
    """The extremal that ends with the attitude lambda* rotated about nu* by an angle.

    `boundary`, `transversality`, `hamiltonian` and `maximality` of its certificate are as small as those of a
    true meeting; `attitude` and `cartesian` are not.

    Parameters
    ----------
    problem : Rendezvous
        The problem whose printed conditions (5), (15), (16) and (17) are to hold.
    angle : float
        Angle of the rotation in radians: about nu*, or about the normal of the target's orbit where craft and
        target move in one plane. 0 gives the true meeting.
    true : Extremal, optional
        A true meeting of the problem, from which the curve is followed; `solve` by default.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it.
    NotConverged
        If the curve ends before it reaches the angle.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
    >>> problem = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6),
    ...                      time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
    >>> certificate = false_meeting(problem, math.pi / 6).certificate
    >>> bool(certificate.boundary < 1e-11), bool(certificate.cartesian > 0.4)
    (True, True)
    """
    target = number("angle", angle)
    if true is not None:
        require_extremal("true", true)
    start = solve(problem) if true is None else true
    _, roots = _curve(start, [target])
    return Extremal(problem, roots[target])


def false_family(solution: Extremal, angles: ArrayLike) -> FalseFamily:
    """Follow the solutions of the printed conditions from a true meeting to given angles about nu*.

    Each member satisfies the ten reduced equations and conditions (5), (15), (16), (17) of Pimkina &
    Chelnokov. (6) holds only at whole turns, where the craft makes that many revolutions more or fewer.

    Parameters
    ----------
    solution : Extremal
        Solution of a problem with a free duration.
    angles : (k,) array_like
        Angles in radians, of either sign; 2 pi is a whole turn. The rotation is about nu*; where craft and
        target move in one plane it is about the normal of the target's orbit, and a positive angle is ahead
        of the target.

    Raises
    ------
    TypeError
        If `solution` is not an Extremal.
    ValueError
        If the duration is prescribed, since (17) needs a free one, or if `angles` are not as above.
    NotConverged
        If the curve ends before an angle is reached.

    Examples
    --------
    >>> from pontryagin.rendezvous import solve
    >>> from pontryagin.rendezvous.problem.cases import case
    >>> family = false_family(solve(case("ellipse-mixed").problem), [0.0, 0.5])
    >>> bool(family.printed.max() < 1e-11), family.distances.round(3)
    (True, array([0.   , 0.759]))
    """
    if not isinstance(solution, Extremal):
        raise ArgumentTypeError(f"solution must be of type Extremal, got {solution!r}", "solution")
    if not solution.problem.free:
        raise ArgumentValueError(
            f"solution must have a free duration, as (17) requires, got a fixed one of {solution.duration:g}",
            "solution",
        )
    targets = np.atleast_1d(finite("angles", angles, "numbers"))
    if targets.ndim > 1:
        raise ArgumentValueError(f"angles must be of shape (k,), got shape {targets.shape}", "angles")
    roots = {0.0: solution.root}
    for sign in (1.0, -1.0):
        nearest_first = sorted({float(angle) for angle in targets if sign * angle > 0}, key=abs)
        roots |= _curve(solution, nearest_first)[1]
    return FalseFamily(solution, tuple(_member(solution, a, roots[a]) for a in targets.tolist()))


def false_curve(solution: Extremal, first: float, last: float) -> FalseFamily:
    """The members at all points of the curve of false meetings through a true one, also where it turns back.

    Parameters
    ----------
    solution : Extremal
        Solution of a problem with a free duration.
    first, last : float
        Angles as in `false_family` at which the curve ends: ``first < 0 < last``.

    Raises
    ------
    TypeError, ValueError
        As `false_family`, or if the angles are not of those signs.
    NotConverged
        If the curve ends before it reaches an angle.
    """
    if not first < 0 < last:
        raise ArgumentValueError(
            f"first must be below 0 and last above 0, got {first} and {last}",
            "last" if first < 0 else "first",
        )
    ends = false_family(solution, [first, last]).members
    family, members = rotated_target_family(solution), [_member(solution, 0.0, solution.root)]
    for sign, end in zip((-1, 1), ends, strict=True):
        points, _ = _curve(solution, [end.angle])
        angles = [point.parameter for point in points[1:-1]]
        roots = [newton_at_angle(family, point.unknowns, point.parameter) for point in points[1:-1]]
        branch = [*(_member(solution, *pair) for pair in zip(angles, roots, strict=True)), end]
        members = [*members, *branch] if sign > 0 else [*reversed(branch), *members]
    return FalseFamily(solution, tuple(members))


def _member(solution: Extremal, angle: float, root: Root[Flight]) -> RotatedMeeting:
    return RotatedMeeting(Extremal(solution.problem, root), angle)


def _curve(
    solution: Extremal, angles: list[float]
) -> tuple[list[Point[ReducedEquations]], dict[float, Root[Flight]]]:
    """Follow the curve from a true meeting through angles of one sign, sorted by magnitude.

    Returns the points of the curve up to the first one at or beyond the last angle, and the solutions at
    the angles.
    """
    family, points, roots = (
        rotated_target_family(solution),
        list[Point[ReducedEquations]](),
        dict[float, Root[Flight]](),
    )
    left = list(angles)
    if left[:1] == [0.0]:
        return points, {0.0: newton_at_angle(family, solution.root.unknowns, 0.0)}
    start = solution.root.unknowns
    for point in follow(family, start, 0.0, left[-1], scales=scales, largest=LARGEST) if left else ():
        while left and points and abs(point.parameter) >= abs(left[0]) and point.parameter * left[0] > 0:
            angle = left.pop(0)
            roots[angle] = newton_at_angle(family, between(points[-1], point, angle), angle)
        points.append(point)
        if not left:
            return points, roots
    if left:
        raise NotConverged(
            f"the curve of false meetings ends at {points[-1].parameter:.3g} rad, before it reaches "
            f"{left[0]:.6g} rad",
            abs(left[0] - points[-1].parameter),
        )
    return points, roots
