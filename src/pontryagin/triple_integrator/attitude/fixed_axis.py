"""The turn of a rigid body about a fixed axis, planned by the programme of one channel.

The programme plans the angle x1 about the axis e. By Euler's equations w = x2 e needs the torque
M = J e (x3 + f) + x2^2 e x (J e): the channel's torque along J e, and a gyroscopic torque across the axis.
The gyroscopic torque vanishes only if e is a principal axis, and no channel commands it. With feedforward the
actuators give it too; without feedforward the body misses its target.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.rotation import between, cross, quaternion, rotation_vector
from pontryagin.triple_integrator.attitude.rigid_body import Commands, Motion, RigidBody, simulate
from pontryagin.triple_integrator.problem.disturbance import function_of
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import Programme
from pontryagin.validation import vectors
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Turn:
    """A body turned about a fixed axis by a programme. Times t (k,) are those of the programme.

    Attributes
    ----------
    body : RigidBody
    axis : (3,) array
        Unit axis e; its components in body and inertial axes are the same while the turn goes as planned.
    programme : solution of one manoeuvre
        The programme that plans the angle about the axis.
    feedforward : bool
        Whether the actuators also give the gyroscopic torque.
    motion : Motion
        The motion by Euler's equations; its commands are the planned x1, x2, x3, integrated with it.
    """

    body: RigidBody
    axis: Array
    programme: Programme
    feedforward: bool
    motion: Motion = field(compare=False)

    def attitude(self, t: ArrayLike) -> Array:
        """Quaternion, scalar first, from body to inertial axes, (k, 4)."""
        return self.motion.attitude(t)

    def planned_attitude(self, t: ArrayLike) -> Array:
        """Quaternion of the turn by x1 about the axis, (k, 4)."""
        return quaternion(self.motion.commands(t)[:, :1] * self.axis)

    def rate(self, t: ArrayLike) -> Array:
        """Angular rate in body axes, (k, 3)."""
        return self.motion.rate(t)

    def error(self, t: ArrayLike) -> Array:
        """Rotation vector of the turn from the planned to the true attitude, rad, (k, 3)."""
        return rotation_vector(between(self.planned_attitude(t), self.attitude(t)))

    def rate_error(self, t: ArrayLike) -> Array:
        """True minus planned angular rate, (k, 3)."""
        return self.rate(t) - self.motion.commands(t)[:, 1:2] * self.axis

    def angle(self, t: ArrayLike) -> Array:
        """Angle gamma of (0.1), turned about the axis, rad, (k,): the twist of the true attitude about it."""
        turn = between(self.planned_attitude(t), self.attitude(t))
        twist: Array = 2 * np.arctan2(turn[:, 1:] @ self.axis, turn[:, 0])
        return self.motion.commands(t)[:, 0] + twist

    def channel_torque(self, t: ArrayLike) -> Array:
        """J e x3, the torque that the programme commands, the m of (0.3) times J e, (k, 3)."""
        return self.motion.commands(t)[:, 2:] * (self.body.inertia @ self.axis)

    def gyroscopic_torque(self, t: ArrayLike) -> Array:
        """x2^2 e x (J e), the gyroscopic torque of the planned turn, (k, 3)."""
        return self.motion.commands(t)[:, 1:2] ** 2 * self.gyroscopic_inertia

    def torque(self, t: ArrayLike) -> Array:
        """Torque that the actuators give, (k, 3)."""
        channel = self.channel_torque(t)
        return channel + self.gyroscopic_torque(t) if self.feedforward else channel

    def torque_rate(self, t: ArrayLike) -> Array:
        """Rate of change of `torque` between impulses, (0.4), (k, 3); at an impulse du it jumps by J e du."""
        x2, x3 = self.motion.commands(t)[:, 1:].T
        control = self.programme.control(t)
        channel = np.where(np.isfinite(control), control, 0.0)[:, None] * (self.body.inertia @ self.axis)
        if not self.feedforward:
            return channel
        f = disturbance_of(self.programme.maneuver)
        acceleration = x3 + np.array([f(time) for time in np.atleast_1d(t)])
        gyroscopic: Array = (2 * x2 * acceleration)[:, None] * self.gyroscopic_inertia
        return channel + gyroscopic

    @property
    def gyroscopic_inertia(self) -> Array:
        """e x (J e), (3,): zero about a principal axis."""
        return cross(self.axis, self.body.inertia @ self.axis)

    @property
    def attitude_miss(self) -> float:
        """Angle between the attitude reached and the target, rad."""
        return float(np.linalg.norm(self.error(self.motion.edges[-1:])))

    @property
    def rate_miss(self) -> float:
        """Length of the error of the angular rate at the end."""
        return float(np.linalg.norm(self.rate_error(self.motion.edges[-1:])))


def turn(body: RigidBody, axis: ArrayLike, programme: Programme, feedforward: bool = True) -> Turn:
    """Turn a rigid body about a fixed axis by a programme, and integrate its motion.

    The body starts turned by x1(t0) about the axis, with the rate x2(t0) about it. A disturbance f of the
    manoeuvre acts as the external torque J e f. SciPy integrates Euler's equations and the kinematics of
    the quaternion; only the control and the impulses are taken from the programme.

    Parameters
    ----------
    body : RigidBody
        The body that turns.
    axis : (3,) array_like
        Direction of the axis, not zero.
    programme : solution of one manoeuvre
        From `minimum_energy`, `minimum_peak`, `minimum_impulse`, `minimum_norm` or `minimum_time`.
    feedforward : bool
        Whether the actuators give the gyroscopic torque in addition to the channel's torque.

    Returns
    -------
    Turn

    Raises
    ------
    TypeError, ValueError
        If `axis` is not a direction, or the programme is that of a stack.

    Examples
    --------
    >>> from pontryagin.triple_integrator.problem.maneuver import Maneuver
    >>> from pontryagin.triple_integrator.norms.peak import minimum_peak
    >>> body = RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
    >>> programme = minimum_peak(Maneuver([0, 0, 0], [1.5, 0, 0], tf=2.0))
    >>> turn(body, [1, 2, 2], programme).attitude_miss < 1e-10
    True
    >>> round(turn(body, [1, 2, 2], programme, feedforward=False).attitude_miss, 4)
    0.4983
    """
    t0, tf = (float(time) for time in (single(programme).t0, programme.maneuver.tf))
    flown = programme.from_start()
    maneuver = flown.maneuver
    e = _unit(axis)
    start, rate, _ = maneuver.x0
    scales = float(maneuver.duration) ** -np.arange(3.0)
    commands = Commands(
        maneuver.x0,
        _planned_motion(flown),
        scales,
        [*flown.breakpoints.tolist(), *maneuver.edge_offsets.tolist()],
        [(time, np.array([0.0, 0.0, jump])) for time, jump in impulses(flown)],
    )
    inertia = body.inertia @ e
    gyroscopic = cross(e, inertia) if feedforward else np.zeros(3)
    f = disturbance_of(maneuver)

    def torque(t: float, q: Array, w: Array, planned: Array) -> Array:
        total: Array = (planned[2] + f(t)) * inertia + planned[1] ** 2 * gyroscopic
        return total

    interval = 0.0, float(maneuver.duration)
    motion = simulate(body, interval, quaternion(start * e), rate * e, commands, torque)
    return Turn(body, e, programme, bool(feedforward), motion.on_clock(t0, tf))


def single(programme: Programme, name: str = "programme") -> Maneuver:
    """The manoeuvre of a programme, which is the caller's argument of this name.

    Raises
    ------
    ValueError
        If the programme is that of a stack of manoeuvres.
    """
    maneuver = programme.maneuver
    if maneuver.shape != ():
        raise ArgumentValueError(
            f"{name} must be the solution of one manoeuvre, got a stack of shape {maneuver.shape}", name
        )
    return maneuver


def impulses(programme: Any) -> list[tuple[float, float]]:
    """Impulses of the control as pairs (time, jump of x3); an empty list for other programmes."""
    if not hasattr(programme, "impulses"):
        return []
    pairs = zip(programme.impulse_times.tolist(), programme.impulses.tolist(), strict=True)
    return [(time, jump) for time, jump in pairs if jump != 0.0]


def _unit(axis: ArrayLike) -> Array:
    direction = vectors("axis", axis, 3)
    size = np.linalg.norm(direction)
    if direction.shape != (3,) or not size > 0:
        raise ArgumentValueError(
            f"axis must be an array (3,) that is not zero, got {direction.tolist()}", "axis"
        )
    return direction / size


def _planned_motion(programme: Programme) -> Callable[[float, Array], tuple[float, float, float]]:
    f = disturbance_of(programme.maneuver)

    def rate(t: float, x: Array) -> tuple[float, float, float]:
        return x[1], x[2] + f(t), float(programme.control(t)[0])

    return rate


def disturbance_of(maneuver: Maneuver) -> Callable[[float], float]:
    """The disturbance f as a function of one time."""
    f = function_of(maneuver.disturbance)
    return lambda t: float(f(np.array([t]))[0])
