"""All extremals of the unaveraged problem: the roots of y1 over the family, bracketed and polished."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.arrivals import (
    arrivals,
    fixed_ending,
)
from pontryagin.averaging.exact.certificate import Proof
from pontryagin.averaging.exact.extremal import (
    Extremal,
    Extremals,
)
from pontryagin.averaging.exact.family import (
    Family,
    family,
)
from pontryagin.averaging.exact.members import nearby_extremal
from pontryagin.averaging.exact.refinement import (
    crossings,
    turns_resolved,
    with_members,
)
from pontryagin.averaging.exact.shooting import (
    Shooting,
    Shot,
    newton_step,
    shooting,
)
from pontryagin.averaging.system.anomaly import (
    anomaly_at,
    phase_at,
)
from pontryagin.errors import NotConverged
from pontryagin.validation import finite, positive

POLISHED = 1e-11
"""Residual of an extremal in the problem's own units."""
SLACK = 1e-6
"""How far beyond its bracket a root may lie: members, and their signs, are not polished."""


@dataclass(frozen=True)
class Roots:
    """Extremals (k) by rising theta.

    Attributes
    ----------
    shot : Shot
    slope : (k,) array
        dy1/dtheta along the family: positive at minima of J.
    """

    shot: Shot
    slope: Array


def extremals(solution, epsilon: ArrayLike, phase: ArrayLike) -> Extremals:
    """All exact extremals about the averaged one, the least cost first; see `AveragedSolution.exact`.

    Raises
    ------
    ValueError
        If epsilon is not positive, phase is not a finite number, or the solution is a stack.
    NotConverged
        If no extremal is found; at a large epsilon the averaged one may be too far from any.
    """
    small, begin = positive("epsilon", epsilon), finite("phase", phase, "a number")
    for name, value in (("epsilon", small), ("phase", begin)):
        if value.ndim:
            raise ValueError(f"{name} must be one number, got an array of shape {value.shape}")
    if solution.duration.shape:
        raise ValueError(f"exact takes one problem, got a stack of shape {solution.duration.shape}")
    if not solution.duration > 0:
        raise ValueError("exact takes a problem that is not solved at the start: the target holds there")
    start = anomaly_at(solution.model, solution.start, begin, solution.numbers)
    held = solution if solution.frame is None else solution.frame(solution)
    problem = shooting(held, float(small), float(start))
    centre = float(solution.anomaly(solution.duration, float(small), begin)[0])
    guess = np.concatenate([held.costate([0.0])[0], np.atleast_1d(held.multipliers)])
    traced, found = _found(problem, centre, guess)
    proof = Proof(problem, found.shot)

    def phase_of(slow: Array, anomaly: Array) -> Array:
        return phase_at(solution.model, slow, anomaly, solution.numbers)

    starts = problem.starts(found.shot.unknowns)
    items = [
        Extremal(
            cost=float(found.shot.cost[i]),
            duration=float(found.shot.duration[i]),
            kind="minimum" if found.slope[i] > 0 else "maximum",
            epsilon=float(small),
            starting_anomaly=float(start),
            ending_anomaly=float(found.shot.theta[i]),
            curvature=float(small * found.slope[i]),
            initial=starts[i],
            equations=problem.equations,
            parameters=problem.parameters,
            certify=partial(proof.one, i),
            turn_to_phase=phase_of,
            view=None if solution.frame is None else held.seen,
        )
        for i in np.argsort(found.shot.cost)
    ]
    return Extremals(tuple(items), float(small), float(begin), traced)


def _found(problem: Shooting, centre: float, guess: Array) -> tuple[Family | None, Roots]:
    if fixed_ending(problem.equations):
        turns = (centre - problem.anomaly) / (2 * np.pi)
        shot = arrivals(problem, float(np.sign(guess[0])), turns)
        return None, Roots(shot, np.full(len(shot.theta), np.inf))
    try:
        return roots(problem, family(problem, centre, guess))
    except NotConverged:
        return roots(problem, family(problem, *nearby_extremal(problem, centre, guess)))


def roots(problem: Shooting, traced: Family) -> tuple[Family, Roots]:
    """Bracket and polish every root of y1; returns the family with the members added on the way.

    Raises
    ------
    NotConverged
        If y1 does not vanish in the window, or a bracketed root is not found.
    """
    current = turns_resolved(problem, traced)
    if len(_sign_changes(current)) == 0:
        raise NotConverged("the phase's costate does not vanish in the window", float(np.abs(traced.y).min()))
    found: list[Roots] = []
    solved = np.empty(0)
    for _ in range(10):
        at = _sign_changes(current)
        at = at[~np.isin(current.theta[at], solved)]
        if len(at) == 0:
            return current, _sorted(found)
        low, high = current.theta[at], current.theta[at + 1]
        theta, unknowns = crossings(current, at)
        reached, good = _polished(problem, theta, unknowns, low, high, current.y)
        found.append(reached)
        solved = np.append(solved, low[good])
        if not good.all():
            current = with_members(problem, current, theta[~good])
    raise NotConverged("an extremal was bracketed but not found", float(np.abs(current.y[at]).max()))


def _sign_changes(current: Family) -> NDArray[np.intp]:
    """Members after which y1 changes sign; a root at a member lies before it."""
    positive = current.y >= 0
    return np.nonzero(positive[:-1] != positive[1:])[0]


def _polished(
    problem: Shooting, theta: Array, w: Array, low: Array, high: Array, y: Array
) -> tuple[Roots, NDArray[np.bool_]]:
    """Newton's method for w and theta together from k guesses: the roots found, and which were."""
    n, size = w.shape[1], float(np.ptp(y))
    theta, w = theta.copy(), w.copy()
    good, slope, open_ = np.zeros(len(theta), bool), np.zeros(len(theta)), np.ones(len(theta), bool)
    shots = problem.shoot(theta, w)
    for _ in range(6):
        i = np.nonzero(open_)[0]
        if len(i) == 0:
            break
        shot, slopes = problem.slopes(theta[i], w[i])
        whole = np.empty((len(i), n + 1, n + 1))
        whole[:, :n, :n], whole[:, :n, n] = slopes.residual_w, slopes.residual_theta
        whole[:, n, :n], whole[:, n, n] = slopes.y_w / size, slopes.y_theta / size
        slope[i] = slopes.along[1]
        left = np.concatenate([shot.residual, shot.y[:, None] / size], axis=1)
        for _ in range(4):
            step = newton_step(whole, left)
            w[i] += step[:, :n]
            theta[i] = np.clip(theta[i] + step[:, n], low[i] - SLACK, high[i] + SLACK)
            shot = problem.shoot(theta[i], w[i])
            before, left = left, np.concatenate([shot.residual, shot.y[:, None] / size], axis=1)
            error = np.abs(left).max(axis=1)
            shots.put(i, shot)
            done = error <= POLISHED
            good[i[done]], open_[i[done]] = True, False
            keep = ~done & (error <= 0.2 * np.abs(before).max(axis=1))
            i, whole, left = i[keep], whole[keep], left[keep]
            if len(i) == 0:
                break
    return Roots(shots[good], slope[good]), good


def _sorted(found: list[Roots]) -> Roots:
    shot = Shot.joined([each.shot for each in found])
    order = np.argsort(shot.theta)
    return Roots(shot[order], np.concatenate([each.slope for each in found])[order])
