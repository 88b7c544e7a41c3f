"""All extremals of the unaveraged problem: the roots of y1 over the family, bracketed and polished."""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.reference import ReferenceExtremal
from pontryagin.averaging.exact.arrivals import arrivals, fixed_ending
from pontryagin.averaging.exact.certificate import certificate
from pontryagin.averaging.exact.extremal import Extremal, Extremals
from pontryagin.averaging.exact.family import Family, family
from pontryagin.averaging.exact.members import CLOSE, nearby_extremal, updated
from pontryagin.averaging.exact.members import TOLERANCE as CLOSE_TOLERANCE
from pontryagin.averaging.exact.refinement import crossings, turns_resolved, with_members
from pontryagin.averaging.exact.shooting import TOLERANCE, Shooting, Shot, along, shooting
from pontryagin.errors import NotConverged
from pontryagin.numerics.newton_stack import solved
from pontryagin.progress import report

POLISHED = 1e-11
"""Largest residual of an extremal, in the problem's own units."""
SLACK = 1e-6
"""Distance by which a root may lie outside its bracket, since members, and so signs of y1, are inexact."""


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


def extremals(
    reference: ReferenceExtremal,
    epsilon: float,
    phase: float,
    *,
    start: float,
    end: float,
    to_phase: Callable[[Array, Array], Array],
) -> Extremals:
    """All exact extremals about an averaged one, the least cost first; see `AveragedSolution.exact`.

    Parameters
    ----------
    reference : ReferenceExtremal
        The averaged extremal of one problem.
    epsilon, phase : float
        epsilon > 0, and psi_0.
    start, end : float
        Anomaly at the start, and at the end of the averaged extremal.
    to_phase : callable
        psi of slow variables (k, n) and anomalies (k,).

    Raises
    ------
    NotConverged
        If no extremal is found; at a large epsilon the averaged one may be too far from all of them.
    """
    problem = shooting(reference, epsilon, start)
    guess = np.concatenate([reference.costate([0.0])[0], np.atleast_1d(reference.multipliers)])
    traced, found = _found(problem, end, guess)
    starts = problem.starts(found.shot.unknowns)
    items = [
        Extremal(
            cost=float(found.shot.cost[i]),
            duration=float(found.shot.duration[i]),
            kind="minimum" if found.slope[i] > 0 else "maximum",
            epsilon=epsilon,
            starting_anomaly=start,
            ending_anomaly=float(found.shot.theta[i]),
            curvature=float(epsilon * found.slope[i]),
            initial=starts[i],
            equations=problem.equations,
            parameters=problem.parameters,
            certify=partial(certificate, problem, found.shot[[int(i)]]),
            turn_to_phase=to_phase,
            view=getattr(reference, "to_slow_variables", None),
        )
        for i in np.argsort(found.shot.cost)
    ]
    return Extremals(tuple(items), epsilon, phase, traced)


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
    """Bracket and polish every root of y1, (2.2); returns the family with the members added on the way.

    Raises
    ------
    NotConverged
        If y1 does not vanish in the window, or a bracketed root is not found.
    """
    current = turns_resolved(problem, traced)
    if len(_sign_changes(current)) == 0:
        raise NotConverged(
            "no solution of the family is an extremal: the phase's costate at the end does not change sign",
            float(np.abs(traced.y).min()),
        )
    found: list[Roots] = []
    solved = np.empty(0)
    for _ in range(10):
        at = _sign_changes(current)
        at = at[~np.isin(current.theta[at], solved)]
        report("exact extremals found", len(solved), len(solved) + len(at))
        if len(at) == 0:
            return current, _sorted(found)
        low, high = current.theta[at], current.theta[at + 1]
        guess = _Guess(*crossings(current, at), low - SLACK, high + SLACK)
        reached, good = _polished(problem, guess, float(np.ptp(current.y)))
        found.append(reached)
        solved = np.append(solved, low[good])
        if not good.all():
            current = with_members(problem, current, guess.theta[~good])
    raise NotConverged(
        "an extremal between two solutions of the family was not found", float(np.abs(current.y[at]).max())
    )


def _sign_changes(current: Family) -> NDArray[np.intp]:
    """Members after which y1 changes sign; zero counts as positive."""
    positive = current.y >= 0
    return np.asarray(np.nonzero(positive[:-1] != positive[1:])[0], dtype=np.intp)


@dataclass(frozen=True)
class _Guess:
    """Guesses of k extremals.

    Attributes
    ----------
    theta, unknowns : (k,), (k, n + r) array
        Anomaly at the end, (p0, alpha).
    derivatives : (k, n + r + 1, n + r + 1) array
        Those of `Slopes`.
    low, high : (k,) array
        Bounds of theta.
    """

    theta: Array
    unknowns: Array
    derivatives: Array
    low: Array
    high: Array

    def __getitem__(self, rows: NDArray[np.bool_]) -> "_Guess":
        return _Guess(*(getattr(self, f.name)[rows] for f in fields(self)))


def _polished(problem: Shooting, guess: _Guess, size: float) -> tuple[Roots, NDArray[np.bool_]]:
    """The roots near k guesses, by flights that are as exact as those of members, then by exact ones.

    y has the given size. Returns the roots found, and which of the guesses (k,) converged.
    """
    shots, derivatives, near = _newton(problem, guess, size, CLOSE_TOLERANCE, CLOSE)
    close = _Guess(shots.theta, shots.unknowns, derivatives, guess.low, guess.high)[near]
    shots, derivatives, exact = _newton(problem, close, size, TOLERANCE, POLISHED)
    found = near.copy()
    found[near] = exact
    return Roots(shots[exact], along(derivatives[exact])[1]), found


def _newton(
    problem: Shooting, guess: _Guess, size: float, tolerance: float, goal: float
) -> tuple[Shot, Array, NDArray[np.bool_]]:
    """Newton's method for w and theta together, each Jacobian used while it serves.

    Returns the last shots, the last derivatives and which of the shots have residuals within the goal.
    """
    theta, w, derivatives = guess.theta.copy(), guess.unknowns.copy(), guess.derivatives.copy()
    n = w.shape[1]
    shots = problem.shoot(theta, w, tolerance)
    good = np.abs(_conditions(shots, size)).max(axis=1) <= goal
    for attempt in range(6):
        i = np.flatnonzero(~good)
        if len(i) == 0:
            break
        if attempt:
            derivatives[i] = problem.slopes(theta[i], w[i]).matrix
        jacobians = derivatives[i] / np.append(np.ones(n), size)[:, None]
        residual = _conditions(shots[i], size)
        for _ in range(4):
            step = solved(jacobians, -residual)
            aimed = theta[i] + step[:, n]
            w[i] += step[:, :n]
            theta[i] = np.clip(aimed, guess.low[i], guess.high[i])
            shot = problem.shoot(theta[i], w[i], tolerance)
            before, residual = residual, _conditions(shot, size)
            error = np.abs(residual).max(axis=1)
            shots.put(i, shot)
            good[i] = error <= goal
            free = aimed == theta[i]
            jacobians[free] = updated(jacobians[free], step[free], residual[free])
            keep = ~good[i] & (error <= 0.2 * np.abs(before).max(axis=1))
            i, jacobians, residual = i[keep], jacobians[keep], residual[keep]
            if len(i) == 0:
                break
    return shots, derivatives, good


def _conditions(shot: Shot, size: float) -> Array:
    """The residuals, and y in units of its range."""
    return np.column_stack([shot.residual, shot.y / size])


def _sorted(found: list[Roots]) -> Roots:
    shot = Shot.joined([each.shot for each in found])
    order = np.argsort(shot.theta)
    return Roots(shot[order], np.concatenate([each.slope for each in found])[order])
