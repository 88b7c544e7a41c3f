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
        return self.maneuver.drift(t) + forced * np.stack([T**3, T**2, T], axis=-1)

    def _to_go(self, t: ArrayLike) -> Array:
        m = self.maneuver
        return np.clip((m.tf[..., None] - m.times(t)) / m.duration[..., None], 0.0, 1.0)


def scaled_moments(maneuver: Maneuver) -> Array:
    """(6 c1/T^3, 2 c2/T^2, c3/T), (..., 3): for a constant control each of them is its level."""
    c1, c2, c3 = np.moveaxis(maneuver.moments, -1, 0)
    T = maneuver.duration
    return np.stack([6 * c1 / T / T / T, 2 * c2 / T / T, c3 / T], axis=-1)


def certify(
    maneuver: Maneuver, shape: Quadratic, peak: Array, profile: Profile, q: float, bound: Array
) -> Certificate:
    """Certificate by a lower bound, and by moments and norm from the graded rule, which no solver uses."""
    T, targets = maneuver.duration, scaled_moments(maneuver).reshape(-1, 3)
    flat, unit, size = shape.reshape(-1), np.empty_like(targets), np.empty(len(targets))
    for start in range(0, len(targets), BLOCK):
        part = slice(start, start + BLOCK)
        s, h, weights = flat[part].sample(graded_rule())
        u = profile(h)
        unit[part] = np.stack([(weights * u * (j + 1) * s**j).sum(axis=(-2, -1)) for j in (2, 1, 0)], axis=-1)
        size[part] = (weights * np.abs(u) ** q).sum(axis=(-2, -1)) ** (1 / q)
    scale = np.abs(targets).max(axis=1)
    missed = np.abs(unit * peak.reshape(-1, 1) - targets).max(axis=1)
    residual = np.divide(missed, scale, out=np.zeros_like(missed), where=scale > 0)
    norm = np.abs(peak) * size.reshape(T.shape) * T ** (1 / q)
    return Certificate(residual.reshape(T.shape), np.asarray(norm), bound)
