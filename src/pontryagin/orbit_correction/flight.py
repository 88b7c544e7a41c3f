"""Plans flown on the nonlinear equations of motion, and new plans for the deviation that they leave.

A plan is made for the linearised equations, so that the deviation it leaves is quadratic in |z0|. Two further
plans, each for the deviation that the one before left, reduce it to rounding.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.numerics.flow import Flow, flow
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.plan.correction import Plan, correct, single
from pontryagin.validation import positive, vectors
from pontryagin.value import value_class

CIRCLE = np.array([1.0, 0.0, 1.0])
"""The circular orbit (r, v_R, v_T), from which deviations are measured."""

ROUNDING = 1e-14
"""A deviation of at most this length is due to rounding, since radius and speed are numbers near 1."""

ROUNDS = 12
"""Largest number of plans of a closed loop."""


@cache
def motion() -> Flow:
    """The flow of (r, v_R, v_T, theta) in the field 1/r^2, compiled from the derived equations of motion."""
    import sympy as sp

    from pontryagin.orbit_correction import derivation as d

    rates = [*d.equations_of_motion(), d.v_transverse / d.r]
    return flow([d.r, d.v_radial, d.v_transverse, sp.Symbol("theta", real=True)], rates)


@value_class
@dataclass(frozen=True, eq=False)
class Flight:
    """A sequence of impulses flown on the nonlinear equations of motion.

    Attributes
    ----------
    impulses : (M, 2) array
        Radial and transverse impulses at the starts of the intervals, orbital speeds.
    interval : float
        Time between impulses, rad of the orbit.
    states : (M + 1, 3) array
        Deviations (dr, dv_R, dv_T) before each impulse, and at the end; dimensionless.
    angles : (M + 1,) array
        Angle theta on the orbit at the same instants, rad.
    """

    impulses: Array
    interval: float
    states: Array
    angles: Array

    @property
    def residual(self) -> float:
        """Length of the deviation at the end."""
        return float(np.linalg.norm(self.states[-1]))

    def path(self, samples: int) -> tuple[Array, Array, Array]:
        """Times (k,), deviations (k, 3) and angles (k,), with the given number of samples in each interval.

        The instant of an impulse appears twice, with the deviation before it and after it.
        """
        grid = np.linspace(0.0, self.interval, samples)
        times, states = [np.zeros(1)], [np.append(self.states[0] + CIRCLE, self.angles[0])[None]]
        for j, impulse in enumerate(self.impulses):
            kicked = self.states[j] + CIRCLE + np.array([0.0, *impulse])
            times.append(j * self.interval + grid)
            states.append(motion()(np.append(kicked, self.angles[j]), grid))
        flown = np.concatenate(states)
        return np.concatenate(times), flown[:, :3] - CIRCLE, flown[:, 3]


def fly(z0: ArrayLike, impulses: ArrayLike, interval: float, angle: float = 0.0) -> Flight:
    """Fly impulses on the nonlinear equations of motion, integrated by a Runge-Kutta method of order 8.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation at the start, dimensionless.
    impulses : (M, 2) array_like
        Radial and transverse impulses, orbital speeds.
    interval : float
        Time between them, rad of the orbit.
    angle : float
        Angle theta on the orbit at the start, rad.

    Returns
    -------
    Flight
        Deviations and angles at the impulses and at the end.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.

    Examples
    --------
    >>> plan = correct([-0.0037787, -0.0039109, 0.0141512])
    >>> f"{fly(plan.z0, plan.impulses, 0.25).residual:.1e}"
    '1.1e-04'
    """
    start, kicks = arguments.state(z0), vectors("impulses", impulses, 2)
    if kicks.ndim != 2:
        raise ArgumentValueError(f"impulses must be an array (M, 2), got shape {kicks.shape}", "impulses")
    step = arguments.positive_number("interval", interval)
    states, angles = [start], [arguments.angle("angle", angle)]
    for kick in kicks:
        kicked = np.append(states[-1] + CIRCLE + np.array([0.0, *kick]), angles[-1])
        reached = motion()(kicked, [0.0, step])[-1]
        states.append(reached[:3] - CIRCLE)
        angles.append(float(reached[3]))
    return Flight(kicks, step, np.array(states), np.array(angles))


def fly_plan(plan: Plan) -> Flight:
    """Fly the impulses of one plan, see `fly`.

    Raises
    ------
    ValueError
        If the plan is that of a stack.
    """
    single(plan)
    return fly(plan.z0, plan.impulses, plan.thrust.interval)


@value_class
@dataclass(frozen=True, eq=False)
class ClosedLoop:
    """A sequence of plans, each for the deviation that the flight of the one before left.

    Attributes
    ----------
    plans, flights : tuples
        The plans and their flights, in the order in which they are flown.
    """

    plans: tuple[Plan, ...]
    flights: tuple[Flight, ...]

    @property
    def residuals(self) -> Array:
        """Length of the deviation at the start and after each flight, (rounds + 1,)."""
        sizes = [float(np.linalg.norm(flight.states[0])) for flight in self.flights[:1]]
        return np.array(sizes + [flight.residual for flight in self.flights])

    @property
    def impulse_counts(self) -> NDArray[np.int64]:
        """Impulses fired in each round, (rounds,)."""
        return np.array([int(plan.impulse_count) for plan in self.plans], dtype=np.int64)


def close_loop(
    z0: ArrayLike,
    interval: float = 0.25,
    peak: float = 0.0035,
    thrust: str = "ball",
    tolerance: float = ROUNDING,
) -> ClosedLoop:
    """Plan and fly repeatedly until only rounding is left of the deviation.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation at the start, dimensionless.
    interval, peak, thrust
        As in `correct`.
    tolerance : float
        Length of the deviation at which the loop ends. The default is the size of rounding errors, since
        radius and speed are numbers near 1.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.NotConverged
        If the deviation is still longer after a dozen plans.

    Examples
    --------
    >>> loop = close_loop([-0.0037787, -0.0039109, 0.0141512])
    >>> loop.impulse_counts.tolist()
    [6, 2, 2]
    """
    state, angle = arguments.state(z0), 0.0
    bound = arguments.positive_number("tolerance", tolerance)
    plans: list[Plan] = []
    flights: list[Flight] = []
    while np.linalg.norm(state) > bound:
        if len(plans) == ROUNDS:
            reason = f"after {ROUNDS} plans the deviation is still longer than tolerance = {bound}"
            raise NotConverged(reason, float(np.linalg.norm(state)))
        plans.append(correct(state, interval, peak, thrust))
        flights.append(fly(state, plans[-1].impulses, interval, angle))
        state, angle = flights[-1].states[-1], float(flights[-1].angles[-1])
    return ClosedLoop(tuple(plans), tuple(flights))


def residuals(
    z0: ArrayLike,
    scales: ArrayLike,
    interval: float = 0.25,
    peak: float = 0.0035,
    thrust: str = "ball",
) -> tuple[Array, Array]:
    """Sizes |z0| and lengths of the deviations left by the flights, (k,) each, for multiples of one state.

    State and peak are multiplied by the same factors, so that the plans are multiples of one plan and only
    the nonlinear terms differ.
    """
    start, factors = arguments.state(z0), np.atleast_1d(positive("scales", scales))
    plan = single(correct(start, interval, peak, thrust))
    left = [fly(s * start, s * plan.impulses, interval).residual for s in factors]
    return factors * float(np.linalg.norm(start)), np.array(left)
