"""The oracle of the meetings: Newton's law under the thrust that a solution gives, and the primer vector.

Nothing of a solution is used but its thrust, the attitude in which it is given, and its duration. The flight
must end at the target, whose place follows from Kepler's equation. By the maximum principle the thrust of
least energy is half the costate of the velocity, and that of least time has its direction; this costate y
solves y'' = G(R) y with the gradient G of gravity, so that some y(0) and y'(0) must reproduce the thrust.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import make_interp_spline
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from pontryagin.arrays import Array

SAMPLES = (6_000, 24_000, 96_000)
"""Times at which the thrust of a flight is asked for; a spline of the seventh degree joins them. Where the
primer vector all but vanishes the thrust turns at once, and more of them are needed."""
ENOUGH = 1e-6
"""No more are tried where the disagreement is within this."""
COMPARED = 80
"""Times at which the primer vector is compared with the thrust."""


def turned(attitude: Array) -> Rotation:
    """The rotations of unit quaternions with the scalar part first."""
    return Rotation.from_quat(np.roll(np.asarray(attitude), -1, axis=-1))


def on_orbit(orbit: Any, anomaly: float) -> Array:
    """Place and velocity on a Kepler orbit at a true anomaly, (6,), for gravity 1."""
    p, e = orbit.parameter, orbit.eccentricity
    cos, sin = math.cos(anomaly), math.sin(anomaly)
    place = p / (1 + e * cos) * np.array([cos, sin, 0.0])
    velocity = np.array([-sin, e + cos, 0.0]) / math.sqrt(p)
    axes = turned(orbit.attitude)
    return np.concatenate([axes.apply(place), axes.apply(velocity)])


def later(orbit: Any, time: float) -> Array:
    """Place and velocity of the target after a time, (6,), by Kepler's equation."""
    e = orbit.eccentricity
    motion = ((1 - e * e) / orbit.parameter) ** 1.5
    half = math.tan(orbit.anomaly / 2) * math.sqrt((1 - e) / (1 + e))
    first = 2 * math.atan(half)
    mean = first - e * math.sin(first) + motion * time
    eccentric = brentq(lambda E: E - e * math.sin(E) - mean, mean - 1, mean + 1, xtol=1e-15, rtol=1e-15)
    true = 2 * math.atan2(
        math.sqrt(1 + e) * math.sin(eccentric / 2), math.sqrt(1 - e) * math.cos(eccentric / 2)
    )
    return on_orbit(orbit, true)


def departure(chaser: Any) -> Array:
    """Place and velocity of the craft at the start, (6,)."""
    axes = turned(chaser.attitude)
    velocity = np.array([chaser.v1, chaser.c / chaser.r, 0.0])
    return np.concatenate([axes.apply([chaser.r, 0.0, 0.0]), axes.apply(velocity)])


def thrust_of(solution: Any, samples: int) -> Any:
    """The thrust in inertial axes as a function of time."""
    times = np.linspace(0.0, solution.duration, samples)
    axes = turned(solution.state(times)[:, 4:8])
    return make_interp_spline(times, axes.apply(solution.control(times)), k=7)


def disagreement(solution: Any) -> float:
    """The smallest that `disagreement_at` finds; what a finer spline does not mend is the solution's."""
    found = float("inf")
    for samples in SAMPLES:
        found = min(found, disagreement_at(solution, samples))
        if found <= ENOUGH:
            break
    return found


def disagreement_at(solution: Any, samples: int) -> float:
    """How far a meeting of least energy without a bound, or of least time, is from an extremal.

    The largest of: the distance from the target at the end; the part of the thrust that no primer vector
    explains, relative to the largest thrust; the difference of the cost, relative to it.
    """
    problem, T = solution.problem, float(solution.duration)
    thrust = thrust_of(solution, samples)
    grid = np.linspace(0.0, T, COMPARED)

    def rate(t: float, x: Array) -> Array:
        place, u = x[:3], thrust(t)
        r = math.sqrt(place @ place)
        gradient = 3 * np.outer(place, place) / r**5 - np.eye(3) / r**3
        primer = x[7:].reshape(6, 6)
        return np.concatenate(
            [x[3:6], u - place / r**3, [u @ u], primer[3:].ravel(), (gradient @ primer[:3]).ravel()]
        )

    start = np.concatenate([departure(problem.chaser), [0.0], np.eye(6).ravel()])
    flown = solve_ivp(rate, (0.0, T), start, "DOP853", grid, rtol=1e-11, atol=1e-12).y.T
    missed = float(np.abs(flown[-1, :6] - later(problem.target, T)).max())
    cost = problem.time_weight * T + problem.energy_weight * float(flown[-1, 6])
    vectors = flown[:, 7:].reshape(COMPARED, 6, 6)[:, :3]
    given = np.array([thrust(t) for t in grid])
    free = problem.duration is None
    left = _unexplained_direction(vectors, given) if free else _unexplained(vectors, given)
    return max(missed, left, abs(cost - solution.cost) / abs(solution.cost))


def _unexplained(vectors: Array, given: Array) -> float:
    rows, right = vectors.reshape(-1, 6), given.ravel()
    found = np.linalg.lstsq(rows, right, rcond=None)[0]
    return float(np.abs(rows @ found - right).max() / np.abs(right).max())


def _unexplained_direction(vectors: Array, given: Array) -> float:
    directions = given / np.linalg.norm(given, axis=1, keepdims=True)
    across = np.eye(3) - directions[:, :, None] * directions[:, None, :]
    rows = (across @ vectors).reshape(-1, 6)
    scale = np.linalg.norm(rows, axis=0)
    least = np.linalg.svd(rows / scale)[2][-1] / scale
    primer = vectors @ least
    along = (primer * directions).sum(axis=1)
    if along.sum() < 0:
        primer, along = -primer, -along
    if along.min() <= 0:
        return float("inf")
    return float(np.abs((across @ primer[..., None])[..., 0]).max() / np.abs(primer).max())
