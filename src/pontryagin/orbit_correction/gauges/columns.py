"""Convex programmes over sums of G_k u_k = b by generated columns: mixtures of boundary points, by HiGHS.

A mixture is admissible because the sets are convex; the multipliers psi of the linear programme prove a
bound whatever the mixture, and name for each step the boundary point that would help most.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged

PRECISIONS = (1e-10, 1e-9, 1e-8)
"""Tolerances of HiGHS, tried in turn: where hardly more than one plan exists the finest may find none."""


@dataclass(frozen=True)
class Columns:
    """Points of the steps' sets: whose they are (n,), which (n, m), and what each costs (n,)."""

    owners: NDArray[np.int64]
    points: Array
    costs: Array

    def joined(self, owners: NDArray, points: NDArray, costs: NDArray) -> "Columns":
        """These and more."""
        return Columns(
            np.append(self.owners, owners),
            np.concatenate([self.points, points]),
            np.append(self.costs, costs),
        )


def mixture(factors: Array, target: Array, columns: Columns, shared: bool) -> tuple[float, Array, Array]:
    """The cheapest mixture of columns that reaches the target: its cost, psi, and the controls.

    Parameters
    ----------
    factors : (steps, 3, m) array
        G_k, best scaled so that the sum of G G' is the identity.
    target : (3,) array
        b.
    columns : Columns
    shared : bool
        Whether the largest total weight of a step is the cost (the gauge), else it is at most 1 and each
        column costs its own.

    Raises
    ------
    pontryagin.NotConverged
        If HiGHS finds no mixture.
    """
    from scipy.optimize import linprog

    steps = len(factors)
    reach = np.einsum("nij,nj->in", factors[columns.owners], columns.points)
    within = (columns.owners == np.arange(steps)[:, None]).astype(float)
    last = float(shared)
    equal = np.hstack([reach, np.zeros((3, 1))])
    below = np.hstack([within, np.full((steps, 1), -last)])
    for precision in PRECISIONS:
        tolerances = dict.fromkeys(("primal_feasibility_tolerance", "dual_feasibility_tolerance"), precision)
        found = linprog(  # type: ignore[call-overload]
            np.append((1 - last) * columns.costs, last),
            A_ub=below,
            b_ub=np.full(steps, 1 - last),
            A_eq=equal,
            b_eq=target,
            method="highs-ds",
            options=tolerances,
        )
        if found.status == 0:
            break
    else:
        raise NotConverged(f"HiGHS stopped: {found.message}", float("inf"))
    controls = np.zeros((steps, columns.points.shape[1]))
    np.add.at(controls, columns.owners, found.x[:-1, None] * columns.points)
    miss = target - np.einsum("kij,kj->i", factors, controls)
    return float(found.fun), found.eqlin.marginals, controls + np.einsum("kij,i->kj", factors, miss)


def whitened(factors: Array, target: Array) -> tuple[NDArray, NDArray]:
    """G_k and b in the coordinates in which the sum of G G' is the identity."""
    root = np.linalg.cholesky(np.einsum("kij,klj->il", factors, factors))
    return np.linalg.solve(root, factors), np.linalg.solve(root, target)
