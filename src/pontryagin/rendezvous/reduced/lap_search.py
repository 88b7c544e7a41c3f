"""Extremals lap by lap: transcribed transfers in equinoctial elements, then Newton's method on exact flights.

Laps are counted from the target's own: lap 0 ends at the target's longitude next ahead of its start, each
further lap one turn later, negative laps sooner. They are tried upwards and downwards from 0, up to the first
lap that guesses of the least cost show to be dearer than `WORSE` times the best extremal.
"""

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.progress import report
from pontryagin.rendezvous.estimate import TOGETHER, gap, gap_duration
from pontryagin.rendezvous.laps import families, ladder
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.start import Guesses, least_energy_guesses
from pontryagin.rendezvous.laps.transcription import Path
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.root import Root

WORSE = 2.0
"""The search ends in a direction with the first lap that costs more than this many times the best."""
FURTHER = 2.5
"""Extremals of free duration on that last lap are taken if they cost less than this many times the best."""
FARTHEST = 6
"""Largest number of laps more or fewer than the target's own that is tried."""
MEAN_THRUSTS = (1.0, 0.7, 0.9, 0.8, 0.6)
"""Root mean square of the thrust, in units of p_max, of transfers from which least time is sought."""
LONGER = 2.0
"""Factor by which the duration of such a transfer may exceed the longest duration of interest."""
DETOURS, STEEP_DETOURS = (0.5, 2.0), (0.5, 0.7, 2.0)
"""Durations from which further extremals of a fixed duration are continued, in units of that duration, and
the same where they begin at the inclination `INCLINED`."""
INCLINED, STEEP = math.radians(60), 1.1
"""An inclination at which extremals that climb begin, and the factor from which on it is a lesser one."""
CLIMBING = 96
"""Nodes for each lap of extremals that may climb, where they move slowly and their longitude hardly."""
SHORT = 0.3
"""The shortest duration of a guess, in units of that in which the thrust closes the gap without gravity."""
MARGIN = 1.2
"""Factor by which the energy of a guess may exceed the largest possible energy under the bound."""
COASTING = np.array([0, 0, 0, 0, 0, 1e-6])
"""Costates of a craft that coasts; nu is slightly off zero, so that it has a direction."""
ALIKE, SIMILAR, SAME = 1e-2, 5e-2, 1e-7
"""Largest differences of one extremal: as transcribed, in the duration and in the costates at t0, both
relative; in an unknown, as flown."""


def extremals_on_laps(setting: Setting, log: SearchLog, best: float = math.inf) -> Iterator[Root[Flight]]:
    """The extremals of a problem that are found lap by lap, in no particular order.

    The cost of the best extremal known is given, if there is one.

    Raises
    ------
    Infeasible
        If on every lap a fixed duration needs a larger mean thrust than the bound.
    NotConverged
        If no extremal was reached for another reason.
    """
    if max(gap(setting.scaled)) < TOGETHER:  # So the duration is fixed, and no thrust is needed.
        yield meet(setting, COASTING)
        return
    for sense in (1, -1):
        laps, last = 0 if sense > 0 else -1, False
        while abs(laps) <= FARTHEST and not last:
            report(f"seeking extremals on lap {laps:+d}")
            lap, most = Lap.of(setting.scaled, laps), FURTHER * best if setting.free else math.inf
            starts = first_durations(setting, lap, WORSE * best)
            if not starts and best < math.inf:
                starts, last = first_durations(setting, lap, most), True
            for root in on_lap(setting, lap, starts, log, most):
                own = cost(setting, root)
                best, last = min(best, own), last or own > WORSE * best
                yield root
            laps += sense
        log.ends.append(f"laps from {laps:+d} {'up' if sense > 0 else 'down'} were not tried")
    if best == math.inf:
        raise _failure(setting, log)


def _failure(setting: Setting, log: SearchLog) -> Infeasible | NotConverged:
    """The reason why a search found nothing."""
    if setting.duration is not None and not log.durations:
        laps = [Lap.of(setting.scaled, number) for number in range(-FARTHEST, FARTHEST + 1)]
        guesses = [least_energy_guesses(lap, np.array([setting.duration])) for lap in laps]
        least = min((float(energy) for guess in guesses for energy in guess.energies), default=math.inf)
        if least < math.inf:
            mean, unit = math.sqrt(least / setting.duration), setting.scaled.acceleration
            return Infeasible(
                "no transfer of this duration keeps the thrust within the peak: its root mean square is at "
                f"least about {mean * unit:.4g} on each lap, which is above the peak of "
                f"{setting.peak * unit:.4g}"
            )
    reasons = log.given_up or ["each lap costs too much thrust, or is over before the start"]
    return NotConverged(f"no extremal was reached on any lap: {'; '.join(reasons)}", math.inf)


def cost(setting: Setting, root: Root[Flight]) -> float:
    """J in the units of the solver."""
    time_weight, energy_weight = setting.scaled.weights
    spent = energy_weight * energy(root.flight) if energy_weight else 0.0
    return time_weight * root.flight.duration + spent


def first_durations(setting: Setting, lap: Lap, most: float = math.inf) -> list[float]:
    """Durations of the first transfers of a lap; none if, by guesses, all its extremals cost more than that.

    The guesses are of least energy without a bound. Under a bound the mean of p^2 is at most p_max^2, so that
    no transfer is shorter than the duration at which the least mean is that.
    """
    if setting.duration is not None:
        guesses = least_energy_guesses(lap, np.array([setting.duration]))
        largest = min(most, MARGIN * setting.peak**2 * setting.duration)
        return [setting.duration] if (guesses.energies < largest).any() else []
    if setting.bang:
        return _with_mean_thrusts(setting, lap, most)

    def minima(guesses: Guesses) -> list[tuple[float, float]]:
        return ladder.minima(guesses, setting.ratio, setting.peak)

    def longest(guesses: Guesses) -> float:
        return min((WORSE * price / setting.ratio for price, _ in minima(guesses)), default=math.inf)

    shortest = SHORT * gap_duration(setting.scaled, math.sqrt(setting.ratio))
    guesses = ladder.guesses_on(lap, shortest, longest, most / setting.ratio)
    return [duration for price, duration in minima(guesses) if price < most]


def _with_mean_thrusts(setting: Setting, lap: Lap, most: float) -> list[float]:
    """The durations of guesses whose thrust has the sizes `MEAN_THRUSTS`, in their order."""

    def durations(guesses: Guesses, *shares: float) -> list[float]:
        return [ladder.duration_of_thrust(guesses, share * setting.peak) for share in shares]

    def longest(guesses: Guesses) -> float:
        return max(durations(guesses, *MEAN_THRUSTS))

    shortest = SHORT * gap_duration(setting.scaled, setting.peak)
    guesses = ladder.guesses_on(lap, shortest, longest, LONGER * most)
    (least,) = durations(guesses, 1.0)
    return [found for found in durations(guesses, *MEAN_THRUSTS) if found < math.inf] if least < most else []


def on_lap(
    setting: Setting, lap: Lap, durations: list[float], log: SearchLog, most: float = math.inf
) -> list[Root[Flight]]:
    """The extremals of a problem on one lap, sought from first transfers of some durations.

    Those whose transcription costs more than ``most`` are left out.
    """
    found: list[Root[Flight]] = []
    log.durations.extend(duration for duration in durations if duration not in log.durations)
    for path in _transcribed(setting, lap, durations, log, most):
        try:
            costates = reduced_costates(setting.scaled, lap.axes, path.nodes[:, 0])
            root = meet(setting, np.append(costates, path.duration) if setting.free else costates)
        except (NotConverged, Infeasible) as reason:
            log.given_up.append(f"lap {lap.laps}: {reason}")
            continue
        if all(np.abs(root.unknowns - other.unknowns).max() > SAME for other in found):
            found.append(root)
            log.revolutions.append(lap.laps)
    return found


def _transcribed(
    setting: Setting, lap: Lap, durations: list[float], log: SearchLog, most: float
) -> Iterator[Path]:
    """Transcribed extremals under the bound, as guesses of exact ones."""
    if setting.bang:
        yield from _of_least_time(lap, setting.peak, durations, log, most)
        return
    cost = RunningCost(setting.ratio if setting.free else 0.0, 1.0, setting.peak)
    if setting.duration is not None:
        yield from _of_fixed_duration(lap, cost, setting.duration, log)
        return
    reasons: list[str] = []
    try:
        begin = partial(families.least_energy, lap)
        yield from ladder.Ladder(lap, cost, begin).transfers(durations, reasons, most)
        log.given_up.extend(f"lap {lap.laps}, {reason}" for reason in reasons)
    except NotConverged as reason:
        log.given_up.append(f"lap {lap.laps}: {reason}")


def _of_fixed_duration(lap: Lap, cost: RunningCost, duration: float, log: SearchLog) -> Iterator[Path]:
    """Transcribed extremals of a fixed duration, also those that are continued from other durations.

    Along a family of extremals the duration may turn, so that several lie on one lap.
    """
    ways = [partial(families.least_energy, lap, duration, families.FINEST)]
    by_way_of = partial(families.least_energy_by_way_of, lap, duration)
    steep = lap.inclination > STEEP * INCLINED
    ways += [partial(by_way_of, share * duration, round_folds=steep) for share in DETOURS]
    if steep:
        share = INCLINED / lap.inclination
        ways += [partial(by_way_of, factor * duration, share, CLIMBING, True) for factor in STEEP_DETOURS]
    known: list[Path] = []
    for way in ways:
        try:
            path = way()
            if any(similar(path, other) for other in known):
                continue
            known.append(path)
            yield families.bounded(lap, path, cost, duration)
        except NotConverged as reason:
            if not known:
                log.given_up.append(f"lap {lap.laps}: {reason}")


def similar(one: Path, other: Path) -> bool:
    """Whether two transcribed paths of one duration, perhaps on different nodes, seem to be one extremal."""
    first, second = one.nodes[6:, 0], other.nodes[6:, 0]
    return float(np.abs(first - second).max()) < SIMILAR * float(np.abs(first).max())


def _of_least_time(
    lap: Lap, peak: float, durations: list[float], log: SearchLog, most: float
) -> Iterator[Path]:
    """Transcribed extremals of least time, until two first transfers lead to the same."""
    known: list[float] = []
    for duration in durations:
        try:
            path = families.least_time(lap, families.least_energy(lap, duration), peak)
        except NotConverged as reason:
            log.given_up.append(f"lap {lap.laps}, from the duration {duration:.4g}: {reason}")
            continue
        if any(abs(path.duration / other - 1) < ALIKE for other in known):
            return
        known.append(path.duration)
        if path.duration < most:
            yield path
