"""The averaged boundary value problem (2.11), (2.4), (2.12) as collocation equations, and their solution."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.system.jets import Jet
from pontryagin.averaging.system.model import Model
from pontryagin.numerics.collocation import Mesh, evaluate
from pontryagin.numerics.newton_stack import newton_stack

Selection = NDArray[np.intp] | NDArray[np.bool_] | list[int]

CLOSE = 1e-10
"""Largest relative size of Newton's last step; the error after it is of the order of its square."""


@dataclass(frozen=True, eq=False)
class Problem:
    """A stack of problems (s): from `start` (s, n) to M = `level` (s, r) at the given kappa (s)."""

    model: Model
    start: Array
    level: Array
    kappa: Array
    numbers: tuple[Array, ...]

    def __getitem__(self, members: Selection) -> "Problem":
        return replace(
            self,
            start=self.start[members],
            level=self.level[members],
            kappa=self.kappa[members],
            numbers=tuple(number[members] for number in self.numbers),
        )

    def hamiltonian(self, z: Array) -> Jet:
        """Jet of H0 = omega kappa + h0 at z (s, k, 2n)."""
        h, omega = self.averaged(z)
        if not self.kappa.any():
            return h
        return h + omega.times(np.broadcast_to(self.kappa[:, None], omega.value.shape))

    def averaged(self, z: Array) -> tuple[Jet, Jet]:
        """Jets of h0 and omega at z (s, k, 2n)."""
        return self.model.averaged(z, tuple(number[:, None] for number in self.numbers))


@dataclass(frozen=True, eq=False)
class Trajectories:
    """Guesses or solutions of a stack of problems (s): values at the points of a mesh of tau / duration.

    Attributes
    ----------
    mesh : Mesh
    z : (s, k, 2n) array
        (xi, eta) at its points.
    duration : (s) array
    multipliers : (s, r) array
        alpha.
    """

    mesh: Mesh
    z: Array
    duration: Array
    multipliers: Array

    def __getitem__(self, members: Selection) -> "Trajectories":
        return Trajectories(self.mesh, self.z[members], self.duration[members], self.multipliers[members])

    @property
    def unknowns(self) -> Array:
        """All unknowns of each problem in one row, (s, unknowns)."""
        return np.concatenate(
            [self.z.reshape(len(self.z), -1), self.duration[:, None], self.multipliers], axis=1
        )

    def with_unknowns(self, rows: Array) -> "Trajectories":
        """Trajectories on the same mesh with these unknowns (k, unknowns)."""
        count = self.z[0].size
        z = rows[:, :count].reshape(len(rows), *self.z.shape[1:])
        return Trajectories(self.mesh, z, rows[:, count], rows[:, count + 1 :])

    def on(self, mesh: Mesh) -> "Trajectories":
        """The same trajectories at the points of another mesh."""
        values = evaluate(np.array(self.mesh.edges), self.mesh.series(self.z), mesh.points)
        return replace(self, mesh=mesh, z=values)

    def tails(self) -> Array:
        """Largest of the last two coefficients on each panel, relative to the variable, (s, panels)."""
        last = np.abs(self.mesh.series(self.z)[..., -2:, :]).max(axis=-2)
        return np.asarray((last / scales(self.z)[:, None]).max(axis=-1))


def scales(z: Array) -> Array:
    """Sizes (s, 2n) of the variables along a trajectory; a costate's is at least action over variable."""
    n = z.shape[-1] // 2
    largest = np.abs(z).max(axis=1)
    xi, eta = largest[:, :n], largest[:, n:]
    xi = np.where(xi > 0, xi, 1.0)
    action = (xi * eta).max(axis=-1, keepdims=True)
    action = np.where(action > 0, action, 1.0)
    return np.concatenate([xi, np.maximum(eta, action / xi)], axis=-1)


@dataclass(frozen=True, eq=False)
class _Equations:
    """The collocation equations at some trajectories: residuals, and Jacobians where they are needed."""

    problem: Problem
    path: Trajectories
    h: Jet
    residual: Array

    def jacobian(self, rows: NDArray[np.intp]) -> Array:
        return _matrix(self.problem[rows], self.path[rows], self.h[rows])


def newton(problem: Problem, guess: Trajectories, enough: float = -np.inf) -> tuple[Trajectories, Array]:
    """Newton's method with damping, on every problem of the stack.

    A residual of at most `enough` ends it too. Where features are narrow the equations are so badly
    conditioned that rounding alone makes steps larger than `CLOSE`.

    Returns
    -------
    Trajectories
        The last iterates.
    (s) array
        At most `CLOSE` where it converged: the relative sizes of the last steps. Inf where it failed.
    """

    def equations(members: NDArray[np.intp], unknowns: Array) -> _Equations:
        here, path = problem[members], guess.with_unknowns(unknowns)
        h = here.hamiltonian(path.z)
        return _Equations(here, path, h, _residual(here, path, h))

    with np.errstate(all="ignore"):
        found = newton_stack(
            equations,
            guess.unknowns,
            tolerance=enough,
            step_tolerance=CLOSE,
            iterations=30,
            halvings=12,
            decrease=0.1,
            size=lambda members, unknowns, residual: _norm(guess.with_unknowns(unknowns), residual),
            step_size=lambda members, unknowns, step: _step_size(guess.with_unknowns(unknowns), step),
            admissible=lambda members, unknowns: guess.with_unknowns(unknowns).duration > 0,
        )
    return guess.with_unknowns(found.unknowns), np.where(
        found.converged, np.minimum(found.correction, CLOSE), np.inf
    )


def _step_size(path: Trajectories, step: Array) -> Array:
    """Relative sizes of steps; the duration's counts less where the slow variables change little."""
    count, n = path.z[0].size, path.z.shape[-1] // 2
    moves = np.abs(step[:, :count].reshape(path.z.shape)).max(axis=1) / scales(path.z)
    travelled = np.ptp(path.z[..., :n], axis=1)
    xi = scales(path.z)[:, :n]
    lost = np.divide(xi, travelled, out=np.full_like(xi, np.inf), where=travelled > 0).min(axis=-1)
    lost = np.where(np.isfinite(lost), np.maximum(lost, 1), 1)
    return np.asarray(np.maximum(moves.max(axis=-1), np.abs(step[:, count]) / (lost * np.abs(path.duration))))


def _norm(path: Trajectories, residual: Array) -> Array:
    """Largest residuals relative to the variables; inf where they are not defined."""
    n = path.z.shape[-1] // 2
    r = path.multipliers.shape[-1]
    each = scales(path.z)
    action = (each[:, :n] * each[:, n:]).max(axis=-1) / np.abs(path.duration)
    sizes = np.concatenate(
        [
            each[:, :n],
            np.tile(each, (1, path.z.shape[1] - 1)),
            np.ones((len(each), r)),
            each[:, n:],
            action[:, None],
        ],
        axis=1,
    )
    return np.asarray(np.nan_to_num(np.abs(residual / sizes).max(axis=1), nan=np.inf))


def _residual(problem: Problem, path: Trajectories, h: Jet) -> Array:
    """Residuals (s, unknowns): start, collocation, target, transversality (2.12), H0 = 0 at the end."""
    z, n = path.z, problem.model.slow
    displacement = path.mesh.panel_integrals @ _hamiltonian_flow(h.gradient, -1)
    target, terminal = problem.model.ends(z[:, -1, :n], problem.numbers)
    normal = terminal.gradient + np.einsum("sr,sri->si", path.multipliers, target.gradient)
    return np.concatenate(
        [
            z[:, 0, :n] - problem.start,
            (z - z[:, path.mesh.starts] - path.duration[:, None, None] * displacement)[:, 1:].reshape(
                len(z), -1
            ),
            target.value - problem.level,
            z[:, -1, n:] + normal,
            h.value[:, -1:],
        ],
        axis=1,
    )


def _matrix(problem: Problem, path: Trajectories, h: Jet) -> Array:
    """Derivatives of the residual (s, unknowns, unknowns) in z by points, the duration and alpha."""
    stack, points, width = path.z.shape
    n, r = width // 2, path.multipliers.shape[-1]
    weights, starts = path.mesh.panel_integrals, path.mesh.starts
    size = points * width
    result = np.zeros((stack, size + 1 + r, size + 1 + r))
    result[:, np.arange(n), np.arange(n)] = 1
    flow = -path.duration[:, None, None, None] * _hamiltonian_flow(h.hessian, -2)
    block = weights[:, None, :, None] * flow.transpose(0, 2, 1, 3)[:, None]
    index = np.arange(points)
    for i in range(width):
        block[:, index, i, index, i] += 1
        block[:, index, i, starts, i] -= 1
    row = size - n
    result[:, n:row, :size] = block[:, 1:].reshape(stack, size - width, size)
    result[:, n:row, size] = -(weights @ _hamiltonian_flow(h.gradient, -1))[:, 1:].reshape(stack, -1)
    target, terminal = problem.model.ends(path.z[:, -1, :n], problem.numbers)
    end = slice(size - width, size - n)
    result[:, row : row + r, end] = target.gradient
    row += r
    curvature = np.einsum("sr,srij->sij", path.multipliers, target.hessian)
    result[:, row : row + n, end] = terminal.hessian + curvature
    result[:, row + np.arange(n), size - n + np.arange(n)] = 1
    result[:, row : row + n, size + 1 :] = np.swapaxes(target.gradient, 1, 2)
    result[:, -1, size - width : size] = h.gradient[:, -1]
    return result


def _hamiltonian_flow(derivatives: Array, axis: int) -> Array:
    """(d/d xi, d/d eta) as (d/d eta, -d/d xi) along the axis: Hamilton's equations (2.4)."""
    by_xi, by_eta = np.split(derivatives, 2, axis=axis)
    return np.concatenate([by_eta, -by_xi], axis=axis)
