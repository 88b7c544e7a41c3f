"""Solve a rendezvous: extremals are sought lap by lap, and the cheapest one is returned with the others."""

from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous.estimate import require_solvable
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.search import extremals
from pontryagin.rendezvous.reduced.search_log import INTERRUPTED, SearchLog
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.reduced.solution import Extremal, distinct, require_extremal


def solve(problem: Rendezvous, start: Extremal | None = None) -> Extremal:
    """The best extremal found of the rendezvous (1)-(7); its `others` are the other extremals found.

    The equations solved are (5), (6), (8)-(14), (16) and (17), with the angle about nu* in the place of (15).
    On each lap, which is a number of turns that the craft makes more or fewer than the target, extremals are
    transcribed in equinoctial elements and continued to the bound or to least time; they are the guesses of
    Newton's method for exact flights. Where planes are steep, orbits eccentric or no lap has an extremal,
    paths in space are brought to their least energy, and continued likewise. The maximum principle is
    necessary, not sufficient: the cheapest of the extremals found is returned, and `searched` states where
    they were sought.

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
        The cheapest one found. Its ``others`` are all other extremals found.

    Raises
    ------
    TypeError
        If ``problem`` is not a `Rendezvous`, or ``start`` not an `Extremal`.
    ValueError
        If the duration is free and the craft is with the target at the start.
    Infeasible
        If the duration is free and costs nothing (``time_weight=0``), or if a fixed one is too short for the
        bound: on every lap the transfer of least energy needs a mean thrust above the bound, or the costates
        grew without limit as the bound was lowered.
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
