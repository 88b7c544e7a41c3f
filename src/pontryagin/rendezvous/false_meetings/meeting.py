"""One solution of the printed conditions: their residual, the residual of (6), and the distance missed."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.rotation import conjugate, product
from pontryagin.rendezvous.false_meetings.printed_conditions import printed_residual
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.certificate import fly_full
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.witness.cartesian import separation
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class RotatedMeeting:
    """A meeting with the target rotated about nu*: a solution of the printed conditions.

    Attributes
    ----------
    extremal : Extremal
        The solution. `boundary`, `transversality`, `hamiltonian` and `maximality` of its certificate are as
        small as those of a true meeting; `attitude` and `cartesian` are not.
    angle : float
        Angle in radians by which lambda(t_k) is rotated from lambda*, including whole turns: about nu*, or
        about the normal of the target's orbit where craft and target move in one plane.
    """

    extremal: Extremal = field(repr=False)
    angle: float

    @property
    def problem(self) -> Rendezvous:
        """The problem whose printed conditions are satisfied."""
        return self.extremal.problem

    @property
    def flight(self) -> Flight:
        """The flight of the extremal, in the solver's units."""
        return self.extremal.flight

    @property
    def duration(self) -> float:
        """t_k, in the user's unit of time."""
        return self.extremal.duration

    @property
    def cost(self) -> float:
        """J, the integral of alpha1 + alpha2 p^2."""
        return self.extremal.cost

    @cached_property
    def _ends(self) -> Array:
        """The 16 variables at t0 and t_k, (2, 16), by the integrator that the solver does not use."""
        return fly_full(self.flight, np.array([0.0, self.flight.duration]))

    @cached_property
    def printed(self) -> float:
        """Largest residual of (5), (15), (16) and (17) at t0 and t_k, with p* = c* = fM = 1."""
        return printed_residual(self.flight, self._ends, self.problem.free)

    @cached_property
    def turn(self) -> Array:
        """The quaternion lambda(t_k) o lambda*~ in inertial axes, (4,): 1 at a true meeting."""
        end = self._ends[-1]
        goal, _ = self.flight.scaled.target(float(end[3]))
        relative = product(end[4:8], conjugate(goal[3:]))
        axes = self.problem.chaser.attitude
        return product(product(axes, relative if relative[0] >= 0 else -relative), conjugate(axes))

    @property
    def mismatch(self) -> float:
        """Angle between lambda(t_k) and lambda* of (6), in radians; lambda and -lambda are one attitude."""
        return float(2 * math.atan2(np.linalg.norm(self.turn[1:]), self.turn[0]))

    @cached_property
    def _separation(self) -> Array:
        return separation(self.flight)

    @property
    def distance(self) -> float:
        """Distance of craft and target at t_k in the user's unit, by Newton's law and Kepler's equation."""
        return float(np.linalg.norm(self._separation[:3])) * self.problem.scaled.length

    @property
    def drift(self) -> float:
        """Speed of the craft relative to the target at t_k, in the user's unit."""
        scaled = self.problem.scaled
        return float(np.linalg.norm(self._separation[3:])) * scaled.length / scaled.time
