"""Members of the family: Newton's method for the solutions that end at given anomalies."""

from collections.abc import Iterable

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.exact.shooting import (
    Shooting,
    Shot,
    newton_step,
)
from pontryagin.errors import NotConverged

CLOSE = 1e-7
"""Residual of a member; the roots are polished."""
SWEEPS, QUICK = 20, 6
"""Newton steps allowed from a rough guess, and from a neighbour."""
SHORTEST = 1e-4
"""Step, in shares of that between members, at which the family counts as ended."""
FAR = 10.0
"""Size of h* at the end, in units of the mean running cost, beyond which no root is looked for."""


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
        step = newton_step(slopes.residual_w, shot.residual)
        w = _damped(problem, theta, w, step, shot.error)
    raise NotConverged("Newton's method found no extremal that ends there", float(shot.error.max()))


def nearby_extremal(problem: Shooting, theta: float, unknowns: Array) -> tuple[float, Array]:
    """Anomaly at the end and unknowns of an extremal near a guess, by damped Newton for both.

    Where the control hardly moves the anomaly at the end, no member may end at the one that is guessed.

    Raises
    ------
    NotConverged
        If none is found.
    """
    z = np.append(unknowns, theta)[None]

    def left(shot: Shot) -> Array:
        return np.append(shot.residual[0], shot.hamiltonian[0] / problem.price)

    for _ in range(SWEEPS):
        shot, slopes = problem.slopes(z[:, -1], z[:, :-1])
        missing = left(shot)
        if np.abs(missing).max() <= CLOSE:
            return float(z[0, -1]), z[0, :-1]
        rate = shot.hamiltonian[0] / shot.y[0] / problem.price
        above = np.hstack([slopes.residual_w[0], slopes.residual_theta[0][:, None]])
        below = rate * np.append(slopes.y_w[0], slopes.y_theta[0])
        step = newton_step(np.vstack([above, below])[None], missing[None])[0]
        for share in 0.5 ** np.arange(8):
            trial = z + share * step
            try:
                better = np.linalg.norm(left(problem.shoot(trial[:, -1], trial[:, :-1])))
            except NotConverged:
                continue
            if better < (1 - share / 4) * np.linalg.norm(missing):
                z = trial
                break
        else:
            break
    raise NotConverged("no extremal was found near the averaged one", float(np.abs(missing).max()))


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
        step = newton_step(jacobians, shot.residual)
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
    """Member after member from the edge towards each of the angles, each guessed from the ones before.

    Steps are shortened where Newton's method does not follow, with a member at each; the march ends where it
    follows no step, or where h* has left its size on extremals far behind.
    """
    w, _, jacobians = edge
    _, slopes = problem.slopes(np.array([theta]), w)
    tangent = slopes.along[0]
    reach = np.inf
    for angle in angles:
        grid = abs(angle - theta)
        while theta != angle:
            reach = min(2 * reach, abs(angle - theta))
            while reach >= SHORTEST * grid:
                target = angle if reach == abs(angle - theta) else theta + np.copysign(reach, angle - theta)
                try:
                    found = chord(problem, np.array([target]), w + (target - theta) * tangent, jacobians)
                    break
                except NotConverged:
                    reach /= 3
            else:
                return
            tangent = (found[0] - w) / (target - theta)
            theta, (w, _, jacobians) = target, found
            yield (np.array([theta]), *found)
            if abs(float(found[1].hamiltonian[0])) > FAR * problem.price:
                return
