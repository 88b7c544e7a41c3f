"""Example 3 in a frame that turns with the free body, where its target is regular.

The rigid body of example 3 is to be freed of its equatorial rates, a = 0, where the phase psi has no meaning.
In a frame that turns about the body's axis with the free precession, (w_x, w_y) = R(chi) (z_1, z_2) and
chi' = |(d - 1) w_z|: then z' = epsilon R(-chi) (u_x, u_y) is regular throughout, the target is z = 0, and the
costates of z are constants of the exact motion. psi is chi plus the direction of z.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.derivation import rigid_body as body
from pontryagin.averaging.system.control_sets import Ellipsoid
from pontryagin.averaging.system.phase_system import PhaseSystem
from pontryagin.value import value_class

SENSE = sp.Symbol("sense", real=True)
AT_REST = 1e-9
"""The body counts as at rest below this share of its first transverse rate."""


@value_class
@dataclass(frozen=True, eq=False)
class RotatingFrame:
    """The averaged solution in the rotating frame: a `ReferenceExtremal`, regular at the target."""

    averaged: AveragedSolution
    system: PhaseSystem
    numbers: tuple[Array, ...]

    @property
    def duration(self) -> Array:
        """tau_1 of the averaged solution."""
        return self.averaged.duration

    @property
    def cost(self) -> Array:
        """J_0 of the averaged solution."""
        return self.averaged.cost

    @property
    def start(self) -> Array:
        """(a_0, 0, c_0): chi starts as psi does."""
        return _inserted(self.averaged.start)

    @property
    def multipliers(self) -> Array:
        """Multipliers of z = 0: minus the costates of z."""
        return -self.costate(np.zeros(1))[..., 0, :2]

    @property
    def turn(self) -> tuple[float, ...]:
        """No cells of a turn: the body has no narrow features."""
        return ()

    def slow(self, tau: ArrayLike) -> Array:
        """(z_1, z_2, c), (..., k, 3): z keeps its direction."""
        return _inserted(self.averaged.slow(tau))

    def costate(self, tau: ArrayLike) -> Array:
        """Costates of (z_1, z_2, c), (..., k, 3)."""
        return _inserted(self.averaged.costate(tau))

    def to_slow_variables(self, states: Array, control: Array) -> Array:
        """States (z, c, p, y, tau, J, chi) (k, 10) as (a, c, p_a, p_c, y, tau, J, psi) (k, 8).

        At rest, psi is the direction from which (w_x, w_y) arrives, opposite to the control.
        """
        z, zeta, chi = states[:, :2], states[:, 3:5], states[:, -1]
        sense, a = float(self.averaged.numbers[-1]), np.hypot(*z.T)
        push = control[:, 0] + 1j * sense * control[:, 1]
        moving = a > AT_REST * float(self.start[0])
        place = np.where(moving, z[:, 0] + 1j * z[:, 1], -push * np.exp(-1j * chi))
        along = place / np.abs(place)
        p_a = zeta[:, 0] * along.real + zeta[:, 1] * along.imag
        return np.column_stack([a, states[:, 2], p_a, *states[:, 5:-1].T, chi + np.angle(along)])


def in_rotating_frame(solution: AveragedSolution) -> RotatingFrame:
    """The averaged solution of `spin_down` in the rotating frame."""
    numbers = dict(zip(map(str, solution.system.numbers), solution.numbers, strict=True))
    system = rotating_body()
    return RotatingFrame(solution, system, tuple(numbers[str(symbol)] for symbol in system.numbers))


def _inserted(values: Array) -> Array:
    """(a, c) as (a, 0, c)."""
    return np.insert(values, 1, 0.0, axis=-1)


@cache
def rotating_body() -> PhaseSystem:
    """Example 3 in z, c and chi, from Euler's equations (3.10).

    Examples
    --------
    >>> rotating_body().f[0]
    sense*u_y*sin(chi) + u_x*cos(chi)
    """
    z = sp.Matrix(sp.symbols("z_1 z_2", real=True))
    chi = sp.Symbol("chi", real=True)
    rotation, mirror = sp.rot_ccw_axis3(chi)[:2, :2], sp.diag(1, SENSE)
    omega = SENSE * body.anomaly_rate()
    place = mirror * rotation * z
    rates = body.symmetric_rates().subs({body.w[0]: place[0], body.w[1]: place[1], body.w[2]: body.c})
    relative = mirror * rates[:2, :] - rotation.diff(chi) * z * omega
    rates_of_z = (rotation.T * relative).applyfunc(_with_sense)
    return PhaseSystem(
        f=[sp.expand(rate / body.epsilon) for rate in (*rates_of_z, rates[2])],
        omega=omega,
        control_set=Ellipsoid(list(body.semiaxes)),
        slow=[*z, body.c],
        control=list(body.u),
        phase=chi,
        target=list(z),
        numbers={**dict.fromkeys(body.semiaxes, 1.0), body.d: 0.5, SENSE: 1.0},
    )


def _with_sense(expression: sp.Expr) -> sp.Expr:
    """The expression simplified with sense^2 = 1."""
    return sp.trigsimp(sp.expand(sp.expand(expression).subs(SENSE**2, 1)))
