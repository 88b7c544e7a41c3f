"""All means of seeking extremals: lap by lap, and from shapes where the laps may miss some."""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.estimate import eccentricity
from pontryagin.rendezvous.laps.cartesian import Transfer
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.lap_search import SAME, cost, extremals_on_laps
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shape_search import extremals_from_shapes
from pontryagin.rendezvous.root import Root

INCLINED, ECCENTRIC = math.radians(30), 0.3
"""Inclination and eccentricity from which on extremals of a fixed duration are also sought from shapes."""


def extremals(setting: Setting, log: SearchLog) -> Iterator[Root[Flight]]:
    """The extremals of a problem, in no particular order.

    Raises
    ------
    Infeasible
        If a fixed duration needs a larger mean thrust than the bound.
    NotConverged
        If no extremal was reached for another reason.
    """
    known: list[Root[Flight]] = []
    failure: Infeasible | NotConverged | None = None
    try:
        for root in extremals_on_laps(setting, log):
            known.append(root)
            yield root
    except (Infeasible, NotConverged) as reason:
        failure = reason
    best = min((cost(setting, root) for root in known), default=math.inf)
    further = not setting.free and (not known or _demanding(setting))
    for root in extremals_from_shapes(setting, best, log) if further else ():
        if all(np.abs(root.unknowns - other.unknowns).max() > SAME for other in known):
            known.append(root)
            yield root
    if failure is not None and not known:
        raise failure


def _demanding(setting: Setting) -> bool:
    """Whether the search lap by lap may miss good extremals."""
    scaled = setting.scaled
    most = max(eccentricity(scaled.start), scaled.eccentricity)
    return Transfer(scaled).inclination > INCLINED or most > ECCENTRIC
