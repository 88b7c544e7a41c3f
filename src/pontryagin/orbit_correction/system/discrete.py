"""Nonstationary linear systems (1) with ellipsoidal controls, section 6, and their summands, Lemma 1."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
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
        return self._checked(k + 1)[k]

    def factors(self, steps: int) -> Array:
        """G_k = (A(k) ... A(0))^-1 L(k) for k < steps, (steps, n, n).

        The set X(N, 0) of (2) is the sum of the G_k B, Lemma 1, which are ellipsoids by Lemma 8.
        """
        dynamics, ellipsoids = (np.array(rows) for rows in zip(*self._checked(steps)[:steps], strict=True))
        with np.errstate(all="ignore"):
            result = np.array([*accumulate(np.linalg.inv(dynamics), np.dot)]) @ ellipsoids
        within = np.isfinite(result).all(axis=(1, 2))
        if not within.all():
            raise ArgumentValueError(
                "A must have inverses of its products A(k) ... A(0) within the range of floating-point "
                f"numbers, got one beyond it at k = {np.argmin(within)}",
                "A",
            )
        return np.asarray(result)

    def _checked(self, count: int) -> list[tuple[Array, Array]]:
        """The first steps or more, evaluated and checked as far as that was not done; all new ones together.

        Threads that check the same steps put the same results in the same places.
        """
        steps = self._steps
        start = len(steps)
        if count <= start:
            return steps
        called = [(name, given) for name, given in (("A", self.A), ("H", self.H)) if callable(given)]
        values: dict[str, list[Array]] = {name: [] for name, _ in called}
        for k in range(start, count):
            for name, given in called:
                values[name].append(finite(f"{name}({k})", given(k), "an (n, n) matrix"))
        first = steps[0][0].shape if steps else None
        dynamics = _stack("A", values.get("A", self.A), start, count, first)
        shapes = _stack("H", values.get("H", self.H), start, count, dynamics.shape[1:])
        _require_nonsingular(dynamics, start)
        stacks = (dynamics, _ellipsoid_factors(shapes, start))
        rows = (np.broadcast_to(stack, (count - start, *stack.shape[1:])) for stack in stacks)
        steps[start:count] = zip(*rows, strict=True)
        return steps


def _stack(
    name: str, given: list[Array] | Any, start: int, count: int, first: tuple[int, ...] | None
) -> Array:
    """The matrices of the steps from `start` to `count`, (steps, n, n); (1, n, n) if all are the same.

    They must be square, of the shape ``first`` of A(0) if that is given, and of one shape.
    """
    if isinstance(given, np.ndarray):
        if given.ndim == 3 and count > len(given):
            short = f"for step {max(start, len(given))}, got {len(given)} matrices"
            raise ArgumentValueError(f"{name} must hold a matrix {short}", name)
        given = given[None] if given.ndim == 2 else given[start:count]
    for k, matrix in enumerate(given, start):
        if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not matrix.size:
            raise ArgumentValueError(f"{name}({k}) must be an (n, n) matrix, got shape {matrix.shape}", name)
        first = first or matrix.shape
        if matrix.shape != first:
            takes = f"have shape {first} like A({0 if name == 'A' else k})"
            raise ArgumentValueError(f"{name}({k}) must {takes}, got {matrix.shape}", name)
    return np.asarray(given)


def _require_nonsingular(dynamics: Array, start: int) -> None:
    """Raise if one of the matrices A(start), A(start + 1), ... is singular."""
    conditions = np.linalg.cond(dynamics)
    if (conditions > SINGULAR).any():
        at = int(np.argmax(conditions > SINGULAR))
        takes = f"be nonsingular, with a condition number up to {SINGULAR:g}"
        raise ArgumentValueError(f"A({start + at}) must {takes}, got {conditions[at]:.3g}", "A")


def _ellipsoid_factors(shapes: Array, start: int) -> Array:
    """L(k) with L L' = H(k)^-1, from the eigenvalues of the matrices H(start), H(start + 1), ..."""
    transposed = np.swapaxes(shapes, 1, 2)
    differences = np.abs(shapes - transposed)
    values, axes = np.linalg.eigh(shapes)
    lopsided = np.asarray((differences > 1e-12 * np.abs(transposed)).any(axis=(1, 2)))
    faults = lopsided | (values[:, 0] <= 1e-15 * values[:, -1]) | (values[:, 0] <= 0)
    if faults.any():
        at = int(np.argmax(faults))
        least, largest = values[at, 0], values[at, -1]
        if lopsided[at]:
            reason = f"be symmetric, got one that differs from its transpose by {differences[at].max():.3g}"
        elif least <= 0:
            reason = f"be positive definite, got the least eigenvalue {least:.3g}"
        else:
            reason = f"have a condition number below 1e15, got {largest / least:.3g}"
        raise ArgumentValueError(f"H({start + at}) must {reason}", "H")
    return np.asarray(axes / np.sqrt(values)[:, None, :])
