"""First guesses of averaged extremals: along the straight line to the target, or by integration."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.aim import aimed
from pontryagin.averaging.averaged.collocation import Problem, Trajectories
from pontryagin.numerics.collocation import Mesh, derivative, evaluate

GROWTHS, FAR = 40, 10
"""Largest number of Newton steps for a costate's length. Each of the first may multiply it by eight, each one
after ten by eight times more than the one before. Then the root is also sought in the logarithms of length
and H0, which are all but linear far from it."""
KNOWN = 1e-6
"""Growth of H0, relative to its value at a zero costate, that rounding leaves digits of."""
FARTHEST = 1e280
"""Largest length of a costate that is tried, and its inverse the least."""
NEAR = 1e-3
"""A costate's length is accepted once a Newton step changes it by at most this fraction."""

STEPS = 96
"""Number of Runge-Kutta steps from the start to the target."""
IDLE = 1e-9
"""Factor that makes a costate negligibly small; at a zero costate h* may have no derivatives."""
BESIDE = 1e-3
"""Distance of a point beside the start, relative to 1 + the size of its variables."""


@dataclass(frozen=True, eq=False)
class Guess:
    """Guessed trajectories, and the points on them where no costate makes the averaged Hamiltonian zero.

    Attributes
    ----------
    path : Trajectories
    slow : (s, k, n) array
        Points of the straight line to the target.
    frequency : (s, k) array
        omega at these points.
    idle : (s) array
        H0 at the start for a zero costate: minus the mean running cost, plus omega kappa.
    stuck : (s, k) boolean array
        Whether no control moves the slow variables along the guessed direction at the point.
    """

    path: Trajectories
    slow: Array
    frequency: Array
    idle: Array
    stuck: NDArray[np.bool_]


def straight(
    problem: Problem, mesh: Mesh, direction: Array | None = None, *, own_times: bool = False
) -> Guess:
    """A trajectory along the straight line to the target's nearest point, at the mesh's points of slow time.

    The costate has the given direction (s, n), or that of the target's gradient, and the length that makes H0
    vanish. With `own_times`, for one problem, the mesh is one of distance, and the trajectory's panels are
    those of time in which its panels are passed.
    """
    model = problem.model
    start = problem.start
    end, along_gradient = _nearest(problem)
    direction = along_gradient if direction is None else direction
    slow = start[:, None] + mesh.points[:, None] * (end - start)[:, None]
    length, stuck = _level(problem, slow, direction)
    eta = length[..., None] * direction[:, None]
    z = np.concatenate([slow, eta], axis=-1)
    h, omega = problem.averaged(z)
    speed = h.gradient[..., model.slow :]
    idle = problem.hamiltonian(np.concatenate([slow, IDLE * eta], axis=-1)[:, :1]).value[:, 0]
    along = np.einsum("ski,si->sk", speed, direction)
    reach = np.einsum("si,si->s", end - start, direction)[:, None]
    pace = np.divide(reach, along, out=np.ones_like(along), where=(along > 0) & (reach > 0))
    clock = pace @ mesh.integrals.T
    shares = clock / clock[:, -1:]
    times = Mesh((*shares[0, : -1 : mesh.degree], 1.0), mesh.degree) if own_times else mesh
    z = _at_times(mesh, shares, z, times.points)
    alpha = multipliers_at(problem, z[:, -1])
    return Guess(Trajectories(times, z, clock[:, -1], alpha), slow, omega.value, idle, stuck)


def towards_target(problem: Problem, mesh: Mesh) -> Trajectories | None:
    """The guess `straight` of one problem (1) with the costate that `aimed` finds; None if it finds none."""
    end, direction = _nearest(problem)
    length, stuck = _level(problem, problem.start[:, None], direction)
    first = length * direction
    idle = problem.hamiltonian(np.concatenate([problem.start, IDLE * first], axis=-1)[:, None]).value[0, 0]
    target, _ = problem.model.ends(end, problem.numbers)
    found = None
    if not stuck.any():
        found = aimed(problem, (end - problem.start)[0], target.gradient[0], first[0], float(idle))
    return straight(problem, mesh, found[None] / np.linalg.norm(found)).path if found is not None else None


def initial_costate(problem: Problem) -> Array | None:
    """The costate (s, n) of `straight` at the start; None where no control moves along its direction."""
    _, direction = _nearest(problem)
    length, stuck = _level(problem, problem.start[:, None], direction)
    return None if stuck.any() else length * direction


def shot(problem: Problem, mesh: Mesh) -> Trajectories | None:
    """The averaged extremal with the initial costate of `straight`, up to the target's level.

    It is integrated by the Runge-Kutta method, each step covering an equal share of the distance to the
    target. The result is None if an extremal does not approach the target.
    """
    model, n = problem.model, problem.model.slow
    costate = initial_costate(problem)
    if costate is None:
        return None

    def flow(z: Array) -> Array:
        gradient = problem.hamiltonian(z[:, None]).gradient[:, 0]
        return np.concatenate([gradient[:, n:], -gradient[:, :n]], axis=-1)

    def distance(z: Array) -> tuple[Array, Array]:
        target, _ = model.ends(z[:, :n], problem.numbers)
        return problem.level - target.value, np.einsum("sri,si->sr", target.gradient, flow(z)[:, :n])

    z = np.concatenate([problem.start, costate], axis=-1)
    far, _ = distance(z)
    states, times = [z], [np.zeros(len(z))]
    for _ in range(STEPS):
        left, pace = distance(z)
        nearing = (pace * far).sum(axis=1)
        if not (nearing > 0).all():
            return None
        step = np.minimum((far * far).sum(axis=1) / STEPS, (left * far).sum(axis=1)) / nearing
        h = step[:, None]
        k1 = flow(z)
        k2 = flow(z + h / 2 * k1)
        k3 = flow(z + h / 2 * k2)
        k4 = flow(z + h * k3)
        z = z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        states.append(z)
        times.append(times[-1] + step)
    values, clock = np.stack(states, axis=1), np.stack(times, axis=1)
    duration = clock[:, -1]
    if not (np.isfinite(values).all() and (duration > 0).all()):
        return None
    at = [
        np.stack([np.interp(mesh.points * c[-1], c, column) for column in own.T], axis=-1)
        for c, own in zip(clock, values, strict=True)
    ]
    return Trajectories(mesh, np.stack(at), duration, multipliers_at(problem, values[:, -1]))


def _at_times(mesh: Mesh, clock: Array, z: Array, times: Array) -> Array:
    """Values (s, k, 2n) at shares of the duration (k), from values at the mesh's points of distance."""
    edges, series = np.array(mesh.edges), mesh.series(clock[..., None])
    share = np.stack([np.interp(times, np.maximum.accumulate(c), mesh.points) for c in clock])
    for _ in range(3):
        late = evaluate(edges, series, share)[..., 0] - times
        inside = np.clip(share, 1e-9, 1 - 1e-9)
        pace = derivative(edges, series, inside)[..., 0]
        share = np.clip(share - np.divide(late, pace, out=np.zeros_like(late), where=pace > 0), 0, 1)
    return evaluate(edges, mesh.series(z), share)


def _nearest(problem: Problem) -> tuple[Array, Array]:
    """A point of the target (s, n) near the start, and the covector (s, n) that points towards it.

    Where a condition is stationary at the start, as between two roots, the search begins beside it.
    """
    end, direction = problem.start, None
    target, _ = problem.model.ends(end, problem.numbers)
    flat = ((target.gradient == 0).all(axis=-1) & (target.value != problem.level)).any(axis=1)
    end = np.where(flat[:, None], end + BESIDE * (1 + np.abs(end)), end)
    for _ in range(50):
        target, _ = problem.model.ends(end, problem.numbers)
        short = problem.level - target.value
        inverse = np.linalg.pinv(np.nan_to_num(target.gradient @ np.swapaxes(target.gradient, 1, 2)))
        multiplier = np.einsum("srq,sq->sr", inverse, short)
        step = np.einsum("sri,sr->si", target.gradient, multiplier)
        direction = step if direction is None else direction
        end = end + step
        if (np.abs(step) <= 1e-12 * (np.abs(end) + np.abs(end - problem.start))).all():
            break
    assert direction is not None
    away = -target.gradient.sum(axis=1)
    direction = np.where((direction == 0).all(axis=1, keepdims=True), away, direction)
    size = np.linalg.norm(direction, axis=1, keepdims=True)
    return end, direction / np.where(size > 0, size, 1)


def _level(problem: Problem, slow: Array, direction: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Lengths (s, k) of the costate along `direction` at which H0 = 0; H0 is convex along it.

    Newton's method with bounded steps. Where it does not settle, the length is 1 and marked as stuck, (s, k).
    """
    length = np.ones(slow.shape[:-1])
    idle, _ = _along(problem, slow, direction, np.full(slow.shape[:-1], 1 / FARTHEST))
    for k in range(GROWTHS):
        value, slope = _along(problem, slow, direction, length)
        with np.errstate(all="ignore"):
            root = np.where(slope > 0, length - value / slope, np.inf)
            following = np.clip(root, length / 8, length * 8.0 ** max(1, k + 1 - FAR))
            if k >= FAR:
                grown = value - idle
                power = length * slope / grown
                far = length * (-idle / grown) ** (1 / power)
                known = (grown > KNOWN * np.abs(idle)) & (power >= 1) & (idle < 0)
                following = np.where(known, far, following)
            following = np.clip(following, 1 / FARTHEST, FARTHEST)
        settled = (np.abs(following - length) <= NEAR * length) & (following < FARTHEST)
        length = following
        if (settled | np.isnan(root)).all():
            break
    stuck = ~settled
    return np.where(stuck, 1.0, length), stuck


def _along(problem: Problem, slow: Array, direction: Array, length: Array) -> tuple[Array, Array]:
    """H0 at costates of these lengths along the direction, and its derivative by the length, (s, k) each."""
    eta = length[..., None] * direction[:, None]
    with np.errstate(all="ignore"):
        h = problem.hamiltonian(np.concatenate([slow, eta], axis=-1))
        slope = np.einsum("ski,si->sk", h.gradient[..., problem.model.slow :], direction)
    return h.value, slope


def multipliers_at(problem: Problem, end: Array) -> Array:
    """alpha from eta_1 = -(g' + alpha M'), by least squares."""
    n = problem.model.slow
    target, terminal = problem.model.ends(end[:, :n], problem.numbers)
    inverse = np.linalg.pinv(np.nan_to_num(np.swapaxes(target.gradient, 1, 2)))
    return np.asarray(-np.einsum("sri,si->sr", inverse, end[:, n:] + terminal.gradient))
