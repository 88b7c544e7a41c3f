"""The base class of all solutions: a control with norm, state and costate at any times, and a certificate."""

from abc import ABC, abstractmethod
from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError
from pontryagin.numerics.jit import Batched
from pontryagin.triple_integrator import kernels
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.scales import ANSWER, scaled_moments
from pontryagin.validation import beyond_range, require_digits, times


class Programme(ABC):
    """The control that solves a problem, or a stack (...) of them, with the motion it causes.

    A subclass is a frozen dataclass that also holds the numbers that define its control.

    Attributes
    ----------
    certificate : Certificate
        Residual of the moment equalities (1.11), primal value and dual value, each (...).
    """

    certificate: Certificate

    if TYPE_CHECKING:  # At run time a property here would hide the fields that some subclasses have.

        @property
        @abstractmethod
        def maneuver(self) -> Maneuver:
            """The problem that is solved."""

        @property
        @abstractmethod
        def multipliers(self) -> Array:
            """l0 of the minimal element h0 = l0'h(s), with l0'c = 1, (..., 3); zeros where c = 0."""

    @property
    def norm(self) -> Array:
        """The least norm of u, (...)."""
        return self.certificate.primal_value

    @property
    def breakpoints(self) -> Array:
        """Times within one manoeuvre at which the control is not smooth, (j,)."""
        return np.minimum(self._interval[0] + self.breakpoint_offsets, self._interval[1])

    @property
    def breakpoint_offsets(self) -> Array:
        """The `breakpoints` as times since the start, which a clock far from 0 cannot carry, (j,)."""
        return breakpoints(self._knots)

    @property
    def _knots(self) -> Array:
        """Times since the start at which the control is not smooth, (..., j); nan where there is none."""
        return np.empty((*self.maneuver.shape, 0))

    @abstractmethod
    def control(self, t: ArrayLike) -> Array:
        """u at the times t, (k,) -> (..., k)."""

    @abstractmethod
    def state(self, t: ArrayLike) -> Array:
        """x at the times t, (k,) -> (..., k, 3)."""

    def costate(self, t: ArrayLike) -> Array:
        """psi = Phi(tf, t)' l0 at the times t, (k,) -> (..., k, 3): it solves (1.15) and attains (1.17)."""
        s = self._interval[1][..., None] - self._times(t)
        l1, l2, l3 = (self.multipliers[..., None, i] for i in range(3))
        third = kernels.dual_function(l1, l2, l3, s)
        return np.stack(np.broadcast_arrays(l1, l1 * s + l2, third), axis=-1)

    def from_start(self) -> Self:
        """The same programme of one manoeuvre on a clock that is 0 at the start and loses no digits."""
        start, _ = self._interval
        return self if start == 0.0 else replace(self, maneuver=self.maneuver.from_start())  # type: ignore[type-var]

    @property
    def _interval(self) -> tuple[Array, Array]:
        """Start and end of the motion, each (...)."""
        return self.maneuver.t0, self.maneuver.tf

    def _times(self, t: ArrayLike) -> Array:
        """The times t (k,) or (..., k) checked to lie within the interval, as (..., k)."""
        return times("t", t, *self._interval)

    def _since(self, t: ArrayLike, offsets: Array) -> Array:
        """Times elapsed at t (k,) since knots that are offsets (..., j) after the start, (..., k, j).

        At a time that is the knot's as far as the clock can tell, nothing has elapsed, and not less.
        """
        clock, start = self._times(t)[..., :, None], self._interval[0][..., None, None]
        knots = offsets[..., None, :]
        elapsed = (clock - start) - knots
        return np.where((elapsed < 0) & (clock == start + knots), 0.0, elapsed)


def breakpoints(events: Array) -> Array:
    """The events of one problem that happen, sorted; a time of nan stands for an event that does not."""
    if events.ndim != 1:
        raise ValueError(f"breakpoints are those of one manoeuvre, got a stack of shape {events.shape[:-1]}")
    return np.sort(events[np.isfinite(events)])


def normalise(multipliers: Array, moments: Array, duration: Array) -> Array:
    """Multipliers from those of T = 1, scaled so that l'c = 1, (1.16); zeros where c = 0.

    Raises
    ------
    ValueError
        If double precision cannot hold them.
    """
    shares, size = scaled_moments(moments, duration)
    moving = size != 0
    unit = np.divide(1.0, size, out=np.zeros_like(size), where=moving)
    require_digits("xf", "multipliers", moving, unit, unit / duration, unit / duration / duration)
    pairing = (multipliers * shares).sum(axis=-1, keepdims=True)
    ratio = np.divide(multipliers, pairing, out=np.zeros(shares.shape), where=moving[..., None])
    l1, l2, l3 = np.moveaxis(ratio * unit[..., None], -1, 0)
    return np.stack([l1 / duration / duration, l2 / duration, l3], axis=-1)


def truncated_power(elapsed: Array, order: int) -> Array:
    """(t - knot)_+^n / n! of the times t - knot elapsed since knots; 0 for nan."""
    if order == 0:
        return np.where(elapsed >= 0, 1.0, 0.0)
    past = np.where(elapsed > 0, elapsed, 0.0)
    return past**order / (1, 1, 2, 6, 24, 120)[order]


def response(elapsed: Array, amplitudes: Array, order: int) -> Array:
    """State reached from rest under sums of amplitude (t - knot)_+^n / n! in u, (..., k, 3).

    The times t - knot are ``elapsed`` (..., k, j), and the amplitudes (..., j). ``order`` is n + 1, the order
    of the truncated power in x3: 0 for impulses, 1 for steps, 2 for ramps.
    """
    past = truncated_power(elapsed, 1)
    part = truncated_power(elapsed, 0) * amplitudes[..., None, :]
    for n in range(1, order + 1):
        part = part * (past / n)
    parts = [part]
    for n in (order + 1, order + 2):  # The powers by themselves may overflow where the motion does not.
        parts.insert(0, parts[0] * (past / n))
    return np.stack([each.sum(axis=-1) for each in parts], axis=-1)


def numbers_of(maneuver: Maneuver) -> bytes | None:
    """The packed numbers of one manoeuvre; None for a stack.

    Raises
    ------
    TypeError
        If `maneuver` is not a Maneuver.
    """
    try:
        return maneuver._numbers
    except AttributeError:
        message = f"maneuver must be a Maneuver, got {maneuver!r} of type {type(maneuver).__name__}"
        raise ArgumentTypeError(message, "maneuver") from None


def over_stack(solver: Batched, maneuver: Maneuver, *tables: bytes) -> Array:
    """Run a solver (c1, c2, c3, T, tables) -> numbers over one manoeuvre or a stack, as (..., numbers)."""
    c = _within_range(maneuver.moments)
    if c.ndim == 1:
        result = solver.one(*c.tolist(), float(maneuver.duration), tables=tables)
    else:
        flat = c.reshape(-1, 3)
        result = solver(flat[:, 0], flat[:, 1], flat[:, 2], maneuver.duration.ravel(), tables=tables)
        result = result.reshape(*maneuver.shape, result.shape[-1])
    return _within_range(result)


def _within_range(numbers: NDArray[Any]) -> Array:
    if not (all(map(isfinite, numbers.tolist())) if numbers.ndim == 1 else np.isfinite(numbers).all()):
        raise beyond_range("xf", ANSWER, ~np.isfinite(numbers).all(axis=-1))
    return numbers
