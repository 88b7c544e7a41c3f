"""SciPy's root finders on the paper's system (11), with alpha as the fourth unknown.

The system is alpha sum of G_k G_k'psi / |G_k'psi| = -z0 and (psi, psi) = 1. Besides the costate and the gauge
it has the spurious root (-psi, -alpha). A finder starts at alpha = 1 and at a psi drawn from the sphere, or
along -z0.
"""

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from benchmarks.clock import one_by_one, take_turns
from benchmarks.contest import CALL, worst
from benchmarks.orbit_correction.states import INTERVAL, PEAK, SEED, states, thrust, unit_factors
from benchmarks.table import by_heading
from pontryagin.arrays import Array
from pontryagin.orbit_correction import correct

FINDERS: dict[str, dict] = {
    "hybr": {},
    "hybr, Jacobian": {"jac": True},
    "lm": {},
    "lm, Jacobian": {"jac": True},
    "broyden1": {"options": {"maxiter": 100}},
    "anderson": {"options": {"maxiter": 100}},
    "krylov": {"options": {"maxiter": 100}},
    "df-sane": {},
}
"""Methods of `scipy.optimize.root` and their options, with the default tolerances of each method.

Methods that would take thousands of iterations are limited to 100; with ten times as many only few more
starts reach a root.
"""

SAME = 1e-4
"""Largest relative difference of a root's alpha from the gauge (right) or from minus the gauge (spurious)."""


@dataclass(frozen=True)
class Task:
    """The system (11) of one state, its gauge, and the starting points (starts, 4)."""

    factors: Array
    state: Array
    gauge: float
    starts: Array

    def equations(self, unknowns: NDArray) -> Array:
        """The left-hand sides of (11), which vanish at a root (psi, alpha)."""
        psi, alpha = unknowns[:3], unknowns[3]
        along = np.einsum("kij,i->kj", self.factors, psi)
        unit = along / np.linalg.norm(along, axis=1)[:, None]
        point = np.einsum("kij,kj->i", self.factors, unit)
        return np.append(alpha * point + self.state, psi @ psi - 1)

    def with_jacobian(self, unknowns: NDArray) -> tuple[Array, Array]:
        """The equations and their derivative, (4,) and (4, 4)."""
        psi, alpha = unknowns[:3], unknowns[3]
        along = np.einsum("kij,i->kj", self.factors, psi)
        size = np.linalg.norm(along, axis=1)[:, None]
        points = np.einsum("kij,kj->ki", self.factors, along / size)
        spread = np.einsum("kij,klj->kil", self.factors, self.factors) - points[:, :, None] * points[:, None]
        jacobian = np.zeros((4, 4))
        jacobian[:3, :3] = alpha * (spread / size[:, :, None]).sum(axis=0)
        jacobian[:3, 3] = points.sum(axis=0)
        jacobian[3, :3] = 2 * psi
        return np.append(alpha * points.sum(axis=0) + self.state, psi @ psi - 1), jacobian


@dataclass(frozen=True)
class Ends:
    """Numbers of starts from which a method ended at each root, and the worst relative error of alpha."""

    right: int
    spurious: int
    starts: int
    error: float


def tasks(count: int, starts: int) -> list[Task]:
    """States whose N_min exceeds 1, each with random starts, or for 0 starts with the one along -z0."""
    stack = states(2 * count)
    plan = correct(stack, INTERVAL, PEAK)
    chosen = np.flatnonzero(plan.steps > 1)[:count]
    rng = np.random.default_rng(SEED)
    found = []
    for i in chosen:
        psi = rng.standard_normal((starts, 3)) if starts else -stack[i : i + 1]
        psi /= np.linalg.norm(psi, axis=1)[:, None]
        begin = np.column_stack([psi, np.ones(len(psi))])
        factors = unit_factors("ball", int(plan.steps[i]))
        found.append(Task(factors, stack[i] / PEAK, float(plan.gauge[i]), begin))
    return found


def attempt(task: Task, start: NDArray, method: str) -> float:
    """alpha of the root that the finder reports, nan if it reports none."""
    function = task.with_jacobian if "jac" in FINDERS[method] else task.equations
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = root(function, start, method=method.split(",")[0], **FINDERS[method])
        except (ValueError, ArithmeticError, np.linalg.LinAlgError):
            return float("nan")
        ended = found.success and np.abs(task.equations(found.x)).max() < 1e-4
    return float(found.x[3]) if ended else float("nan")


def ends(work: Sequence[Task], method: str) -> Ends:
    """The roots at which a method ends from all starts of all tasks."""
    shares = np.array([attempt(task, x, method) / task.gauge for task in work for x in task.starts])
    right, spurious = np.abs(shares - 1) < SAME, np.abs(shares + 1) < SAME
    return Ends(int(right.sum()), int(spurious.sum()), len(shares), worst(shares[right] - 1))


def table(quick: bool) -> dict[str, list]:
    """Every method from random starts and from -z0, with times beside our own call for the same states."""
    states_, starts, rounds = (4, 2, 1) if quick else (40, 10, 2)
    kinds = {"random": tasks(states_, starts), "along -z0": tasks(2 * states_, 0)}
    return by_heading([row for label, work in kinds.items() for row in _rows(label, work, rounds)])


def _rows(label: str, work: Sequence[Task], rounds: int) -> Iterator[dict[str, Any]]:
    pairs = [(task, start) for task in work for start in task.starts]
    runs = {
        method: one_by_one(partial(attempt, method=method), *zip(*pairs, strict=True)) for method in FINDERS
    }
    timings = take_turns({CALL: _ours(work), **runs}, rounds)
    for method in FINDERS:
        end, taken = ends(work, method), 1e6 * timings[method].typical
        a_root = taken * end.starts / end.right if end.right else float("nan")
        yield {
            "start": label,
            "method": method,
            "starts": end.starts,
            "right root": end.right / end.starts,
            "spurious root": end.spurious / end.starts,
            "no root": 1 - (end.right + end.spurious) / end.starts,
            "worst relative error": end.error,
            "microseconds a start": taken,
            "microseconds a right root": a_root,
            "times our call": a_root / (1e6 * timings[CALL].typical),
        }


def _ours(work: Sequence[Task]) -> Callable[[], int]:
    """The gauge, costate and controls of the same states for the same numbers of steps."""
    engine, counts = thrust("ball"), [np.array([len(task.factors)]) for task in work]
    return one_by_one(lambda task, steps: engine.gauges(PEAK * task.state[None], steps), work, counts)
