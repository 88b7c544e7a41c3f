"""SciPy's solve_bvp on the repaired form, with its Jacobians, from a neighbouring problem's trajectory."""

from typing import Any

import numpy as np
from scipy.integrate import solve_bvp

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import derivative, jacobian
from pontryagin.rendezvous import Extremal, Rendezvous, kernels
from pontryagin.rendezvous.reduced.conditions import SEEN
from pontryagin.rendezvous.reduced.flight import chart_of

NODES, MOST = 60, 20_000
"""Number of nodes of the initial mesh, and the maximum number of nodes."""


def collocate(problem: Rendezvous, start: Extremal, tolerance: float) -> Any:
    """SciPy's solution, whose ``status`` is 0 if solve_bvp has reached its tolerance.

    The unknown functions are the eleven states; their argument is the time over the duration. A free
    duration, which only problems of least time have here, is an unknown parameter. Derivatives are exact to
    rounding, by a complex step.
    """
    scaled, free = problem.scaled, problem.free
    chart = chart_of(start.flight.costates)
    shares = np.linspace(0, 1, NODES)
    guess = start.flight.sample(shares * start.flight.duration)[:, :11].T
    fixed = scaled.duration or start.flight.duration
    first = np.array([*scaled.start, scaled.anomaly, 0.0])

    def rates(x: Array, duration: complex | float) -> Array:
        parameters = (1.0, 1.0, scaled.eccentricity, 1.0)
        loose = np.array(kernels.unsaturated(*[*x, *parameters, 1.0, chart]))
        if scaled.peak == np.inf:
            return loose * duration
        tight = np.array(kernels.saturated(*[*x, *parameters, scaled.peak, chart]))
        square = kernels.switching_square(x[0], x[2], x[5], x[6], x[7])
        bound = free or np.real(square) > (2 * scaled.peak) ** 2
        return np.where(bound, tight, loose) * duration

    def ends(xa: Array, xb: Array) -> Array:
        goal = kernels.target(xb[3], 1.0, scaled.eccentricity, 1.0, *scaled.orientation)
        goals = [*goal[:3], *goal[4:]]
        missed = kernels.mismatch(*[*xb[SEEN], *xa[7:10], chart, *goals])
        law = []
        if free:
            square = kernels.switching_square(xb[0], xb[2], xb[5], xb[6], xb[7])
            law = [square * scaled.peak**2 - 1]
        return np.array([*(xa[[0, 1, 2, 3, 10]] - first), *missed, *law])

    def fun(_, x, p=(fixed,)):
        return rates(x, p[0])

    def fun_jac(_, x, p=(fixed,)):
        _, by_state = jacobian(lambda lifted: rates(lifted, p[0]), x)
        return (by_state, rates(x, 1.0)[:, None]) if free else by_state

    def bc(xa, xb, _=None):
        return ends(xa, xb)

    def bc_jac(xa, xb, _=None):
        size = 12 if free else 11
        by_start = np.stack([derivative(lambda x: ends(x, xb), xa, u)[1] for u in np.eye(11)], axis=-1)
        by_end = np.stack([derivative(lambda x: ends(xa, x), xb, u)[1] for u in np.eye(11)], axis=-1)
        return (by_start, by_end, np.zeros((size, 1))) if free else (by_start, by_end)

    with np.errstate(all="ignore"):
        return solve_bvp(
            fun,
            bc,
            shares,
            guess,
            p=[start.flight.duration] if free else None,
            tol=tolerance,
            max_nodes=MOST,
            fun_jac=fun_jac,
            bc_jac=bc_jac,
        )


def cost(problem: Rendezvous, found: Any) -> float:
    """The cost of a solution in the user's units; nan if solve_bvp failed."""
    scaled = problem.scaled
    if found.status:
        return float("nan")
    if scaled.duration is None:
        return float(found.p[0]) * scaled.value
    nodes, weights = np.polynomial.legendre.leggauss(8)
    edges = np.linspace(0, 1, 4001)
    half = np.diff(edges)[:, None] / 2
    x = found.sol((edges[:-1, None] + half * (1 + nodes)).ravel())
    size = np.sqrt(kernels.switching_square(x[0], x[2], x[5], x[6], x[7])) / 2
    squares = np.minimum(size, scaled.peak).reshape(-1, 8) ** 2
    return float(np.sum(half * weights * squares)) * scaled.duration * scaled.value
