"""Warm solves by several methods, each from the solution of a neighbouring problem."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

from benchmarks.apart import answer
from benchmarks.clock import Timing, one_call, repeated, take_turns
from benchmarks.peers import absent
from benchmarks.rendezvous import problems, pykep_peer
from benchmarks.rendezvous.collocation import collocate, cost
from benchmarks.table import by_heading
from pontryagin.rendezvous import solve
from pontryagin.rendezvous.problem.cases import cases

OURS = "pontryagin"
WARM = (*problems.FIXED, "inclined-10")
TOLERANCES = (1e-3, 1e-6, 1e-9)
MESHES = (60, 120)


def table(quick: bool) -> dict[str, list[Any]]:
    """Milliseconds of every method on every problem, and the relative error of its cost."""
    rounds = 1 if quick else 3
    rows = []
    for name in ("inclined-energy",) if quick else WARM:
        problem, start = problems.neighbour(name), problems.solved(name)
        ours = solve(problem, start)
        runs, errors = _peers(name, ours.cost)
        runs[OURS] = repeated(one_call(partial(solve, problem, start)), 5)
        errors[OURS] = ours.certificate.residual.item()
        timings = take_turns(runs, rounds)
        if problem.energy_weight == 0 and not pykep_peer.absent():
            found = pykep_peer.solve(problem, start, rounds)
            label = f"pykep {found['version']}" if found else "pykep"
            timings[label] = Timing(found.get("typical", math.nan), found.get("least", math.nan), 1)
            errors[label] = abs(found.get("duration", math.nan) / ours.flight.duration - 1)
        own = timings[OURS].typical
        for method in sorted(timings, key=lambda method: method != OURS):
            taken = timings[method]
            rows.append(
                {
                    "problem": name,
                    "method": method,
                    "milliseconds": 1e3 * taken.typical,
                    "fastest round": 1e3 * taken.least,
                    "times ours": taken.typical / own,
                    "error": errors[method],
                }
            )
    return by_heading(rows)


def _peers(name: str, best: float) -> tuple[dict[str, Callable[[], int]], dict[str, float]]:
    """A function that runs each peer, and the relative difference of its cost from ours."""
    problem, start = problems.neighbour(name), problems.solved(name)
    runs: dict[str, Callable[[], int]] = {}
    errors: dict[str, float] = {}
    for tolerance in TOLERANCES:
        label, collocated = (
            f"solve_bvp, tolerance {tolerance:.0e}",
            partial(collocate, problem, start, tolerance),
        )
        runs[label] = one_call(collocated)
        found = answer(label, lambda run=collocated: cost(problem, run()), math.nan)
        errors[label] = abs(found / best - 1)
    if absent("casadi"):
        return runs, errors
    from pontryagin.rendezvous.judge.collocation import direct

    case = cases()[name]
    for intervals in MESHES:
        label = f"CasADi + Ipopt, cold, {intervals} intervals"
        programme = partial(direct, problem, case.guess, case.revolutions, intervals)
        runs[label] = one_call(programme)
        errors[label] = abs(answer(label, lambda run=programme: run().cost, math.nan) / best - 1)
    return runs, errors
