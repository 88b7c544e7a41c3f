"""Transcribed extremals of free duration from shapes: descents for many durations, then continuation.

The least energies over the durations show where an extremal of the mixed cost may be, or which durations have
a mean thrust near the bound, so that those of least time are not far.
"""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.errors import NotConverged
from pontryagin.progress import report
from pontryagin.rendezvous.estimate import gap_duration
from pontryagin.rendezvous.laps import families, ladder
from pontryagin.rendezvous.laps.cartesian import Transfer
from pontryagin.rendezvous.laps.descent import Curve, Thrust
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.shapes import Shape
from pontryagin.rendezvous.laps.transcription import Path, refined
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.lap_search import ALIKE, LONGER, SHORT
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shape_search import DOUBLINGS, minima, note_lost, shapes, transcribed

RISES = (0.5, 1.0)
"""Heights of the apex of a first path."""
COARSE, ROUGHLY = 24, 1e-2
"""Nodes for each lap of a descent, and its accuracy in units of the energy."""
FACTOR, LONGEST = 1.2, 60.0
"""Ratio of two durations that are tried, and the longest of them, in units of sqrt(p*^3/fM)."""
FINEST = 1 / 256
"""The least step of a walk, in units of its length: the thrust turns quickly where little of it is needed."""
SLOWEST = 0.6
"""Least root mean square of the thrust, in units of p_max, of transfers from which least time is sought."""
EACH = 2
"""Number of curves of one duration from which least time is sought."""
WORTH = 1.1
"""Durations end where the time alone costs this many times the best."""


def paths_of_free_duration(setting: Setting, log: SearchLog, best: float) -> Iterator[Path]:
    """Transcribed extremals of free duration that descents from shapes lead to, in no particular order.

    What is not reached is logged.
    """
    paths = _of_least_time if setting.bang else _of_mixed_cost
    yield from paths(setting, Transfer(setting.scaled), best, log)


def least_energy_in_space(scaled: Scaled, duration: float) -> float:
    """The least energy of a duration that descents from a few shapes lead to; inf if none ends."""
    found = minima(scaled, duration, shapes(scaled, duration, RISES[:1]), math.inf, [], COARSE, ROUGHLY)
    return min((Thrust.of(curve).energy for curve in found), default=math.inf)


def _curves(setting: Setting, thrust: float, lost: list[Shape]) -> Iterator[tuple[float, list[Curve]]]:
    """Longer and longer durations, each with its different curves of least energy, the best first."""
    scaled = setting.scaled
    duration = SHORT * gap_duration(scaled, thrust)
    while duration < LONGEST:
        report(f"seeking paths in space for the duration {duration:.4g}")
        tried = shapes(scaled, duration, RISES)
        found = minima(scaled, duration, tried, math.inf, lost, COARSE, ROUGHLY)
        yield duration, sorted(found, key=lambda curve: Thrust.of(curve).energy)
        duration *= FACTOR


def _of_least_time(setting: Setting, transfer: Transfer, best: float, log: SearchLog) -> Iterator[Path]:
    """Transcribed extremals of least time.

    A longer duration may suddenly need little thrust, where a lap opens. From the first one that needs no
    more than the bound, least time is therefore sought even if its thrust is far below the bound.
    """
    known: list[float] = []
    reached = False
    lost: list[Shape] = []
    for duration, curves in _curves(setting, setting.peak, lost):
        means = [math.sqrt(Thrust.of(curve).energy / duration) / setting.peak for curve in curves]
        slowest = SLOWEST if reached else 0.0
        reached = reached or min(means, default=math.inf) < 1
        for mean, curve in zip(means[:EACH], curves, strict=False):
            if not slowest < mean < 1:
                continue
            log.durations.append(duration)
            try:
                path = families.least_time(
                    transfer, transcribed(transfer, curve), setting.peak, FINEST, DOUBLINGS
                )
            except NotConverged as reason:
                log.given_up.append(f"a path in space of duration {duration:.4g}: {reason}")
                continue
            if all(abs(path.duration / other - 1) > ALIKE for other in known):
                known.append(path.duration)
                yield path
        if min(means, default=math.inf) < SLOWEST or duration > LONGER * best:
            break
    note_lost(lost, log)


def _of_mixed_cost(setting: Setting, transfer: Transfer, best: float, log: SearchLog) -> Iterator[Path]:
    """Transcribed extremals of a mixed cost, under the bound if there is one."""
    lost: list[Shape] = []
    durations: list[float] = []
    prices: list[float] = []
    starts: dict[float, Curve] = {}
    for duration, curves in _curves(setting, math.sqrt(setting.ratio), lost):
        energy = Thrust.of(curves[0]).energy if curves else math.inf
        if energy <= (ladder.ROOM * setting.peak) ** 2 * duration:
            durations.append(duration)
            prices.append(setting.ratio * duration + energy)
            starts[duration] = curves[0]
            best = min(best, prices[-1])
        if setting.ratio * duration > WORTH * best:
            break
    note_lost(lost, log)
    around = np.pad(prices, 1, constant_values=math.inf)
    least = [i for i, price in enumerate(prices) if price <= min(around[i], around[i + 2])]
    seeds = [durations[i] for i in sorted(least, key=lambda i: prices[i])]
    log.durations.extend(seeds)
    cost, reasons = RunningCost(setting.ratio, 1.0, setting.peak), list[str]()
    rungs = ladder.Ladder(transfer, cost, lambda duration: transcribed(transfer, starts[duration]))
    for path in rungs.transfers(seeds, reasons):
        try:
            yield refined(transfer, cost, None, path, DOUBLINGS)
        except NotConverged as reason:
            reasons.append(f"near the duration {path.duration:.4g}: {reason}")
    log.given_up.extend(f"paths in space, {reason}" for reason in reasons)
