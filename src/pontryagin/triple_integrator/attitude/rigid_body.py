"""A rigid body under torque: Euler's equations and its attitude, integrated by SciPy.

No formula of a channel is used. Attitudes are unit quaternions, scalar first, that turn body axes into
inertial axes; angular rates and torques are in body axes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from math import nextafter
from typing import cast

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import OdeSolution, solve_ivp

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.numerics.rotation import attitude_rate, cross
from pontryagin.validation import finite, vectors
from pontryagin.value import freeze, value_class

TOLERANCE = 1e-13
"""The integrator's relative tolerance, and its absolute tolerance in scaled units."""

INSET = 1e-13
"""The control is not evaluated nearer than this share of a smooth stretch to the ends of the stretch."""

CommandRate = Callable[[float, Array], ArrayLike]
"""A function from (t, commands) to the rate of change of the commands (n,)."""

Torque = Callable[[float, Array, Array, Array], Array]
"""A function from (t, attitude, rate, commands) to the torque on the body in body axes, (3,)."""


@value_class
@dataclass(frozen=True, eq=False, init=False)
class RigidBody:
    """A rigid spacecraft.

    Parameters
    ----------
    inertia : (3, 3) array_like
        Inertia tensor J about the centre of mass in body axes: symmetric, positive definite, no principal
        moment greater than the sum of the other two. Any consistent unit will do: multiplying both J and the
        torques by a number leaves the motion as it is.

    Raises
    ------
    TypeError, ValueError
        If `inertia` does not hold numbers, or is not the inertia tensor of a body.

    Examples
    --------
    >>> RigidBody([[2, 0, 0], [0, 3, 0], [0, 0, 4]]).principal_moments
    array([2., 3., 4.])
    """

    inertia: Array

    def __init__(self, inertia: ArrayLike) -> None:
        tensor = finite("inertia", inertia, "an array (3, 3)")
        if tensor.shape != (3, 3):
            raise ArgumentValueError(f"inertia must be an array (3, 3), got shape {tensor.shape}", "inertia")
        size = np.abs(tensor).max()
        if np.abs(tensor - tensor.T).max() > 1e-12 * size:
            raise ArgumentValueError(f"inertia must be symmetric, got {tensor.tolist()}", "inertia")
        tensor = (tensor + tensor.T) / 2
        moments = np.linalg.eigvalsh(tensor)
        listed = ", ".join(f"{moment:.6g}" for moment in moments)
        if not moments[0] > 1e-12 * size:
            raise ArgumentValueError(
                f"inertia must be positive definite, got principal moments {listed}", "inertia"
            )
        if moments[2] > (moments[0] + moments[1]) * (1 + 1e-12):
            raise ArgumentValueError(
                "inertia must be that of a rigid body, whose principal moments each are at most the sum of "
                f"the other two, got principal moments {listed}",
                "inertia",
            )
        freeze(tensor)
        self.__dict__["inertia"] = tensor

    @cached_property
    def inverse(self) -> Array:
        """J^-1, (3, 3)."""
        return np.asarray(np.linalg.inv(self.inertia), dtype=float)

    @cached_property
    def principal_moments(self) -> Array:
        """Eigenvalues of J in increasing order, (3,)."""
        return np.asarray(np.linalg.eigvalsh(self.inertia), dtype=float)

    def acceleration(self, rate: Array, torque: Array) -> Array:
        """w' = J^-1 (M - w x J w), for rates and torques (..., 3)."""
        return (torque - cross(rate, rate @ self.inertia)) @ self.inverse


@value_class
@dataclass(frozen=True, eq=False)
class Motion:
    """A motion of the body, evaluated at any times.

    The commands jump at impulses and are continuous from the right. Two motions are equal if their edges and
    ends are.

    Attributes
    ----------
    edges : (p+1,) array
        Ends of the smooth stretches.
    offsets : (p+1,) array
        The edges as times since the start, which a clock far from zero cannot carry.
    stretches : p solutions of SciPy's integrator
        The motion on each stretch, by the time since the start.
    start, end : (7+n,) arrays
        Attitude, rate and commands at the start, before any impulse, and at the end, after all impulses.
    """

    edges: Array
    offsets: Array
    stretches: Sequence[OdeSolution] = field(compare=False)
    start: Array
    end: Array

    def at(self, t: ArrayLike) -> Array:
        """Attitude (4), rate (3) and commands (n) at the times t, (k,) -> (k, 7+n)."""
        time = np.atleast_1d(finite("t", t, "a number or an array (k,) of times"))
        first, last = self.edges[0], self.edges[-1]
        takes = f"t must be an array (k,) of times from {first} to {last}"
        if time.ndim != 1:
            raise ArgumentValueError(f"{takes}, got shape {time.shape}", "t")
        outside = (time < first) | (time > last)
        if outside.any():
            raise ArgumentValueError(f"{takes}, got {time[outside][0]}", "t")
        elapsed = time - first
        index = np.searchsorted(self.offsets, elapsed, side="right")
        at_edge = np.searchsorted(self.edges, time, side="right")  # An edge as far as the clock can tell.
        index = np.clip(np.maximum(index, at_edge) - 1, 0, len(self.stretches) - 1)
        result = np.empty((time.size, self.start.size))
        for i in np.unique(index):
            result[index == i] = self.stretches[i](elapsed[index == i]).T
        result[time == first] = self.start
        result[time == last] = self.end
        return result

    def on_clock(self, start: float, end: float) -> "Motion":
        """The same motion on a clock that shows other times at the start and at the end."""
        edges = np.clip(start + self.offsets, start, end)
        edges[-1] = end
        return Motion(edges, self.offsets, self.stretches, self.start, self.end)

    def attitude(self, t: ArrayLike) -> Array:
        """Quaternion at the times t, (k,) -> (k, 4)."""
        return self.at(t)[:, :4]

    def rate(self, t: ArrayLike) -> Array:
        """Angular rate w in body axes, (k,) -> (k, 3)."""
        return self.at(t)[:, 4:7]

    def commands(self, t: ArrayLike) -> Array:
        """Commands to the actuators at the times t, (k,) -> (k, n)."""
        return self.at(t)[:, 7:]


@value_class
@dataclass(frozen=True, eq=False)
class Commands:
    """Commands to the actuators: n numbers z with z' = `rate`(t, z), smooth except at the events.

    Attributes
    ----------
    start : (n,) array
        z at the start.
    rate : function (t, z) -> (n,)
    scales : (n,) array
        Typical sizes of z, by which the integrator's absolute tolerance is multiplied.
    breakpoints : sequence of times
        Times at which the rate is not smooth.
    impulses : sequence of (time, jump (n,))
        Jumps of z.
    """

    start: Array
    rate: CommandRate
    scales: Array
    breakpoints: Sequence[float] = ()
    impulses: Sequence[tuple[float, Array]] = ()

    def __post_init__(self) -> None:
        for name in ("start", "scales"):
            object.__setattr__(self, name, np.array(getattr(self, name), dtype=float))
        object.__setattr__(self, "breakpoints", tuple(self.breakpoints))
        jumps = tuple((time, np.array(jump, dtype=float)) for time, jump in self.impulses)
        object.__setattr__(self, "impulses", jumps)


def simulate(
    body: RigidBody,
    interval: tuple[float, float],
    attitude: ArrayLike,
    rate: ArrayLike,
    commands: Commands,
    torque: Torque,
) -> Motion:
    """Integrate Euler's equations and q' = q w / 2 by SciPy's DOP853, restarted on each smooth stretch.

    Parameters
    ----------
    body : RigidBody
    interval : (start, end)
        Where it is far from zero, the clock carries few digits of the times of `commands` and `torque`:
        simulate from 0 and put the motion on its clock by `Motion.on_clock`.
    attitude, rate : (4,), (3,) array_like
        Quaternion and angular rate at the start.
    commands : Commands
        The commands, which are integrated together with the motion.
    torque : function (t, attitude, rate, commands) -> (3,)
        All torque on the body, in body axes.

    Returns
    -------
    Motion

    Raises
    ------
    pontryagin.NotConverged
        If the integrator stops before the end.
    """
    first, last = interval
    quaternion, spin = vectors("attitude", attitude, 4), vectors("rate", rate, 3)
    start = np.concatenate([quaternion, spin, commands.start])
    instants = [*commands.breakpoints, *(time for time, _ in commands.impulses)]
    edges = np.unique([first, last, *(time for time in instants if first < time < last)])
    offsets = edges - first
    scales = np.concatenate([np.ones(4), np.full(3, 1 / (last - first)), commands.scales])
    state, stretches = _after_impulses(start, first, commands), []
    for (a, b), event in zip(pairwise(offsets.tolist()), edges[1:].tolist(), strict=True):
        right_hand_side = _right_hand_side(body, commands.rate, torque, first, (a, b))
        run = solve_ivp(
            right_hand_side,
            (a, b),
            state,
            method="DOP853",
            rtol=TOLERANCE,
            atol=TOLERANCE * scales,
            dense_output=True,
        )
        if not run.success:
            stopped = first + run.t[-1]
            reason = (
                f"the integration of the motion stopped at t = {stopped}, before t = {event}: {run.message}"
            )
            raise NotConverged(reason, float(b - run.t[-1]))
        stretches.append(cast(OdeSolution, run.sol))
        state = _after_impulses(run.y[:, -1], event, commands)
    return Motion(edges, offsets, stretches, start, state)


def _after_impulses(state: Array, time: float, commands: Commands) -> Array:
    jumps = [jump for instant, jump in commands.impulses if instant == time]
    return state if not jumps else np.concatenate([state[:7], state[7:] + np.sum(jumps, axis=0)])


def _right_hand_side(
    body: RigidBody, command_rate: CommandRate, torque: Torque, first: float, stretch: tuple[float, float]
) -> Callable[[float, Array], Array]:
    """The equations by the time since the start, on a stretch of it, whose ends may be jumps."""
    a, b = stretch
    inset = INSET * (b - a)
    low, high = max(a + inset, nextafter(a, b)), min(b - inset, nextafter(b, a))

    def right_hand_side(t: float, y: Array) -> Array:
        inside = first + min(max(t, low), high)
        q, w, z = y[:4], y[4:7], y[7:]
        result = np.empty_like(y)
        result[:4] = attitude_rate(q, w)
        result[4:7] = body.acceleration(w, torque(inside, q, w, z))
        result[7:] = command_rate(inside, z)
        return result

    return right_hand_side
