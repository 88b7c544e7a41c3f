"""Controls u = function of a quadratic in the time to go, with certificates by quadrature."""

from abc import abstractmethod
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.triple_integrator.norms.quadrature import Quadratic, graded_rule, moments_beyond
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import Programme
from pontryagin.triple_integrator.problem.scales import scaled_moments

BLOCK = 256
"""How many problems are evaluated at once for a certificate."""

Profile = Callable[[Array], Array]
"""A function from the values of the quadratic to the control as a share of its peak."""


class QuadraticProgramme(Programme):
    """A control u = peak * profile(h(s/T)) of a quadratic h in the time to go s as a share of T.

    Attributes
    ----------
    peak : (...) array
        The factor of the profile, whose largest modulus is 1.
    """

    peak: Array

    @property
    @abstractmethod
    def _law(self) -> tuple[Quadratic, Profile]:
        """The quadratic, and the profile."""

    def control(self, t: ArrayLike) -> Array:
        """u at the times t, (k,) -> (..., k)."""
        quadratic, profile = self._law
        return self.peak[..., None] * profile(quadratic(self._to_go(t)))

    def state(self, t: ArrayLike) -> Array:
        """x at the times t, (k,) -> (..., k, 3), by quadrature that is exact to rounding."""
        T = self.maneuver.duration[..., None]
        quadratic, profile = self._law

        def control(problem: NDArray[np.intp], h: Array) -> Array:
            return self.peak.reshape(-1)[problem, None] * profile(h)

        forced = moments_beyond(quadratic, self._to_go(t), control)
        x1, x2, x3 = np.moveaxis(forced * T[..., None], -1, 0)
        return np.asarray(self.maneuver.drift(t) + np.stack([x1 * T * T, x2 * T, x3], axis=-1))

    def _to_go(self, t: ArrayLike) -> Array:
        m = self.maneuver
        return np.clip((m.tf[..., None] - m.times(t)) / m.duration[..., None], 0.0, 1.0)


def certify(
    maneuver: Maneuver, shape: Quadratic, peak: Array, profile: Profile, q: float, bound: Array
) -> Certificate:
    """Certificate by a lower bound, and by moments and norm from the graded rule, which no solver uses."""
    T = maneuver.duration
    moments, impulse = scaled_moments(maneuver.moments, T)
    targets, level = (moments * [6.0, 2.0, 1.0]).reshape(-1, 3), (impulse / T).reshape(-1, 1)
    flat, unit, size = shape.reshape(-1), np.empty_like(targets), np.empty(len(targets))
    for start in range(0, len(targets), BLOCK):
        part = slice(start, start + BLOCK)
        s, h, weights = flat[part].sample(graded_rule())
        u = profile(h)
        unit[part] = np.stack([(weights * u * (j + 1) * s**j).sum(axis=(-2, -1)) for j in (2, 1, 0)], axis=-1)
        size[part] = (weights * np.abs(u) ** q).sum(axis=(-2, -1)) ** (1 / q)
    scale = np.abs(targets).max(axis=1)
    shares = np.divide(peak.reshape(-1, 1), level, out=np.zeros_like(level), where=level > 0)
    missed = np.abs(unit * shares - targets).max(axis=1)
    residual = np.divide(missed, scale, out=np.zeros_like(missed), where=scale > 0)
    norm = np.abs(peak) * size.reshape(T.shape) * T ** (1 / q)
    return Certificate(residual.reshape(T.shape), np.asarray(norm), bound)
