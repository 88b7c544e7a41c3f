"""Solve times against their aims: warm solves, and the whole search for extremals of least time."""

from functools import partial
from time import process_time

from benchmarks.apart import answer
from benchmarks.clock import one_call, repeated, take_turns
from benchmarks.peers import absent
from benchmarks.rendezvous import problems
from benchmarks.table import by_heading
from pontryagin.errors import NotConverged
from pontryagin.rendezvous import solve
from pontryagin.rendezvous.problem.cases import (
    Case,
    cases,
)

WARM_AIM, SEARCH_AIM = 0.05, 1.0
"""The aims for a warm solve and for a whole search, in seconds on one core."""
MESH = 60
"""Number of intervals of the direct method."""


def warm(quick: bool) -> dict[str, list]:
    """Times of warm solves of problems with a fixed duration, and the aim."""
    rows = []
    for name in problems.FIXED[:1] if quick else problems.FIXED:
        warm_solve = partial(solve, problems.neighbour(name), problems.solved(name))
        timing = take_turns({name: repeated(one_call(warm_solve), 5)}, 1 if quick else 9)[name]
        rows.append(
            {
                "case": name,
                "aim, ms": 1e3 * WARM_AIM,
                "milliseconds": 1e3 * timing.typical,
                "fastest round": 1e3 * timing.least,
                "certificate": warm_solve().certificate.residual.item(),
            }
        )
    return by_heading(rows)


def least_time(quick: bool) -> dict[str, list]:
    """Times of the whole search for least time and of the direct method, each from a cold start."""
    rounds = 1 if quick else 3
    rows = []
    for name in ("inclined-10",) if quick else problems.LEAST:
        case = cases()[name]
        best = problems.solved(name)
        timing = take_turns({name: one_call(partial(solve, case.problem))}, rounds)[name]
        count = 1 + len(best.others)
        direct_seconds, direct_cost = _direct(case, best.cost)
        rows.append(
            {
                "case": name,
                "aim, s": SEARCH_AIM,
                "whole search, s": timing.typical,
                "fastest round": timing.least,
                "extremals": count,
                "seconds an extremal": timing.typical / count,
                "CasADi + Ipopt, cold, s": direct_seconds,
                "its cost over ours": direct_cost,
            }
        )
    return by_heading(rows)


def _direct(case: Case, best: float) -> tuple[float, float]:
    """Seconds of the direct method from its cold start, and its cost over ours; nan if it failed."""
    if absent("casadi"):
        return float("nan"), float("nan")
    from pontryagin.rendezvous.judge.collocation import direct

    def timed() -> tuple[float, float]:
        begun = process_time()
        try:
            found = direct(case.problem, case.guess, case.revolutions, MESH)
        except NotConverged:
            return process_time() - begun, float("nan")
        return process_time() - begun, found.cost / best

    seconds, ratio = answer("CasADi + Ipopt", timed, (float("nan"), float("nan")))
    return seconds, ratio
