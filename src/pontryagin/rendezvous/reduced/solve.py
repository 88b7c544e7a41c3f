"""Solve a rendezvous: first without a bound on the thrust, then with it, and for least time with alpha2 = 0.

Every step follows a family of rendezvous problems: without bound over the duration and over the revolutions,
then over the bound, then over alpha1/alpha2. All extremals reached are returned, cheapest first.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.progress import report
from pontryagin.rendezvous.estimate import require_solvable
from pontryagin.rendezvous.families import bounded, loose_ratios
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.search import UnboundedExtremal, through_revolutions
from pontryagin.rendezvous.reduced.search_log import INTERRUPTED, SearchLog
from pontryagin.rendezvous.reduced.shooting import SHOOTING, meet
from pontryagin.rendezvous.reduced.solution import Extremal, distinct, require_extremal
from pontryagin.rendezvous.reduced.start import unbounded
from pontryagin.rendezvous.root import Root

KEPT = 4
"""Number of extremals of the unbounded problem that are continued to the bound; for least time it is two."""


def solve(problem: Rendezvous, start: Extremal | None = None) -> Extremal:
    """The best extremal found of the rendezvous (1)-(7); its `others` are the other extremals found.

    The equations solved are (5), (6), (8)-(14), (16) and (17), with the angle about nu* in the place of (15).
    By continuation from coasting a transfer without bound is found, by families over the duration and over
    the revolutions further ones. Then the bound is lowered, and for least time alpha1/alpha2 is raised until
    the thrust is saturated throughout. The maximum principle is necessary, not sufficient: the cheapest of
    the extremals found is returned, and `searched` states where they were sought.

    Parameters
    ----------
    problem : Rendezvous
        The problem to be solved.
    start : Extremal, optional
        A solution of a problem close to this one. Newton's method then starts from its costates, and no
        other extremal is sought.

    Returns
    -------
    Extremal
        The cheapest one found. Its ``others`` are, without a bound, all extremals that the search found;
        with a bound, those that could be continued to it.

    Raises
    ------
    TypeError
        If ``problem`` is not a `Rendezvous`, or ``start`` not an `Extremal`.
    ValueError
        If the duration is free and the craft is with the target at the start.
    Infeasible
        If the duration is free and costs nothing (``time_weight=0``), or if a fixed one is too short for the
        bound: no extremal was reached, and in one of the families the costates grew without limit.
    NotConverged
        If no extremal was reached for another reason.
    KeyboardInterrupt
        After Ctrl-C; its argument is the best extremal found so far, if there is one.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> best = solve(leap)
    >>> round(best.cost, 6), best.certificate.holds(1e-10)
    (0.023882, True)
    """
    require_solvable(problem)
    scaled = problem.scaled
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    if start is not None:
        require_extremal("start", start)
        return Extremal(problem, meet(setting, _unknowns(start, problem)))
    log = SearchLog()
    found: list[Extremal] = []
    try:
        found.extend(Extremal(problem, root) for root in extremals(setting, log))
    except KeyboardInterrupt as stop:
        if found:
            log.ends.append(INTERRUPTED)
            stop.args = (_best(found, log),)
        raise
    return _best(found, log)


def _best(found: list[Extremal], log: SearchLog) -> Extremal:
    """The cheapest of the extremals found, with the others and the log of the search."""
    cheapest, *others = distinct(found)
    return replace(cheapest, others=tuple(others), searched=log.closed())


def _unknowns(start: Extremal, problem: Rendezvous) -> Array:
    """Costates of another problem's solution in this problem's units, with its duration if that is free."""
    scaled = problem.scaled
    costates = start.initial_costate / scaled.costate_units
    return np.append(costates, start.duration / scaled.time) if problem.free else costates


def extremals(setting: Setting, log: SearchLog) -> Iterator[Root[Flight]]:
    """All extremals found of a problem, in no particular order, each as soon as it is found.

    Raises
    ------
    NotConverged
        If none was reached.
    Infeasible
        If none was reached and in one of the families the bound came to the least for the fixed duration.
    """
    none, too_short = True, False
    for ratio in loose_ratios(setting.ratio, setting.peak):
        loose = setting.replace(peak=math.inf, ratio=ratio)
        reached: list[UnboundedExtremal] = []
        try:
            kept = _without_bound(setting, loose, log, reached)
        except KeyboardInterrupt:
            if setting.peak == math.inf:
                yield from (known.root for known in reached)
            raise
        for number, known in enumerate(kept, start=1):
            report("continuing extremals to the bound", number - 1, len(kept))
            try:
                root = bounded(SHOOTING, setting, loose.replace(lead=known.lead), known.root)
            except (NotConverged, Infeasible) as reason:
                too_short = too_short or isinstance(reason, Infeasible)
                log.given_up.append(f"extremal {number} of the problem without bound: {reason}")
                continue
            none = False
            yield root
    if not none:
        return
    reasons = "; ".join(log.given_up)
    if too_short and not setting.free:
        raise Infeasible(f"no extremal of this duration keeps the thrust within the peak: {reasons}")
    raise NotConverged(f"no extremal was found: {reasons}", float("inf"))


def _without_bound(
    setting: Setting, loose: Setting, log: SearchLog, reached: list[UnboundedExtremal]
) -> list[UnboundedExtremal]:
    """The extremals without bound that are continued to the bound, cheapest first; all if there is none.

    Each extremal is appended to ``reached`` as soon as it is found.
    """
    try:
        reached.extend(through_revolutions(loose, unbounded(loose, log), log))
    except NotConverged as reason:
        log.given_up.append(f"the problem without bound: {reason}")
        return []
    found = sorted(reached, key=lambda one: one.cost)
    most = len(found) if setting.peak == math.inf else 2 if setting.bang else KEPT
    if most < len(found):
        log.given_up.append(
            f"the {len(found) - most} most costly extremals of the problem without bound were not continued "
            "to the bound"
        )
    return found[:most]
