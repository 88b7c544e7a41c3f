"""Worst miss and worst gap of our stacks over a million problems or more, including degenerate classes."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from benchmarks.contest import worst
from benchmarks.table import by_heading
from benchmarks.triple_integrator import problems, propagation
from benchmarks.triple_integrator.problems import MOMENT_CLASSES, TRANSFER_CLASSES
from benchmarks.triple_integrator.transfers import by_pontryagin
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak
from pontryagin.triple_integrator.least_time import arrival


def table(quick: bool) -> dict[str, list]:
    """Worst miss and worst gap for each solver and class of problems.

    The miss is that of the returned control, propagated piece by piece in extended precision, relative to
    the largest term of the propagation; the gap is 1 - dual bound / cost.
    """
    count = 2_000 if quick else 200_000
    rows = [row for name in MOMENT_CLASSES for row in _fixed_time(name, count)]
    rows += [_least_time(name, count // 2) for name in TRANSFER_CLASSES]
    return by_heading(sorted(rows, key=lambda row: (row["problem"], row["class"])))


def _fixed_time(name: str, count: int) -> Iterator[dict[str, Any]]:
    c, T = problems.moments(name, count)
    maneuver = Maneuver(np.zeros(3), c, T)
    peak, impulse, energy = minimum_peak(maneuver), minimum_impulse(maneuver), minimum_energy(maneuver)
    pieces = propagation.bang_bang_pieces(T, peak.shares, peak.levels)
    for problem, solution, miss in (
        ("least peak", peak, propagation.miss(maneuver.x0, maneuver.xf, *pieces)),
        ("least impulse", impulse, _impulse_miss(maneuver, impulse)),
        ("least energy", energy, energy.certificate.primal_residual),
    ):
        gap = _gap(solution.certificate.primal_value, solution.certificate.dual_value)
        yield _row(problem, name, count, 0.0, worst(miss), gap)


def _row(problem: str, name: str, count: int, unsolved: float, miss: float, gap: float) -> dict[str, Any]:
    return {
        "problem": problem,
        "class": name,
        "problems": count,
        "unsolved": unsolved,
        "worst miss": miss,
        "worst gap": gap,
    }


def _impulse_miss(maneuver: Maneuver, solution) -> np.ndarray:
    inner, coast = solution.inner * maneuver.duration, np.zeros((len(solution.inner), 2))
    durations = np.stack([(1 - solution.inner) * maneuver.duration, inner], axis=-1)
    return propagation.miss(
        maneuver.x0, maneuver.xf, durations, coast, impulses=solution.amplitudes.astype(np.longdouble)
    )


def _least_time(name: str, count: int) -> dict[str, Any]:
    work = problems.transfers(name, count)
    answers = by_pontryagin(work)
    columns = [x[:, i] for x in (work.x0, work.xf) for i in range(3)]
    bound = arrival.solve_stack(*columns, work.force, work.peak)[:, 5]
    solved = answers.solved
    gap = _gap(answers.duration[solved], bound[solved])
    return _row("least time", name, count, float(1 - solved.mean()), worst(answers.miss[solved]), gap)


def _gap(primal: np.ndarray, dual: np.ndarray) -> float:
    size = np.where(primal == 0, 1.0, primal)
    return worst((primal - dual) / size)
