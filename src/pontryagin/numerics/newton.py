"""Newton's method with damping, for one system of equations or for a stack of systems side by side.

`newton` solves one system whose evaluation may be dear (a flight, say) and hands back the last evaluation;
`newton_stack` solves many at once, each with a damping of its own. Both say what stopped them; neither
raises because it did not converge.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Literal, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged

Outcome = Literal["converged", "stalled", "singular", "iterations"]
"""What stopped the iteration.

The next correction is expected to be negligible; no share of the step makes the residual smaller, which near
a solution is rounding; the Jacobian is singular; or the steps were used up.
"""

ROUNDING = 1e-15
"""Relative correction that cannot be told from rounding."""
QUADRATIC = 1e-9
"""Residual below which a step is no longer shortened: what the whole step cannot improve is rounding."""


class Linearised(Protocol):
    """Equations at some unknowns."""

    @property
    def residual(self) -> Array:
        """What is zero at a solution, (m,)."""

    @property
    def jacobian(self) -> Array:
        """Its derivatives in the unknowns, (m, n)."""


E = TypeVar("E", bound=Linearised)

Scales = Callable[[Array], Array]
"""Unknowns (n,) to the sizes that their corrections are measured by, (n,)."""


def ones(unknowns: Array) -> Array:
    """Scales of unknowns that are all of size 1."""
    return np.ones_like(unknowns)


@dataclass(frozen=True)
class Iterate(Generic[E]):
    """Where Newton's method ended.

    Attributes
    ----------
    unknowns : (n,) array
    equations : object with ``residual`` and ``jacobian``
        The equations there.
    correction : float
        The last relative correction; inf if none was made.
    outcome : str
        "converged", "stalled", "singular" or "iterations".
    """

    unknowns: Array
    equations: E
    correction: float
    outcome: Outcome

    @property
    def residual(self) -> float:
        """Euclidean norm of the residual."""
        return float(np.linalg.norm(self.equations.residual))


def newton(
    evaluate: Callable[[Array], E],
    unknowns: Array,
    *,
    scales: Scales = ones,
    tolerance: float = ROUNDING,
    iterations: int = 25,
    halvings: int = 6,
    admissible: Callable[[Array, Array], bool] | None = None,
    rough: Callable[[Array], E] | None = None,
    rough_tolerance: float = 1e-8,
) -> Iterate[E]:
    """Newton's method for one system, its steps halved until the residual becomes smaller.

    Parameters
    ----------
    evaluate : function of unknowns (n,)
        The equations; it may raise `NotConverged` where they cannot be evaluated, which shortens the step.
    unknowns : (n,) array
        Where to begin.
    scales : function of unknowns, optional
        What corrections are measured by.
    tolerance : float
        Relative correction, expected by quadratic convergence, of a step that need not be made.
    iterations, halvings : int
        The most steps, and how many lengths of each are tried: 1, 1/2, 1/4, ...
    admissible : function of unknowns before and after a step, optional
        Whether a step may be made at all.
    rough : function of unknowns, optional
        A cheaper evaluation of the same equations, with which the first steps are made.
    rough_tolerance : float
        The tolerance of those.

    Raises
    ------
    NotConverged
        If the equations cannot be evaluated where it begins.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> def circle_and_line(x):
    ...     residual = np.array([x @ x - 2, x[0] - x[1]])
    ...     return SimpleNamespace(residual=residual, jacobian=np.array([2 * x, [1.0, -1.0]]))
    >>> found = newton(circle_and_line, np.array([3.0, 1.0]))
    >>> found.unknowns.tolist(), found.outcome
    ([1.0, 1.0], 'converged')
    """
    allowed = admissible or (lambda before, after: True)
    correction = np.inf
    if rough is not None:
        unknowns, correction = _approach(
            rough, unknowns, scales, rough_tolerance, iterations, halvings, allowed
        )
    here = evaluate(unknowns)
    for _ in range(iterations):
        step = newton_step(here)
        if step is None:
            return Iterate(unknowns, here, correction, "singular")
        last, correction = correction, float(np.abs(step / scales(unknowns)).max())
        moved = _damped(evaluate, unknowns, here, step, halvings, allowed)
        if moved is None:
            return Iterate(unknowns, here, correction, "stalled")
        unknowns, here = moved
        if expected(correction, last) < tolerance:
            return Iterate(unknowns, here, correction, "converged")
    return Iterate(unknowns, here, correction, "iterations")


def _approach(
    rough: Callable[[Array], E],
    unknowns: Array,
    scales: Scales,
    tolerance: float,
    iterations: int,
    halvings: int,
    allowed: Callable[[Array, Array], bool],
) -> tuple[Array, float]:
    """The first steps, by the rough evaluation: where they lead, and the last relative correction.

    The last step is made without evaluating the equations after it.
    """
    here = rough(unknowns)
    correction = np.inf
    for _ in range(iterations):
        step = newton_step(here)
        if step is None:
            break
        last, correction = correction, float(np.abs(step / scales(unknowns)).max())
        if expected(correction, last) < tolerance:
            return unknowns + step, correction
        moved = _damped(rough, unknowns, here, step, halvings, allowed)
        if moved is None:
            break
        unknowns, here = moved
    return unknowns, np.inf


def newton_step(here: Linearised) -> Array | None:
    """The step that solves the linearised equations; None where they are singular."""
    try:
        step = np.asarray(np.linalg.solve(here.jacobian, -here.residual), dtype=float)
    except np.linalg.LinAlgError:
        return None
    return step if np.isfinite(step).all() else None


def expected(correction: float, last: float) -> float:
    """The correction to come, after two of quadratic convergence; after one, that one."""
    return correction * min(1.0, (correction / last) ** 2) if last < np.inf else correction


def _damped(
    evaluate: Callable[[Array], E],
    unknowns: Array,
    here: E,
    step: Array,
    halvings: int,
    allowed: Callable[[Array, Array], bool],
) -> tuple[Array, E] | None:
    """The longest of the halved steps that makes the residual smaller; None if none does."""
    size = np.linalg.norm(here.residual)
    for halving in range(1 if size < QUADRATIC else halvings):
        trial = unknowns + step / 2**halving
        if not allowed(unknowns, trial):
            continue
        try:
            there = evaluate(trial)
        except NotConverged:
            continue
        if np.linalg.norm(there.residual) < size:
            return trial, there
    return None


class LinearisedStack(Protocol):
    """A stack of systems at unknowns of their own."""

    @property
    def residual(self) -> Array:
        """What is zero at the solutions, (k, m); nan where it cannot be evaluated."""

    def jacobian(self, rows: NDArray[np.intp]) -> Array:
        """Derivatives of the residuals of some rows in their unknowns, (len(rows), m, n)."""


@dataclass(frozen=True)
class Evaluated:
    """Residuals (k, m) with Jacobians (k, m, n) that are known already: a `LinearisedStack`."""

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

    In every round each member that is not finished tries its step, or a half of what it tried last; those
    whose residual becomes smaller take it.

    Parameters
    ----------
    evaluate : function of members (k,) and unknowns (k, n)
        The systems of those members; rows of nan where one cannot be evaluated.
    unknowns : (s, n) array
        Where to begin.
    tolerance : float
        Size of the residual at which a member is finished.
    step_tolerance : float
        Size of a step that is made without a further look: the error after it is its square.
    iterations, halvings : int
        The most steps of a member, and how often each may be halved.
    decrease : float
        What a share of a step must gain: the new residual is at most (1 - decrease * share) of the old one.
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
        """New steps of some members; the last one of those that are close is made at once."""
        step[members] = solved(there.jacobian(rows), -there.residual[rows])
        correction[members] = _sized(measure_step(members, x[members], step[members]))
        share[members] = 1.0
        close = members[correction[members] <= step_tolerance]
        x[close] += step[close]
        finished[close], open_[close] = True, False
        open_[members[~np.isfinite(correction[members])]] = False

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

    Rows that are not finite have nan.
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
