"""Least energy, L4 norm and peak by generic tools: SciPy's solve_bvp and CasADi with Ipopt."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp

from benchmarks.peers import absent
from benchmarks.triple_integrator.fixed_time import Peer, Solver

NODES = 100

EXPONENTS = {"least energy": 2, "least L4 norm": 4, "least peak": 0}
"""Even exponents of the norms, and 0 for the peak."""


def boundary_value_problem(tolerance: float) -> Solver:
    """Least L2 norm from the linear boundary value problem of the maximum principle, with its Jacobians."""
    flow = np.zeros((6, 6))
    for row, column, value in ((0, 1, 1), (1, 2, 1), (2, 5, 1), (4, 3, -1), (5, 4, -1)):
        flow[row, column] = value
    at_start, at_end = np.zeros((6, 6)), np.zeros((6, 6))
    at_start[:3, :3] = at_end[3:, :3] = np.eye(3)
    mesh, guess = np.linspace(0, 1, 11), np.zeros((6, 11))
    nodes, weights = np.polynomial.legendre.leggauss(20)
    nodes, weights = (nodes + 1) / 2, weights / 2

    def solve(x0: NDArray, xf: NDArray) -> float:
        found = solve_bvp(
            lambda t, y: flow @ y,
            lambda a, b: np.concatenate([a[:3] - x0, b[:3] - xf]),
            mesh,
            guess,
            tol=tolerance,
            fun_jac=lambda t, y: np.repeat(flow[:, :, None], len(t), axis=2),
            bc_jac=lambda a, b: (at_start, at_end),
        )
        return float(np.sqrt(weights @ found.sol(nodes)[5] ** 2)) if found.success else float("nan")

    return solve


def direct(q: int) -> Solver:
    """Least L_q norm, or for q = 0 least peak, by Ipopt for a control constant on `NODES` cells."""
    import casadi as ca

    h = 1 / NODES
    step = ca.DM([[1, h, h * h / 2], [0, 1, h], [0, 0, 1]])
    push = ca.DM([h**3 / 6, h * h / 2, h])
    x, u, ends = ca.MX.sym("x", 3, NODES + 1), ca.MX.sym("u", 1, NODES), ca.MX.sym("ends", 6)
    peak = ca.MX.sym("peak")
    equal = [ca.vec(x[:, 1:] - step @ x[:, :-1] - push @ u), x[:, 0] - ends[:3], x[:, -1] - ends[3:]]
    variables, above, cost = [ca.vec(x), ca.vec(u)], [], h * ca.sum2(u**q)
    if q == 0:
        variables, above, cost = [*variables, peak], [ca.vec(peak - u), ca.vec(peak + u)], peak
    programme: Any = {"x": ca.vertcat(*variables), "f": cost, "g": ca.vertcat(*equal, *above), "p": ends}
    options: Any = {"print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-10}}
    solver = ca.nlpsol("solver", "ipopt", programme, options)
    upper = np.concatenate([np.zeros(3 * NODES + 6), np.full(2 * NODES if q == 0 else 0, np.inf)])

    def solve(x0: NDArray, xf: NDArray) -> float:
        found = solver(x0=0, p=np.concatenate([x0, xf]), lbg=0, ubg=upper)
        if not solver.stats()["success"]:
            return float("nan")
        return float(found["f"]) ** (1 / max(q, 1))

    return solve


def peers(problem: str, quick: bool) -> dict[str, Peer]:
    """The generic tools that can solve a problem, with the number of problems for each."""
    size = 5 if quick else 20
    found: dict[str, Peer] = {}
    if problem == "least energy":
        for tolerance in ("1e-3", "1e-6"):
            solver = boundary_value_problem(float(tolerance))
            found[f"solve_bvp, tolerance {tolerance}"] = Peer(solver, size)
    if problem in EXPONENTS and not absent("casadi"):
        found[f"CasADi + Ipopt, {NODES} cells"] = Peer(direct(EXPONENTS[problem]), size)
    return found
