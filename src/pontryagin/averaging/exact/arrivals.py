"""Exact extremals whose control follows the sign of one costate: one slow variable, a costless control.

The control depends on the sign of p alone. So there is one trajectory a(x) for each sign, which can end only
where it arrives at the target. An arrival is an extremal if there is a costate that keeps this sign: p1
follows from h* = 0 at the end, and p from p1 by integration backwards. As the switching function has no zero,
nearby controls cost more to first order, so that each extremal is a local minimum. There is no family over
the ending anomaly along which to differentiate: (2.13) and (2.15) are zero.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
import sympy as sp
from scipy.optimize import brentq

from pontryagin.arrays import Array
from pontryagin.averaging.exact.arcs import switched_flow
from pontryagin.averaging.exact.canonical import Canonical, y
from pontryagin.averaging.exact.shooting import Shooting, Shot
from pontryagin.errors import NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import Flow, flow
from pontryagin.progress import report

SIGN = sp.Symbol("sign_p", real=True)
FINE = 64
"""Number of points of a turn between which arrivals are sought."""
STRETCHES = 10_000
"""Largest number of pieces in which the trajectory is followed."""
CLOSE = 1e-9
"""Largest relative distance from the start at which a backward trajectory counts as arrived there."""


def fixed_ending(equations: Canonical) -> bool:
    """Whether the trajectory depends on the sign of the one costate alone."""
    return len(equations.slow) == 1 and equations.free


def arrivals(problem: Shooting, sign: float, turns: float) -> Shot:
    """The extremals whose costate has the given sign, by rising duration.

    Parameters
    ----------
    problem : Shooting
        With one slow variable.
    sign : float
        1 or -1, that of the averaged costate.
    turns : float
        Turns of the averaged solution, a first guess of those of the extremals.

    Raises
    ------
    NotConverged
        If the trajectory does not arrive, or no arrival is an extremal.
    """
    found = [
        shot
        for anomaly, energy in _crossings(problem, sign, turns)
        if (shot := _extremal(problem, sign, anomaly, energy)) is not None
    ]
    if not found:
        raise NotConverged("no trajectory that arrives at the target is an extremal", np.inf)
    return Shot.joined(found)


def _crossings(problem: Shooting, sign: float, turns: float) -> list[tuple[float, float]]:
    """Anomalies where the trajectory meets the target, with a there, sought until a turn has none."""
    follow = _trajectory(problem.equations, sign)
    state, begin = np.append(problem.start, [0.0, 0.0]), problem.anomaly
    found: list[tuple[float, float]] = []
    points = FINE * max(int(np.ceil(turns / 4)), 1)
    for _ in range(STRETCHES):
        report(f"following the trajectory, turn {(begin - problem.anomaly) / (2 * np.pi):.0f}")
        grid = begin + 2 * np.pi * np.arange(points + 1) / FINE
        try:
            path = follow(state, grid, problem.parameters)
        except NotConverged:
            if points > 1:
                points //= 2
                continue
            if found:
                return found
            raise
        missing = _target(problem.equations)(path[:, 0], *problem.parameters)[0]
        at = np.nonzero((missing[:-1] > 0) != (missing[1:] > 0))[0]
        found += [_refined(problem, sign, path[i], grid[i], grid[i + 1]) for i in at]
        state, begin = path[-1], grid[-1]
        if found and begin > found[-1][0] + 2 * np.pi:
            return found
        points = min(points, FINE) if found else points
    raise NotConverged(
        f"the trajectory does not arrive at the target before the anomaly {begin:.6g}",
        float(abs(missing[-1])),
    )


def _refined(problem: Shooting, sign: float, state: Array, low: float, high: float) -> tuple[float, float]:
    follow = _trajectory(problem.equations, sign)

    def at(anomaly: float) -> Array:
        return state if anomaly == low else follow(state, np.array([low, anomaly]), problem.parameters)[-1]

    def missing(anomaly: float) -> float:
        return float(_target(problem.equations)(at(anomaly)[0], *problem.parameters)[0])

    anomaly = float(brentq(missing, low, high, xtol=1e-14, rtol=1e-15))
    return anomaly, float(at(anomaly)[0])


def _extremal(problem: Shooting, sign: float, anomaly: float, energy: float) -> Shot | None:
    """The extremal that ends in an arrival, if its costate keeps the sign all along."""
    price, rate = _end(problem.equations)(energy, anomaly, sign, *problem.parameters)
    last = float(price / rate)
    if last * sign <= 0:
        return None
    _, gradient, jacobian, _ = problem.boundary(np.array([[energy]]), np.zeros((1, 2)))
    alpha = -(last + gradient[0, 0, 0]) / jacobian[0, 0, 0]
    start = np.array([[energy, last, 0.0, 0.0, 0.0]])
    (back,) = problem.carry(start, anomaly, problem.anomaly)
    if back[1] * sign <= 0 or abs(back[0] - problem.start[0]) > CLOSE * problem.scale_a[0]:
        return None
    return problem.shoot(np.array([anomaly]), np.array([[back[1], alpha]]))


@lru_cache(maxsize=16)
def _trajectory(equations: Canonical, sign: float) -> Flow:
    """The flow of (a, tau, J) over the anomaly, under the control for a sign of p."""
    known = {equations.costates[0]: sp.Integer(int(sign)), y: sp.Integer(0)}
    modes = []
    for mode, switching in equations.modes:
        function = switching.xreplace(known)
        if function.is_number:
            known[mode] = sp.sign(function)
        else:
            modes.append((mode, function))
    rates = tuple(equations.rates[i].xreplace(known) for i in (0, 3, 4))
    states = (*equations.slow, *equations.states[3:])
    if modes:
        return switched_flow(tuple(modes), states, rates, equations.parameters, equations.anomaly)
    return flow(states, rates, equations.parameters, clock=equations.anomaly)


@lru_cache(maxsize=16)
def _target(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    return compiler.function("target", [*equations.slow, *equations.parameters], {"M": equations.boundary[0]})


@lru_cache(maxsize=16)
def _end(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    """The running cost, and f at the control for a sign of p: p1 is their quotient, h* being zero."""
    known = {equations.costates[0]: SIGN, y: sp.Integer(0)}
    f = equations.motion[0].subs(known)
    price = SIGN * f - equations.hamiltonian.subs(known)
    arguments = [*equations.slow, equations.anomaly, SIGN, *equations.parameters]
    return compiler.function("end", arguments, {"price": price, "rate": f})
