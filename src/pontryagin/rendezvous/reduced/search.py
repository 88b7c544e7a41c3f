"""All means of seeking extremals: lap by lap, and from shapes where the laps may miss some."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.estimate import eccentricity
from pontryagin.rendezvous.laps.cartesian import Transfer
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.free_shape_search import free_extremals_from_shapes
from pontryagin.rendezvous.reduced.lap_search import SAME, cost, extremals_on_laps
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shape_search import extremals_from_shapes
from pontryagin.rendezvous.root import Root

INCLINED, ECCENTRIC = math.radians(30), 0.3
"""Inclination and eccentricity from which on extremals of a fixed duration are also sought from shapes."""
Means = Callable[[Setting, SearchLog, float], Iterator[Root[Flight]]]
"""A search, given the cost of the best extremal known."""
FREE_INCLINED = math.radians(66)
"""Inclination from which on extremals of free duration are also sought from shapes, which takes longer."""


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
    demanding = _demanding(setting)
    for means in _in_order(setting, demanding):
        if means is not extremals_on_laps and known and not demanding:
            break
        best = min((cost(setting, root) for root in known), default=math.inf)
        try:
            for root in means(setting, log, best):
                if all(np.abs(root.unknowns - other.unknowns).max() > SAME for other in known):
                    known.append(root)
                    yield root
        except (Infeasible, NotConverged) as reason:
            failure = reason
    if failure is not None and not known:
        raise failure


def _in_order(setting: Setting, demanding: bool) -> tuple[Means, Means]:
    """Laps and shapes, in the order in which they are tried.

    Free durations on many laps take long, which the cost of an extremal from a shape shortens.
    """
    if not setting.free:
        return extremals_on_laps, extremals_from_shapes
    first, second = extremals_on_laps, free_extremals_from_shapes
    return (second, first) if demanding else (first, second)


def _demanding(setting: Setting) -> bool:
    """Whether the search lap by lap may miss good extremals."""
    scaled = setting.scaled
    inclination = Transfer(scaled).inclination
    if setting.free:
        return inclination > FREE_INCLINED
    return inclination > INCLINED or max(eccentricity(scaled.start), scaled.eccentricity) > ECCENTRIC
