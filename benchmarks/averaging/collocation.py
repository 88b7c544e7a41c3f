"""SciPy's solve_bvp on the exact problem, from the averaged solution, and which extremal it finds.

The independent variable is the anomaly, scaled to run from 0 to 1; its final value theta and the multipliers
are the unknown parameters. The initial guess is the averaged solution: xi, eta, and y from H = 0, at `A_TURN`
points per turn. The Jacobian of the right-hand side is supplied.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import solve_bvp

from benchmarks.averaging.enumeration import timed
from benchmarks.averaging.examples import BODY, EXAMPLES, KEPLER, PAID, SMOOTH
from benchmarks.table import by_heading
from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.canonical import (
    Canonical,
    y,
)
from pontryagin.averaging.exact.extremal import (
    Extremal,
    Extremals,
)
from pontryagin.averaging.exact.shooting import (
    Shooting,
    shooting,
)
from pontryagin.numerics import compile as compiler

EPSILONS = (0.1, 0.05, 0.02, 0.01, 0.005)
SHOWN = (0.05, 0.02)
"""Values of epsilon at which the figure shows the smooth example."""
QUICK = (0.1,)
LEAST = {BODY: 0.05, PAID: 0.02, KEPLER: 0.01}
"""Least epsilon that is run, for examples that are too slow at smaller ones."""
TOLERANCE, NODES, A_TURN = 1e-6, 20_000, 24
SAME = 1e-3
"""Largest difference from a known extremal, of the final anomaly in radians and of the cost relatively."""


@dataclass(frozen=True)
class Boundary:
    """The exact problem in the form of solve_bvp: states (a, p, y, tau, J), parameters (theta, alpha)."""

    problem: Shooting

    def rates(self, s: Array, z: Array, q: Array) -> Array:
        """dz/ds (2n + 3, k)."""
        return (q[0] - self.problem.anomaly) * self._slopes(s, z, q)[0].T

    def jacobians(self, s: Array, z: Array, q: Array) -> tuple[Array, Array]:
        """Derivatives of the rates by z (2n + 3, 2n + 3, k) and by the parameters (2n + 3, 1 + r, k)."""
        slopes, by_state, by_anomaly = self._slopes(s, z, q)
        length = q[0] - self.problem.anomaly
        by_parameters = np.zeros((len(z), len(q), len(s)))
        by_parameters[:, 0] = (slopes + length * s[:, None] * by_anomaly).T
        return length * np.moveaxis(by_state, 0, -1), by_parameters

    def missing(self, first: Array, last: Array, q: Array) -> Array:
        """Boundary residuals: a - a0, H, tau and J at the start; M, p + g' + alpha M' and y at the end."""
        problem, n = self.problem, len(self.problem.start)
        (h,) = _hamiltonian(problem.equations)(*first[: 2 * n + 1], problem.anomaly, *problem.parameters)
        left, _, _ = problem.missing(last[None], q[:1], np.concatenate([last[n : 2 * n], q[1:]])[None])
        return np.concatenate([first[:n] - problem.start, [h], first[-2:], left[0], last[2 * n : 2 * n + 1]])

    def _slopes(self, s: Array, z: Array, q: Array) -> tuple[Array, ...]:
        x = self.problem.anomaly + (q[0] - self.problem.anomaly) * s
        rates, by_state, by_anomaly = _slopes(self.problem.equations)(*z, x, *self.problem.parameters)
        return rates[..., 0], by_state, by_anomaly[..., 0]


@lru_cache(maxsize=8)
def _slopes(equations: Canonical):
    rates = sp.Matrix(equations.unswitched(equations.rates))
    outputs = {
        "rates": rates,
        "by_state": rates.jacobian(equations.states),
        "by_anomaly": rates.diff(equations.anomaly),
    }
    return compiler.function("slopes", [*equations.states, equations.anomaly, *equations.parameters], outputs)


@lru_cache(maxsize=8)
def _hamiltonian(equations: Canonical):
    arguments = [*equations.slow, *equations.costates, y, equations.anomaly, *equations.parameters]
    return compiler.function("hamiltonian", arguments, {"h": equations.hamiltonian})


def posed(solution: AveragedSolution, epsilon: float) -> tuple[Boundary, Array, Array, Array]:
    """The problem, and the averaged solution as mesh (k,), states (2n + 3, k) and parameters (1 + r)."""
    held = solution if solution.frame is None else solution.frame(solution)
    begin = float(solution.anomaly(np.zeros(1), epsilon)[0])
    end = float(solution.anomaly(solution.duration, epsilon)[0])
    problem = shooting(held, epsilon, begin)
    turns = (end - begin) / (2 * np.pi)
    tau = np.linspace(0.0, float(solution.duration), int(A_TURN * turns) + 2)
    x = solution.anomaly(tau, epsilon)
    a, p = held.slow(tau).T, held.costate(tau).T
    (h,) = _hamiltonian(problem.equations)(*a, *p, 0.0, x, *problem.parameters)
    ((rate),) = _rate(problem.equations)(*a, x, *problem.parameters)
    share = float(solution.cost / solution.duration)
    states = np.vstack([a, p, -h / rate, tau, share * tau])
    parameters = np.concatenate([[end], np.atleast_1d(held.multipliers)])
    return Boundary(problem), (x - begin) / (end - begin), states, parameters


@lru_cache(maxsize=8)
def _rate(equations: Canonical):
    return compiler.function(
        "rate", [*equations.slow, equations.anomaly, *equations.parameters], {"r": equations.rate}
    )


def collocated(solution: AveragedSolution, epsilon: float):
    """The result of solve_bvp."""
    boundary, mesh, states, parameters = posed(solution, epsilon)
    with np.errstate(all="ignore"):
        return solve_bvp(
            boundary.rates,
            boundary.missing,
            mesh,
            states,
            parameters,
            fun_jac=boundary.jacobians,
            tol=TOLERANCE,
            max_nodes=NODES,
        )


def landed(found: Extremals, theta: float, cost: float) -> tuple[int, Extremal] | None:
    """Rank by cost, from 1, and extremal that ends at the anomaly theta with this cost; otherwise None."""
    for place, extremal in enumerate(found, 1):
        near = abs(extremal.ending_anomaly - theta) < SAME
        if near and abs(extremal.cost - cost) < SAME * abs(extremal.cost):
            return place, extremal
    return None


def table(quick: bool) -> dict[str, list]:
    """Extremal found and time taken by solve_bvp, compared with our enumeration of all extremals."""
    rows = []
    for name in (SMOOTH,) if quick else (SMOOTH, PAID, KEPLER, BODY):
        solution = EXAMPLES[name].one()
        solution.exact(0.1)
        for epsilon in QUICK if quick else [e for e in EPSILONS if e >= LEAST.get(name, 0.0)]:
            rows.append({"example": name, "epsilon": epsilon} | _compared(solution, epsilon))
    return by_heading(rows)


def landing(epsilon: float) -> tuple[Extremals, tuple[float, float]]:
    """All extremals of the smooth example, and the duration and cost that solve_bvp finds."""
    solution = EXAMPLES[SMOOTH].one()
    answer = collocated(solution, epsilon)
    return solution.exact(epsilon), (float(answer.y[-2, -1]), float(answer.y[-1, -1]))


def _compared(solution: AveragedSolution, epsilon: float) -> dict[str, Any]:
    _slopes(posed(solution, epsilon)[0].problem.equations)
    found, ours = timed(lambda: solution.exact(epsilon))
    answer, theirs = timed(lambda: collocated(solution, epsilon))
    end = landed(found, float(answer.p[0]), float(answer.y[-1, -1])) if answer.success else None
    says = {0: "converged", 1: "too many nodes", 2: "singular Jacobian", 3: "boundary not met"}[answer.status]
    kind, place, excess = "no extremal", None, None
    if end is not None:
        kind, place, excess = f"a {end[1].kind}", end[0], end[1].cost / found[0].cost - 1
    return {
        "solve_bvp, ms": 1e3 * theirs,
        "nodes": len(answer.x),
        "it says": says,
        "lands on": kind,
        "its place by cost": place,
        "dearer than the best": excess,
        "all extremals by ours": len(found),
        "ours, ms": 1e3 * ours,
        "times ours, for one": theirs / ours,
    }
