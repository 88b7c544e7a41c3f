"""Equations of one body driven by three channels, phi'' = m + f exactly, and f(t) along a motion.

A channel is a component of the rotation vector phi; its control acceleration is a component of m, with the
torque M = J m. The cross-coupling f(phi, phi', m) is all that Euler's equations and the kinematics add to m.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import (
    FULL_TURN,
    between,
    quaternion,
    rotation_vector,
    vector_acceleration_drift,
    vector_rate_matrix,
)
from pontryagin.triple_integrator.attitude.fixed_axis import disturbance_of, impulses
from pontryagin.triple_integrator.attitude.rigid_body import Commands, Motion, RigidBody, simulate
from pontryagin.triple_integrator.problem.chebyshev_series import chebyshev_fit
from pontryagin.triple_integrator.problem.programme import Programme
from pontryagin.value import value_class

DEGREE = 40
"""Degree of the Chebyshev series of f on each smooth stretch of the motion."""


@value_class
@dataclass(frozen=True, eq=False)
class Coupling:
    """The cross-coupling f(t) of one channel, continuous from the right.

    Attributes
    ----------
    offsets : (p+1,) array
        Ends of the smooth stretches, as times since the start.
    series : (p, degree+1) array
        Chebyshev coefficients on each stretch.
    start : float
        The time of the start.
    """

    offsets: Array
    series: Array
    start: float = 0.0

    @property
    def edges(self) -> Array:
        """Ends of the smooth stretches, (p+1,)."""
        return self.start + self.offsets

    def from_start(self) -> "Coupling":
        """The same function on a clock that is 0 at the start."""
        return replace(self, start=0.0)

    def __call__(self, t: ArrayLike) -> Array:
        """f at the times t, (...) -> (...)."""
        elapsed = np.asarray(t, dtype=float) - self.start
        index = np.clip(np.searchsorted(self.offsets, elapsed, side="right") - 1, 0, len(self.series) - 1)
        low, high = self.offsets[index], self.offsets[index + 1]
        place = (2 * elapsed - low - high) / (high - low)
        return np.asarray(chebyshev.chebval(place, np.moveaxis(self.series[index], -1, 0), tensor=False))


@value_class
@dataclass(frozen=True, eq=False)
class Channels:
    """The body under three programmes: the channels S are programmed, the motion of the channels G is given.

    Attributes
    ----------
    body : RigidBody
        The body that turns.
    programmes : three solutions
        Solutions of the channels, in order.
    programmed : tuple of int
        The channels S. The control acceleration of the others, G, is the one that their motion requires.
    """

    body: RigidBody
    programmes: Sequence[Programme]
    programmed: tuple[int, ...]

    @property
    def given(self) -> list[int]:
        """The channels G whose motion is given."""
        return [i for i in range(3) if i not in self.programmed]

    @property
    def ends(self) -> Array:
        """States of the three channels at the start and at the end, (2, 3, 3)."""
        maneuvers = [programme.maneuver for programme in self.programmes]
        return np.array([[m.x0 for m in maneuvers], [m.xf for m in maneuvers]])

    @property
    def interval(self) -> tuple[float, float]:
        """Start t0 and end tf."""
        maneuver = self.programmes[0].maneuver
        return float(maneuver.t0), float(maneuver.tf)

    @cached_property
    def _disturbances(self) -> list[Callable[[float], float]]:
        return [disturbance_of(self.programmes[i].maneuver) for i in self.given]

    def drift(self, phi: Array, w: Array) -> Array:
        """The part n of phi'' = B^-1 m + n that does not depend on m, (..., 3)."""
        free = self.body.acceleration(w, np.zeros(3))
        return vector_acceleration_drift(phi, w) + _applied(vector_rate_matrix(phi), free)

    def coupling(self, phi: Array, w: Array, m: Array) -> Array:
        """f = phi'' - m, (..., 3)."""
        return _applied(vector_rate_matrix(phi), m) - m + self.drift(phi, w)

    def control_acceleration(self, t: Array, phi: Array, w: Array, commands: Array) -> Array:
        """m of all channels, (k, 3): in S the commands, in G the m that gives phi'' its given value."""
        if not self.given:
            return commands
        m = np.empty(phi.shape)
        m[:, self.programmed] = commands
        matrix = vector_rate_matrix(phi)[:, self.given]
        required = self._given_acceleration(t) - self.drift(phi, w)[:, self.given]
        required -= _applied(matrix[:, :, self.programmed], commands)
        m[:, self.given] = np.linalg.solve(matrix[:, :, self.given], required[..., None])[..., 0]
        return m

    def _given_acceleration(self, t: Array) -> Array:
        columns = [
            self.programmes[i].state(t)[:, 2] + np.array([f(time) for time in t])
            for i, f in zip(self.given, self._disturbances, strict=True)
        ]
        return np.stack(columns, axis=-1)

    def move(self) -> Motion:
        """The motion under the programmes by the full equations, from the start to the end."""
        return self.from_start()._move().on_clock(*self.interval)

    def from_start(self) -> "Channels":
        """The same channels on a clock that is 0 at the start."""
        return replace(self, programmes=tuple(programme.from_start() for programme in self.programmes))

    def _move(self) -> Motion:
        start, (first, last) = self.ends[0], self.interval
        phi = start[:, 0]
        commands = Commands(
            start[self.programmed, 2],
            lambda t, m: np.array([self.programmes[i].control(t)[0] for i in self.programmed]),
            np.full(len(self.programmed), (last - first) ** -2.0),
            np.concatenate(
                [edges for one in self.programmes for edges in (one.breakpoints, one.maneuver.edge_offsets)]
            ).tolist(),
            self._jumps(),
        )

        def torque(t: float, q: Array, w: Array, m: Array) -> Array:
            if self.given:
                m = self.control_acceleration(np.array([t]), rotation_vector(q)[None], w[None], m[None])[0]
            return self.body.inertia @ m

        return simulate(self.body, (first, last), quaternion(phi), body_rate(start), commands, torque)

    def _jumps(self) -> list[tuple[float, Array]]:
        unit = np.eye(len(self.programmed))
        return [
            (time, jump * unit[row])
            for row, i in enumerate(self.programmed)
            for time, jump in impulses(self.programmes[i])
        ]

    def miss(self, motion: Motion) -> float:
        """The larger of the angle to the target attitude and T times the error of the final angular rate."""
        target, (first, last) = self.ends[1], self.interval
        left = rotation_vector(between(quaternion(target[:, 0]), motion.end[:4]))
        rate_left = motion.end[4:7] - body_rate(target)
        return float(max(np.linalg.norm(left), (last - first) * np.linalg.norm(rate_left)))

    def couplings_along(self, motion: Motion, miss: float) -> list[Coupling | None]:
        """f of the programmed channels along a motion with the given miss; None for the other channels."""
        nodes, fit = chebyshev_fit(DEGREE)
        here, (first, last) = self.from_start(), self.interval
        motion = motion.on_clock(0.0, last - first)
        low, high = motion.offsets[:-1, None], motion.offsets[1:, None]
        t = ((high + low) / 2 + (high - low) / 2 * nodes).ravel()
        phi, w = rotation_vector(motion.attitude(t)), motion.rate(t)
        angle = float(np.linalg.norm(phi, axis=-1).max())
        if angle > 0.99 * FULL_TURN:
            reason = f"the motion reached the angle {angle:.4g} rad; at 2 pi rotation vectors are singular"
            raise NotConverged(reason, miss)
        m = here.control_acceleration(t, phi, w, motion.commands(t))
        f = here.coupling(phi, w, m).reshape(len(low), nodes.size, 3)
        series = np.einsum("dn,pnc->cpd", fit, f)
        parts = (Coupling(motion.offsets, part, first) for part in series)
        return [part if i in self.programmed else None for i, part in enumerate(parts)]


def _applied(matrix: Array, vector: Array) -> Array:
    """Matrices (..., i, j) times vectors (..., j)."""
    return np.asarray(np.einsum("...ij,...j->...i", matrix, vector))


def body_rate(ends: Array) -> Array:
    """Angular rate w = B phi' of channels with the states (3, 3)."""
    return np.asarray(np.linalg.solve(vector_rate_matrix(ends[:, 0]), ends[:, 1]), dtype=float)
