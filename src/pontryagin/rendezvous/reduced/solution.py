"""An extremal of a rendezvous in the user's units: its cost, its state at any time, its certificate."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.certificate import (
    RendezvousCertificate,
    certify,
)
from pontryagin.rendezvous.reduced.flight import (
    Flight,
    thrust,
)
from pontryagin.rendezvous.reduced.quadrature import angle, energy
from pontryagin.rendezvous.reduced.search_log import Search
from pontryagin.rendezvous.root import Root
from pontryagin.validation import times
from pontryagin.value import value_class

SAME = 1e-7
"""Relative difference of durations and of costs below which two extremals count as one."""


@value_class
@dataclass(frozen=True, eq=False)
class Extremal:
    """A rendezvous that satisfies the maximum principle.

    Attributes
    ----------
    problem : Rendezvous
        The problem solved.
    root : Root
        The meeting, in the solver's units.
    others : tuple of Extremal
        The other extremals found, by increasing cost; empty for all but the best extremal.
    searched : Search
        Where extremals were sought, what was given up, and why; None if `solve` was given a ``start``.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> best = solve(leap)
    >>> best.state([0.0, 6.0]).shape, best.costate([0.0, 6.0]).shape, best.control([0.0, 6.0]).shape
    ((2, 8), (2, 6), (2, 3))
    >>> len(best.others), best.modes, best.searched.revolutions
    (1, ('unsaturated',), (0, 1))
    """

    problem: Rendezvous
    root: Root[Flight] = field(repr=False)
    others: tuple["Extremal", ...] = field(default=(), repr=False)
    searched: Search | None = field(default=None, repr=False)

    @property
    def flight(self) -> Flight:
        """The extremal in the solver's units."""
        return self.root.flight

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

    @property
    def arrival_anomaly(self) -> float:
        """phi*_k in radians, with the revolutions since t0 counted."""
        return float(self.flight.end[3]) + self._whole_turns

    @property
    def initial_costate(self) -> Array:
        """rho, s1, e, nu1, nu2, nu3 at t0, (6,), in the user's units of the cost over those of the state."""
        return self.flight.costates * self.problem.scaled.costate_units

    @property
    def switch_times(self) -> Array:
        """Times at which the thrust meets its bound or leaves it, (k,), in the user's unit of time."""
        return self.flight.switch_times * self.problem.scaled.time

    @property
    def modes(self) -> tuple[str, ...]:
        """The mode of each arc between the switches: "unsaturated" or "saturated"."""
        return tuple(piece.mode for piece in self.flight.pieces)

    @cached_property
    def revolutions(self) -> float:
        """Angle through which the craft turns about the centre, in revolutions."""
        return angle(self.flight) / (2 * math.pi)

    @cached_property
    def certificate(self) -> RendezvousCertificate:
        """Every condition of the maximum principle, evaluated independently; see `RendezvousCertificate`."""
        return certify(self.root, self.problem.scaled.weights, self.problem.free)

    @property
    def _whole_turns(self) -> float:
        """By how much phi* of the user exceeds that of the flight, which starts within a turn."""
        return self.problem.target.anomaly - self.problem.scaled.anomaly

    def _sampled(self, t: ArrayLike) -> Array:
        zero, end = np.array(0.0), np.array(self.duration)
        inside = times("t", t, zero, end) / self.problem.scaled.time
        rows = self.flight.sample(np.clip(inside, 0.0, self.flight.duration).ravel())
        return rows.reshape(*inside.shape, -1)

    def state(self, t: ArrayLike) -> Array:
        """r, v1, c, phi* and lambda (four numbers) at the times t (..., k), as (..., k, 8)."""
        scaled, states = self.problem.scaled, self._sampled(t)
        speed = scaled.length / scaled.time
        attitude = product(self.problem.chaser.attitude, self.flight.attitude(states))
        units = np.array([scaled.length, speed, scaled.length * speed, 1.0])
        place = states[..., :4] * units + np.array([0.0, 0.0, 0.0, self._whole_turns])
        return np.concatenate([place, attitude], axis=-1)

    def costate(self, t: ArrayLike) -> Array:
        """rho, s1, e, nu1, nu2, nu3 at the times t (..., k), as (..., k, 6)."""
        return self._sampled(t)[..., 4:10] * self.problem.scaled.costate_units

    def control(self, t: ArrayLike) -> Array:
        """p_eta at the times t (..., k), as (..., k, 3)."""
        return thrust(self._sampled(t), self.flight.peak, self.flight.bang) * self.problem.scaled.acceleration


def require_extremal(name: str, given: object) -> None:
    """Raise unless an argument is an `Extremal`.

    Raises
    ------
    TypeError
        If it is not; the message names the argument.
    """
    if not isinstance(given, Extremal):
        raise ArgumentTypeError(f"{name} must be an Extremal, as solve returns, got {given!r}", name)


def distinct(found: Iterable[Extremal]) -> list[Extremal]:
    """The extremals without repetition, cheapest first."""
    kept: list[Extremal] = []
    for candidate in sorted(found, key=lambda x: x.cost):
        if not any(_same(candidate, other) for other in kept):
            kept.append(candidate)
    return kept


def _same(a: Extremal, b: Extremal) -> bool:
    return bool(
        np.isclose(a.duration, b.duration, rtol=SAME)
        and np.isclose(a.cost, b.cost, rtol=SAME)
        and np.allclose(a.flight.costates, b.flight.costates, rtol=1e-5, atol=1e-6)
    )
