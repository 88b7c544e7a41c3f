"""Exact solutions that end at given anomalies, the members of a family, by Newton's method."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.shooting import Shooting, Shot
from pontryagin.errors import NotConverged
from pontryagin.numerics.newton_stack import Evaluated, LinearisedStack, newton_stack, solved

CLOSE = 1e-7
"""Largest residual of a member; extremals are polished further."""
ITERATIONS, FEW_ITERATIONS = 20, 6
"""Largest numbers of Newton steps from a rough guess, and from a close one."""
SHORTEST = 1e-4
"""The family counts as ended where a step must be shorter than this share of the distance between members."""
FAR = 10.0
"""No root is sought where |h*| at the end exceeds this many times the mean running cost."""


@dataclass(frozen=True, eq=False)
class _Conditions:
    """Conditions of k members at some unknowns (k, m), with Jacobians made only when needed."""

    unknowns: Array
    residual: Array
    jacobians: Callable[[Array, NDArray[np.intp]], Array]

    def jacobian(self, rows: NDArray[np.intp]) -> Array:
        return self.jacobians(self.unknowns[rows], rows)


def members(
    problem: Shooting, theta: Array, guess: Array, iterations: int = ITERATIONS
) -> tuple[Array, Shot, Array]:
    """Unknowns, shots and Jacobians of the members that end at theta (k,), by damped Newton.

    Raises
    ------
    NotConverged
        If some residual does not fall to `CLOSE`.
    """

    shot, slopes = problem.slopes(theta, guess)

    def conditions(rows: NDArray[np.intp], w: Array) -> LinearisedStack:
        if np.array_equal(w, guess):
            return Evaluated(shot.residual, slopes.residual_w)

        def jacobians(w: Array, some: NDArray[np.intp]) -> Array:
            return problem.slopes(theta[rows[some]], w)[1].residual_w

        return _Conditions(w, _residuals(lambda: problem.shoot(theta[rows], w).residual, w.shape), jacobians)

    found = newton_stack(
        conditions, guess, tolerance=CLOSE, iterations=iterations, halvings=4, decrease=0.25, size=_largest
    )
    if not found.converged.all():
        raise NotConverged(
            "Newton's method found no solution that ends at a given anomaly", float(found.residual.max())
        )
    if not np.array_equal(found.unknowns, guess):
        shot, slopes = problem.slopes(theta, found.unknowns)
    return found.unknowns, shot, slopes.residual_w


def nearby_extremal(problem: Shooting, theta: float, unknowns: Array) -> tuple[float, Array]:
    """Anomaly at the end and unknowns of an extremal near a guess, by damped Newton for both.

    Where the control hardly changes the anomaly at the end, there may be no member that ends at the guessed
    anomaly, so that the anomaly has to be sought too.

    Raises
    ------
    NotConverged
        If none is found.
    """

    def missing(z: Array) -> Array:
        shot = problem.shoot(z[:, -1], z[:, :-1])
        return np.column_stack([shot.residual, shot.hamiltonian / problem.price])

    def jacobians(z: Array, _: NDArray[np.intp]) -> Array:
        shot, slopes = problem.slopes(z[:, -1], z[:, :-1])
        rate = shot.hamiltonian / shot.y / problem.price
        above = np.concatenate([slopes.residual_w, slopes.residual_theta[..., None]], axis=2)
        below = rate[:, None] * np.column_stack([slopes.y_w, slopes.y_theta])
        return np.concatenate([above, below[:, None]], axis=1)

    found = newton_stack(
        lambda _, z: _Conditions(z, _residuals(lambda: missing(z), z.shape), jacobians),
        np.append(unknowns, theta)[None],
        tolerance=CLOSE,
        iterations=ITERATIONS,
        halvings=8,
        decrease=0.25,
        size=_largest,
    )
    if not found.converged.all():
        raise NotConverged("no extremal was found near the averaged one", float(found.residual[0]))
    return float(found.unknowns[0, -1]), found.unknowns[0, :-1]


def _residuals(evaluate: Callable[[], Array], shape: tuple[int, ...]) -> Array:
    """Residuals, or nan where a trajectory cannot be followed: Newton's method then shortens its step."""
    try:
        return evaluate()
    except (NotConverged, FloatingPointError):
        return np.full(shape, np.nan)


def _largest(_: NDArray[np.intp], __: Array, residuals: Array) -> Array:
    return np.asarray(np.abs(residuals).max(axis=1))


def chord(problem: Shooting, theta: Array, w: Array, jacobians: Array) -> tuple[Array, Shot, Array]:
    """Members by Broyden's method from the previous turn's Jacobians, or by Newton's where that is slow."""
    shot = problem.shoot(theta, w)
    jacobians = jacobians.copy()
    for _ in range(6):
        if (shot.error <= CLOSE).all():
            return w, shot, jacobians
        step = solved(jacobians, -shot.residual)
        following = problem.shoot(theta, w + step)
        if not (following.error <= np.maximum(0.3 * shot.error, CLOSE)).all():
            break
        length = np.maximum((step**2).sum(axis=-1), 1e-300)
        unexplained = following.residual / length[:, None]
        jacobians += unexplained[:, :, None] * step[:, None, :]
        w, shot = w + step, following
    return members(problem, theta, w, FEW_ITERATIONS)


def march(
    problem: Shooting, theta: float, edge: tuple[Array, Shot, Array], angles: Iterable[float]
) -> Iterable[tuple[Array, Array, Shot, Array]]:
    """Members one after the other from the edge to each of the angles, each guessed by extrapolation.

    Where Newton's method fails, steps are shortened, with a member after each. The march ends where it fails
    for the shortest step, or where |h*| exceeds `FAR` times the mean running cost (extremals have h* = 0).
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
