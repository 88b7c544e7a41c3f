"""Solve times against their aims: warm solves, the homotopy from coasting to least time, the full search."""

from functools import partial
from time import process_time

from benchmarks.clock import one_call, repeated, take_turns
from benchmarks.peers import absent
from benchmarks.rendezvous import problems
from benchmarks.table import by_heading
from pontryagin.errors import NotConverged
from pontryagin.rendezvous import Rendezvous, solve
from pontryagin.rendezvous.families import bounded, loose_ratios
from pontryagin.rendezvous.problem.cases import (
    Case,
    cases,
)
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shooting import SHOOTING
from pontryagin.rendezvous.reduced.start import unbounded
from pontryagin.rendezvous.root import Root

WARM_AIM, HOMOTOPY_AIM = 0.05, 5.0
"""The aims for a warm solve and for one homotopy, in seconds on one core."""
MESH = 60
"""Number of intervals of the direct method."""


def homotopy(problem: Rendezvous) -> Root[Flight]:
    """One homotopy: coasting, least energy at a fixed time, the mixed problem, the bound, least time."""
    setting = problems.setting(problem)
    loose = setting.replace(peak=float("inf"), ratio=loose_ratios(setting.ratio, setting.peak)[0])
    return bounded(SHOOTING, setting, loose, unbounded(loose, SearchLog()))


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
    """Times of the homotopy to least time, the full search and the direct method, each from a cold start."""
    rounds = 1 if quick else 3
    rows = []
    for name in ("inclined-10",) if quick else problems.LEAST:
        case = cases()[name]
        root = homotopy(case.problem)
        timing = take_turns({name: one_call(partial(homotopy, case.problem))}, rounds)[name]
        best, searched = problems.timed_search(name)
        direct_seconds, direct_cost = _direct(case, best.cost)
        rows.append(
            {
                "case": name,
                "aim, s": HOMOTOPY_AIM,
                "one homotopy, s": timing.typical,
                "fastest round": timing.least,
                "its time over the best": root.flight.duration / best.flight.duration,
                "whole search, s": searched,
                "extremals": 1 + len(best.others),
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

    begun = process_time()
    try:
        found = direct(case.problem, case.guess, case.revolutions, MESH)
    except NotConverged:
        return process_time() - begun, float("nan")
    return process_time() - begun, found.cost / best
