"""The gauge of a sum of very many ellipsoids: the method of `ellipsoids`, with NumPy over all steps at once.

A sweep over 100000 steps takes milliseconds, while Numba takes a second of every process to load.
"""

from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.orbit_correction.gauges.ellipsoids import CONTINUATION, GAP, STEPS


@dataclass(frozen=True)
class LongSum:
    """A sum of the ellipsoids G_k B, with the sum of G_k G_k' equal to the identity.

    Attributes
    ----------
    columns : (n, m, steps) array
        The factors G_k.
    """

    columns: Array

    @property
    def _flat(self) -> Array:
        """All columns of all factors side by side, (n, m * steps)."""
        return self.columns.reshape(len(self.columns), -1)

    def reach(self, controls: Array) -> Array:
        """The sum of G_k w_k over the controls w (m, steps), (n,)."""
        return np.asarray(self._flat @ controls.ravel())

    def along(self, psi: Array) -> Array:
        """G_k'psi, (m, steps)."""
        return np.asarray(psi @ self._flat).reshape(self.columns.shape[1:])

    def support_derivatives(self, parts: Array, lengths: Array) -> tuple[Array, Array]:
        """Gradient and Hessian of the support function at the psi with G_k'psi = parts and their lengths."""
        inverse = _inverse(lengths)
        points = np.einsum("ijk,jk->ik", self.columns, parts * inverse)
        grams = (self.columns * inverse).reshape(len(points), -1) @ self._flat.T
        return points.sum(axis=1), grams - (points * inverse) @ points.T


def gauge_rows(factors: Array, targets: Array, costates: Array, results: Array) -> None:
    """`ellipsoids.gauge_stack`, for sums of many ellipsoids."""
    whole = LongSum(np.ascontiguousarray(np.moveaxis(factors, 0, 2)))
    for b, costate, result in zip(targets, costates, results, strict=True):
        costate[:], result[:] = b, 0.0
        if b.any():
            costate[:], result[:] = _gauge_of(whole, b)


def _gauge_of(whole: LongSum, b: Array) -> tuple[Array, tuple[float, float, float]]:
    """The costate; the lower bound that it proves, the peak of controls that reach b, and what they miss."""
    start = b * (b @ b / _lengths(whole.along(b)).sum() ** 2)
    psi = _newton(whole, b, start, 0.0)
    found = _bounds(whole, b, psi)
    lower, upper, _ = found
    if upper - lower > GAP * upper:
        psi = _continuation(whole, b, start)
        found = _bounds(whole, b, psi)
    return psi, found


def _continuation(whole: LongSum, b: Array, psi: Array) -> Array:
    """Newton's method on support functions that are smoothed less from round to round."""
    smoothing = float(_lengths(whole.along(psi)).mean())
    for _ in range(CONTINUATION):
        smoothing *= 0.1
        psi = _newton(whole, b, psi, smoothing)
    return _newton(whole, b, psi, 0.0)


def _newton(whole: LongSum, b: Array, psi: Array, smoothing: float) -> Array:
    """The psi that minimises S(psi)^2/2 - (b, psi), from a first guess."""
    polish = 3
    parts = whole.along(psi)
    lengths = _lengths(parts, smoothing)
    for _ in range(STEPS):
        total = lengths.sum()
        value = 0.5 * total * total - b @ psi
        gradient, hessian = whole.support_derivatives(parts, lengths)
        descent = b - total * gradient
        try:
            root = np.linalg.cholesky(total * hessian + np.outer(gradient, gradient))
        except np.linalg.LinAlgError:
            break
        step = np.linalg.solve(root.T, np.linalg.solve(root, descent))
        slope = descent @ step
        close = slope <= 1e-9 * abs(value)
        length = 1.0
        for _ in range(40):
            trial = psi + length * step
            parts = whole.along(trial)
            lengths = _lengths(parts, smoothing)
            total = lengths.sum()
            if close or 0.5 * total * total - b @ trial <= value - 0.25 * length * slope:
                break
            length *= 0.5
        if length < 1e-6:
            break
        psi = trial
        polish -= int(close)
        if polish == 0:
            break
    return psi


def _bounds(whole: LongSum, b: Array, psi: Array) -> tuple[float, float, float]:
    """The lower bound that psi proves, the peak of its corrected controls, and what they miss of b."""
    parts = whole.along(psi)
    lengths = _lengths(parts)
    lower = b @ psi / lengths.sum()
    controls = parts * (lower * _inverse(lengths))
    controls += whole.along(b - whole.reach(controls))
    miss = np.abs(b - whole.reach(controls)).max() / np.abs(b).max()
    return float(lower), float(_lengths(controls).max()), float(miss)


def _lengths(parts: Array, smoothing: float = 0.0) -> Array:
    """The lengths of the vectors (m, steps), smoothed to sqrt(|g|^2 + smoothing^2)."""
    return np.asarray(np.sqrt(np.einsum("jk,jk->k", parts, parts) + smoothing * smoothing))


def _inverse(lengths: Array) -> Array:
    """1 / lengths, or 0 for the length 0."""
    return np.divide(1.0, lengths, out=np.zeros_like(lengths), where=lengths > 0)
