"""Nonstationary linear systems with ellipsoidal controls, (1), and the gauge of their 0-controllable sets."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible
from pontryagin.jit import compiled
from pontryagin.orbit_correction.ellipsoids import gauge_stack
from pontryagin.validation import finite, vectors

Matrices = Sequence[ArrayLike] | NDArray | Callable[[int], ArrayLike]

SIGNATURE = "void(float64[:,:,::1],float64[:,::1],float64[:,::1],float64[:,::1],float64[:,::1])"
COMPILE_FROM = 40
"""States times steps from which loading the compiled kernel pays."""


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

    def step(self, k: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """A(k) and the factor L(k) of the ellipsoid, L L' = H(k)^-1, both (n, n)."""
        while len(self._known) <= k:
            index = len(self._known)
            dynamics = _square("A", self.A, index)
            shape = _square("H", self.H, index)
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

    def factors(self, steps: int) -> NDArray[np.float64]:
        """G_k = (A(k) ... A(0))^-1 L(k) for k < steps, (steps, n, n): X(N, 0) = sum of G_k B, Lemma 1."""
        inverse, result = None, []
        for k in range(steps):
            dynamics, factor = self.step(k)
            inverse = np.linalg.inv(dynamics) if inverse is None else inverse @ np.linalg.inv(dynamics)
            result.append(inverse @ factor)
        return np.array(result)


def _square(name: str, matrices: Matrices, k: int) -> NDArray[np.float64]:
    if callable(matrices):
        value = matrices(k)
    else:
        stack = finite(name, matrices, "an (n, n) matrix, a sequence of them, or a callable of k")  # type: ignore[arg-type]
        if stack.ndim == 2:
            value = stack
        elif stack.ndim != 3:
            raise ValueError(f"{name} must be (n, n) or (steps, n, n), got shape {stack.shape}")
        elif k >= len(stack):
            raise ValueError(f"{name} must hold a matrix for step {k}, got {len(stack)} matrices")
        else:
            value = stack[k]
    matrix = finite(f"{name}({k})", value, "an (n, n) matrix")
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise ValueError(f"{name}({k}) must be an (n, n) matrix, got shape {matrix.shape}")
    return matrix


def _ellipsoid_factor(shape: NDArray, k: int) -> NDArray[np.float64]:
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


@dataclass(frozen=True, eq=False)
class Gauge:
    """How much of its peak a system needs to bring states to the origin in given steps.

    Attributes
    ----------
    alpha : (...) array
        Minkowski functional of the 0-controllable set at the state: at most 1 where it can be done.
    costate : (..., n) array
        psi_0, unit; zeros for the zero state.
    certificate : Certificate
        alpha of controls that reach the origin exactly, and the bound that psi_0 proves.
    """

    alpha: NDArray[np.float64]
    costate: NDArray[np.float64]
    certificate: Certificate


def gauge(system: DiscreteSystem, x0: ArrayLike, steps: int) -> Gauge:
    """The gauge of the set of states that the system brings to the origin in `steps` steps, Lemmas 7 and 9.

    Parameters
    ----------
    system : DiscreteSystem
        Dynamics and ellipsoids.
    x0 : (..., n) array_like
        States.
    steps : int
        Number of steps, at least one.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If the controls span less than the whole space.
    """
    if not isinstance(steps, int | np.integer) or steps < 1:
        raise ValueError(f"steps must be a positive whole number, got {steps!r}")
    n = system.step(0)[0].shape[0]
    return gauge_of_factors(system.factors(int(steps)), vectors("x0", x0, n))


def gauge_of_factors(factors: NDArray[np.float64], x0: NDArray[np.float64]) -> Gauge:
    """The gauge of states (..., n) for the sum of the ellipsoids G_k B, factors (steps, n, m)."""
    n = factors.shape[1]
    gram = np.einsum("kij,klj->il", factors, factors)
    scale = np.sqrt(np.diag(gram))
    if (scale == 0).any() or np.linalg.cond(gram / np.outer(scale, scale)) > 1e26:
        raise Infeasible("the controls do not span the state space: some states cannot be reached at all")
    targets = np.ascontiguousarray(-x0.reshape(-1, n))
    costates, bounds = np.empty_like(targets), np.empty((len(targets), 2))
    run = compiled(gauge_stack, SIGNATURE, len(targets) * len(factors) > COMPILE_FROM)
    run(
        np.ascontiguousarray(factors),
        np.ascontiguousarray(np.linalg.cholesky(gram)),
        targets,
        costates,
        bounds,
    )
    shape = x0.shape[:-1]
    size = np.linalg.norm(costates, axis=-1, keepdims=True)
    unit = np.divide(costates, size, out=np.zeros_like(costates), where=size > 0)
    lower, upper = bounds[:, 0].reshape(shape), bounds[:, 1].reshape(shape)
    return Gauge(lower, unit.reshape(*shape, n), Certificate(np.zeros(shape), upper, lower))
