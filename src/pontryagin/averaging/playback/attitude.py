"""The symmetric rigid body of example 3 in space: its attitude under a control, by Euler's equations.

Rates and controls are in the principal axes of the body; attitudes are unit quaternions, scalar first, that
turn body axes into inertial ones, of which the third is along the angular momentum at the start. Moments of
inertia are relative to I_x: (1, 1, d).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import cast

import numpy as np
from scipy.integrate import OdeSolution, solve_ivp
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from pontryagin.arrays import Array
from pontryagin.averaging.derivation import rigid_body as body
from pontryagin.averaging.examples.braking import (
    fly,
    synthesis,
)
from pontryagin.averaging.playback.pair import Pair
from pontryagin.errors import NotConverged
from pontryagin.numerics import compile as compiler

PER_TURN, FEWEST = 70, 400
"""Number of samples per turn of the body, and least number of samples in all."""
GAUSS = np.array([-1.0, 1.0]) / (2 * 3**0.5) + 0.5
"""Nodes of Gauss's rule with two points on the interval from 0 to 1."""


@dataclass(frozen=True)
class BodyMotion:
    """The body at times t (k,).

    Attributes
    ----------
    t : (k,) array
    rate : (k, 3) array
        omega.
    control : (k, 3) array
        Torques over the moments of inertia, per epsilon.
    attitude : (k, 4) array
    moments : (3,) array
        (1, 1, d).
    semiaxes : (3,) array
        Semiaxes of the control's ellipsoid.
    """

    t: Array
    rate: Array
    control: Array
    attitude: Array
    moments: Array
    semiaxes: Array

    def in_space(self, vectors: Array) -> Array:
        """Vectors (k, 3) or (3,) of the body in inertial axes, (k, 3)."""
        return np.asarray(_rotation(self.attitude).apply(vectors))

    @property
    def angular_momentum(self) -> Array:
        """The angular momentum in inertial axes, (k, 3)."""
        return self.in_space(self.moments * self.rate)

    @property
    def form(self) -> Array:
        """u_x^2/l_x^2 + u_y^2/l_y^2 + u_z^2/l_z^2, (k,): 1 on the ellipsoid."""
        return np.asarray(((self.control / self.semiaxes) ** 2).sum(axis=-1))


def synthesised_motion(pair: Pair) -> BodyMotion:
    """The motion under the averaged optimum as a synthesis, in which the control is a function of omega.

    Raises
    ------
    pontryagin.NotConverged
        If the body does not come to rest.
    """
    *semiaxes, d, _ = (float(number) for number in pair.averaged.numbers)
    axes = np.array(semiaxes)
    path, last = fly(_first_rate(pair), axes, d, pair.epsilon)
    t = _times(last, _first_rate(pair))
    return _motion(t, path, synthesis(path(t).T, axes), axes, d)


def exact_motion(pair: Pair) -> BodyMotion:
    """The motion under the control of the exact extremal, as a function of time."""
    *semiaxes, d, _ = (float(number) for number in pair.averaged.numbers)
    t = _times(pair.exact.duration / pair.epsilon, _first_rate(pair))
    control = pair.exact.control(np.minimum(pair.epsilon * t, pair.exact.duration))
    push = CubicSpline(t, control)
    path = _integrated(
        lambda time, w: _free()(*w, *push(time), d, pair.epsilon)[0][..., 0], _first_rate(pair), t[-1]
    )
    return _motion(t, path, control, np.array(semiaxes), d)


def _times(last: float, rate: Array) -> Array:
    turns = float(np.linalg.norm(rate)) * last / (2 * np.pi)
    return np.linspace(0.0, last, max(FEWEST, int(np.ceil(PER_TURN * turns))) + 1)


def _first_rate(pair: Pair) -> Array:
    """omega at the start, from a, c and psi, which is counted in the sense in which it turns."""
    (a, c), psi, sense = pair.averaged.start, pair.averaged.initial_phase, pair.averaged.numbers[-1]
    return np.array([a * np.cos(psi), sense * a * np.sin(psi), c])


def _integrated(rate: Callable[[float, Array], Array], start: Array, last: float) -> OdeSolution:
    """omega as a function of time, (k,) to (3, k)."""
    run = solve_ivp(rate, (0.0, last), start, method="DOP853", rtol=1e-10, atol=1e-12, dense_output=True)
    if not run.success:
        raise NotConverged(
            f"the integration of the angular velocity stopped at t = {run.t[-1]:.6g}: {run.message}",
            last - run.t[-1],
        )
    return cast(OdeSolution, run.sol)


def _motion(t: Array, dense: OdeSolution, control: Array, semiaxes: Array, d: float) -> BodyMotion:
    moments, shown = np.array([1.0, 1.0, d]), dense(t).T
    momentum = moments * shown[0]
    first = _upright(momentum)
    return BodyMotion(t, shown, control, _attitudes(t, dense, first), moments, semiaxes)


def _attitudes(t: Array, dense: OdeSolution, first: Rotation) -> Array:
    """Attitudes (k, 4) at times (k,) by Magnus' method of fourth order, with two rates per step."""
    step = np.diff(t)
    w = dense((t[:-1, None] + step[:, None] * GAUSS).ravel()).T.reshape(-1, 2, 3)
    mean = step[:, None] * w.sum(axis=1) / 2
    commutator = 3**0.5 / 12 * step[:, None] ** 2 * np.cross(w[:, 0], w[:, 1])
    attitudes = [first]
    for turn in Rotation.from_rotvec(mean + commutator):
        attitudes.append(attitudes[-1] * turn)
    return Rotation.concatenate(attitudes).as_quat(canonical=False, scalar_first=True)


def _upright(vector: Array) -> Rotation:
    """The smallest rotation that takes a vector to the third axis."""
    unit = vector / np.linalg.norm(vector)
    axis = np.cross(unit, [0.0, 0.0, 1.0])
    size = float(np.linalg.norm(axis))
    angle = float(np.arctan2(size, unit[2]))
    return Rotation.from_rotvec(axis / size * angle if size > 0 else np.array([angle, 0.0, 0.0]))


def _rotation(attitude: Array) -> Rotation:
    return Rotation.from_quat(attitude, scalar_first=True)


@lru_cache(maxsize=1)
def _free() -> Callable[..., tuple[Array, ...]]:
    """omega' as a function of omega and any control."""
    arguments = [*body.w, *body.u, body.d, body.epsilon]
    return compiler.function("euler", arguments, {"rates": body.symmetric_rates()})
