"""Least energy (L2): the parabola c' D^-1 h(s), (2.2) and (2.3)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.certificate import Certificate
from pontryagin.triple_integrator import kernels, trajectory
from pontryagin.triple_integrator.maneuver import Maneuver


@dataclass(frozen=True, eq=False)
class EnergySolution:
    """Control of least L2 norm, a parabola in the time to go.

    Attributes
    ----------
    maneuver : Maneuver
        What was asked.
    coefficients : (..., 3) array
        u = u0 + u1 s + u2 s^2 in the time to go s.
    certificate : Certificate
        Residual of the moments, relative to the largest; the norm; the bound |l'c| / sqrt(l'Dl).
    """

    maneuver: Maneuver
    coefficients: NDArray[np.float64]
    certificate: Certificate

    @property
    def norm(self) -> NDArray[np.float64]:
        """The least L2 norm of u, the root of the generalised energy (1.18), (...)."""
        return self.certificate.primal_value

    @property
    def breakpoints(self) -> NDArray[np.float64]:
        """None: the control is smooth, (0,)."""
        return trajectory.breakpoints(np.empty((*self.maneuver.shape, 0)))

    @cached_property
    def multipliers(self) -> NDArray[np.float64]:
        """l0 = D^-1 c / (c'D^-1 c), (..., 3); zeros where c = 0."""
        m = self.maneuver
        parts = kernels.energy_multipliers(*np.moveaxis(m.moments, -1, 0), m.duration)
        return trajectory.normalised(np.stack(parts, axis=-1), m.moments)

    def control(self, t: ArrayLike) -> NDArray[np.float64]:
        """u at the times t, (k,) -> (..., k)."""
        s = self.maneuver.tf[..., None] - self.maneuver.times(t)
        u0, u1, u2 = (self.coefficients[..., None, i] for i in range(3))
        return u0 + s * (u1 + s * u2)

    def state(self, t: ArrayLike) -> NDArray[np.float64]:
        """x at the times t, (k,) -> (..., k, 3)."""
        m = self.maneuver
        T = m.duration
        u0, u1, u2 = (self.coefficients[..., i] for i in range(3))
        at_start = [u0 + T * (u1 + T * u2), -u1 - 2 * T * u2, 2 * u2]
        time, knot = m.times(t), m.t0[..., None]
        parts = (
            trajectory.response(time, knot, amplitude[..., None], order)
            for order, amplitude in enumerate(at_start, start=1)
        )
        return m.drift(time) + sum(parts)

    def costate(self, t: ArrayLike) -> NDArray[np.float64]:
        """psi = Phi(tf, t)' l0 at the times t, (k,) -> (..., k, 3); u is psi_3 / rho0^2."""
        return trajectory.costate(self.maneuver.tf, self.maneuver.times(t), self.multipliers)


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
    T, c = maneuver.duration, maneuver.moments
    c1, c2, c3 = c[..., 0] / T**3, c[..., 1] / T**2, c[..., 2] / T
    scale = np.maximum(np.maximum(6 * np.abs(c1), 2 * np.abs(c2)), np.abs(c3))
    unit = np.where(scale == 0, 1.0, scale)
    c1, c2, c3 = c1 / unit, c2 / unit, c3 / unit
    u0, u1, u2 = kernels.energy_control(c1, c2, c3, 1.0)
    moments = [u0 / 6 + u1 / 8 + u2 / 10, u0 / 2 + u1 / 3 + u2 / 4, u0 + u1 / 2 + u2 / 3]
    residual = np.max(
        [6 * np.abs(moments[0] - c1), 2 * np.abs(moments[1] - c2), np.abs(moments[2] - c3)], axis=0
    )
    squared = u0 * u0 + u0 * u1 + (u1 * u1 + 2 * u0 * u2) / 3 + u1 * u2 / 2 + u2 * u2 / 5
    l = kernels.energy_multipliers(c1, c2, c3, 1.0)
    form = kernels.gramian_form(*l, 1.0)
    bound = np.abs(l[0] * c1 + l[1] * c2 + l[2] * c3) / np.sqrt(np.where(form > 0, form, 1.0))
    size = scale * np.sqrt(T)
    certificate = Certificate(residual, np.sqrt(squared) * size, bound * size)
    coefficients = np.stack([u0, u1 / T, u2 / T**2], axis=-1) * scale[..., None]
    return EnergySolution(maneuver, coefficients, certificate)
