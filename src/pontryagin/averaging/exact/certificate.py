"""The certificate of an exact extremal, which is propagated again in slow time.

The search integrates over the anomaly, several extremals side by side if nothing switches. Here the
independent variable is slow time, so that the equations and the steps are others, each extremal is followed
alone, and h* comes from the support function and not from the control that attains it.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.exact.arcs import switched_flow
from pontryagin.averaging.exact.canonical import Canonical, y
from pontryagin.averaging.exact.shooting import TOLERANCE, Shooting, Shot
from pontryagin.certificate import TINY, MaximumPrinciple
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import Flow, integrator
from pontryagin.numerics.symbolic import Symbolic

SAMPLES = 200
"""The Hamiltonian and its maximum are evaluated at this many points of the trajectory."""
SWIFT = 4.0
"""How many times its mean rate the anomaly may have where steps must not pass over features."""


def certificate(problem: Shooting, shot: Shot) -> MaximumPrinciple:
    """Residuals of one extremal.

    Target and costates are in the units of `Shooting`, the Hamiltonian and p_x/epsilon times the rate are
    relative to the mean running cost, and the error of the cost is relative to the cost.

    Parameters
    ----------
    problem : Shooting
    shot : Shot
        With one extremal.

    Raises
    ------
    NotConverged
        If the extremal cannot be followed.
    """
    n, r = len(problem.start), len(problem.scale_m)
    start = np.append(problem.starts(shot.unknowns)[0], problem.anomaly)
    times = np.linspace(0.0, 1.0, SAMPLES + 1) * shot.duration
    longest = problem.longest * shot.duration[0] / max(abs(shot.theta[0] - problem.anomaly), TINY)
    path = _follow(problem.equations)(start, times, problem.parameters, longest / SWIFT)
    price = float(np.abs(shot.cost[0]) / shot.duration[0])
    values = _along(problem.equations)(*path[:, : 2 * n + 1].T, path[:, -1], *problem.parameters)
    hamiltonian, gap = (np.abs(value).max() / price for value in values)
    missing, cost, rate = problem.missing(path[-1:, :-1], path[-1:, -1], shot.unknowns)
    boundary = max(np.abs(missing[:, :r]).max(), np.abs(cost / shot.cost - 1).max())
    last = np.abs(path[-1, 2 * n] * rate).max() / price
    parts = (boundary, max(np.abs(missing[:, r:]).max(), last), hamiltonian, gap)
    return MaximumPrinciple(*(np.asarray(part) for part in parts))


@lru_cache(maxsize=32)
def _along(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    arguments = [*equations.slow, *equations.costates, y, equations.anomaly, *equations.parameters]
    return compiler.function("along", arguments, {"hamiltonian": equations.hamiltonian, "gap": equations.gap})


@lru_cache(maxsize=32)
def _follow(equations: Canonical) -> Flow:
    """The flow of (a, p, y, tau, J, x) in slow time."""
    states, rates = (*equations.states, equations.anomaly), equations.time_rates
    if equations.modes:
        return switched_flow(equations.modes, states, rates, equations.parameters)
    along = integrator(Symbolic(states, rates, equations.parameters), TOLERANCE)
    return lambda start, times, parameters, longest: along.sample(start, times, parameters, longest)[0]
