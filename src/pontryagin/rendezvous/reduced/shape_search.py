"""Extremals of a fixed duration from shapes: descents in space, then Newton's method on exact flights.

The search lap by lap describes a path by elements that vary slowly, which fails where the plane is turned far
from the centre or at little angular momentum. A path in space has no such places.
"""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.progress import report
from pontryagin.rendezvous.laps import families
from pontryagin.rendezvous.laps.cartesian import Transfer, reduced_costates
from pontryagin.rendezvous.laps.descent import Curve, Thrust, descended, path_of, spaced
from pontryagin.rendezvous.laps.equinoctial import laps_of
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.shapes import Shape, curve
from pontryagin.rendezvous.laps.transcription import FEWEST, ROUGH, Path, extremal
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.lap_search import MARGIN, WORSE, similar
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.root import Root

RISES = (0.0, 0.5, 1.0)
"""Heights of the apex of a first path."""
FARTHEST = 3
"""Largest number of full turns of a first path beyond the angle to the meeting."""
COARSE, FINE, TRANSCRIBED = 40, 60, 100
"""Nodes for each lap of a first descent, of the last one, and of a transcription by the midpoint rule."""
SAMPLES = 200
"""Times at which the longitude of a flight is evaluated."""
ROUGHLY, CLOSELY = 1e-3, 1e-5
"""Accuracies of the first descent and of the last one, in units of the energy."""


def shapes(scaled: Scaled, duration: float) -> list[Shape]:
    """The shapes that are tried: up to the turns that the faster of craft and target makes, and one more."""
    r, v1, c = scaled.start
    inverse = max(2 / r - v1**2 - (c / r) ** 2, 1 - scaled.eccentricity**2)
    turns = min(FARTHEST, 1 + math.floor(duration * inverse**1.5 / (2 * math.pi)))
    return [Shape(n, rise, back) for n in range(turns + 1) for rise in RISES for back in (False, True)]


def extremals_from_shapes(setting: Setting, best: float, log: SearchLog) -> Iterator[Root[Flight]]:
    """The extremals of a fixed duration that descents from the shapes lead to, in no particular order.

    Those that cost much more than the best are left out; what is not reached is logged.
    """
    scaled, duration = setting.scaled, float(setting.duration or 0.0)
    transfer = Transfer(scaled)
    log.durations.extend({duration} - {*log.durations})
    for found in minima(scaled, duration, min(WORSE * best, MARGIN * setting.peak**2 * duration), log):
        try:
            costates = reduced_costates(scaled, _under_bound(setting, transfer, found).nodes[6:, 0])
            root = meet(setting, costates)
        except (NotConverged, Infeasible) as reason:
            log.given_up.append(f"a path in space of energy {Thrust.of(found).energy:.4g}: {reason}")
            continue
        log.revolutions.append(lap_of(setting, root.flight))
        yield root


def lap_of(setting: Setting, flight: Flight) -> int:
    """The lap of a meeting."""
    states = flight.sample(np.linspace(0.0, flight.duration, SAMPLES))
    return laps_of(setting.scaled, states, flight.attitude(states), flight.duration)


def minima(scaled: Scaled, duration: float, most: float, log: SearchLog) -> Iterator[Curve]:
    """Different curves of least energy from all shapes, of energies below ``most``."""
    known: list[Path] = []
    lost = 0
    tried = shapes(scaled, duration)
    report("seeking paths in space")
    for shape in tried:
        try:
            rough = descended(spaced(curve(scaled, duration, shape), COARSE, FEWEST), ROUGHLY)
            most = min(most, WORSE * Thrust.of(rough).energy)
            path = path_of(rough)
            if Thrust.of(rough).energy > most or any(similar(path, other) for other in known):
                continue
            known.append(path)
            yield descended(spaced(rough, FINE, FEWEST), CLOSELY)
        except NotConverged:
            lost += 1
    if lost:
        log.given_up.append(f"{lost} of {len(tried)} first paths in space: the energy did not settle")


def _under_bound(setting: Setting, transfer: Transfer, found: Curve) -> Path:
    """The transfer under the bound, from a curve of least energy; this itself where it keeps the bound."""
    thrust = np.linalg.norm(Thrust.of(found).values, axis=-1)
    if thrust.max() <= setting.peak:
        return path_of(found)
    path = transcribed(transfer, found)
    return families.bounded(transfer, path, RunningCost(0.0, 1.0, setting.peak), found.times[-1])


def transcribed(transfer: Transfer, found: Curve) -> Path:
    """The transcription by the midpoint rule of a curve of least energy.

    Raises
    ------
    NotConverged
        If Newton's method does not reach it from the curve.
    """
    start = path_of(descended(spaced(found, TRANSCRIBED, FEWEST), CLOSELY))
    return extremal(transfer, families.LEAST_ENERGY, float(found.times[-1]), start, ROUGH)
