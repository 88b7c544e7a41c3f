"""Exact solutions that end at given anomalies, the members of a family, by Newton's method."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.shooting import Selection, Shooting, Shot, along
from pontryagin.errors import NotConverged
from pontryagin.numerics.newton_stack import Evaluated, LinearisedStack, newton_stack, solved

CLOSE = 1e-7
"""Largest residual of a member; extremals are polished further."""
TOLERANCE = 1e-11
"""Relative error allowed in a step; over hundreds of turns the errors add up to less than `CLOSE`."""
ITERATIONS, FEW_ITERATIONS = 20, 6
"""Largest numbers of Newton steps from a rough guess, and from a close one."""
CHORDS = 6
"""Largest number of steps of Broyden's method."""
SHORTEST = 1e-4
"""The family counts as ended where a step must be shorter than this share of the distance between members."""
FAR = 10.0
"""No root is sought where |h*| at the end exceeds this many times the mean running cost."""


@dataclass(frozen=True)
class MemberTable:
    """Solutions (k) that end at given anomalies.

    Attributes
    ----------
    theta, unknowns : (k,), (k, n + r) array
        Anomaly at the end, (p0, alpha).
    y, hamiltonian, duration, cost : (k,) array
        p_x/epsilon and h* at the end, slow time and J.
    derivatives : (k, n + r + 1, n + r + 1) array
        Those of `Slopes`, near the solution.
    """

    theta: Array
    unknowns: Array
    y: Array
    hamiltonian: Array
    duration: Array
    cost: Array
    derivatives: Array

    def __getitem__(self, index: Selection) -> "MemberTable":
        return MemberTable(*(column[index] for column in self.columns))

    @property
    def columns(self) -> tuple[Array, ...]:
        """The attributes, in their order."""
        return tuple(getattr(self, f.name) for f in fields(MemberTable))

    @staticmethod
    def joined(parts: Sequence["MemberTable"]) -> "MemberTable":
        """The members one after the other."""
        return MemberTable(*map(np.concatenate, zip(*(part.columns for part in parts), strict=True)))

    @staticmethod
    def combined(weights: Array, parts: Sequence["MemberTable"]) -> "MemberTable":
        """The sum of members (k) of several parts with a weight for each part."""
        table = zip(*(part.columns for part in parts), strict=True)
        return MemberTable(*(np.tensordot(weights, np.stack(column), 1) for column in table))


@dataclass(frozen=True, eq=False)
class _Conditions:
    """Conditions of k members at some unknowns (k, m), with Jacobians made only when needed."""

    unknowns: Array
    residual: Array
    jacobians: Callable[[Array, NDArray[np.intp]], Array]

    def jacobian(self, rows: NDArray[np.intp]) -> Array:
        return self.jacobians(self.unknowns[rows], rows)


def members(problem: Shooting, theta: Array, guess: Array, iterations: int = ITERATIONS) -> MemberTable:
    """The members that end at theta (k,), by damped Newton.

    Raises
    ------
    NotConverged
        If some residual does not fall to `CLOSE`.
    """

    first = problem.slopes(theta, guess)

    def conditions(rows: NDArray[np.intp], w: Array) -> LinearisedStack:
        if np.array_equal(w, guess):
            return Evaluated(first.residual, first.residual_w)

        def jacobians(w: Array, some: NDArray[np.intp]) -> Array:
            return problem.slopes(theta[rows[some]], w).residual_w

        return _Conditions(
            w, _residuals(lambda: _shoot(problem, theta[rows], w).residual, w.shape), jacobians
        )

    found = newton_stack(
        conditions, guess, tolerance=CLOSE, iterations=iterations, halvings=4, decrease=0.25, size=_largest
    )
    if not found.converged.all():
        raise NotConverged(
            "Newton's method found no solution that ends at a given anomaly", float(found.residual.max())
        )
    moved = not np.array_equal(found.unknowns, guess)
    slopes = problem.slopes(theta, found.unknowns) if moved else first
    return _members(_shoot(problem, theta, found.unknowns), slopes.matrix)


def _members(shot: Shot, matrix: Array) -> MemberTable:
    return MemberTable(shot.theta, shot.unknowns, shot.y, shot.hamiltonian, shot.duration, shot.cost, matrix)


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
        shot = problem.shoot(z[:, -1], z[:, :-1], TOLERANCE)
        return np.column_stack([shot.residual, shot.hamiltonian / problem.price])

    def jacobians(z: Array, _: NDArray[np.intp]) -> Array:
        slopes = problem.slopes(z[:, -1], z[:, :-1])
        matrix = slopes.matrix.copy()
        matrix[:, -1] *= -slopes.rate[:, None] / problem.price
        return matrix

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


def _shoot(problem: Shooting, theta: Array, w: Array) -> Shot:
    return problem.shoot(theta, w, TOLERANCE)


def _largest(_: NDArray[np.intp], __: Array, residuals: Array) -> Array:
    return np.asarray(np.abs(residuals).max(axis=1))


def chord(problem: Shooting, theta: Array, w: Array, derivatives: Array) -> MemberTable:
    """Members by Broyden's method from a close guess, or by damped Newton where that converges slowly."""
    found = close_chord(problem, theta, w, derivatives)
    return members(problem, theta, w, FEW_ITERATIONS) if found is None else found


def close_chord(problem: Shooting, theta: Array, w: Array, derivatives: Array) -> MemberTable | None:
    """Members by Broyden's method from a guess of them and of their derivatives; None where it is slow."""
    jacobians = derivatives[:, :-1, :-1]
    shot = _shoot(problem, theta, w)
    for _ in range(CHORDS):
        if (shot.error <= CLOSE).all():
            return _members(shot, problem.slopes(theta, w).matrix)
        step = solved(jacobians, -shot.residual)
        w, before = w + step, shot
        shot = _shoot(problem, theta, w)
        if not (shot.error <= np.maximum(0.3 * before.error, CLOSE)).all():
            return None
        jacobians = updated(jacobians, step, shot.residual)
    return None


def updated(jacobians: Array, step: Array, unexplained: Array) -> Array:
    """Broyden's update of Jacobians (k, m, n), which then explain the change of values (k, m) in a step."""
    length = np.maximum((step**2).sum(axis=1), 1e-300)
    return np.asarray(jacobians + (unexplained / length[:, None])[:, :, None] * step[:, None, :])


def march(problem: Shooting, edge: MemberTable, angles: Iterable[float]) -> Iterable[MemberTable]:
    """Members one after the other from the edge to each of the angles, each guessed by extrapolation.

    Where Newton's method fails, steps are shortened, with a member after each. The march ends where it fails
    for the shortest step, or where |h*| exceeds `FAR` times the mean running cost (extremals have h* = 0).
    """
    theta, w, derivatives = float(edge.theta[0]), edge.unknowns, edge.derivatives
    tangent = along(derivatives)[0]
    reach = np.inf
    for angle in angles:
        grid = abs(angle - theta)
        while theta != angle:
            reach = min(2 * reach, abs(angle - theta))
            while reach >= SHORTEST * grid:
                target = angle if reach == abs(angle - theta) else theta + np.copysign(reach, angle - theta)
                try:
                    guess = w + (target - theta) * tangent
                    found = chord(problem, np.array([target]), guess, derivatives)
                    break
                except NotConverged:
                    reach /= 3
            else:
                return
            tangent = (found.unknowns - w) / (target - theta)
            theta, w, derivatives = target, found.unknowns, found.derivatives
            yield found
            if abs(float(found.hamiltonian[0])) > FAR * problem.price:
                return
