"""The gauge as a cone programme for Clarabel, through its own interface, in both of its forms.

impulses  min t over |w_k| <= t with sum of G_k w_k = -z0; for the square |w_kj| <= t
costate   max (-z0, psi) over sum of s_k <= 1 with |G_k'psi| <= s_k

A solver is set up once for each number of steps; a new state changes one of its vectors.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from benchmarks.orbit_correction.states import Solver, unit_factors


def impulses(name: str, steps: int) -> Solver:
    """The programme in the impulses; the state is on the right-hand side."""
    factors = unit_factors(name, steps)
    _, _, width = factors.shape
    components = steps * width
    reach = sparse.csc_matrix(np.moveaxis(factors, 1, 0).reshape(3, -1))
    balance = sparse.hstack([reach, sparse.csc_matrix((3, 1))])
    identity, one = sparse.identity(components), np.ones((components, 1))
    if name == "box":
        within = sparse.vstack([sparse.hstack([identity, -one]), sparse.hstack([-identity, -one])])
    else:
        level = sparse.kron(np.ones((steps, 1)), _size_entry(width))
        parts = sparse.kron(sparse.identity(steps), _vector_entries(width))
        within = -sparse.hstack([parts, level])
    constraints = sparse.csc_matrix(sparse.vstack([balance, within]))
    cost = np.append(np.zeros(components), 1.0)
    right = np.zeros(constraints.shape[0])
    solver, settle = _clarabel(cost, constraints, right, 3, 0, _cones(name, steps, width))

    def solve(state: NDArray) -> float:
        right[:3] = -state
        solver.update(b=right)
        return settle(solver.solve())

    return solve


def costate(name: str, steps: int) -> Solver:
    """The programme in the costate; the state is the cost."""
    factors = unit_factors(name, steps)
    _, _, width = factors.shape
    along = np.moveaxis(factors, 2, 1).reshape(-1, 3)
    count = steps * width if name == "box" else steps
    if name == "box":
        identity = sparse.identity(count)
        within = sparse.vstack([sparse.hstack([along, -identity]), sparse.hstack([-along, -identity])])
    else:
        sizes = sparse.kron(sparse.identity(steps), _size_entry(width))
        psi = sparse.kron(sparse.identity(steps), _vector_entries(width)) @ sparse.csc_matrix(along)
        within = -sparse.hstack([psi, sizes])
    total = np.concatenate([np.zeros(3), np.ones(count)])[None]
    constraints = sparse.csc_matrix(sparse.vstack([total, within]))
    right = np.append(1.0, np.zeros(constraints.shape[0] - 1))
    cost = np.append(np.ones(3), np.zeros(count))
    solver, settle = _clarabel(cost, constraints, right, 0, 1, _cones(name, steps, width))

    def solve(state: NDArray) -> float:
        cost[:3] = state
        solver.update(q=cost)
        return -settle(solver.solve())

    return solve


def _size_entry(width: int) -> NDArray:
    """A column (width + 1, 1) that selects the first entry of a cone, the size."""
    return np.eye(width + 1)[:, :1]


def _vector_entries(width: int) -> NDArray:
    """Columns (width + 1, width) that select the other entries of a cone, the vector that the size bounds."""
    return np.eye(width + 1)[:, 1:]


def _cones(name: str, steps: int, width: int) -> list:
    import clarabel

    if name == "box":
        return [clarabel.NonnegativeConeT(2 * steps * width)]
    return [clarabel.SecondOrderConeT(width + 1)] * steps


def _clarabel(
    cost: NDArray, constraints: sparse.csc_matrix, right: NDArray, equal: int, above: int, cones: list
):
    import clarabel

    settings = clarabel.DefaultSettings()
    settings.verbose, settings.presolve_enable, settings.max_threads = False, False, 1
    lead = [clarabel.ZeroConeT(equal)] if equal else [clarabel.NonnegativeConeT(above)]
    quadratic = sparse.csc_matrix((len(cost), len(cost)))
    solver = clarabel.DefaultSolver(quadratic, cost, constraints, right, lead + cones, settings)

    def settle(solution) -> float:
        return solution.obj_val if solution.status == clarabel.SolverStatus.Solved else float("nan")

    return solver, settle
