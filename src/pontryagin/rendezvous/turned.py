"""The repaired equations towards a target turned about nu*: whose solutions satisfy what is printed."""

import copy
import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pontryagin.errors import NotConverged
from pontryagin.rendezvous.flight import Flight
from pontryagin.rendezvous.homotopy import Family, scales
from pontryagin.rendezvous.quaternions import product, rotated
from pontryagin.rendezvous.search import turning
from pontryagin.rendezvous.shooting import Equations, Setting, by_goal, equations
from pontryagin.rendezvous.solution import Extremal

Array = NDArray[np.float64]
STEP = 1e-30
ITERATIONS = 12
FLAT = 1e-12
"""Target and craft are in one plane when the quaternion between their planes leaves it by less than this."""


def towards_turned(solution: Extremal) -> Family:
    """The repaired equations towards the target turned by an angle about nu*, and their slope in it."""
    scaled = solution.problem.scaled
    setting = Setting(scaled, scaled.ratio, scaled.peak)
    if np.hypot(*setting.scaled.orientation[1:3]) < FLAT:
        return turning(setting)
    normal = rotated(np.array([0.0, 0.0, 1.0]), setting.scaled.orientation)
    sense = math.copysign(1.0, float(normal @ solution.flight.costates[3:]))
    return lambda unknowns, angle: _in_space(setting, unknowns, angle, sense)


def _in_space(setting: Setting, unknowns: Array, angle: float, sense: float) -> tuple[Equations, Array]:
    """In space the axis of the turn depends on the costates: so do the target's place and the slopes."""
    scaled = copy.copy(setting.scaled)
    nu = unknowns[3:6]
    scaled.orientation = product(about(nu, sense * angle), setting.scaled.orientation)
    values = equations(setting.but(scaled=scaled), unknowns)
    goal, _ = setting.scaled.target(float(values.flight.end[3]))
    here = np.concatenate([goal[:3], product(about(nu, sense * angle), goal[3:])])

    def slope(direction: Array, by_angle: float) -> Array:
        moved = about(nu + 1j * STEP * direction, sense * (angle + 1j * STEP * by_angle))
        turned = product(moved, goal[3:]).imag / STEP
        return by_goal(values.flight, here, np.concatenate([np.zeros(3), turned]))

    jacobian = values.jacobian.copy()
    jacobian[:6, 3:6] += np.column_stack([slope(axis, 0.0) for axis in np.eye(3)])
    own = replace(values.flight, scaled=setting.scaled)
    return replace(values, flight=own, jacobian=jacobian), np.append(slope(np.zeros(3), 1.0), 0.0)


def about(axis: NDArray, angle: complex) -> NDArray:
    """The turn by an angle about an axis of any length, as a quaternion; also of complex arguments."""
    unit = axis / np.sqrt(np.sum(axis**2))
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * unit])


def refined(family: Family, unknowns: Array, angle: float) -> Flight:
    """Newton's method at an angle."""
    size = math.inf
    for _ in range(ITERATIONS):
        values, _ = family(unknowns, angle)
        change = np.linalg.solve(values.jacobian, -values.residual)
        size = float(np.abs(change / scales(unknowns)).max())
        if size < 1e-13 or (size < 1e-10 and np.abs(values.residual).max() < 1e-14):
            break
        unknowns = unknowns + change
    if not size < 1e-8:
        raise NotConverged(f"Newton's method did not reach a meeting at the angle {angle:.6g}", size)
    return values.flight
