"""The family of false meetings: what conditions (5), (15), (16) and (17) accept without (6).

nu* is an integral, and (15) asks that lambda*(t_k) carry nu(t_k) into it. Where lambda(t_k) does so, every
lambda(t_k) turned about nu* does so too: the angle of that turn is free, and the conditions as printed have
a curve of solutions. It passes through the true ones, at whole turns, and between them the craft meets
nobody. In the plane the turn is one of the target's orbit in itself; angles are then about its normal, along
which nu* is with either sign, and a positive one puts the craft ahead of the target.
"""

import itertools
import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import conjugate, product
from pontryagin.rendezvous.false_meetings.printed_conditions import (
    hamiltonian,
    printed_conditions,
    printed_jacobian,
    reduced,
)
from pontryagin.rendezvous.false_meetings.rotated_target import (
    refined,
    towards_turned,
)
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.certificate import fly_full
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.homotopy import (
    Family,
    Point,
    between,
    follow,
)
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.witness.cartesian import (
    fly_cartesian,
    target_by_kepler,
)
from pontryagin.validation import finite

LARGEST = 0.6
"""Longest step along the curve."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """A solution of the printed conditions.

    Attributes
    ----------
    problem : Rendezvous
        What is asked for.
    angle : float
        By how much lambda(t_k) is turned from lambda*, in radians, whole turns counted: about nu*, in the
        plane about the normal of the target's orbit.
    flight : Flight
        The extremal in the solver's units.
    """

    problem: Rendezvous
    angle: float
    flight: Flight = field(repr=False)

    @property
    def duration(self) -> float:
        """t_k, in the user's unit of time."""
        return self.flight.duration * self.problem.scaled.time

    @cached_property
    def cost(self) -> float:
        """J, the integral of alpha1 + alpha2 p^2."""
        scaled = self.problem.scaled
        alpha1, alpha2 = scaled.weights
        spent = alpha2 * energy(self.flight) if alpha2 else 0.0
        return (alpha1 * self.flight.duration + spent) * scaled.value

    @cached_property
    def _whole(self) -> Array:
        """The 16 variables at t0 and t_k, by the integrator that the solver does not use."""
        return fly_full(self.flight, np.array([0.0, self.flight.duration]))

    @cached_property
    def printed(self) -> float:
        """Largest residual of (5), (15), (16) and (17) at t0 and t_k, with p* = c* = fM = 1."""
        first, last = (reduced(row, self.flight.scaled.eccentricity) for row in self._whole)
        at_start = hamiltonian(self.flight, first, self.flight.pieces[0].mode)
        rest = printed_conditions(self.flight, last[:-1], self.flight.costates[3:], last[-1])
        return float(np.abs([*rest, at_start]).max())

    @cached_property
    def turn(self) -> Array:
        """What turns the target at t_k into the craft, lambda(t_k) o lambda*~ in inertial axes, (4,)."""
        last = self._whole[-1]
        goal, _ = self.flight.scaled.target(float(last[3]))
        whole = product(last[4:8], conjugate(goal[3:]))
        axes = self.problem.chaser.attitude
        return product(product(axes, whole if whole[0] >= 0 else -whole), conjugate(axes))

    @property
    def mismatch(self) -> float:
        """Angle between lambda(t_k) and lambda*, of (6), in radians; lambda and -lambda are one attitude."""
        return float(2 * math.atan2(np.linalg.norm(self.turn[1:]), self.turn[0]))

    @cached_property
    def _apart(self) -> Array:
        last = fly_cartesian(self.flight, np.array([self.flight.duration]))[0, :6]
        return last - target_by_kepler(self.flight.scaled, self.flight.duration)

    @property
    def distance(self) -> float:
        """How far the craft is from the target at t_k, by Newton's law and Kepler's equation."""
        return float(np.linalg.norm(self._apart[:3])) * self.problem.scaled.length

    @property
    def drift(self) -> float:
        """How fast the craft moves against the target at t_k."""
        scaled = self.problem.scaled
        return float(np.linalg.norm(self._apart[3:])) * scaled.length / scaled.time


@dataclass(frozen=True, eq=False)
class FalseFamily:
    """Solutions of the printed conditions along the curve through a true one.

    Attributes
    ----------
    solution : Extremal
        The true meeting that the curve starts from.
    members : tuple of Meeting
        One for each angle asked for.
    """

    solution: Extremal
    members: tuple[Meeting, ...] = field(repr=False)

    def _each(self, name: str) -> Array:
        return np.array([getattr(member, name) for member in self.members])

    @property
    def angles(self) -> Array:
        """Turns about nu*, in the plane about its normal, (k,), in radians."""
        return self._each("angle")

    @property
    def durations(self) -> Array:
        """t_k, (k,)."""
        return self._each("duration")

    @property
    def costs(self) -> Array:
        """J, (k,)."""
        return self._each("cost")

    @property
    def printed(self) -> Array:
        """What the printed conditions leave, (k,); see `Meeting.printed`."""
        return self._each("printed")

    @property
    def mismatches(self) -> Array:
        """What (6) leaves, (k,), in radians; see `Meeting.mismatch`."""
        return self._each("mismatch")

    @property
    def distances(self) -> Array:
        """How far from the target each ends, (k,)."""
        return self._each("distance")

    @cached_property
    def printed_singular_values(self) -> Array:
        """Of the printed conditions' Jacobian at the true meeting, (8,), falling; the last is 0."""
        return _singular_values(printed_jacobian(self.solution.flight))

    @cached_property
    def repaired_singular_values(self) -> Array:
        """Of the repaired conditions' Jacobian at the true meeting, (7,), falling."""
        return _singular_values(self.solution.root.equations.jacobian)


def _singular_values(matrix: Array) -> Array:
    return np.asarray(np.linalg.svd(matrix, compute_uv=False), dtype=float)


def false_family(solution: Extremal, angles: ArrayLike) -> FalseFamily:
    """Follow the solutions of the printed conditions from a true meeting to turns about nu*.

    Each member satisfies the ten reduced equations and conditions (5), (15), (16), (17) of Pimkina &
    Chelnokov; (6) holds at whole turns alone, where the craft makes as many revolutions more or fewer.

    Parameters
    ----------
    solution : Extremal
        Of a problem with a free duration.
    angles : (k,) array_like
        The turns wanted, in radians, of either sign; 2 pi is a whole one. They are about nu*, and where craft
        and target move in one plane about the normal of the target's orbit: positive is ahead of it.

    Raises
    ------
    ValueError
        If the duration is fixed: (17) then says nothing.
    NotConverged
        Where the curve ends before an angle is reached.

    Examples
    --------
    >>> from pontryagin.rendezvous import solve
    >>> from pontryagin.rendezvous.problem.cases import case
    >>> family = false_family(solve(case("ellipse-mixed").problem), [0.0, 0.5])
    >>> bool(family.printed.max() < 1e-11), family.distances.round(3)
    (True, array([0.   , 0.759]))
    """
    if not isinstance(solution, Extremal):
        raise TypeError(f"solution must be of type Extremal, got {solution!r}")
    if not solution.problem.free:
        raise ValueError(
            f"solution must have a free duration, as (17) asks, got a fixed one of {solution.duration:g}"
        )
    wanted = np.atleast_1d(finite("angles", angles, "numbers"))
    if wanted.ndim > 1:
        raise ValueError(f"angles must be of shape (k,), got {wanted.shape}")
    family = towards_turned(solution)
    flights: dict[float, Flight] = {0.0: solution.flight}
    for sign in (1.0, -1.0):
        ahead = sorted({float(angle) for angle in wanted if sign * angle > 0}, key=abs)
        flights |= _walked(family, solution.root.unknowns, ahead, sign)
    return FalseFamily(solution, tuple(Meeting(solution.problem, a, flights[a]) for a in wanted.tolist()))


def false_curve(solution: Extremal, first: float, last: float) -> FalseFamily:
    """Members all along the curve of false meetings through a true one, where it turns back as well.

    Parameters
    ----------
    solution : Extremal
        Of a problem with a free duration.
    first, last : float
        Turns as in `false_family`, at which the curve is left: ``first < 0 < last``.

    Raises
    ------
    ValueError
        As `false_family`, or if the angles are not of those signs.
    NotConverged
        Where the curve ends before.
    """
    if not first < 0 < last:
        raise ValueError(f"first and last must be below and above 0, got {first} and {last}")
    ends = false_family(solution, [first, last])
    family, members = towards_turned(solution), [Meeting(solution.problem, 0.0, solution.flight)]
    for sign, end in ((-1.0, ends.members[0]), (1.0, ends.members[1])):
        there = [end]
        for point in itertools.islice(
            follow(family, solution.root.unknowns, 0.0, sign, largest=LARGEST), 1, None
        ):
            if sign * point.parameter >= sign * end.angle:
                break
            flight = refined(family, point.unknowns, point.parameter).flight
            there.insert(-1, Meeting(solution.problem, point.parameter, flight))
        members = [*reversed(there), *members] if sign < 0 else [*members, *there]
    return FalseFamily(solution, tuple(members))


def _walked(family: Family, unknowns: Array, ahead: list[float], sign: float) -> dict[float, Flight]:
    """The flights at angles of one sign, nearest first, along the curve."""
    found: dict[float, Flight] = {}
    last: Point | None = None
    left = list(ahead)
    for point in follow(family, unknowns, 0.0, sign, largest=LARGEST) if left else ():
        while left and last is not None and abs(point.parameter) >= abs(left[0]):
            angle = left.pop(0)
            found[angle] = refined(family, between(last, point, angle), angle).flight
        if not left:
            break
        last = point
    if left:
        raise NotConverged(f"the curve of meetings ends before the angle {left[0]:.6g}", abs(left[0]))
    return found
