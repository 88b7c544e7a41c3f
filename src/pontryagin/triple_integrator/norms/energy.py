"""Least energy (L2): the parabola c' D^-1 h(s) of (2.2) and (2.3)."""

from dataclasses import dataclass
from functools import cached_property
from math import fabs, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator import kernels
from pontryagin.triple_integrator.kernels import energy_control, energy_multipliers, gramian_form
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import (
    Programme,
    normalise,
    numbers_of,
    over_stack,
    response,
)
from pontryagin.value import Packed, value_class


def solve_energy(c1: float, c2: float, c3: float, T: float) -> tuple[float, ...]:
    """The coefficients of 1, s, s^2 in u, the scaled residual, the norm, and the lower bound."""
    k1, k2, k3 = c1 / T / T / T, c2 / T / T, c3 / T
    scale = max(6.0 * fabs(k1), 2.0 * fabs(k2), fabs(k3))
    if scale == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    k1, k2, k3 = k1 / scale, k2 / scale, k3 / scale
    u0, u1, u2 = energy_control(k1, k2, k3, 1.0)
    residual = max(
        6.0 * fabs(u0 / 6.0 + u1 / 8.0 + u2 / 10.0 - k1),
        2.0 * fabs(u0 / 2.0 + u1 / 3.0 + u2 / 4.0 - k2),
        fabs(u0 + u1 / 2.0 + u2 / 3.0 - k3),
    )
    squared = u0 * u0 + u0 * u1 + (u1 * u1 + 2.0 * u0 * u2) / 3.0 + u1 * u2 / 2.0 + u2 * u2 / 5.0
    l1, l2, l3 = energy_multipliers(k1, k2, k3, 1.0)
    bound = fabs(l1 * k1 + l2 * k2 + l3 * k3) / sqrt(gramian_form(l1, l2, l3, 1.0))
    size = scale * sqrt(T)
    return u0 * scale, u1 * scale / T, u2 * scale / T / T, residual, sqrt(squared) * size, bound * size


solve_stack = batched(solve_energy, outputs=6, groups=(4,), packed=True)


@value_class
@dataclass(frozen=True, eq=False)
class EnergySolution(Packed, Programme):
    """Control of least L2 norm, a parabola in the time to go.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    coefficients : (..., 3) array
        u = u0 + u1 s + u2 s^2 in the time to go s.
    certificate : Certificate
        Residual of the moments, relative to the largest; the norm; and the bound |l'c| / sqrt(l'Dl).
    """

    maneuver: Maneuver
    coefficients: Array
    certificate: Certificate

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        return _answer(numbers[4:])

    @cached_property
    def multipliers(self) -> Array:
        """l0 = D^-1 c / (c'D^-1 c), (..., 3); zeros where c = 0."""
        c = self.maneuver.moments
        powers = self.maneuver.duration[..., None] ** np.array([3.0, 2.0, 1.0])
        k = c / powers
        size = np.abs(k).max(axis=-1, keepdims=True)
        k1, k2, k3 = np.moveaxis(k / np.where(size == 0, 1.0, size), -1, 0)
        parts = kernels.energy_multipliers(k1, k2, k3, 1.0)
        return normalise(np.stack(parts, axis=-1) / powers, c)

    def control(self, t: ArrayLike) -> Array:
        """u at the times t, (k,) -> (..., k)."""
        s = self.maneuver.tf[..., None] - self.maneuver.times(t)
        u0, u1, u2 = (self.coefficients[..., None, i] for i in range(3))
        return u0 + s * (u1 + s * u2)

    def state(self, t: ArrayLike) -> Array:
        """x at the times t, (k,) -> (..., k, 3)."""
        m = self.maneuver
        T = m.duration
        u0, u1, u2 = (self.coefficients[..., i] for i in range(3))
        at_start = [u0 + T * (u1 + T * u2), -u1 - 2 * T * u2, 2 * u2]
        elapsed = (m.times(t) - m.t0[..., None])[..., None]
        parts = (
            response(elapsed, amplitude[..., None], order)
            for order, amplitude in enumerate(at_start, start=1)
        )
        return m.drift(t) + sum(parts)


def _answer(result: Array) -> dict[str, Any]:
    """The fields of a solution from the results of `solve_energy`, (..., 6)."""
    certificate = Certificate(result[..., 3], result[..., 4], result[..., 5])
    return {"coefficients": result[..., :3], "certificate": certificate}


def minimum_energy(maneuver: Maneuver) -> EnergySolution:
    """Control of least energy (integral of u^2) that performs the manoeuvre, problem 1, (1.18).

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre or a stack of them.

    Returns
    -------
    EnergySolution
        ``norm`` is the L2 norm of u, the root of the energy.

    Examples
    --------
    >>> s = minimum_energy(Maneuver([0, 0, 0], [1, 0, 0], tf=1.0))
    >>> s.control([0, 0.5, 1]).round(12).tolist(), s.certificate.holds(1e-12)
    ([60.0, -30.0, 60.0], True)
    """
    numbers = solve_stack.call(numbers_of(maneuver))
    if numbers is not None:
        solution = EnergySolution.from_numbers(numbers)
        solution.__dict__["maneuver"] = maneuver
        return solution
    return EnergySolution(maneuver, **_answer(over_stack(solve_stack, maneuver)))
