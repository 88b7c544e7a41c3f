"""Linear programmes over mixtures of boundary points of the controls' sets, solved by HiGHS.

A mixture of boundary points is an admissible control because the sets are convex. The multipliers psi of the
linear programme prove a lower bound that holds for all controls. They also determine for each step the
boundary point that lowers the cost most when it is added as a column.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged

PRECISIONS = (1e-10, 1e-9, 1e-8)
"""Tolerances of HiGHS, tried in turn.

Where hardly more than one plan exists, HiGHS may find none with the smallest tolerance.
"""


@dataclass(frozen=True)
class Columns:
    """Points of the controls' sets, as columns of a linear programme.

    Attributes
    ----------
    owners : (n,) int array
        The step to which each point belongs.
    points : (n, m) array
        The points.
    costs : (n,) array
        The cost of each point.
    """

    owners: NDArray[np.int64]
    points: Array
    costs: Array

    def joined(self, owners: NDArray[np.int64], points: Array, costs: Array) -> "Columns":
        """These columns followed by further ones."""
        return Columns(
            np.append(self.owners, owners),
            np.concatenate([self.points, points]),
            np.append(self.costs, costs),
        )


def mixture(
    factors: Array, target: Array, columns: Columns, room: float | None = None
) -> tuple[float, Array, Array]:
    """The cheapest mixture of columns that reaches the target: its cost, psi, and the controls.

    Parameters
    ----------
    factors : (steps, 3, m) array
        G_k, preferably scaled so that the sum of G G' is the identity.
    target : (3,) array
        The vector b to reach.
    columns : Columns
        The points to mix.
    room : float, optional
        Largest total weight of a step; the cost is then the sum of the columns' own costs. Without it the
        cost is the largest total weight of any step, and its least value is the gauge.

    Raises
    ------
    pontryagin.NotConverged
        If HiGHS finds no mixture.
    """
    from scipy.optimize import linprog

    steps = len(factors)
    reach = np.einsum("nij,nj->in", factors[columns.owners], columns.points)
    within = (columns.owners == np.arange(steps)[:, None]).astype(float)
    last = float(room is None)
    equal = np.hstack([reach, np.zeros((3, 1))])
    below = np.hstack([within, np.full((steps, 1), -last)])
    for precision in PRECISIONS:
        tolerances = dict.fromkeys(("primal_feasibility_tolerance", "dual_feasibility_tolerance"), precision)
        found = linprog(  # type: ignore[call-overload]
            np.append((1 - last) * columns.costs, last),
            A_ub=below,
            b_ub=np.full(steps, room or 0.0),
            A_eq=equal,
            b_eq=target,
            method="highs-ds",
            options=tolerances,
        )
        if found.status == 0:
            break
    else:
        raise NotConverged(
            f"HiGHS did not solve the linear programme of {steps} steps: {found.message}", float("inf")
        )
    controls = np.zeros((steps, columns.points.shape[1]))
    np.add.at(controls, columns.owners, found.x[:-1, None] * columns.points)
    miss = target - np.einsum("kij,kj->i", factors, controls)
    return float(found.fun), found.eqlin.marginals, controls + np.einsum("kij,i->kj", factors, miss)


def gram_root(factors: Array) -> Array:
    """The Cholesky factor of the sum of G_k G_k', (n, n)."""
    return np.asarray(np.linalg.cholesky(np.einsum("kij,klj->il", factors, factors)))


def whitened(factors: Array, target: Array) -> tuple[Array, Array]:
    """G_k and b in the coordinates in which the sum of G G' is the identity."""
    root = np.asarray(gram_root(factors), dtype=float)
    return np.asarray(np.linalg.solve(root, factors)), np.asarray(np.linalg.solve(root, target))
