"""All means of seeking extremals: lap by lap, and from shapes where the laps may miss some."""

import math
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.estimate import eccentricity
from pontryagin.rendezvous.laps.cartesian import Transfer, reduced_costates
from pontryagin.rendezvous.laps.equinoctial import laps_of
from pontryagin.rendezvous.laps.transcription import Path
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.free_shape_search import least_energy_in_space, paths_of_free_duration
from pontryagin.rendezvous.reduced.lap_search import SAME, cost, extremals_on_laps
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shape_search import paths_of_fixed_duration
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.root import Root

INCLINED, STEEP, ECCENTRIC = math.radians(35), math.radians(66), 0.3
"""Inclination from which on a few paths in space show whether more are worth while; inclination from which on
they are always sought, as from this eccentricity on if the duration is fixed."""
Means = Callable[[Setting, SearchLog, float], Iterator[Root[Flight]]]
"""A search, given the cost of the best extremal known."""
SAMPLES = 200
"""Times at which the longitude of a flight is evaluated."""
RADIAL = 0.1
"""Angular momentum, in units of the target's, below which a path between nodes may lose all of it."""
IDLE, LESS = 0.85, 0.97
"""Root mean square of the thrust of a path in space, in units of p_max, and its cost, in units of that of the
best extremal of the same duration, below which a better one is likely."""


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
        if known and not demanding and not _improvable(setting, known):
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


def _improvable(setting: Setting, known: list[Root[Flight]]) -> bool:
    """Whether paths in space of the best extremal's duration need much less thrust, or cost less."""
    if Transfer(setting.scaled).inclination <= INCLINED:
        return False
    best = min(known, key=partial(cost, setting))
    duration = best.flight.duration
    least = least_energy_in_space(setting.scaled, duration)
    if setting.bang:
        return least < (IDLE * setting.peak) ** 2 * duration
    return setting.scaled.weights[0] * duration + least < LESS * cost(setting, best)


def _in_order(setting: Setting, demanding: bool) -> tuple[Means, Means]:
    """Laps and shapes, in the order in which they are tried.

    Free durations on many laps take long, which the cost of an extremal from a shape shortens.
    """
    order = extremals_on_laps, extremals_from_shapes
    return order[::-1] if setting.free and demanding else order


def extremals_from_shapes(setting: Setting, log: SearchLog, best: float) -> Iterator[Root[Flight]]:
    """The extremals that descents from shapes lead to, in no order; what is not reached is logged."""
    paths = paths_of_free_duration if setting.free else paths_of_fixed_duration
    for path in paths(setting, log, best):
        try:
            costates = reduced_costates(setting.scaled, path.nodes[6:, 0])
            root = meet(setting, np.append(costates, path.duration) if setting.free else costates)
        except (NotConverged, Infeasible) as reason:
            log.given_up.append(f"a path in space of duration {path.duration:.4g}: {reason}{_radial(path)}")
            continue
        log.revolutions.append(_lap(setting, root.flight))
        yield root


def _radial(path: Path) -> str:
    """What is said of a path that loses its angular momentum."""
    if np.linalg.norm(np.cross(path.nodes[:3].T, path.nodes[3:6].T), axis=1).min() > RADIAL:
        return ""
    return "; it moves radially at some time, where the axes eta are undefined: try solve_in_elements"


def _lap(setting: Setting, flight: Flight) -> int:
    """The lap of a meeting."""
    states = flight.sample(np.linspace(0.0, flight.duration, SAMPLES))
    return laps_of(setting.scaled, states, flight.attitude(states), flight.duration)


def _demanding(setting: Setting) -> bool:
    """Whether the search lap by lap may miss good extremals."""
    scaled = setting.scaled
    if Transfer(scaled).inclination > STEEP:
        return True
    return not setting.free and max(eccentricity(scaled.start), scaled.eccentricity) > ECCENTRIC
