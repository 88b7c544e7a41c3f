"""Transcribed extremals of a fixed duration from shapes, by descents in space.

The search lap by lap describes a path by elements that vary slowly, which fails where the plane is turned far
from the centre or at little angular momentum. A path in space has no such places.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from pontryagin.errors import NotConverged
from pontryagin.progress import report
from pontryagin.rendezvous.laps import families
from pontryagin.rendezvous.laps.cartesian import Transfer
from pontryagin.rendezvous.laps.descent import Curve, Thrust, descended, path_of, spaced
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.shapes import Shape, curve
from pontryagin.rendezvous.laps.transcription import FEWEST, ROUGH, Path, extremal, refined
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.lap_search import MARGIN, WORSE, similar
from pontryagin.rendezvous.reduced.search_log import SearchLog

RISES = (0.0, 0.5, 1.0)
"""Heights of the apex of a first path."""
FARTHEST = 3
"""Largest number of full turns of a first path beyond the angle to the meeting."""
COARSE, FINE = 40, 60
"""Nodes for each lap of a first descent and of the last one."""
TRANSCRIBED = 100, 200
"""Nodes for each lap of a transcription by the midpoint rule, and those if it is not reached with these."""
DOUBLINGS = 2
"""How often the intervals of a transcription are halved before Newton's method for exact flights."""
ROUGHLY, CLOSELY = 1e-3, 1e-5
"""Accuracies of the first descent and of the last one, in units of the energy."""


def shapes(scaled: Scaled, duration: float, rises: tuple[float, ...] = RISES) -> list[Shape]:
    """The shapes that are tried: up to the turns that the faster of craft and target makes, and one more."""
    r, v1, c = scaled.start
    inverse = max(2 / r - v1**2 - (c / r) ** 2, 1 - scaled.eccentricity**2)
    turns = min(FARTHEST, 1 + math.floor(duration * inverse**1.5 / (2 * math.pi)))
    return [Shape(n, rise, back) for n in range(turns + 1) for rise in rises for back in (False, True)]


def paths_of_fixed_duration(setting: Setting, log: SearchLog, best: float) -> Iterator[Path]:
    """Transcribed extremals of a fixed duration that descents from the shapes lead to, in no order.

    Those that cost much more than the best are left out; what is not reached is logged.
    """
    scaled, duration = setting.scaled, float(setting.duration or 0.0)
    transfer, lost = Transfer(scaled), list[Shape]()
    log.durations.extend({duration} - {*log.durations})
    most = min(WORSE * best, MARGIN * setting.peak**2 * duration)
    report("seeking paths in space")
    for rough in minima(scaled, duration, shapes(scaled, duration), most, lost):
        try:
            yield _under_bound(setting, transfer, descended(spaced(rough, FINE, FEWEST), CLOSELY))
        except NotConverged as reason:
            log.given_up.append(f"a path in space of energy {Thrust.of(rough).energy:.4g}: {reason}")
    note_lost(lost, log)


def note_lost(lost: Sequence[Shape], log: SearchLog) -> None:
    """Log how many descents did not end."""
    if lost:
        log.given_up.append(f"{len(lost)} first paths in space: no descent ended")


def minima(
    scaled: Scaled,
    duration: float,
    tried: Sequence[Shape],
    most: float,
    lost: list[Shape],
    per_lap: float = COARSE,
    accuracy: float = ROUGHLY,
) -> Iterator[Curve]:
    """Different curves of least energy from some shapes, of energies below ``most``.

    Shapes from which no descent ends are added to a list.
    """
    known: list[Path] = []
    for shape in tried:
        try:
            found = descended(spaced(curve(scaled, duration, shape), per_lap, FEWEST), accuracy)
        except NotConverged:
            lost.append(shape)
            continue
        most = min(most, WORSE * Thrust.of(found).energy)
        path = path_of(found)
        if Thrust.of(found).energy <= most and not any(similar(path, other) for other in known):
            known.append(path)
            yield found


def _under_bound(setting: Setting, transfer: Transfer, found: Curve) -> Path:
    """The transfer under the bound, from a curve of least energy; this itself where it keeps the bound."""
    thrust = np.linalg.norm(Thrust.of(found).values, axis=-1)
    if thrust.max() <= setting.peak:
        return path_of(found)
    cost, duration = RunningCost(0.0, 1.0, setting.peak), float(found.times[-1])
    path = families.bounded(transfer, transcribed(transfer, found), cost, duration)
    return refined(transfer, cost, duration, path, DOUBLINGS)


def transcribed(transfer: Transfer, found: Curve) -> Path:
    """The transcription by the midpoint rule of a curve of least energy.

    Raises
    ------
    NotConverged
        If Newton's method does not reach it from the curve.
    """
    for per_lap in TRANSCRIBED:
        start = path_of(descended(spaced(found, per_lap, FEWEST), CLOSELY))
        try:
            return extremal(transfer, families.LEAST_ENERGY, float(found.times[-1]), start, ROUGH)
        except NotConverged as reason:
            failure = reason
    raise failure
