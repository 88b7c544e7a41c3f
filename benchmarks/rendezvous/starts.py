"""Newton's method from the same random starts in each form of one fixed-time problem.

Where a form's own residual vanishes, the extremal is tested against (5) and (6): it is a true meeting or a
false one. With nu0 = 0, the forms with 16, 14 and 11 equations define the same map and differ only
by rounding.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from benchmarks.clock import timed
from benchmarks.rendezvous import problems
from benchmarks.rendezvous.systems import PROBLEMS, Problem
from benchmarks.table import by_heading
from pontryagin.arrays import Array
from pontryagin.rendezvous import Extremal
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import goal_of, mismatch
from pontryagin.rendezvous.reduced.flight import fly

ITERATIONS, HALVINGS = 30, 6
"""Maximum numbers of steps of Newton's method and of halvings of a step."""
EXACT = 1e-9
"""Residual below which Newton's method has converged."""
TRUE = 1e-7
"""Residual below which (5) and (6) count as satisfied."""
SPREAD = 0.05
"""Standard deviation of the costates of a start."""
DEGREES = (0, 20, 60)
COUNT = 40
ZERO = 1e-10
"""A singular value counts as zero below this share of the largest one."""
CUTOFF = 1e-12
"""A Newton step drops singular values below this share of the largest one."""


@dataclass(frozen=True)
class Ends:
    """Shares of the starts by their outcome, and flights and seconds of processor time per start."""

    true: float
    false: float
    none: float
    flights: float
    seconds: float


def newton(problem: Problem, scaled: Scaled, six: Array, duration: float) -> tuple[Array | None, int]:
    """The solution by Newton's method with halved steps, or None, and the number of flights."""
    unknowns, flights = problem.start(six), 1
    here = problem.residual(scaled, unknowns, duration)
    for _ in range(ITERATIONS):
        if here is None:
            return None, flights
        residual, jacobian = here
        size = float(np.linalg.norm(residual))
        if size < EXACT:
            return unknowns, flights
        step = np.linalg.lstsq(jacobian, -residual, rcond=CUTOFF)[0]
        for halving in range(HALVINGS):
            trial = unknowns + step / 2**halving
            there = problem.residual(scaled, trial, duration)
            flights += 1
            if there is not None and np.linalg.norm(there[0]) < size:
                unknowns, here = trial, there
                break
        else:
            return None, flights
    return None, flights


def is_meeting(extremal: Extremal, six: Array) -> bool:
    """Whether the extremal of these costates satisfies (5) and (6)."""
    scaled, setting = extremal.problem.scaled, problems.setting(extremal.problem)
    flight = fly(scaled, six, float(setting.duration or 0))
    goal, _ = goal_of(setting, float(flight.end[3]))
    return bool(np.abs(mismatch(flight, goal).residual).max() < TRUE)


def ends(extremal: Extremal, starts: Array) -> dict[str, Ends]:
    """The outcome of all starts in every form."""
    scaled, duration = extremal.problem.scaled, extremal.flight.duration
    found: dict[str, list[Array]] = {problem.name: [] for problem in PROBLEMS}
    flights, seconds = dict.fromkeys(found, 0), dict.fromkeys(found, 0.0)
    for six in starts:
        for problem in PROBLEMS:
            (unknowns, used), taken = timed(partial(newton, problem, scaled, six, duration))
            seconds[problem.name] += taken
            flights[problem.name] += used
            if unknowns is not None:
                found[problem.name].append(problem.six(unknowns))
    count = len(starts)
    result = {}
    for name, arrived in found.items():
        true = sum(is_meeting(extremal, six) for six in arrived)
        shares = (true / count, (len(arrived) - true) / count, 1 - len(arrived) / count)
        result[name] = Ends(*shares, flights[name] / count, seconds[name] / count)
    return result


def singular_values(problem: Problem, extremal: Extremal) -> Array:
    """Singular values of the form's Jacobian at the solution, for costates in units of the largest one."""
    six = extremal.flight.costates
    unknowns = problem.start(six)
    residual = problem.residual(extremal.problem.scaled, unknowns, extremal.flight.duration)
    assert residual is not None
    values = np.linalg.svd(residual[1] * np.abs(six).max(), compute_uv=False)
    return np.concatenate([values, np.zeros(len(unknowns) - len(values))])


def table(quick: bool) -> dict[str, list]:
    """The outcomes and the singular values of every form at every inclination."""
    starts = problems.deviations(4 if quick else COUNT, SPREAD)
    rows = []
    for degrees in DEGREES[:2] if quick else DEGREES:
        extremal = problems.solved_leap(degrees)
        for problem in PROBLEMS:  # Everything is compiled before anything is timed.
            problem.residual(extremal.problem.scaled, problem.start(starts[0]), 1.0)
        found = ends(extremal, starts)
        for problem in PROBLEMS:
            end, values = found[problem.name], singular_values(problem, extremal)
            zero = values < ZERO * values[0]
            rows.append(
                {
                    "inclination": f"{degrees} deg",
                    "form": problem.name,
                    "starts": len(starts),
                    "meetings": end.true,
                    "false meetings": end.false,
                    "no convergence": end.none,
                    "flights a start": end.flights,
                    "milliseconds a start": 1e3 * end.seconds,
                    "largest singular value": float(values[0]),
                    "smallest singular value": float(values[-1]),
                    "of them zero": int(zero.sum()),
                    "condition": float("inf") if zero.any() else float(values[0] / values[-1]),
                }
            )
    return by_heading(rows)
