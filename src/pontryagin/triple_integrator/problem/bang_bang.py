"""Controls of constant modulus with at most two switches, given by their level and the switches."""

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import (
    Programme,
    normalise,
    response,
    truncated_power,
)


class BangBang(Programme):
    """A control that is v outside [b, a] and -v inside, where a >= b are times to go as shares of T.

    Attributes
    ----------
    levels : (...) array
        The signed level v.
    shares : (..., 2) array
        Both switches a >= b; a = 1 or b = 0 where one does not happen, a = b if neither does.
    """

    levels: Array
    shares: Array

    @property
    def norm(self) -> Array:
        """The peak of |u|, (...)."""
        return np.abs(self.levels)

    @cached_property
    def switch_times(self) -> Array:
        """Times at which u changes sign, in order, (..., 2); nan where a switch does not happen."""
        start, end = self._interval
        return np.minimum(start[..., None] + self.switch_offsets, end[..., None])

    @cached_property
    def switch_offsets(self) -> Array:
        """The `switch_times` as times since the start, which a clock far from 0 cannot carry, (..., 2)."""
        start, end = self._interval
        return switch_offsets(end - start, self.shares)

    @cached_property
    def first_sign(self) -> Array:
        """Sign of u at the start, (...); 0 where u is 0."""
        return first_sign(self.levels, self.shares)

    @property
    def _knots(self) -> Array:
        return self.switch_offsets

    @cached_property
    def multipliers(self) -> Array:
        """l0 of the minimal element h0 = l0'h(s), with l0'c = 1, (..., 3); zeros where c = 0."""
        return normalise(switching_quadratic(self.shares), self._moments, self._motion.duration)

    @cached_property
    def switch_condition(self) -> Array:
        """Condition of the switches, (..., 2): displacement (share of T) per relative change of c.

        It is large where the control is constant except for a narrow flip, whose place the data then do not
        determine. It is infinite where a switch does not happen.
        """
        return switch_condition(self.shares)

    def control(self, t: ArrayLike) -> Array:
        """u at the times t, (k,) -> (..., k)."""
        return bang_bang(self._since(t, self.switch_offsets), self.first_sign * self.norm)

    def state(self, t: ArrayLike) -> Array:
        """x at the times t, (k,) -> (..., k, 3)."""
        from_start = np.zeros((*self.switch_offsets.shape[:-1], 1))
        knots = np.concatenate([from_start, self.switch_offsets], axis=-1)
        forced = bang_bang_response(self._since(t, knots), self.first_sign * self.norm)
        return self._motion.drift(t) + forced

    @property
    def _motion(self) -> Maneuver:
        """The manoeuvre whose motion without control is added to the motion that the control causes."""
        return self.maneuver

    @property
    def _moments(self) -> Array:
        return self.maneuver.moments


def bang_bang(since_switches: Array, first: Array) -> Array:
    """u = first at the start, with a change of sign at each switch; at a switch u has the later value.

    The times since both switches are (..., k, 2).
    """
    count = truncated_power(since_switches, 0).sum(axis=-1)
    return first[..., None] * np.where(count % 2 == 0, 1.0, -1.0)


def bang_bang_response(since: Array, first: Array) -> Array:
    """State reached from rest under `bang_bang`, by the times since its start and switches, (..., k, 3)."""
    return response(since, first[..., None] * np.array([1.0, -2.0, 2.0]), order=1)


def _happen(shares: Array) -> NDArray[np.bool_]:
    """Whether the switch at a happens, and whether the one at b does, (..., 2)."""
    a, b = shares[..., 0], shares[..., 1]
    return np.stack([(a < 1) & (a > b), (b > 0) & (a > b)], axis=-1)


def switch_offsets(duration: Array, shares: Array) -> Array:
    """Times from the start to the switches that happen, in order, then nan for the others, (..., 2)."""
    whole = duration[..., None]
    offsets = np.where(_happen(shares), whole - whole * shares, np.nan)
    return np.where(np.isnan(offsets[..., :1]), offsets[..., ::-1], offsets)


def first_sign(levels: Array, shares: Array) -> Array:
    """Sign of the control at the start: that of the level unless the inner piece reaches the start."""
    a, b = shares[..., 0], shares[..., 1]
    return np.where((a == 1) & (a > b), -1.0, 1.0) * np.sign(levels)


def switching_quadratic(shares: Array) -> Array:
    """Multipliers for T = 1 of (s - a)(s - b), whose sign the control has, (..., 3)."""
    a, b = shares[..., 0], shares[..., 1]
    return np.stack([np.full(a.shape, 2.0), -(a + b), a * b], axis=-1)


def switch_condition(shares: Array) -> Array:
    """Displacement of each switch of `switch_times` per relative change of the scaled moments, (..., 2).

    It follows from the derivatives of the moments: by v those of the control that is 1 outside [b, a] and -1
    inside, by a -2 v (3a^2, 2a, 1), by b 2 v (3b^2, 2b, 1).
    """
    a, b = shares[..., 0], shares[..., 1]
    happens = _happen(shares)
    level = np.stack([1 - 2 * (a**i - b**i) for i in (3, 2, 1)], axis=-1)
    at_a, at_b = (np.stack([3 * x**2, 2 * x, np.ones_like(x)], axis=-1) for x in (a, b))
    jacobian = np.stack([level, -2 * at_a, 2 * at_b], axis=-1)
    narrow = np.abs(np.linalg.det(jacobian)) < 1e-290
    inverse = np.linalg.inv(np.where(narrow[..., None, None], np.eye(3), jacobian))
    reaction = np.abs(inverse[..., 1:, :]).sum(axis=-1)
    result = np.where(happens & ~narrow[..., None], reaction, np.inf)
    alone = happens[..., 1:] & ~happens[..., :1]
    return np.where(alone, result[..., ::-1], result)
