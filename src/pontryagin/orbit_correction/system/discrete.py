"""Nonstationary linear systems with ellipsoidal controls, (1) and section 6, and their summands, Lemma 1."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.validation import finite

Matrices = Sequence[ArrayLike] | Array | Callable[[int], ArrayLike]


@dataclass(frozen=True, eq=False)
class DiscreteSystem:
    """x(k+1) = A(k) x(k) + u(k) with (u(k), H(k) u(k)) <= 1, section 6.

    Parameters
    ----------
    A : sequence of (n, n) matrices, (steps, n, n) array, one (n, n) matrix, or callable of k
        Nonsingular. One matrix stands for a stationary system.
    H : the same
        Symmetric positive definite.

    Raises
    ------
    TypeError, ValueError
        When a matrix is used (`factors`, `gauge`) that is wrongly shaped, not finite, singular, not
        symmetric or not positive definite; the message names it with its k.

    Examples
    --------
    >>> system = DiscreteSystem(np.eye(2), np.eye(2))
    >>> round(float(gauge(system, [3.0, 4.0], steps=10).alpha), 12)
    0.5
    """

    A: Matrices
    H: Matrices
    _known: list[tuple[NDArray, NDArray]] = field(default_factory=list, init=False, repr=False)
    _stacks: dict[str, NDArray] = field(default_factory=dict, init=False, repr=False)

    def step(self, k: int) -> tuple[Array, Array]:
        """A(k) and the factor L(k) of the ellipsoid, L L' = H(k)^-1, both (n, n)."""
        while len(self._known) <= k:
            index = len(self._known)
            dynamics, shape = self._matrix("A", index), self._matrix("H", index)
            if index and all(self._stacks.get(name, np.empty(0)).ndim == 2 for name in "AH"):
                self._known.append(self._known[0])
                continue
            if shape.shape != dynamics.shape:
                raise ValueError(f"H({index}) must be {dynamics.shape} like A({index}), got {shape.shape}")
            if index and dynamics.shape != self._known[0][0].shape:
                raise ValueError(
                    f"A({index}) must be {self._known[0][0].shape} like A(0), got {dynamics.shape}"
                )
            if np.linalg.cond(dynamics) > 1e14:
                raise ValueError(f"A({index}) must be nonsingular, its condition is above 1e14")
            self._known.append((dynamics, _ellipsoid_factor(shape, index)))
        return self._known[k]

    def _matrix(self, name: str, k: int) -> Array:
        """A(k) or H(k), checked to be square and finite."""
        given = getattr(self, name)
        if callable(given):
            return _square(f"{name}({k})", finite(f"{name}({k})", given(k), "an (n, n) matrix"))
        if name not in self._stacks:
            self._stacks[name] = finite(
                name, given, "an (n, n) matrix, a sequence of them, or a callable of k"
            )
        stack = self._stacks[name]
        if stack.ndim not in (2, 3):
            raise ValueError(f"{name} must be (n, n) or (steps, n, n), got shape {stack.shape}")
        if stack.ndim == 3 and k >= len(stack):
            raise ValueError(f"{name} must hold a matrix for step {k}, got {len(stack)} matrices")
        return _square(f"{name}({k})", stack if stack.ndim == 2 else stack[k])

    def factors(self, steps: int) -> Array:
        """G_k = (A(k) ... A(0))^-1 L(k) for k < steps, (steps, n, n): X(N, 0) = sum of G_k B, Lemma 1."""
        inverse, result = None, []
        for k in range(steps):
            dynamics, factor = self.step(k)
            with np.errstate(all="ignore"):
                inverse = np.linalg.inv(dynamics) if inverse is None else inverse @ np.linalg.inv(dynamics)
                result.append(inverse @ factor)
            if not np.isfinite(result[-1]).all():
                raise ValueError(f"A: the inverse of A({k}) ... A(0) is beyond the range of floating numbers")
        return np.array(result)


def _square(name: str, matrix: NDArray) -> Array:
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not matrix.size:
        raise ValueError(f"{name} must be an (n, n) matrix, got shape {matrix.shape}")
    return matrix


def _ellipsoid_factor(shape: NDArray, k: int) -> Array:
    if not np.allclose(shape, shape.T, rtol=1e-12, atol=0):
        raise ValueError(
            f"H({k}) must be symmetric, it differs from its transpose by {np.abs(shape - shape.T).max():.3g}"
        )
    values, vectors_ = np.linalg.eigh(shape)
    if values[0] <= 0:
        raise ValueError(f"H({k}) must be positive definite, its least eigenvalue is {values[0]:.3g}")
    if values[0] <= 1e-15 * values[-1]:
        raise ValueError(f"H({k}) must be nonsingular, its condition is {values[-1] / values[0]:.3g}")
    return vectors_ / np.sqrt(values)
