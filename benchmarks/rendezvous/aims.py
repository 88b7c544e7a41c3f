"""Solve times against their aims: warm solves, the homotopy from coasting to least time, the full search."""

from time import process_time

from benchmarks.clock import repeated, take_turns
from benchmarks.peers import absent
from benchmarks.rendezvous import problems
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
        problem, start = problems.neighbour(name), problems.solved(name)

        def run(problem=problem, start=start) -> int:
            solve(problem, start)
            return 1

        timing = take_turns({name: repeated(run, 5)}, 1 if quick else 9)[name]
        residual = solve(problem, start).certificate.residual.item()
        rows.append((name, 1e3 * WARM_AIM, 1e3 * timing.typical, 1e3 * timing.least, residual))
    headings = ("case", "aim, ms", "milliseconds", "fastest round", "certificate")
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


def least_time(quick: bool) -> dict[str, list]:
    """Times of the homotopy to least time, the full search and the direct method, each from a cold start."""
    rounds = 1 if quick else 3
    rows = []
    for name in ("inclined-10",) if quick else problems.LEAST:
        case = cases()[name]

        def curve(case: Case = case) -> int:
            homotopy(case.problem)
            return 1

        root = homotopy(case.problem)
        timing = take_turns({name: curve}, rounds)[name]
        best, searched = problems.timed_search(name)
        rows.append(
            (
                name,
                HOMOTOPY_AIM,
                timing.typical,
                timing.least,
                root.flight.duration / best.flight.duration,
                searched,
                1 + len(best.others),
                *_direct(case, best.cost),
            )
        )
    headings = (
        "case",
        "aim, s",
        "one homotopy, s",
        "fastest round",
        "its time over the best",
        "whole search, s",
        "extremals",
        "CasADi + Ipopt, cold, s",
        "its cost over ours",
    )
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


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
