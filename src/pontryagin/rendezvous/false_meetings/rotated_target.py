"""The repaired equations towards a target turned about nu*: whose solutions satisfy what is printed.

Angles are about nu*, by the rule of the right hand. In the plane they are about the normal of the target's
orbit, positive where the craft ends ahead: nu* is parallel to it, of either sign, and along the curve that
sign may change.
"""

import math
from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.homotopy import (
    Family,
    Root,
    scales,
    step_of,
)
from pontryagin.rendezvous.reduced.search import turning
from pontryagin.rendezvous.reduced.shooting import (
    Equations,
    Setting,
    by_goal,
    end_rates,
    equations,
    goal_of,
    mismatch,
)
from pontryagin.rendezvous.reduced.solution import Extremal

CHI = 10
"""Place of chi among the twelve states."""
ITERATIONS = 12
FLAT = 1e-12
"""Target and craft are in one plane when the quaternion between their planes leaves it by less than this."""


def towards_turned(solution: Extremal) -> Family:
    """The repaired equations towards the target turned by an angle from a true meeting, and their slope."""
    scaled = solution.problem.scaled
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    if in_one_plane(scaled):
        return turning(setting)
    return lambda unknowns, angle: turned_equations(setting, unknowns, angle)


def in_one_plane(scaled: Scaled) -> bool:
    """Whether craft and target move in one plane, the same way round."""
    return bool(np.hypot(*scaled.orientation[1:3]) < FLAT)


def turned_equations(setting: Setting, unknowns: Array, angle: float) -> tuple[Equations, Array]:
    """`shooting.equations` towards lambda* turned about nu* by an angle, and their slope in the angle."""
    whole = equations(setting, unknowns)
    flight = whole.flight
    shift = np.zeros(len(flight.end))
    shift[CHI] = flight.chart
    goal, moving = goal_of(setting, float(flight.end[3]))
    turned = replace(flight, end=flight.end - angle * shift)
    values, by_state, by_start = mismatch(turned, goal)
    columns = by_state @ flight.slopes
    columns[:, 3:6] += by_start
    jacobian, residual = whole.jacobian.copy(), whole.residual.copy()
    jacobian[:6, :6], residual[:6] = columns[:, :6], values
    if setting.free:
        jacobian[:6, 6] = by_state @ end_rates(flight) + by_goal(turned, goal, moving)
    by_angle = np.zeros(len(residual))
    by_angle[:6] = -by_state @ shift
    return replace(whole, jacobian=jacobian, residual=residual), by_angle


def refined(family: Family, unknowns: Array, angle: float) -> Root:
    """Newton's method at an angle.

    Raises
    ------
    NotConverged
        If it does not converge.
    """
    size = math.inf
    for _ in range(ITERATIONS):
        values, _ = family(unknowns, angle)
        change = step_of(values)
        size = float(np.abs(change / scales(unknowns)).max())
        if size < 1e-13 or (size < 1e-10 and np.abs(values.residual).max() < 1e-14):
            break
        unknowns = unknowns + change
    else:
        values, _ = family(unknowns, angle)
    if not size < 1e-8:
        raise NotConverged(f"Newton's method did not reach a meeting at the angle {angle:.6g}", size)
    return Root(unknowns, values, size)
