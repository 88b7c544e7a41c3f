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
from pontryagin.triple_integrator.kernels import energy_control, energy_multipliers, gramian_form
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import (
    Programme,
    normalise,
    numbers_of,
    over_stack,
    response,
)
from pontryagin.triple_integrator.problem.scales import in_range, level_unit, scaled_moments
from pontryagin.validation import require_digits
from pontryagin.value import Packed, value_class


def solve_energy(c1: float, c2: float, c3: float, T: float) -> tuple[float, ...]:
    """The coefficients of 1, s/T, (s/T)^2 in u, the scaled residual, the norm, and the lower bound."""
    if c1 == 0.0 and c2 == 0.0 and c3 == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    k1, k2, k3 = c1 / T / T, c2 / T, c3
    scale = max(6.0 * fabs(k1), 2.0 * fabs(k2), fabs(k3))
    level = level_unit(scale, T)
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
    size = in_range(level * sqrt(T))
    return u0 * level, u1 * level, u2 * level, residual, sqrt(squared) * size, bound * size


solve_stack = batched(solve_energy, outputs=6, groups=(4,), packed=True)


@value_class
@dataclass(frozen=True, eq=False)
class EnergySolution(Packed, Programme):
    """Control of least L2 norm, a parabola in the time to go.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    parabola : (..., 3) array
        u = p0 + p1 x + p2 x^2 in the time to go as a share of T, x = s/T.
    certificate : Certificate
        Residual of the moments, relative to the largest; the norm; and the bound |l'c| / sqrt(l'Dl).
    """

    maneuver: Maneuver
    parabola: Array
    certificate: Certificate

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        return _answer(numbers[4:])

    @cached_property
    def multipliers(self) -> Array:
        """l0 = D^-1 c / (c'D^-1 c), (..., 3); zeros where c = 0."""
        c, T = self.maneuver.moments, self.maneuver.duration
        k1, k2, k3 = np.moveaxis(scaled_moments(c, T)[0], -1, 0)
        return normalise(np.stack(energy_multipliers(k1, k2, k3, 1.0), axis=-1), c, T)

    @cached_property
    def coefficients(self) -> Array:
        """u0, u1, u2 of u = u0 + u1 s + u2 s^2 in the time to go s, (..., 3)."""
        T, size = self.maneuver.duration, np.abs(self.parabola).max(axis=-1)
        require_digits("xf", "coefficients of the control", size != 0, size, size / T, size / T / T)
        p0, p1, p2 = np.moveaxis(self.parabola, -1, 0)
        return np.stack([p0, p1 / T, p2 / T / T], axis=-1)

    def control(self, t: ArrayLike) -> Array:
        """u at the times t, (k,) -> (..., k)."""
        m = self.maneuver
        x = (m.tf[..., None] - m.times(t)) / m.duration[..., None]
        p0, p1, p2 = (self.parabola[..., None, i] for i in range(3))
        return p0 + x * (p1 + x * p2)

    def state(self, t: ArrayLike) -> Array:
        """x at the times t, (k,) -> (..., k, 3)."""
        m = self.maneuver
        T = m.duration[..., None]
        p0, p1, p2 = (self.parabola[..., None, i] * T for i in range(3))
        at_start = [p0 + p1 + p2, -p1 - 2 * p2, 2 * p2]
        elapsed = ((m.times(t) - m.t0[..., None]) / T)[..., None]
        parts = [response(elapsed, amplitude, order) for order, amplitude in enumerate(at_start, start=1)]
        x1, x2, x3 = np.moveaxis(np.add.reduce(parts), -1, 0)
        return np.asarray(m.drift(t) + np.stack([x1 * T * T, x2 * T, x3], axis=-1))


def _answer(result: Array) -> dict[str, Any]:
    """The fields of a solution from the results of `solve_energy`, (..., 6)."""
    certificate = Certificate(result[..., 3], result[..., 4], result[..., 5])
    return {"parabola": result[..., :3], "certificate": certificate}


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
