"""Least peak and least impulse as linear programmes on a grid: Clarabel and HiGHS, each in its fastest form.

The grid's optimum is that of controls constant on its cells (peak) or of impulses at its nodes (impulse). It
lies above the exact one by the error of the grid, to which the tolerance of the solver is added. With time as
a share of T the matrices are the same for every problem; they are built once, and this is not timed.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.optimize import Bounds, LinearConstraint, milp

from benchmarks.clarabel_programme import programme
from benchmarks.peers import absent
from benchmarks.triple_integrator.fixed_time import Peer, Solver


def peak_rows(cells: int) -> NDArray:
    """Scaled moments of a unit control on each cell, (3, cells)."""
    s = np.linspace(0, 1, cells + 1)
    return np.stack([np.diff(s**3), np.diff(s**2), np.diff(s)])


def impulse_rows(cells: int) -> NDArray:
    """Moments 1, sigma, sigma^2 of a unit impulse at each node, (3, cells + 1)."""
    s = np.linspace(0, 1, cells + 1)
    return np.stack([np.ones_like(s), s, s * s])


def clarabel_peak(cells: int) -> Solver:
    """min p over levels u with |u| <= p and the given moments; the solver is set up once and updated."""
    rows, identity, one = peak_rows(cells), np.eye(cells), np.ones((cells, 1))
    constraints = np.block([[rows, np.zeros((3, 1))], [identity, -one], [-identity, -one]])
    cost, right = np.append(np.zeros(cells), 1.0), np.zeros(3 + 2 * cells)
    solver, optimum = programme(cost, constraints, right, [("Zero", 3), ("Nonnegative", 2 * cells)])

    def solve(x0: NDArray, xf: NDArray) -> float:
        c1, c2, c3 = _scaled_moments(x0, xf)
        right[:3] = 3 * c1, 2 * c2, c3
        solver.update(b=right)
        return optimum(solver.solve())

    return solve


def clarabel_impulse(cells: int) -> Solver:
    """The dual programme in three variables: max p.mu over |p0 + p1 sigma + p2 sigma^2| <= 1 at the nodes."""
    nodes = impulse_rows(cells).T
    within = np.concatenate([nodes, -nodes])
    solver, optimum = programme(np.ones(3), within, np.ones(len(within)), [("Nonnegative", len(within))])

    def solve(x0: NDArray, xf: NDArray) -> float:
        solver.update(q=-np.array(_scaled_moments(x0, xf)[::-1]))
        return -optimum(solver.solve())

    return solve


def highs_peak(cells: int) -> Solver:
    """The programme of `clarabel_peak` through SciPy's `milp`, its shortest way to HiGHS."""
    rows, identity, one = peak_rows(cells), np.eye(cells), np.ones((cells, 1))
    constraints = sparse.csc_matrix(
        np.block([[rows, np.zeros((3, 1))], [identity, one], [identity, -one]]),
    )
    cost = np.append(np.zeros(cells), 1.0)
    low = np.concatenate([np.zeros(3 + cells), np.full(cells, -np.inf)])
    high = np.concatenate([np.zeros(3), np.full(cells, np.inf), np.zeros(cells)])
    free = Bounds(-np.inf, np.inf)

    def solve(x0: NDArray, xf: NDArray) -> float:
        c1, c2, c3 = _scaled_moments(x0, xf)
        low[:3] = high[:3] = 3 * c1, 2 * c2, c3
        found = milp(cost, constraints=LinearConstraint(constraints, low, high), bounds=free)
        return found.fun if found.success else float("nan")

    return solve


def highs_impulse(cells: int) -> Solver:
    """The dual of the impulse programme through SciPy's `milp`."""
    nodes = LinearConstraint(sparse.csr_matrix(impulse_rows(cells).T), -1.0, 1.0)
    free = Bounds(-np.inf, np.inf)

    def solve(x0: NDArray, xf: NDArray) -> float:
        found = milp(-np.array(_scaled_moments(x0, xf)[::-1]), constraints=nodes, bounds=free)
        return -found.fun if found.success else float("nan")

    return solve


def peers(problem: str, quick: bool) -> dict[str, Peer]:
    """Clarabel and HiGHS on grids of each size for linear programmes, with the number of problems each."""
    sizes = {100: 50} if quick else {100: 200, 400: 50, 1600: 10}
    found: dict[str, Peer] = {}
    if problem not in ("least peak", "least impulse"):
        return found
    peak = problem == "least peak"
    if not absent("clarabel"):
        build = clarabel_peak if peak else clarabel_impulse
        found |= {f"Clarabel, {cells} cells": Peer(build(cells), size) for cells, size in sizes.items()}
    build = highs_peak if peak else highs_impulse
    for cells, size in sizes.items():
        if not (peak and cells > 400):  # These take a second or more per problem.
            found[f"HiGHS, {cells} cells"] = Peer(build(cells), size // 5 if peak else size)
    return found


def _scaled_moments(x0: NDArray, xf: NDArray) -> tuple[float, float, float]:
    """2 c1, c2, c3 of (1.10) for unit duration."""
    (x10, x20, x30), (x1f, x2f, x3f) = x0.tolist(), xf.tolist()
    return 2 * (x1f - x10 - x20) - x30, x2f - x20 - x30, x3f - x30
