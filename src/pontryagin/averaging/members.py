"""Members of the family: Newton's method for the solutions that end at given anomalies."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from pontryagin.averaging.shooting import Shooting, Shot
from pontryagin.errors import NotConverged

Array = NDArray[np.float64]

CLOSE = 1e-7
"""Residual of a member; the roots are polished."""
SWEEPS, QUICK = 20, 6
"""Newton steps allowed from a rough guess, and from a neighbour."""


def members(problem: Shooting, theta: Array, guess: Array, sweeps: int = SWEEPS) -> tuple[Array, Shot, Array]:
    """Unknowns, shots and Jacobians of the members that end at theta (k,), by damped Newton.

    Raises
    ------
    NotConverged
        If some residual is not brought under `CLOSE`.
    """
    w = guess
    for _ in range(sweeps):
        shot, slopes = problem.slopes(theta, w)
        if (shot.error <= CLOSE).all():
            return w, shot, slopes.residual_w
        step = -np.linalg.solve(slopes.residual_w, shot.residual[..., None])[..., 0]
        w = _damped(problem, theta, w, step, shot.error)
    raise NotConverged("Newton's method found no extremal that ends there", float(shot.error.max()))


def _damped(problem: Shooting, theta: Array, w: Array, step: Array, error: Array) -> Array:
    """w + share step, the share halved where the residual does not fall."""
    share = np.ones(len(w))
    for _ in range(4):
        try:
            trial = problem.shoot(theta, w + share[:, None] * step).error
        except (NotConverged, FloatingPointError):
            share = share / 2
            continue
        worse = ~(trial <= (1 - share / 4) * error) & (error > CLOSE)
        if not worse.any():
            break
        share = np.where(worse, share / 2, share)
    else:
        raise NotConverged("Newton's method found no extremal that ends there", float(error.max()))
    return w + share[:, None] * step


def chord(problem: Shooting, theta: Array, w: Array, jacobians: Array) -> tuple[Array, Shot, Array]:
    """Newton's method with the Jacobians of the turn before, corrected by Broyden; exact ones if slow."""
    shot = problem.shoot(theta, w)
    jacobians = jacobians.copy()
    for _ in range(6):
        if (shot.error <= CLOSE).all():
            return w, shot, jacobians
        step = -np.linalg.solve(jacobians, shot.residual[..., None])[..., 0]
        following = problem.shoot(theta, w + step)
        if not (following.error <= np.maximum(0.3 * shot.error, CLOSE)).all():
            break
        length = np.maximum((step**2).sum(axis=-1), 1e-300)
        unexplained = following.residual / length[:, None]
        jacobians += unexplained[:, :, None] * step[:, None, :]
        w, shot = w + step, following
    return members(problem, theta, w, QUICK)


def march(
    problem: Shooting, theta: float, edge: tuple[Array, Shot, Array], angles: Iterable[float]
) -> Iterable[tuple[Array, Array, Shot, Array]]:
    """Member after member from the edge, each guessed from the ones before; ends where none is found."""
    w, _, jacobians = edge
    _, slopes = problem.slopes(np.array([theta]), w)
    tangent = slopes.along[0]
    for angle in angles:
        while theta != angle:
            for halvings in range(4):
                target = angle if halvings == 0 else theta + (angle - theta) / 2**halvings
                try:
                    found = chord(problem, np.array([target]), w + (target - theta) * tangent, jacobians)
                    break
                except NotConverged:
                    continue
            else:
                return
            tangent = (found[0] - w) / (target - theta)
            theta, (w, _, jacobians) = target, found
        yield (np.array([angle]), *found)
