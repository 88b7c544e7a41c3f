"""The gauge through CVXPY with Clarabel; the state is a parameter, so that the model is compiled once."""

import numpy as np
from numpy.typing import NDArray

from benchmarks.orbit_correction.states import Solver, unit_factors


def by_cvxpy(name: str, steps: int) -> Solver:
    """The programme min t over impulses of size at most t that bring the state to 0."""
    import cvxpy as cp

    factors = unit_factors(name, steps)
    reach = np.moveaxis(factors, 1, 0).reshape(3, -1)
    controls, state, peak = cp.Variable((steps, factors.shape[2])), cp.Parameter(3), cp.Variable()
    size = cp.abs(controls) if name == "box" else cp.norm(controls, axis=1)
    balance = reach @ cp.vec(controls, order="C") == -state
    problem = cp.Problem(cp.Minimize(peak), [balance, size <= peak])

    def solve(value: NDArray) -> float:
        state.value = value
        found = problem.solve(solver=cp.CLARABEL, max_threads=1)
        return float(found) if problem.status == cp.OPTIMAL else float("nan")

    solve(np.ones(3))
    return solve
