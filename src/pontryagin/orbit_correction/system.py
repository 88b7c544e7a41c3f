"""Nonstationary linear systems with ellipsoidal controls, (1), and the gauge of their 0-controllable sets."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible
from pontryagin.numerics.jit import compiled
from pontryagin.orbit_correction.ellipsoids import gauge_stack
from pontryagin.orbit_correction.proof import require_closed, unit
from pontryagin.validation import finite, vectors

Matrices = Sequence[ArrayLike] | NDArray | Callable[[int], ArrayLike]

SIGNATURE = "void(float64[:,:,::1],float64[:,::1],float64[:,::1],float64[:,::1])"
COMPILE_FROM = 40
"""States times steps from which loading the compiled kernel pays."""

FLAT = 1e-13
"""Least width, relative to the largest, of a set that is not flat; axes measured by the reach along them."""

VANISHING = 1e-100
"""What steps less than this share of the reach add is lost, and their squares would not be numbers."""


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

    alpha: Array
    costate: Array
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
    if not isinstance(system, DiscreteSystem):
        raise TypeError(f"system must be a DiscreteSystem, got {type(system).__name__}")
    if isinstance(steps, bool) or not isinstance(steps, int | np.integer) or steps < 1:
        raise ValueError(f"steps must be a positive whole number, got {steps!r}")
    n = system.step(0)[0].shape[0]
    return gauge_of_factors(system.factors(int(steps)), vectors("x0", x0, n))


def gauge_of_factors(factors: Array, x0: Array) -> Gauge:
    """The gauge of states (..., n) for the sum of the ellipsoids G_k B, factors (steps, n, m).

    A flat sum is taken as a set of the plane that it spans: states there have a gauge, others none.
    """
    n, shape = factors.shape[1], x0.shape[:-1]
    reach = np.abs(factors).max(axis=(0, 2))
    reach = np.where(reach > 0, reach, reach.max(initial=0.0))
    if not (reach > 0).all():
        raise Infeasible("the controls do nothing: only the zero state needs none")
    scaled = factors / reach[:, None]
    scaled[np.abs(scaled).max(axis=(1, 2)) < VANISHING] = 0.0
    rows = -x0.reshape(int(np.prod(shape)), n)
    size = np.abs(rows).max(axis=1, initial=0.0)
    targets = rows / np.where(size > 0, size, 1.0)[:, None] / reach
    longest = np.abs(targets).max(axis=1, initial=0.0)
    targets /= np.where(longest > 0, longest, 1.0)[:, None]
    axes, widths, _ = np.linalg.svd(np.moveaxis(scaled, 0, 1).reshape(n, -1), full_matrices=False)
    thick = widths > FLAT * widths[0]
    axes, widths = axes[:, thick], widths[thick]
    whitening = (axes / widths).T
    within = whitening @ targets.T
    _require_reachable(targets - within.T @ (axes * widths).T, x0)
    costates, results = np.empty(within.T.shape), np.empty((len(targets), 3))
    run = compiled(gauge_stack, SIGNATURE, len(targets) * len(factors) > COMPILE_FROM)
    with np.errstate(all="ignore"):
        run(
            np.ascontiguousarray(whitening @ scaled),
            np.ascontiguousarray(within.T),
            costates,
            results,
        )
        scale = size * longest
        lower, upper = (results[:, i].reshape(shape) * scale.reshape(shape) for i in range(2))
    proof = Certificate(results[:, 2].reshape(shape), upper, lower)
    require_closed(proof, "the gauge")
    return Gauge(lower, unit(costates @ whitening / reach).reshape(*shape, n), proof)


def _require_reachable(left: Array, x0: Array) -> None:
    outside = np.abs(left).max(axis=1, initial=0.0) > 1e-9
    if outside.any():
        state = x0.reshape(left.shape)[int(np.argmax(outside))]
        raise Infeasible(
            f"the controls do not span the state space: x0 = {state.tolist()} is out of their reach, "
            "whatever their size"
        )
