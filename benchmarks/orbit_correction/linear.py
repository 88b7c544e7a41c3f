"""The square's gauge as a linear programme for HiGHS, in its fastest form.

The programme is max s over sum of g_k w_k = -s z0 and |w_k| <= 1. It has only three equations, since the
constraints on w_k are bounds instead of rows.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from benchmarks.orbit_correction.states import Solver, unit_factors
from pontryagin.arrays import Array


def by_linprog(name: str, steps: int) -> Solver:
    """The programme through SciPy's `linprog`."""
    segments = _segments(name, steps)
    cost = np.append(np.zeros(segments.shape[1]), -1.0)
    bounds = np.array([[-1.0, 1.0]] * segments.shape[1] + [[0.0, np.inf]])

    def solve(state: NDArray) -> float:
        rows = np.column_stack([segments, state])
        found = linprog(cost, A_eq=rows, b_eq=np.zeros(3), bounds=bounds, method="highs")
        return -1 / found.fun if found.status == 0 else float("nan")

    return solve


def by_highspy(name: str, steps: int) -> Solver:
    """By HiGHS's own interface: a state changes three coefficients, and the last basis is the start."""
    import highspy

    segments = _segments(name, steps)
    count = segments.shape[1]
    solver = highspy.Highs()
    solver.setOptionValue("output_flag", False)
    solver.setOptionValue("threads", 1)
    solver.addVars(count + 1, np.full(count + 1, -1.0), np.ones(count + 1))
    solver.changeColBounds(count, 0.0, highspy.kHighsInf)
    solver.changeColCost(count, -1.0)
    for row in segments:
        entries = np.append(row, 1.0)
        solver.addRow(0.0, 0.0, count + 1, np.arange(count + 1, dtype=np.int32), entries)

    def solve(state: NDArray) -> float:
        for i in range(3):
            solver.changeCoeff(i, count, float(state[i]))
        solver.run()
        done = solver.getModelStatus() == highspy.HighsModelStatus.kOptimal
        return -1 / solver.getInfo().objective_function_value if done else float("nan")

    return solve


def _segments(name: str, steps: int) -> Array:
    """The effects of the impulse components on the initial state, (3, components)."""
    if name != "box":
        raise ValueError(f"only the box is a linear programme, got {name!r}")
    return np.moveaxis(unit_factors(name, steps), 1, 0).reshape(3, -1)
