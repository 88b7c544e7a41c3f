"""An extremal in Sapunkov's elements, in the user's units: cost, elements, control, certificate."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.numerics.rotation import conjugate, product, rotated
from pontryagin.rendezvous.elements.certificate import (
    ElementsCertificate,
    certify,
)
from pontryagin.rendezvous.elements.elements import Elements
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
    switching,
)
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.root import Root
from pontryagin.validation import times
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class ElementsExtremal:
    """A rendezvous in the elements that satisfies the maximum principle.

    Attributes
    ----------
    problem : Rendezvous
        The problem solved.
    root : Root
        The meeting, in the solver's units.
    value : float
        The solver's unit of the cost, in the user's units.
    smoothed : tuple of Root
        Extremals with the thrust's jump smoothed, by decreasing width, from which `least_fuel` continued to
        this one; empty for other solvers.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve_in_elements
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> found = solve_in_elements(leap)
    >>> found.elements([0.0, 6.0]).A.shape, found.control([0.0, 6.0]).shape, found.switch_times.shape
    ((2, 4), (2, 3), (0,))
    """

    problem: Rendezvous
    root: Root[ElementFlight] = field(repr=False)
    value: float = field(repr=False)
    smoothed: tuple[Root[ElementFlight], ...] = field(default=(), repr=False)

    @property
    def flight(self) -> ElementFlight:
        """The extremal in the solver's units and in the axes eta of t0."""
        return self.root.flight

    @property
    def duration(self) -> float:
        """t_k, in the user's unit of time."""
        fixed = self.problem.duration
        return self.flight.duration * self.problem.scaled.time if fixed is None else fixed

    @property
    def cost(self) -> float:
        """The integral of alpha1 + alpha2 p^2, or of alpha1 + alpha2 |p|."""
        return self.flight.cost * self.value

    @property
    def switch_times(self) -> Array:
        """Times at which the thrust meets or leaves its bound, or is switched on or off, (k,)."""
        return self.flight.switch_times * self.problem.scaled.time

    @property
    def modes(self) -> tuple[str, ...]:
        """The mode of each arc between the switches: "unsaturated", "saturated" or "coast"."""
        return tuple(piece.mode for piece in self.flight.pieces)

    @cached_property
    def certificate(self) -> ElementsCertificate:
        """Every condition of the maximum principle, evaluated independently; see `ElementsCertificate`."""
        return certify(self.root, self.problem.free)

    def _sampled(self, t: ArrayLike) -> tuple[Array, Array]:
        """phi (..., k) and the states (..., k, n) at the times t."""
        inside = times("t", t, np.array(0.0), np.array(self.duration)) / self.problem.scaled.time
        grid, back = np.unique(np.clip(inside, 0.0, self.flight.duration), return_inverse=True)
        phi = self.flight.angle_at(grid)
        return phi[back], self.flight.sample(phi)[back]

    def elements(self, t: ArrayLike) -> Elements:
        """A, B and phi at the times t (..., k), in inertial axes and the user's units."""
        scaled = self.problem.scaled
        phi, states = self._sampled(t)
        back = conjugate(self.problem.chaser.attitude)
        A, B = (math.sqrt(scaled.length) * product(states[..., i : i + 4], back) for i in (0, 4))
        return Elements(A, B, phi, self.problem.gravity)

    def _inertial(self, vectors: Array) -> Array:
        return rotated(vectors, np.broadcast_to(self.problem.chaser.attitude, (*vectors.shape[:-1], 4)))

    def control(self, t: ArrayLike) -> Array:
        """p in inertial axes at the times t (..., k), as (..., k, 3)."""
        phi, _ = self._sampled(t)
        order, back = np.unique(phi, return_inverse=True)
        thrust = self.flight.thrust(self.flight.sample(order), order)[back]
        return self._inertial(thrust) * self.problem.scaled.acceleration

    def switching(self, t: ArrayLike) -> Array:
        """n in inertial axes at the times t (..., k), as (..., k, 3), in units of the cost over velocity."""
        phi, states = self._sampled(t)
        scaled = self.problem.scaled
        return self._inertial(switching(states, phi)) * (self.value * scaled.time / scaled.length)
