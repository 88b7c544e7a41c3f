"""Nonstationary linear systems (1) with ellipsoidal controls, section 6, and their summands, Lemma 1."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.validation import finite
from pontryagin.value import value_class

Matrices = Sequence[ArrayLike] | Array | Callable[[int], ArrayLike]

SINGULAR = 1e14
"""A matrix A(k) whose condition is above this counts as singular."""


@value_class
@dataclass(frozen=True, eq=False)
class DiscreteSystem:
    """x(k+1) = A(k) x(k) + u(k) with (u(k), H(k) u(k)) <= 1, system (1) with the ellipsoids of section 6.

    Parameters
    ----------
    A : sequence of (n, n) matrices, (steps, n, n) array, one (n, n) matrix, or callable of k
        The nonsingular matrices A(k). One matrix defines a stationary system.
    H : the same
        The symmetric, positive definite matrices H(k).

    Raises
    ------
    TypeError, ValueError
        If A or H does not hold finite numbers. A matrix that is wrongly shaped, singular, not symmetric or
        not positive definite raises when it is used (`factors`, `gauge`); the message names it with its k.

    Examples
    --------
    >>> from pontryagin.orbit_correction import gauge
    >>> system = DiscreteSystem(np.eye(2), np.eye(2))
    >>> round(float(gauge(system, [3.0, 4.0], steps=10).alpha), 12)
    0.5
    """

    A: Matrices
    H: Matrices

    def __post_init__(self) -> None:
        for name in ("A", "H"):
            given = getattr(self, name)
            if not callable(given):
                matrices = finite(name, given, "an (n, n) matrix, a sequence of them, or a callable of k")
                if matrices.ndim not in (2, 3):
                    raise ArgumentValueError(
                        f"{name} must be an array (n, n) or (steps, n, n), got shape {matrices.shape}", name
                    )
                object.__setattr__(self, name, matrices)

    @cached_property
    def _steps(self) -> list[tuple[Array, Array]]:
        """The results of `step` for the steps that were checked so far."""
        return []

    def step(self, k: int) -> tuple[Array, Array]:
        """A(k) and the factor L(k) of the ellipsoid, L L' = H(k)^-1, both (n, n)."""
        while len(self._steps) <= k:
            index = len(self._steps)
            if index and _one_matrix(self.A) and _one_matrix(self.H):
                self._steps.append(self._steps[0])
                continue
            dynamics, shape = _matrix("A", self.A, index), _matrix("H", self.H, index)
            if shape.shape != dynamics.shape:
                raise ArgumentValueError(
                    f"H({index}) must have shape {dynamics.shape} like A({index}), got {shape.shape}", "H"
                )
            if index and dynamics.shape != self._steps[0][0].shape:
                takes = f"have shape {self._steps[0][0].shape} like A(0)"
                raise ArgumentValueError(f"A({index}) must {takes}, got {dynamics.shape}", "A")
            condition = np.linalg.cond(dynamics)
            if condition > SINGULAR:
                takes = f"be nonsingular, with a condition number up to {SINGULAR:g}"
                raise ArgumentValueError(f"A({index}) must {takes}, got {condition:.3g}", "A")
            self._steps.append((dynamics, _ellipsoid_factor(shape, index)))
        return self._steps[k]

    def factors(self, steps: int) -> Array:
        """G_k = (A(k) ... A(0))^-1 L(k) for k < steps, (steps, n, n).

        The set X(N, 0) of (2) is the sum of the G_k B, Lemma 1, which are ellipsoids by Lemma 8.
        """
        inverse, result = None, []
        for k in range(steps):
            dynamics, factor = self.step(k)
            with np.errstate(all="ignore"):
                inverse = np.linalg.inv(dynamics) if inverse is None else inverse @ np.linalg.inv(dynamics)
                result.append(inverse @ factor)
            if not np.isfinite(result[-1]).all():
                raise ArgumentValueError(
                    "A must have inverses of its products A(k) ... A(0) within the range of floating-point "
                    f"numbers, got one beyond it at k = {k}",
                    "A",
                )
        return np.array(result)


def _one_matrix(given: Matrices) -> bool:
    """Whether the same matrix is given for all steps."""
    return isinstance(given, np.ndarray) and given.ndim == 2


def _matrix(name: str, given: Any, k: int) -> Array:
    """A(k) or H(k), checked to be square and finite."""
    if callable(given):
        matrix = finite(f"{name}({k})", given(k), "an (n, n) matrix")
    elif given.ndim == 3 and k >= len(given):
        raise ArgumentValueError(f"{name} must hold a matrix for step {k}, got {len(given)} matrices", name)
    else:
        matrix = given if given.ndim == 2 else given[k]
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not matrix.size:
        raise ArgumentValueError(f"{name}({k}) must be an (n, n) matrix, got shape {matrix.shape}", name)
    return matrix


def _ellipsoid_factor(shape: Array, k: int) -> Array:
    """L with L L' = H(k)^-1, from the eigenvalues of H(k)."""
    if not np.allclose(shape, shape.T, rtol=1e-12, atol=0):
        difference = np.abs(shape - shape.T).max()
        raise ArgumentValueError(
            f"H({k}) must be symmetric, got one that differs from its transpose by {difference:.3g}", "H"
        )
    values, axes = np.linalg.eigh(shape)
    if values[0] <= 0:
        raise ArgumentValueError(
            f"H({k}) must be positive definite, got the least eigenvalue {values[0]:.3g}", "H"
        )
    if values[0] <= 1e-15 * values[-1]:
        raise ArgumentValueError(
            f"H({k}) must have a condition number below 1e15, got {values[-1] / values[0]:.3g}", "H"
        )
    return np.asarray(axes / np.sqrt(values))
