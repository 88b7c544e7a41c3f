"""Damped Newton's method for one system of equations.

An evaluation may be expensive (an integrated trajectory, say), so the last one is returned with the result.
The result says what stopped the iteration; failure to converge raises nothing. `newton_stack` solves many
systems side by side.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Literal, Protocol, TypeVar, cast

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged

Outcome = Literal["converged", "stalled", "singular", "iterations"]
"""What stopped the iteration.

"converged": the next correction is expected to be negligible. "stalled": no tried length of the step makes
the residual smaller, which near a solution is due to rounding. "singular": the Jacobian is singular.
"iterations": the steps were used up.
"""

ROUNDING = 1e-15
"""Relative correction that is not distinguishable from rounding."""
QUADRATIC = 1e-9
"""Residual below which steps are not shortened: a full step that fails to reduce it has met rounding."""


class Residuals(Protocol):
    """Equations evaluated at given unknowns."""

    @property
    def residual(self) -> Array:
        """The residual, zero at a solution, (m,)."""


class Linearised(Residuals, Protocol):
    """Equations evaluated at given unknowns, with their derivatives."""

    @property
    def jacobian(self) -> Array:
        """Derivatives of the residual in the unknowns, (m, n)."""


E = TypeVar("E", bound=Linearised)
V = TypeVar("V", bound=Residuals)

Scales = Callable[[Array], Array]
"""A function of the unknowns (n,) that gives the units in which corrections are measured, (n,)."""


def ones(unknowns: Array) -> Array:
    """Scales of unknowns that are all of size 1."""
    return np.ones_like(unknowns)


@dataclass(frozen=True)
class Iterate(Generic[V]):
    """Where Newton's method ended.

    Attributes
    ----------
    unknowns : (n,) array
    equations : object with ``residual`` and ``jacobian``
        The equations evaluated at the unknowns.
    correction : float
        The last relative correction; inf if none was made.
    outcome : str
        "converged", "stalled", "singular" or "iterations".
    """

    unknowns: Array
    equations: V
    correction: float
    outcome: Outcome

    @property
    def residual(self) -> float:
        """Euclidean norm of the residual."""
        return float(np.linalg.norm(self.equations.residual))


def newton(
    evaluate: Callable[[Array], V],
    unknowns: Array,
    *,
    scales: Scales = ones,
    tolerance: float = ROUNDING,
    iterations: int = 25,
    halvings: int = 6,
    admissible: Callable[[Array, Array], bool] | None = None,
    rough: Callable[[Array], V] | None = None,
    rough_tolerance: float = 1e-8,
    solve: Callable[[V], Array | None] | None = None,
) -> Iterate[V]:
    """Newton's method for one system, with each step halved until the residual becomes smaller.

    Parameters
    ----------
    evaluate : function of unknowns (n,)
        The equations; it may raise `NotConverged` where they cannot be evaluated, which shortens the step.
    unknowns : (n,) array
        Initial guess.
    scales : function of unknowns, optional
        Units in which corrections are measured, see `Scales`.
    tolerance : float
        The iteration ends when quadratic convergence predicts a next relative correction below this.
    iterations, halvings : int
        The largest number of steps, and how many lengths of each are tried: 1, 1/2, 1/4, ...
    admissible : function of unknowns before and after a step, optional
        Whether a step may be made at all.
    rough : function of unknowns, optional
        A cheaper evaluation of the same equations, with which the first steps are made.
    rough_tolerance : float
        The tolerance of the steps made with ``rough``.
    solve : function of the equations, optional
        The step (n,) that solves the linearised equations, or None where they are singular; for equations
        whose Jacobian has a structure. By default `newton_step`.

    Raises
    ------
    NotConverged
        If the equations cannot be evaluated at the initial guess.

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
    linear = solve or cast(Callable[[V], Array | None], newton_step)
    correction = np.inf
    if rough is not None:
        unknowns, correction = _approach(
            rough, unknowns, scales, rough_tolerance, iterations, halvings, allowed, linear
        )
    here = evaluate(unknowns)
    for _ in range(iterations):
        step = linear(here)
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
    rough: Callable[[Array], V],
    unknowns: Array,
    scales: Scales,
    tolerance: float,
    iterations: int,
    halvings: int,
    allowed: Callable[[Array, Array], bool],
    linear: Callable[[V], Array | None],
) -> tuple[Array, float]:
    """The first steps, by the rough evaluation: the unknowns reached and the last relative correction.

    The last step is made without evaluating the equations after it. The correction is inf if the rough
    iteration did not converge.
    """
    here = rough(unknowns)
    correction = np.inf
    for _ in range(iterations):
        step = linear(here)
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
    """The next correction, predicted from two by quadratic convergence; with only one, that one itself."""
    return correction * min(1.0, (correction / last) ** 2) if 0 < last < np.inf else correction


def _damped(
    evaluate: Callable[[Array], V],
    unknowns: Array,
    here: V,
    step: Array,
    halvings: int,
    allowed: Callable[[Array, Array], bool],
) -> tuple[Array, V] | None:
    """Unknowns and equations after the longest halved step that reduces the residual; None if none does."""
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
