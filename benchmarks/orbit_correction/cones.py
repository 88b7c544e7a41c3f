"""The gauge as a cone programme for Clarabel, through its own interface, in both of its forms.

impulses  min t over |w_k| <= t with sum of G_k w_k = -z0; for the square |w_kj| <= t
costate   max (-z0, psi) over sum of s_k <= 1 with |G_k'psi| <= s_k

A solver is set up once for each number of steps; a new state changes one of its vectors.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from benchmarks.clarabel_programme import programme
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
    cost, right = np.append(np.zeros(components), 1.0), np.zeros(3 + within.shape[0])
    constraints, cones = sparse.vstack([balance, within]), [("Zero", 3), *_cones(name, steps, width)]
    solver, optimum = programme(cost, constraints, right, cones)

    def solve(state: NDArray) -> float:
        right[:3] = -state
        solver.update(b=right)
        return optimum(solver.solve())

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
    cost, right = np.append(np.ones(3), np.zeros(count)), np.append(1.0, np.zeros(within.shape[0]))
    constraints, cones = sparse.vstack([total, within]), [("Nonnegative", 1), *_cones(name, steps, width)]
    solver, optimum = programme(cost, constraints, right, cones)

    def solve(state: NDArray) -> float:
        cost[:3] = state
        solver.update(q=cost)
        return -optimum(solver.solve())

    return solve


def _size_entry(width: int) -> NDArray:
    """A column (width + 1, 1) that selects the first entry of a cone, the size."""
    return np.eye(width + 1)[:, :1]


def _vector_entries(width: int) -> NDArray:
    """Columns (width + 1, width) that select the other entries of a cone, the vector that the size bounds."""
    return np.eye(width + 1)[:, 1:]


def _cones(name: str, steps: int, width: int) -> list[tuple[str, int]]:
    return [("Nonnegative", 2 * steps * width)] if name == "box" else [("SecondOrder", width + 1)] * steps
