"""Linear cone programmes for Clarabel, through its own interface."""

from collections.abc import Callable, Sequence
from typing import Any

from numpy.typing import NDArray
from scipy import sparse


def programme(
    cost: NDArray, constraints: NDArray | sparse.sparray, right: NDArray, cones: Sequence[tuple[str, int]]
) -> tuple[Any, Callable[[Any], float]]:
    """min cost.x with right - constraints x in a product of cones, set up once to be updated and solved.

    Returns the solver, and the optimum that its solution holds, nan if there is none. A cone is a name,
    "Zero", "Nonnegative" or "SecondOrder", and a size.
    """
    import clarabel

    settings = clarabel.DefaultSettings()
    settings.verbose, settings.presolve_enable, settings.max_threads = False, False, 1
    quadratic = sparse.csc_matrix((len(cost), len(cost)))
    made = [getattr(clarabel, f"{name}ConeT")(size) for name, size in cones]
    solver = clarabel.DefaultSolver(quadratic, cost, sparse.csc_matrix(constraints), right, made, settings)

    def optimum(solution: Any) -> float:
        solved = solution.status == clarabel.SolverStatus.Solved
        return solution.obj_val if solved else float("nan")

    return solver, optimum
