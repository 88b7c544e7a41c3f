"""Problems of the triple integrator: least norms, greatest entropy, least time."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from tests.independent import exact_bang_bang_times

from pontryagin.arrays import Array
from pontryagin.triple_integrator import (
    Maneuver,
    maximum_entropy,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)
from studies.part import Found, Part
from studies.soak.draws import STRATA, TRANSFERS, drawn, positive_controls
from studies.soak.exactly import disagreement
from studies.soak.graded import entropy_disagreement, power_disagreement
from studies.soak.outcome import Input, Outcome, attempt, relative, text

CHUNK = 12_000
"""Problems of a chunk, about."""
WANTED = 1_000_000
FEW, WANTED_ENTROPIES = 1_000, 100_000
"""The same for the greatest entropy, which takes a millisecond each."""
ALLOWED = 1e-9
"""Largest disagreement with the oracle that is no failure."""
EXPONENTS = (1.001, 1.01, 1.1, 1.5, 2.0, 3.0, 10.0, 100.0, 1e4)
"""The q of the L_q norms; a chunk has one of them."""
INSIDE = 1e-12
"""A root counts as admissible for the comparison where its switches leave the transfer by this share."""
CLUSTER = 1e-2
"""Roots that differ by less than this share are judged together."""
ROUNDINGS = 2e-14
"""The same, times the sizes of the terms of the moments relative to what the bound produces in the time."""

Solve = Callable[[Maneuver], Any]
Judge = Callable[[Any, Array], float]


def maneuver(rows: Array) -> Maneuver:
    """A stack of rows of `draws.COLUMNS`, or one of them."""
    force = rows[..., 8] if rows.ndim > 1 else float(rows[8])
    return Maneuver(rows[..., :3], rows[..., 3:6], rows[..., 6], rows[..., 7], force)


def given(row: Array) -> Input:
    return {"x0": row[:3], "xf": row[3:6], "tf": row[6], "t0": row[7], "disturbance": row[8]}


def line(call: str, problem: Input) -> str:
    """A line of Python; `call` has a brace for the manoeuvre."""
    name = call.partition("(")[0]
    made = f"Maneuver({', '.join(text(value) for value in problem.values())})"
    return (
        f"from pontryagin.triple_integrator import Maneuver, {name}; h = float.fromhex; "
        f"s = {call.format(made)}; print(s.norm, s.certificate)"
    )


def stacks(
    solve: Solve, judge: Judge, call: str, strata: tuple, count: int, rng: np.random.Generator, number: int
) -> Found:
    """A chunk of manoeuvres: certificates on all, the oracle on a hundredth of each stratum."""
    rows, sample = drawn(rng, strata, count)
    return _found(solve, judge, call, rows, sample)


def norms(rng: np.random.Generator, number: int) -> Found:
    """A chunk of manoeuvres of least L_q norm."""
    q = EXPONENTS[number % len(EXPONENTS)]
    rows, sample = drawn(rng, STRATA, CHUNK)
    judge = partial(power_disagreement, q=q)
    return _found(partial(minimum_norm, q=q), judge, f"minimum_norm({{}}, {q})", rows, sample)


def _found(solve: Solve, judge: Judge, call: str, rows: Array, sample: Sequence[int]) -> Found:
    outcome = Outcome(partial(line, call))
    outcome.problems = len(rows)
    suspicious: set[int] = set()
    inputs = [given(row) for row in rows]
    values = np.full(len(rows), np.nan)
    for numbers, solution in attempt(outcome, lambda some: solve(maneuver(rows[some])), inputs):
        bad = outcome.certified(solution.certificate, [inputs[i] for i in numbers])
        suspicious |= {numbers[i] for i in bad}
        values[numbers] = solution.norm
    for i in sorted(suspicious | set(sample)):
        if np.isnan(values[i]):
            continue
        judged(outcome, lambda row: solve(maneuver(row)), judge, rows[i], inputs[i], values[i])
    return outcome.found()


def judged(
    outcome: Outcome, solve: Callable[[Array], Any], judge: Judge, row: Array, problem: Input, value: float
) -> None:
    """Solve a problem alone, compare it with its stack, and have it judged."""
    try:
        alone = solve(row)
        apart = relative(float(alone.certificate.primal_value), value)
        if apart > 1e-13:
            outcome.failed(f"alone it differs from its stack by {apart:.1e}", problem)
        outcome.judged(judge(alone, row), problem, ALLOWED, "the oracle")
    except Exception as error:  # whatever is raised is what is looked for
        outcome.failed(f"alone: {type(error).__name__}: {error}", problem)


def transfer(rows: Array) -> Any:
    """Least times of rows: ends (6), bound, force."""
    return minimum_time(rows[..., :3], rows[..., 3:6], rows[..., 6], disturbance=rows[..., 7])


def ends(row: Array) -> Input:
    return {"x0": row[:3], "xf": row[3:6], "peak": row[6], "disturbance": row[7]}


def time_line(problem: Input) -> str:
    arguments = ", ".join(text(value) for value in problem.values())
    return (
        "from pontryagin.triple_integrator import minimum_time; h = float.fromhex; "
        f"s = minimum_time({arguments}); print(s.duration, s.certificate)"
    )


def time_disagreement(solution: Any, row: Array) -> float:
    """The distance of a least time from the exact root, or from an earlier one that is admissible.

    Roots that nearly coincide move by more than the last digits of the data do: their distances count as a
    product, which is what the polynomial is multiplied by.
    """
    duration = float(solution.duration)
    if duration == 0:
        return float(np.abs(row[3:6] - row[:3]).max())
    roots = [(float(v), float(T)) for v, T in exact_bang_bang_times(row[:3], row[3:6], row[6], row[7])]
    if not any(v <= inside(row, T) and relative(T, duration) < CLUSTER for v, T in roots):
        return 1.0
    away = [min(1.0, relative(T, duration) / CLUSTER) for _, T in roots]
    earlier = [T for v, T in roots if v <= -inside(row, T) and duration * (1 - CLUSTER) > T]
    return max(CLUSTER * float(np.prod(away)), relative(min(earlier), duration) if earlier else 0.0)


def inside(row: Array, T: float) -> float:
    """The share of T by which the switches of a root move when the last digits of the ends do."""
    (a1, a2, a3, b1, b2, b3), bound, f = np.abs(row[:6]), row[6], abs(row[7])
    terms = [b1 + a1 + T * a2 + T * T * (a3 + f) / 2, b2 + a2 + T * (a3 + f), a3 + b3]
    return INSIDE + ROUNDINGS * max(x / (bound * T**k) for x, k in zip(terms, (3, 2, 1), strict=True))


def times(rng: np.random.Generator, number: int) -> Found:
    """A chunk of transfers of least time."""
    rows, sample = drawn(rng, TRANSFERS, CHUNK)
    outcome = Outcome(time_line)
    outcome.problems = len(rows)
    inputs, values, suspicious = [ends(row) for row in rows], np.full(len(rows), np.nan), set[int]()
    for numbers, solution in attempt(outcome, lambda some: transfer(rows[some]), inputs):
        bad = outcome.certified(solution.certificate, [inputs[i] for i in numbers])
        suspicious |= {numbers[i] for i in bad}
        values[numbers] = solution.duration
    for i in sorted(suspicious | set(sample)):
        if not np.isnan(values[i]):
            judged(outcome, transfer, time_disagreement, rows[i], inputs[i], values[i])
    return outcome.found()


def parts() -> list[Part]:
    """The rows of the table."""
    chunks = -(-WANTED // CHUNK)
    solvers: dict[str, tuple[Solve, str, tuple, int]] = {
        "energy": (minimum_energy, "minimum_energy({})", STRATA, CHUNK),
        "peak": (minimum_peak, "minimum_peak({})", STRATA, CHUNK),
        "impulse": (minimum_impulse, "minimum_impulse({})", STRATA, CHUNK),
    }
    of_norms = [
        Part(f"least {name}", [__name__], chunks, partial(stacks, solve, partial(disagreement, name), *rest))
        for name, (solve, *rest) in solvers.items()
    ]
    entropies = (maximum_entropy, entropy_disagreement, "maximum_entropy({})", (positive_controls,), FEW)
    return [
        *of_norms,
        Part("least norm q", [__name__], chunks, norms, share=2.0),
        Part("greatest entropy", [__name__], WANTED_ENTROPIES // FEW, partial(stacks, *entropies)),
        Part("least time", [__name__], chunks, times, share=2.0),
    ]
