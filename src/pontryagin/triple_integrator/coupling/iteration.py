"""Programmes for three coupled channels of one body, by an iteration over the cross-coupling f(t).

With phi'' = m + f as in `channels`, the motion of one iterate gives f(t). The moment problem of each
channel is solved with it as disturbance, the full equations are integrated with the controls found, and
this is repeated until attitude and rate reach the target.

Since f(phi, k phi', k^2 m) = k^2 f(phi, phi', m), the iteration in t/T does not depend on the duration T.
Along every motion x(tf) = Phi x(t0) + g(f) + c, so that an iteration subtracts the miss of the last motion
from the moments c. For a spherical body and a turn from rest to rest an iteration multiplies the miss by
`spherical_factor`, which is half the angle for small angles and does not depend on the norm; unequal
moments of inertia change that factor.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, NotConverged
from pontryagin.numerics.rotation import FULL_TURN, rotation_vector, vector_rate_matrix
from pontryagin.triple_integrator.attitude.rigid_body import Motion, RigidBody
from pontryagin.triple_integrator.coupling.channels import Channels, Coupling
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import Programme
from pontryagin.validation import finite
from pontryagin.value import value_class

NOISE = 1e-11
"""A miss below this is an error of the integrator and is no measure of the iteration's convergence."""

GROWN = 100.0
"""A miss (rad) at which the iteration is given up."""

Solver = Callable[[Maneuver], Programme]
"""A solver of the moment problem of one channel, such as `minimum_energy`."""


@value_class
@dataclass(frozen=True, eq=False)
class CoupledManeuver:
    """A manoeuvre of all three channels that reaches its target through the full equations.

    Attributes
    ----------
    body : RigidBody
        The body that turns.
    programmes : three solutions
        Solutions of the channels, in order; the disturbance of those programmed here is the cross-coupling.
    programmed : tuple of int
        Which channels were programmed; the motion of the others was given.
    misses : (n,) array
        By how much the motion of each iterate misses the target: the larger of the angle between the
        attitudes (rad) and T times the error of the angular rate. The first iterate is the motion under the
        uncoupled programmes.
    motion : Motion
        Motion of the last iterate, by Euler's equations; its commands are m of the programmed channels.
    """

    body: RigidBody
    programmes: tuple[Programme, ...]
    programmed: tuple[int, ...]
    misses: Array
    motion: Motion

    @property
    def factor(self) -> float:
        """Factor of the miss per iteration: the geometric mean of the last three factors above rounding.

        It is 0 if the miss of the first iterate is rounding already.
        """
        last = self.misses[self.misses > NOISE][-4:]
        return float((last[-1] / last[0]) ** (1 / (last.size - 1))) if last.size > 1 else 0.0

    def attitude(self, t: ArrayLike) -> Array:
        """Quaternion, scalar first, from body to inertial axes, (k,) -> (k, 4)."""
        return self.motion.attitude(t)

    def rate(self, t: ArrayLike) -> Array:
        """Angular rate in body axes, (k,) -> (k, 3)."""
        return self.motion.rate(t)

    def state(self, t: ArrayLike) -> Array:
        """Angle, its rate and control acceleration (phi, phi', m) of each channel, (k,) -> (3, k, 3)."""
        phi, rate = rotation_vector(self.attitude(t)), self.rate(t)
        phi_rate = np.einsum("kij,kj->ki", vector_rate_matrix(phi), rate)
        return np.moveaxis(np.stack([phi, phi_rate, self._control_acceleration(t)], axis=-1), 1, 0)

    def control(self, t: ArrayLike) -> Array:
        """u of the programmed channels, (k,) -> (channels, k)."""
        return np.stack([self.programmes[i].control(t) for i in self.programmed])

    def coupling(self, t: ArrayLike) -> Array:
        """f = phi'' - m of each channel along the motion, (k,) -> (3, k)."""
        return self._channels.coupling(
            rotation_vector(self.attitude(t)), self.rate(t), self._control_acceleration(t)
        ).T

    def torque(self, t: ArrayLike) -> Array:
        """Torque J m, (k,) -> (k, 3)."""
        return self._control_acceleration(t) @ self.body.inertia

    @cached_property
    def _channels(self) -> Channels:
        return Channels(self.body, self.programmes, self.programmed)

    def _control_acceleration(self, t: ArrayLike) -> Array:
        phi = rotation_vector(self.attitude(t))
        return self._channels.control_acceleration(
            np.atleast_1d(t), phi, self.rate(t), self.motion.commands(t)
        )


def couple(
    body: RigidBody,
    channels: Sequence[Maneuver | Programme],
    solve: Solver,
    tol: float = 1e-9,
    iterations: int = 60,
) -> CoupledManeuver:
    """Programme channels of one body so that the full equations take its attitude and rate to the target.

    Parameters
    ----------
    body : RigidBody
        The body that turns.
    channels : three of Maneuver or solution
        A Maneuver (x1, x2, x3 = phi_i, phi_i', m_i at both ends, no disturbance) is programmed. A solution is
        the given motion of its channel, whatever torque that requires.
    solve : function Maneuver -> solution
        `minimum_energy`, `minimum_peak`, `minimum_impulse` or another solver.
    tol : float
        Largest miss accepted, rad.
    iterations : int
        Largest number of motions integrated.

    Returns
    -------
    CoupledManeuver

    Raises
    ------
    TypeError, ValueError
        If the channels are not three or not of one interval, if none is a Maneuver, if one has a disturbance
        of its own or is a stack, or if an end is a full turn or more.
    pontryagin.NotConverged
        If the miss does not come below `tol`, or the motion leaves |phi| < 2 pi; its residual is the miss.

    Examples
    --------
    >>> from pontryagin.triple_integrator.norms.energy import minimum_energy
    >>> body = RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
    >>> ends = [0.3, -0.2, 0.4]
    >>> channels = [Maneuver([0, 0, 0], [angle, 0, 0], tf=2.0) for angle in ends]
    >>> turn = couple(body, channels, minimum_energy)
    >>> rotation_vector(turn.attitude(2.0))[0].round(8).tolist()
    [0.3, -0.2, 0.4]
    >>> [round(float(factor), 2) for factor in (turn.factor, spherical_factor(np.linalg.norm(ends)))]
    [0.25, 0.27]
    """
    maneuvers, programmed = _maneuvers_of(channels)
    couplings: list[Coupling | None] = [None] * 3
    misses: list[float] = []
    while len(misses) < iterations:
        programmes = tuple(
            solve(_with(maneuvers[i], couplings[i])) if i in programmed else cast(Programme, channels[i])
            for i in range(3)
        )
        system = Channels(body, programmes, programmed)
        motion = system.move()
        misses.append(system.miss(motion))
        if misses[-1] <= tol:
            return CoupledManeuver(body, programmes, programmed, np.array(misses), motion)
        if not misses[-1] <= GROWN:
            reason = f"the iteration diverges: motion {len(misses)} misses its end by more than {GROWN:g} rad"
            raise NotConverged(reason, misses[-1])
        couplings = system.couplings_along(motion, misses[-1])
    reason = (
        f"the cross-coupling did not settle in {iterations} iterations: the miss is above tol = {tol:g} rad"
    )
    raise NotConverged(reason, misses[-1])


def spherical_factor(angle: ArrayLike) -> Array:
    """Factor by which an iteration multiplies the miss of a spherical body's turn from rest to rest.

    |1 - x cot x + i x| with x = angle/2: the modulus of the eigenvalues of 1 - B^-1 (dimensionless). It is 1
    at an angle of 1.895 rad (108.6 degrees). For larger angles, with nearly equal moments of inertia, the
    iteration diverges.

    A change of the moments c has two parts. One changes the axis of the turn, and is corrected in one
    iteration. The other leaves a rate w at the end, for which the iteration uses phi' = B^-1 w.

    Parameters
    ----------
    angle : (...) array_like
        Angle of the turn, rad, more than 0 and less than 2 pi.

    Examples
    --------
    >>> spherical_factor([0.2, 1.8955]).round(3).tolist()
    [0.1, 1.0]
    """
    x = finite("angle", angle, "a number or an array (...)") / 2
    outside = ~((x > 0) & (x < np.pi))
    if outside.any():
        wrong = 2 * x[outside].flat[0]
        raise ArgumentValueError(f"angle must be more than 0 and less than 2 pi, got {wrong}", "angle")
    return np.asarray(np.hypot(1 - x / np.tan(x), x))


def _with(maneuver: Maneuver, coupling: Coupling | None) -> Maneuver:
    return Maneuver(maneuver.x0, maneuver.xf, maneuver.tf, maneuver.t0, coupling)


def _maneuvers_of(channels: Sequence[Maneuver | Programme]) -> tuple[list[Maneuver], tuple[int, ...]]:
    """The manoeuvres of the channels, checked, and which of them are to be programmed."""
    if len(channels) != 3:
        raise _refusal(f"be three manoeuvres or solutions, got {len(channels)}")
    for i, channel in enumerate(channels):
        if not isinstance(channel, Maneuver) and not hasattr(channel, "maneuver"):
            got = f"{type(channel).__name__} at index {i}"
            raise ArgumentTypeError(f"channels must be manoeuvres or solutions, got {got}", "channels")
    programmed = tuple(i for i, channel in enumerate(channels) if isinstance(channel, Maneuver))
    maneuvers = [channel if isinstance(channel, Maneuver) else channel.maneuver for channel in channels]
    if not programmed:
        raise _refusal("hold at least one Maneuver to be programmed, got three solutions")
    if any(maneuver.shape for maneuver in maneuvers):
        raise _refusal(f"be single manoeuvres, got shapes {[m.shape for m in maneuvers]}")
    disturbed = [i for i in programmed if maneuvers[i].disturbance is not None]
    if disturbed:
        given = f"{maneuvers[disturbed[0]].disturbance!r} at index {disturbed[0]}"
        raise _refusal(f"have no disturbance, since the cross-coupling takes its place, got {given}")
    intervals = {(float(m.t0), float(m.tf)) for m in maneuvers}
    if len(intervals) > 1:
        raise _refusal(f"have one interval (t0, tf) in common, got {sorted(intervals)}")
    for end in ("x0", "xf"):
        angle = np.linalg.norm([getattr(m, end)[0] for m in maneuvers])
        if not angle < FULL_TURN:
            raise _refusal(f"give an attitude turned by less than 2 pi, got {angle:.6g} at {end}")
    return maneuvers, programmed


def _refusal(takes: str) -> ArgumentValueError:
    return ArgumentValueError(f"channels must {takes}", "channels")
