"""The initial costate whose mean rates lead towards the target: a convex problem, by cutting planes.

Among the costates p with H0(p) <= 0, a convex set, the one with the largest p'd is a costate whose mean rates
have the direction d. The costate along the target's gradient may be far from it: where the mean of |s| over
a turn does not depend on a component of p, the rates have a corner, and all costates around have the same.
"""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import Problem

CUTS = 60
"""Largest number of cutting planes."""
CLOSE_ENOUGH = 1e-2
"""H0, relative to its value at a zero costate, at which the search ends: it is for a guess."""
FARTHEST = 1e3
"""Bound on the multipliers, relative to those of the first costate."""


def aimed(problem: Problem, towards: Array, normals: Array, first: Array, idle: float) -> Array | None:
    """A costate (n,) of one problem (1) at its start; None if there is none within the bounds.

    Parameters
    ----------
    problem : Problem
        One problem.
    towards : (n,) array
        From the start to the target.
    normals : (r, n) array
        The target's gradients, of which the costate is a combination.
    first : (n,) array
        A costate with H0 = 0, from which the search begins.
    idle : float
        H0 at a zero costate, negative.
    """
    from scipy.optimize import linprog  # few problems need it, and it takes longer to import than to solve

    n = len(towards)
    multipliers: Array = np.asarray(np.linalg.lstsq(normals.T, first, rcond=None)[0])
    most = FARTHEST * float(np.abs(multipliers).max())
    rows, right = np.empty((0, len(normals))), np.empty(0)
    for _ in range(CUTS):
        p = normals.T @ multipliers
        h = problem.hamiltonian(np.concatenate([problem.start[0], p])[None, None])
        value, slope = float(h.value[0, 0]), normals @ h.gradient[0, 0, n:]
        if not np.isfinite(value) or not np.isfinite(slope).all():
            return None
        if len(rows) and value <= CLOSE_ENOUGH * abs(idle):
            return p if np.abs(multipliers).max() < 0.9 * most else None
        rows, right = np.vstack([rows, slope]), np.append(right, slope @ multipliers - value)
        found = linprog(-(normals @ towards), A_ub=rows, b_ub=right, bounds=(-most, most))
        if not found.success:
            return None
        multipliers = np.asarray(found.x)
    return None
