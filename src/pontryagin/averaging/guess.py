"""A first guess: straight to the target, with the costate that makes the Hamiltonian vanish on the way."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.averaging import chebyshev
from pontryagin.averaging.collocation import Path, Problem

Array = NDArray[np.float64]

GROWTHS = 40
NEAR = 1e-5
"""Eightfold growths of a costate before it is taken that none is large enough; how near it need be."""

IDLE = 1e-9
"""The share of a costate that is as good as none, and has derivatives where none has not."""


@dataclass(frozen=True, eq=False)
class Guess:
    """Guessed paths, and where along them no costate brings the averaged Hamiltonian up to zero.

    Attributes
    ----------
    path : Path
        Of the given degree.
    slow : (s, k, n) array
        Points of the straight way.
    frequency : (s, k) array
        omega there.
    idle : (s, k) array
        h0 without costate: minus the mean running cost, plus omega kappa.
    stuck : (s, k) boolean array
        No control moves the slow variables along the guessed direction there.
    """

    path: Path
    slow: Array
    frequency: Array
    idle: Array
    stuck: NDArray[np.bool_]


def straight(problem: Problem, degree: int) -> Guess:
    """The way along the straight line to the target's nearest point, at Chebyshev's points of slow time."""
    model = problem.model
    start = problem.start
    end, direction = _nearest(problem)
    share = chebyshev.points(degree)
    slow = start[:, None] + share[:, None] * (end - start)[:, None]
    length, stuck = _level(problem, slow, direction, _level(problem, slow[:, :1], direction)[0])
    eta = length[..., None] * direction[:, None]
    h, omega = problem.averaged(np.concatenate([slow, IDLE * eta], axis=-1))
    idle = h.value + problem.kappa[:, None] * omega.value
    z = np.concatenate([slow, eta], axis=-1)
    speed = problem.hamiltonian(z).gradient[..., model.slow :]
    along = np.einsum("ski,si->sk", speed, direction)
    reach = np.einsum("si,si->s", end - start, direction)
    with np.errstate(divide="ignore", invalid="ignore"):
        pace = reach[:, None] / along
    pace = np.where(np.isfinite(pace) & (pace > 0), pace, np.nan)
    usable = np.asarray(np.isfinite(pace).all(axis=1))
    pace = np.where(usable[:, None], pace, 1.0)
    clock = pace @ chebyshev.integrals(degree).T
    clock = np.maximum.accumulate(clock, axis=1)
    duration = clock[:, -1]
    z = np.stack([_at_times(c / c[-1], share, path) for c, path in zip(clock, z, strict=True)])
    alpha = _multipliers(problem, z[:, -1])
    return Guess(Path(z, duration, alpha), slow, omega.value, idle, stuck)


def _at_times(clock: Array, times: Array, values: Array) -> Array:
    return np.stack([np.interp(times, clock, column) for column in values.T], axis=-1)


def _nearest(problem: Problem) -> tuple[Array, Array]:
    """A point of the target (s, n) near the start, and the covector (s, n) that points at it."""
    end, direction = problem.start, None
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


def _level(
    problem: Problem, slow: Array, direction: Array, length: Array | float = 1.0
) -> tuple[Array, NDArray[np.bool_]]:
    """Lengths (s, k) of the costate along `direction` at which H0 = 0; H0 is convex along it.

    Newton's method, its steps bounded; where there is no root the length grows and the result is 1.
    """
    n = problem.model.slow
    length = np.broadcast_to(length, slow.shape[:-1])
    for _ in range(GROWTHS):
        eta = length[..., None] * direction[:, None]
        h = problem.hamiltonian(np.concatenate([slow, eta], axis=-1))
        slope = np.einsum("ski,si->sk", h.gradient[..., n:], direction)
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.where(slope > 0, length - h.value / slope, np.inf)
        following = np.clip(root, length / 8, 8 * length)
        settled = np.abs(following - length) <= NEAR * length
        length = following
        if (settled | np.isnan(root)).all():
            break
    stuck = ~settled
    return np.where(stuck, 1.0, length), stuck


def _multipliers(problem: Problem, end: Array) -> Array:
    """alpha of eta_1 = -(g' + alpha M'), in the sense of least squares."""
    n = problem.model.slow
    target, terminal = problem.model.ends(end[:, :n], problem.numbers)
    inverse = np.linalg.pinv(np.nan_to_num(np.swapaxes(target.gradient, 1, 2)))
    return -np.einsum("sri,si->sr", inverse, end[:, n:] + terminal.gradient)
