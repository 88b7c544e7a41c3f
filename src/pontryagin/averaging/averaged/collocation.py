"""The averaged boundary value problem (2.11), (2.4), (2.12): collocation and Newton's method."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.mesh import (
    Mesh,
    evaluate,
)
from pontryagin.averaging.system.jets import Jet
from pontryagin.averaging.system.model import Model

STEPS = 30
HALVINGS = 12
CLOSE = 1e-10
"""Newton's last step in shares of the variables; the error after it is the square."""


@dataclass(frozen=True, eq=False)
class Problem:
    """A stack of problems (s): from `start` (s, n) to M = `level` (s, r) at the given kappa (s)."""

    model: Model
    start: Array
    level: Array
    kappa: Array
    numbers: tuple[Array, ...]

    def __getitem__(self, members) -> "Problem":
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
class Path:
    """What Newton's method works on, for a stack (s): values at the points of a mesh of tau / duration.

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

    def __getitem__(self, members) -> "Path":
        return Path(self.mesh, self.z[members], self.duration[members], self.multipliers[members])

    def moved(self, step: Array, share: Array) -> "Path":
        """The path after a share (s) of the step (s, unknowns)."""
        _, points, width = self.z.shape
        count = points * width
        step = share[:, None] * step
        return Path(
            self.mesh,
            self.z + step[:, :count].reshape(self.z.shape),
            self.duration + step[:, count],
            self.multipliers + step[:, count + 1 :],
        )

    def on(self, mesh: Mesh) -> "Path":
        """The same path at the points of another mesh."""
        values = evaluate(np.array(self.mesh.edges), self.mesh.series(self.z), mesh.points)
        return replace(self, mesh=mesh, z=values)

    def tails(self) -> Array:
        """Largest of the last two coefficients on each panel, in shares of the variable, (s, panels)."""
        last = np.abs(self.mesh.series(self.z)[..., -2:, :]).max(axis=-2)
        return (last / scales(self.z)[:, None]).max(axis=-1)


def scales(z: Array) -> Array:
    """Natural sizes (s, 2n) of the variables along a path; of a small costate, cost over its variable."""
    n = z.shape[-1] // 2
    largest = np.abs(z).max(axis=1)
    xi, eta = largest[:, :n], largest[:, n:]
    xi = np.where(xi > 0, xi, 1.0)
    action = (xi * eta).max(axis=-1, keepdims=True)
    action = np.where(action > 0, action, 1.0)
    return np.concatenate([xi, np.maximum(eta, action / xi)], axis=-1)


def newton(problem: Problem, path: Path) -> tuple[Path, Array]:
    """Newton's method with damping, on every problem of the stack.

    Returns
    -------
    Path
        Where it arrived.
    (s) array
        The last step in shares of the variables: at most `CLOSE` where it converged, inf where it failed.
    """
    with np.errstate(all="ignore"):
        return _newton(problem, path)


def _newton(problem: Problem, path: Path) -> tuple[Path, Array]:
    closeness = np.full(len(path.duration), np.inf)
    active = np.arange(len(closeness))
    result, h = path, problem.hamiltonian(path.z)
    residual = _residual(problem, path, h)
    for _ in range(STEPS):
        here, at = problem[active], result[active]
        step, solvable = _solve(_matrix(here, at, h), residual)
        size = _size(at, step)
        last, further = solvable & (size <= CLOSE), np.nonzero(solvable & ~(size <= CLOSE))[0]
        closeness[active[last]] = size[last]
        result = _replaced(result, active[last], at[last].moved(step[last], np.ones(last.sum())))
        if not len(further):
            break
        before = _norm(at, residual)[further]
        moved, after, left, improved = _damped(here[further], at[further], step[further], before)
        active, h, residual = active[further[improved]], after[improved], left[improved]
        if not len(active):
            break
        result = _replaced(result, active, moved[improved])
    return result, closeness


def _replaced(path: Path, members: NDArray[np.intp], by: Path) -> Path:
    z, duration, multipliers = path.z.copy(), path.duration.copy(), path.multipliers.copy()
    z[members], duration[members], multipliers[members] = by.z, by.duration, by.multipliers
    return Path(path.mesh, z, duration, multipliers)


def _solve(matrix: Array, residual: Array) -> tuple[Array, NDArray[np.bool_]]:
    finite = np.asarray(np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(residual).all(axis=1))
    safe = np.where(finite[:, None, None], matrix, np.eye(matrix.shape[-1]))
    try:
        step = np.linalg.solve(safe, -np.where(finite[:, None], residual, 0.0)[..., None])[..., 0]
    except np.linalg.LinAlgError:
        step = np.stack(
            [np.linalg.lstsq(m, -r)[0] for m, r in zip(safe, np.nan_to_num(residual), strict=True)]
        )
    return step, finite & np.isfinite(step).all(axis=1)


def _size(path: Path, step: Array) -> Array:
    """A step in shares of the variables; the duration's digits are those of the way travelled."""
    count, n = path.z[0].size, path.z.shape[-1] // 2
    moves = np.abs(step[:, :count].reshape(path.z.shape)).max(axis=1) / scales(path.z)
    travelled = np.ptp(path.z[..., :n], axis=1)
    xi = scales(path.z)[:, :n]
    lost = np.divide(xi, travelled, out=np.full_like(xi, np.inf), where=travelled > 0).min(axis=-1)
    lost = np.where(np.isfinite(lost), np.maximum(lost, 1), 1)
    return np.maximum(moves.max(axis=-1), np.abs(step[:, count]) / (lost * np.abs(path.duration)))


def _damped(
    problem: Problem, path: Path, step: Array, before: Array
) -> tuple[Path, Jet, Array, NDArray[np.bool_]]:
    """The longest of the step, its half, its quarter, ... that lowers the residual; H0's jet and it there."""
    share = np.ones(len(before))
    trial = path.moved(step, share)
    h = problem.hamiltonian(trial.z)
    for halving in range(HALVINGS):
        residual = _residual(problem, trial, h)
        good = (_norm(trial, residual) <= (1 - 0.1 * share) * before) & (trial.duration > 0)
        if good.all() or halving == HALVINGS - 1:
            break
        share = np.where(good, share, share / 2)
        trial = path.moved(step, share)
        again = np.nonzero(~good)[0]
        h = h.replaced(again, problem[again].hamiltonian(trial.z[again]))
    return trial, h, residual, good


def _norm(path: Path, residual: Array) -> Array:
    """Largest residual in shares of the variables; nan counts as infinite."""
    n = path.z.shape[-1] // 2
    r = path.multipliers.shape[-1]
    each = scales(path.z)
    action = (each[:, :n] * each[:, n:]).max(axis=-1) / np.abs(path.duration)
    rows = np.concatenate(
        [
            each[:, :n],
            np.tile(each, (1, path.z.shape[1] - 1)),
            np.ones((len(each), r)),
            each[:, n:],
            action[:, None],
        ],
        axis=1,
    )
    return np.nan_to_num(np.abs(residual / rows).max(axis=1), nan=np.inf)


def _residual(problem: Problem, path: Path, h: Jet) -> Array:
    """What is left (s, unknowns) of: start, collocation, target, transversality, H0 = 0 at the end."""
    z, n = path.z, problem.model.slow
    way = path.mesh.integrals @ _turned(h.gradient, -1)
    target, terminal = problem.model.ends(z[:, -1, :n], problem.numbers)
    pull = terminal.gradient + np.einsum("sr,sri->si", path.multipliers, target.gradient)
    return np.concatenate(
        [
            z[:, 0, :n] - problem.start,
            (z - z[:, :1] - path.duration[:, None, None] * way)[:, 1:].reshape(len(z), -1),
            target.value - problem.level,
            z[:, -1, n:] + pull,
            h.value[:, -1:],
        ],
        axis=1,
    )


def _matrix(problem: Problem, path: Path, h: Jet) -> Array:
    """Derivatives of the residual (s, unknowns, unknowns) in z by points, the duration and alpha."""
    stack, points, width = path.z.shape
    n, r = width // 2, path.multipliers.shape[-1]
    weights = path.mesh.integrals
    size = points * width
    result = np.zeros((stack, size + 1 + r, size + 1 + r))
    result[:, np.arange(n), np.arange(n)] = 1
    flow = -path.duration[:, None, None, None] * _turned(h.hessian, -2)
    block = weights[:, None, :, None] * flow.transpose(0, 2, 1, 3)[:, None]
    index = np.arange(points)
    for i in range(width):
        block[:, index, i, index, i] += 1
        block[:, :, i, 0, i] -= 1
    row = size - n
    result[:, n:row, :size] = block[:, 1:].reshape(stack, size - width, size)
    result[:, n:row, size] = -(weights @ _turned(h.gradient, -1))[:, 1:].reshape(stack, -1)
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


def _turned(derivatives: Array, axis: int) -> Array:
    """(d/d xi, d/d eta) to (d/d eta, -d/d xi) along the axis: Hamilton's equations."""
    by_xi, by_eta = np.split(derivatives, 2, axis=axis)
    return np.concatenate([by_eta, -by_xi], axis=axis)
