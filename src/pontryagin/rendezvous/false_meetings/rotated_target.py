"""The repaired equations for a target rotated about nu*: their solutions satisfy the printed conditions.

(15) compares lambda o nu o lambda~ with lambda* o nu o lambda*~. Rotating lambda about nu* changes neither.
So a craft whose attitude at t_k is lambda* rotated about nu* by any angle satisfies (15); if it satisfies
(5), (16) and (17) too, it satisfies all conditions that the paper imposes on the ten equations.

Angles are about nu*, by the right-hand rule. In the plane they are about the normal of the target's orbit,
and positive where the craft ends ahead of the target: nu* is parallel or antiparallel to that normal, and its
sense may change along the curve of solutions.
"""

from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.continuation import Family
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import (
    I3,
    ReducedEquations,
    Setting,
    end_rates,
    equations,
    goal_of,
    mismatch,
)
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.shooting import WITHIN
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.root import Root, root

CHI = 10
"""Index of chi among the twelve states."""
FLAT = 1e-12
"""Two orbits are coplanar if the quaternion between them has a smaller out-of-plane part than this."""


def rotated_target_family(solution: Extremal) -> Family[ReducedEquations]:
    """The repaired equations of a true meeting as a family in the angle by which the target is rotated."""
    scaled = solution.problem.scaled
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    if in_one_plane(scaled):
        return lambda unknowns, angle: leading_equations(setting, unknowns, angle)
    return lambda unknowns, angle: rotated_equations(setting, unknowns, angle)


def in_one_plane(scaled: Scaled) -> bool:
    """Whether craft and target move in one plane, in the same direction."""
    return bool(np.hypot(*scaled.orientation[1:3]) < FLAT)


def leading_equations(setting: Setting, unknowns: Array, angle: float) -> tuple[ReducedEquations, Array]:
    """`conditions.equations` for a target that is ahead by an angle, and their derivative by the angle."""
    led = setting.replace(lead=angle)
    found = equations(led, unknowns)
    goal, _ = goal_of(led, float(found.flight.end[3]))
    by_angle = np.zeros(len(found.residual))
    by_angle[:6] = mismatch(found.flight, goal).by_goal[:, 3:] @ product(goal[3:], I3) / 2
    return found, by_angle


def rotated_equations(setting: Setting, unknowns: Array, angle: float) -> tuple[ReducedEquations, Array]:
    """`conditions.equations` for lambda* rotated about nu* by an angle, and their derivative by the angle."""
    unrotated = equations(setting, unknowns)
    flight = unrotated.flight
    shift = np.zeros(len(flight.end))
    shift[CHI] = flight.chart
    goal, goal_rate = goal_of(setting, float(flight.end[3]))
    shifted = replace(flight, end=flight.end - angle * shift)
    met = mismatch(shifted, goal)
    jacobian, residual = unrotated.jacobian.copy(), unrotated.residual.copy()
    jacobian[:6, :6], residual[:6] = met.by_start[:, :6], met.residual
    if setting.free:
        jacobian[:6, 6] = met.by_end @ end_rates(flight) + met.by_goal @ goal_rate
    by_angle = np.zeros(len(residual))
    by_angle[:6] = -met.by_end @ shift
    return replace(unrotated, jacobian=jacobian, residual=residual), by_angle


def newton_at_angle(family: Family[ReducedEquations], unknowns: Array, angle: float) -> Root[Flight]:
    """The solution at an angle, by Newton's method.

    Raises
    ------
    NotConverged
        If Newton's method does not converge.
    """
    return root(lambda x: family(x, angle)[0], unknowns, within=WITHIN)
