"""Extremals lap by lap: transcribed transfers in equinoctial elements, then Newton's method on exact flights.

Laps are counted from the target's own: lap 0 ends at the target's longitude next ahead of its start, each
further lap one turn later, negative laps sooner. They are tried upwards and downwards from 0, until a guess
of the least cost on a lap is more than `WORSE` times the best extremal.
"""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.errors import Infeasible, NotConverged
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
"""Transfers that cost more than this many times the best extremal are not continued."""
FARTHEST = 6
"""Largest number of laps more or fewer than the target's own that is tried."""
MEAN_THRUSTS = (1.0, 0.7, 0.9, 0.8, 0.6)
"""Root mean square of the thrust, in units of p_max, of transfers from which least time is sought."""
LONGER = 2.0
"""Factor by which the duration of such a transfer may exceed the longest duration of interest."""
MARGIN = 1.2
"""Factor by which the energy of a guess may exceed the largest possible energy under the bound."""
ALIKE, SAME = 1e-2, 1e-7
"""Largest differences of one extremal: in the duration, relative, as transcribed; in an unknown, as flown."""


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
        laps = 0 if sense > 0 else -1
        while abs(laps) <= FARTHEST:
            lap = Lap.of(setting.scaled, laps)
            starts = first_durations(setting, lap, WORSE * best)
            if not starts and (roots or sense < 0):
                break
            found = on_lap(setting, lap, starts, log, WORSE * best)
            best = min([best, *(cost(setting, root) for root in found)])
            roots += found
            laps += sense
        log.ends.append(f"laps from {laps:+d} {'up' if sense > 0 else 'down'} were not tried")
    if not roots:
        reasons = log.given_up or ["each lap costs too much thrust, or is over before the start"]
        raise NotConverged(f"no extremal was reached on any lap: {'; '.join(reasons)}", math.inf)
    return roots


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
        return _with_mean_thrusts(lap, setting.peak, most)

    def minima(guesses: Guesses) -> list[tuple[float, float]]:
        return ladder.minima(guesses, setting.ratio, setting.peak)

    def longest(guesses: Guesses) -> float:
        return min((WORSE * price / setting.ratio for price, _ in minima(guesses)), default=math.inf)

    guesses = ladder.guesses_on(lap, longest, most / setting.ratio)
    return [duration for price, duration in minima(guesses) if price < most]


def _with_mean_thrusts(lap: Lap, peak: float, most: float) -> list[float]:
    """The durations of guesses whose thrust has the sizes `MEAN_THRUSTS`, in their order."""

    def durations(guesses: Guesses, *shares: float) -> list[float]:
        return [ladder.duration_of_thrust(guesses, share * peak) for share in shares]

    guesses = ladder.guesses_on(lap, lambda found: max(durations(found, *MEAN_THRUSTS)), LONGER * most)
    (least,) = durations(guesses, 1.0)
    return [found for found in durations(guesses, *MEAN_THRUSTS) if found < math.inf] if least < most else []


def on_lap(
    setting: Setting, lap: Lap, durations: list[float], log: SearchLog, most: float = math.inf
) -> list[Root[Flight]]:
    """The extremals of a problem on one lap, sought from first transfers of some durations.

    Those whose transcription costs more than ``most`` are left out.
    """
    found: list[Root[Flight]] = []
    log.durations.extend(durations)
    for path in _transcribed(setting, lap, durations, log, most):
        try:
            costates = reduced_costates(setting.scaled, path.nodes[:, 0])
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
    try:
        if setting.duration is None:
            reasons: list[str] = []
            yield from ladder.Ladder(lap, cost).transfers(durations, reasons, most)
            log.given_up.extend(f"lap {lap.laps}, {reason}" for reason in reasons)
        else:
            path = families.least_energy(lap, setting.duration)
            yield families.bounded(lap, path, cost, setting.duration)
    except NotConverged as reason:
        log.given_up.append(f"lap {lap.laps}: {reason}")


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
