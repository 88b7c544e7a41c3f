"""Damped Newton's method for a stack of systems side by side, each damped on its own.

The result says which members converged; failure to converge raises nothing. `newton` solves one system.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array


class LinearisedStack(Protocol):
    """A stack of systems, each evaluated at its own unknowns."""

    @property
    def residual(self) -> Array:
        """Residuals, zero at solutions, (k, m); nan where they cannot be evaluated."""

    def jacobian(self, rows: NDArray[np.intp]) -> Array:
        """Derivatives of the residuals of some rows in their unknowns, (len(rows), m, n)."""


@dataclass(frozen=True)
class Evaluated:
    """A `LinearisedStack` whose residuals (k, m) and Jacobians (k, m, n) are all computed beforehand."""

    residual: Array
    jacobians: Array

    def jacobian(self, rows: NDArray[np.intp]) -> Array:
        """The Jacobians of some rows."""
        return np.asarray(self.jacobians[rows])


@dataclass(frozen=True)
class Iterates:
    """Where Newton's method ended on a stack (k).

    Attributes
    ----------
    unknowns : (k, n) array
    residual : (k,) array
        Sizes of the residuals; inf where even the first could not be evaluated.
    correction : (k,) array
        Sizes of the last steps, inf where none was made.
    converged : (k,) array of bool
    """

    unknowns: Array
    residual: Array
    correction: Array
    converged: NDArray[np.bool_]


def newton_stack(
    evaluate: Callable[[NDArray[np.intp], Array], LinearisedStack],
    unknowns: Array,
    *,
    tolerance: float,
    step_tolerance: float = 0.0,
    iterations: int = 30,
    halvings: int = 6,
    decrease: float = 0.0,
    size: Callable[[NDArray[np.intp], Array, Array], Array] | None = None,
    step_size: Callable[[NDArray[np.intp], Array, Array], Array] | None = None,
    admissible: Callable[[NDArray[np.intp], Array], NDArray[np.bool_]] | None = None,
) -> Iterates:
    """Newton's method for a stack of systems, each with its own damping.

    In every round each unfinished member tries its full step, or half of what it tried last; members whose
    residual becomes smaller accept the trial.

    Parameters
    ----------
    evaluate : function of members (k,) and unknowns (k, n)
        The systems of those members; rows of nan where one cannot be evaluated.
    unknowns : (s, n) array
        Initial guesses.
    tolerance : float
        Size of the residual at which a member is finished.
    step_tolerance : float
        A step up to this size is made as the last one, without evaluating the equations after it, since the
        error after it is of the order of its square.
    iterations, halvings : int
        The largest number of steps of a member, and how often each may be halved.
    decrease : float
        Required gain of a step shortened to a given share: the new residual is at most
        (1 - decrease * share) times the old one.
    size, step_size : function of members, unknowns and residuals or steps, optional
        Sizes (k,) of residuals and of steps; by default Euclidean norms.
    admissible : function of members and unknowns, optional
        Which unknowns may be tried, (k,).

    Examples
    --------
    >>> def square_roots(members, x):
    ...     return Evaluated(x**2 - np.array([[2.0], [9.0]])[members], 2 * x[:, :, None])
    >>> newton_stack(square_roots, np.ones((2, 1)), tolerance=1e-12).unknowns.round(9).tolist()
    [[1.414213562], [3.0]]
    """
    measure = size or _norm
    measure_step = step_size or _norm
    x = np.array(unknowns, dtype=float)
    count = len(x)
    every = np.arange(count)
    here = evaluate(every, x)
    residual = _sized(measure(every, x, here.residual))
    step, correction, share = np.zeros_like(x), np.full(count, np.inf), np.ones(count)
    steps_left, finished = np.full(count, iterations), residual <= tolerance
    open_ = np.isfinite(residual) & ~finished

    def aim(members: NDArray[np.intp], there: LinearisedStack, rows: NDArray[np.intp]) -> None:
        """Compute the next steps of some members; a step within the step tolerance is made at once."""
        step[members] = solved(there.jacobian(rows), -there.residual[rows])
        correction[members] = _sized(measure_step(members, x[members], step[members]))
        share[members] = 1.0
        close = members[correction[members] <= step_tolerance]
        x[close] += step[close]
        finished[close], open_[close] = True, False
        open_[members[~np.isfinite(correction[members])]] = False

    if open_.any():
        aim(np.flatnonzero(open_), here, np.flatnonzero(open_))
    while open_.any():
        members = np.flatnonzero(open_)
        trial = x[members] + share[members, None] * step[members]
        there = evaluate(members, trial)
        after = _sized(measure(members, trial, there.residual))
        before = residual[members]
        better = after <= (1 - decrease * share[members]) * before if decrease else after < before
        if admissible is not None:
            better &= admissible(members, trial)
        taken, refused = members[better], members[~better]
        x[taken], residual[taken] = trial[better], after[better]
        steps_left[taken] -= 1
        share[refused] /= 2
        finished[taken] = residual[taken] <= tolerance
        open_[taken] = ~finished[taken] & (steps_left[taken] > 0)
        open_[refused] = share[refused] > 0.5**halvings
        rows = np.flatnonzero(better)
        going = open_[taken]
        if going.any():
            aim(taken[going], there, rows[going])
    return Iterates(x, residual, correction, finished)


def solved(matrices: Array, right: Array) -> Array:
    """Solutions (k, n) of stacked linear systems (k, m, n); by least squares if some are singular.

    The solution is nan for systems that hold nan or infinity.
    """
    usable = np.isfinite(matrices).all(axis=(1, 2)) & np.isfinite(right).all(axis=1)
    result = np.full((len(matrices), matrices.shape[-1]), np.nan)
    rows = np.flatnonzero(usable)
    try:
        result[rows] = np.linalg.solve(matrices[rows], right[rows, :, None])[..., 0]
    except (np.linalg.LinAlgError, ValueError):
        for i in rows:
            result[i] = np.linalg.lstsq(matrices[i], right[i])[0]
    return result


def _norm(members: NDArray[np.intp], unknowns: Array, vectors: Array) -> Array:
    return np.asarray(np.linalg.norm(vectors, axis=1))


def _sized(sizes: Array) -> Array:
    return np.where(np.isfinite(sizes), sizes, np.inf)
