"""Extremals lap by lap: transcribed transfers in equinoctial elements, then Newton's method on exact flights.

Laps are counted from the target's own: lap 0 ends at the target's longitude next ahead of its start, each
further lap one turn later, negative laps sooner. They are tried upwards and downwards from 0, until a lap
has nothing that costs less than `WORSE` times the best extremal.
"""

import math

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.families import END_SHARES
from pontryagin.rendezvous.laps import families
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.ladder import free_transfers, price
from pontryagin.rendezvous.laps.transcription import Path
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.root import Root

WORSE = 2.0
"""A lap is the last one in its direction if all of its extremals cost more than this many times the best."""
FARTHEST = 6
"""Largest number of laps more or fewer than the target's own that is tried."""
HOPELESS = 3.0
"""A transfer that costs more than this many times the best extremal is not continued to the bound."""
FEW = 2
"""Number of transfers without a bound from which least time is sought on each lap."""


def extremals_on_laps(setting: Setting, log: SearchLog) -> list[Root[Flight]]:
    """The extremals of a problem that are found lap by lap, in no particular order.

    Raises
    ------
    NotConverged
        If none was reached on any lap.
    """
    roots: list[Root[Flight]] = []
    best = math.inf
    for sense in (1, -1):
        for laps in range(0 if sense > 0 else -1, sense * (FARTHEST + 1), sense):
            found = on_lap(setting, laps, log, best)
            roots += found
            least = min((cost(setting, root) for root in found), default=math.inf)
            best = min(best, least)
            if least > WORSE * best or not found:
                log.ends.append(f"{'more' if sense > 0 else 'fewer'} laps were tried up to {laps:+d}")
                break
    if not roots:
        raise NotConverged(f"no extremal was reached on any lap: {'; '.join(log.given_up)}", math.inf)
    return roots


def cost(setting: Setting, root: Root[Flight]) -> float:
    """J in the units of the solver."""
    time_weight, energy_weight = setting.scaled.weights
    spent = energy_weight * energy(root.flight) if energy_weight else 0.0
    return time_weight * root.flight.duration + spent


def on_lap(setting: Setting, laps: int, log: SearchLog, best: float = math.inf) -> list[Root[Flight]]:
    """The extremals of a problem on one lap, without those that can hardly cost less than the best one known.

    For least time several values of alpha1/alpha2 are tried until one of them leads to an extremal.
    """
    lap = Lap.of(setting.scaled, laps)
    found: list[Root[Flight]] = []
    for ratio in _ratios(setting):
        for path in _without_bound(setting, lap, ratio, log):
            if setting.peak < math.inf and _estimate(setting, path, ratio) > HOPELESS * best:
                log.given_up.append(f"lap {laps}: a transfer in the time {path.duration:.4g} costs too much")
                continue
            try:
                found.append(_transcribed(setting, lap, path, RunningCost(ratio, 1.0, setting.peak)))
                log.revolutions.append(laps)
            except (NotConverged, Infeasible) as reason:
                log.given_up.append(f"lap {laps}: {reason}")
        if found:
            break
    return found


def _estimate(setting: Setting, path: Path, ratio: float) -> float:
    """The cost of a transfer without a bound; its duration where the least time is sought."""
    return path.duration if setting.bang else price(path, ratio)


def _ratios(setting: Setting) -> list[float]:
    """Values of alpha1/alpha2 of the transfers without a bound; 0 where the duration is fixed."""
    if not setting.free:
        return [0.0]
    if setting.bang:
        return [(share * setting.peak) ** 2 for share in reversed(END_SHARES)]
    return [setting.ratio]


def _without_bound(setting: Setting, lap: Lap, ratio: float, log: SearchLog) -> list[Path]:
    """Transfers without a bound from which the extremals of the problem are sought."""
    try:
        if setting.duration is not None:
            return [families.least_energy(lap, setting.duration)]
        paths = free_transfers(lap, ratio, WORSE)
    except NotConverged as reason:
        log.given_up.append(f"lap {lap.laps}: {reason}")
        return []
    log.durations.extend(path.duration for path in paths)
    return paths[:FEW] if setting.bang else paths


def _transcribed(setting: Setting, lap: Lap, path: Path, limits: RunningCost) -> Root[Flight]:
    """The extremal reached by continuing the transcribed transfer to the bound, and to least time."""
    if setting.peak < math.inf:
        path = families.bounded(lap, path, limits, setting.duration)
    if setting.bang:
        path = families.least_time(lap, path, limits)
    return _met(setting, path)


def _met(setting: Setting, path: Path) -> Root[Flight]:
    costates = reduced_costates(setting.scaled, path.nodes[:, 0])
    return meet(setting, np.append(costates, path.duration) if setting.free else costates)
