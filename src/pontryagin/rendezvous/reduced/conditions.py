"""The conditions of a meeting and their exact derivatives.

The unknowns are rho, s1, e, nu1, nu2, nu3 at t0, and t_k if it is free. The conditions are (5), the attitude
(6) in terms of nu and chi and, for a free duration, the terminal law for |n(t_k)|: it is
2 sqrt(alpha1 alpha2) for unsaturated thrust and alpha1/p_max + alpha2 p_max for saturated thrust.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import jacobian
from pontryagin.numerics.rotation import about_third, product
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.flight import (
    Flight,
    fly,
    switching,
)
from pontryagin.rendezvous.terminal_law import end_switching
from pontryagin.value import value_class

SEEN = [0, 1, 2, 7, 8, 9, 10]
"""Indices of r, v1, c, nu and chi, on which the conditions depend, among the twelve states."""
I3 = np.array([0.0, 0.0, 0.0, 1.0])
"""The third axis as a quaternion."""


@value_class
@dataclass(frozen=True, eq=False)
class Setting:
    """A problem with the constants under which it is solved, in the units of `Scaled`.

    Parameters
    ----------
    scaled : Scaled
        The problem.
    ratio : float
        alpha1/alpha2; inf for alpha2 = 0.
    peak : float
        p_max, inf for no bound.
    lead : float
        Angle by which the target's orbit is turned ahead in its plane, in radians.
    duration : float or None
        t_k if it is fixed.
    rough : bool
        Whether flights are integrated only to 1e-10, as along curves, whose points are guesses for `meet`.
    """

    scaled: Scaled
    ratio: float
    peak: float
    lead: float = 0.0
    duration: float | None = None
    rough: bool = False

    @property
    def bang(self) -> bool:
        """Whether alpha2 = 0."""
        return self.ratio == math.inf

    @property
    def free(self) -> bool:
        """Whether t_k is an unknown."""
        return self.duration is None

    @property
    def end_switching(self) -> float:
        """|n(t_k)| by the terminal law."""
        return end_switching(self.ratio, self.peak)

    def replace(self, **changes: Any) -> "Setting":
        """A copy with some attributes changed."""
        return replace(self, **changes)


@value_class
@dataclass(frozen=True, eq=False)
class ReducedEquations:
    """Residuals of the conditions and their derivatives at given unknowns.

    Attributes
    ----------
    flight : Flight
        The flight of these unknowns.
    residual : (n,) array
        Residuals; n = 6, or 7 with the terminal law.
    jacobian : (n, n) array
        Derivatives of the residual in the unknowns.
    """

    flight: Flight
    residual: Array
    jacobian: Array


@dataclass(frozen=True)
class Mismatch:
    """Residuals of (5) and (6) at the end of a flight, and their derivatives.

    Attributes
    ----------
    residual : (6,) array
        Residuals.
    by_start : (6, 7) array
        Derivatives in the six costates at t0 and in p_max.
    by_end : (6, 12) array
        Derivatives in the twelve states at the end.
    by_goal : (6, 7) array
        Derivatives in the goal.
    """

    residual: Array
    by_start: Array
    by_end: Array
    by_goal: Array


def mismatch(flight: Flight, goal: Array) -> Mismatch:
    """Residuals of (5) and (6) with a goal (7,) of r, v1, c and lambda0~ o lambda in the target's place."""
    inputs = np.concatenate([flight.end[SEEN], flight.costates[3:], goal])
    values, slopes = jacobian(lambda x: kernels.mismatch(*[*x[:10], flight.chart, *x[10:]]), inputs)
    by_end = np.zeros((6, 12))
    by_end[:, SEEN] = slopes[:, :7]
    by_start = by_end @ flight.slopes
    by_start[:, 3:6] += slopes[:, 7:10]
    return Mismatch(values, by_start, by_end, slopes[:, 10:])


def end_rates(flight: Flight) -> Array:
    """Rates of the twelve states at the end."""
    kernel = getattr(kernels, flight.mode)
    scale = flight.peak if flight.mode == "saturated" else 1.0
    end = flight.end[:11]
    return np.array([*kernel(*end, 1.0, 1.0, flight.scaled.eccentricity, 1.0, scale, flight.chart), 0.0])


def goal_of(setting: Setting, anomaly: float) -> tuple[Array, Array]:
    """The goal at an anomaly of the target, with its orbit turned ahead by the lead, and the goal's rate."""
    ahead = product(setting.scaled.orientation, about_third(setting.lead))
    return setting.scaled.target(anomaly, ahead)


def equations(setting: Setting, unknowns: Array) -> ReducedEquations:
    """Residuals of a setting and their derivatives.

    Raises
    ------
    NotConverged
        If the flight cannot be integrated to its end.
    """
    costates = unknowns[:6]
    duration = float(unknowns[6]) if setting.free else float(setting.duration or 0)
    flight = fly(
        setting.scaled,
        costates,
        duration,
        setting.peak,
        setting.bang,
        rough=setting.rough,
    )
    goal, moving = goal_of(setting, float(flight.end[3]))
    met = mismatch(flight, goal)
    columns = met.by_start[:, :6]
    if not setting.free:
        return ReducedEquations(flight, met.residual, columns)
    rates = end_rates(flight)
    by_time = met.by_end @ rates + met.by_goal @ moving
    law, law_by_state = _terminal(setting, flight)
    law_columns = law_by_state @ flight.slopes[:, :6]
    jacobian = np.block(
        [[columns, by_time[:, None]], [law_columns[None, :], np.array([[law_by_state @ rates]])]]
    )
    return ReducedEquations(flight, np.append(met.residual, law), jacobian)


def _terminal(setting: Setting, flight: Flight) -> tuple[float, Array]:
    """|n| at the end relative to that of the terminal law, minus 1; its derivatives in the twelve states."""
    used = [0, 2, 5, 6, 7]
    square, by_used = jacobian(lambda x: [kernels.switching_square(*x)], flight.end[used])
    size = math.sqrt(square[0])
    slopes = np.zeros(12)
    slopes[used] = by_used[0] / (2 * size) / setting.end_switching
    return size / setting.end_switching - 1, slopes


def end_thrust(flight: Flight) -> float:
    """|p| at the end of an unsaturated flight."""
    return float(np.linalg.norm(switching(flight.end))) / 2
