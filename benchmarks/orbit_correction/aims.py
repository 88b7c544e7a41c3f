"""Times of our solvers beside the aims, with the gaps and residuals of their certificates."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import Timing, one_by_one, one_call, repeated, take_turns
from benchmarks.contest import worst, worst_gap
from benchmarks.orbit_correction.states import INTERVAL, PEAK, states, thrust
from benchmarks.table import by_heading
from pontryagin.arrays import Array
from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.orbit_correction.plan.thrust import THRUSTS

AIMS = {
    "plans of 1000 states": 0.1,
    "gauge in 10000 steps": 0.02,
    "plan of 10000 steps": 0.1,
    "gauge of a general system in 100000 steps": 1.0,
}
"""The aim for each task, in seconds on one core."""

MANY = 10_000
"""Number of steps of the longest plans."""

FAR = 5
"""Number of states whose gauges in `MANY` steps are measured one by one."""


@dataclass(frozen=True)
class Entry:
    """A task: the function to time, the number of its states, its worst gap and its worst residual."""

    run: Callable[[], int]
    states: int
    gap: float
    miss: float | None


def table(quick: bool) -> dict[str, list]:
    """Seconds of each task beside its aim: the median over the rounds; for single states the slowest."""
    large, rounds = (5_000, 2) if quick else (100_000, 7)
    rows = []
    for name in THRUSTS:
        rows += _rows(name, _tasks(name, large), rounds)
    general = {f"gauge of a general system in {large} steps": [_general(large)]}
    return by_heading(rows + _rows("ellipsoid", general, rounds))


def _rows(impulses: str, tasks: dict[str, list[Entry]], rounds: int) -> list[dict]:
    """The rows of tasks that are timed in turns."""
    entries = {f"{task} {i}": entry for task, found in tasks.items() for i, entry in enumerate(found)}
    timings = take_turns({label: entry.run for label, entry in entries.items()}, rounds)
    rows = []
    for task, found in tasks.items():
        taken = [timings[f"{task} {i}"] for i in range(len(found))]
        slowest: Timing = max(taken, key=lambda timing: timing.typical)
        misses = [entry.miss for entry in found if entry.miss is not None]
        count = found[0].states
        rows.append(
            {
                "task": task,
                "impulses": impulses,
                "aim, s": AIMS.get(task),
                "seconds": slowest.typical * count,
                "fastest round": slowest.least * count,
                "microseconds a state": 1e6 * slowest.typical,
                "worst gap": max(entry.gap for entry in found),
                "worst miss": max(misses, default=None),
            }
        )
    return rows


def far_states(name: str) -> Array:
    """States (FAR, 3) whose N_min is `MANY`: alpha(MANY - 1) and alpha(MANY) lie evenly about 1."""
    directions, counts = states(FAR), np.full(FAR, MANY)
    enough, too_few = (thrust(name).gauges(directions, counts - fewer).upper for fewer in (0, 1))
    return directions * (2 / (enough + too_few))[:, None]


def _tasks(name: str, large: int) -> dict[str, list[Entry]]:
    far = far_states(name)
    return {
        "plans of 1000 states": [_plans(name, states(1000), 3)],
        f"plans of {large} states": [_plans(name, states(large), 1)],
        "plan of one state, one by one": [_single(name, states(100))],
        f"gauge in {MANY} steps": [_gauge(name, state) for state in far],
        f"plan of {MANY} steps": [_plans(name, state[None], 1) for state in far],
    }


def _plans(name: str, stack: NDArray, times: int) -> Entry:
    run = one_call(lambda: correct(stack, INTERVAL, PEAK, name), len(stack))
    certificate = correct(stack, INTERVAL, PEAK, name).certificate
    gap = worst_gap(certificate.dual_value, certificate.primal_value)
    return Entry(repeated(run, times), len(stack), gap, worst(certificate.primal_residual))


def _single(name: str, stack: NDArray) -> Entry:
    together = _plans(name, stack, 1)
    run = one_by_one(lambda state: correct(state, INTERVAL, PEAK, name), stack)
    return Entry(run, 1, together.gap, together.miss)


def _gauge(name: str, state: NDArray) -> Entry:
    engine, counts = thrust(name), np.full(1, MANY)
    found = engine.gauges(state[None], counts)
    run = one_call(lambda: engine.gauges(state[None], counts))
    return Entry(run, 1, worst_gap(found.lower, found.upper), None)


def _general(steps: int) -> Entry:
    """The gauge of a system whose A(k) and H(k) all differ; the checks of its matrices are timed as well."""
    k = np.arange(steps)
    A, H = (np.tile(np.eye(3), (steps, 1, 1)) for _ in range(2))
    A[:, 0, 1], A[:, 1, 0], A[:, 2, 0] = 0.1 * np.sin(k), -0.1 * np.sin(k), 0.001 * np.cos(k)
    A /= np.linalg.norm(A, axis=1, keepdims=True)
    H[:, 0, 0], H[:, 1, 1] = 1.5 + np.sin(k), 2 + np.cos(k)
    run = one_call(lambda: gauge(DiscreteSystem(A, H), [3.0, -2.0, 1.0], steps))
    proof = gauge(DiscreteSystem(A, H), [3.0, -2.0, 1.0], steps).certificate
    return Entry(run, 1, float(proof.gap), float(proof.primal_residual))
