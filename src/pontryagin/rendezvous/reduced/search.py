"""From one extremal to all that the search finds: durations, revolutions, the bound, least time.

Every step follows a curve of true rendezvous problems: the duration of the unbounded problem, the place of
the target's pericentre turned through whole revolutions, the bound from where it does not bind down to
p_max, and alpha1/alpha2 upwards until the thrust is saturated throughout.
"""

import math
from dataclasses import dataclass

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.reduced.bound import bounded
from pontryagin.rendezvous.reduced.first_extremal import first
from pontryagin.rendezvous.reduced.homotopy import (
    Point,
    Root,
    between,
    follow,
    newton,
)
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.search_log import Search
from pontryagin.rendezvous.reduced.shooting import (
    Equations,
    Setting,
    equations,
)

TAU = 2 * math.pi
WALK = 100
"""Points of a curve through the revolutions, each way."""
REVOLUTIONS = 4
"""How many revolutions more or fewer than the first extremal's are looked at."""
WORSE = 2.0
"""The walk through the revolutions ends where an extremal costs this many times the best and more."""
KEPT = 4
"""How many extremals of the unbounded problem are taken on to the bound."""
END_SHARES = (2.5, 1.5, 0.7)
"""Thrust in units of p_max at the end of the unbounded problems from which least time is sought.

From one of them alone the curve may turn back before the thrust is saturated, or lead to a slower extremal.
"""


def extremals(setting: Setting, log: Search) -> list[Root]:
    """All extremals found of a problem, in no order.

    Raises
    ------
    NotConverged
        If none was reached.
    Infeasible
        If none was, and on a curve followed the bound came to the least for the fixed duration.
    """
    roots: list[Root] = []
    short = False
    for ratio in _loose_ratios(setting):
        loose = setting.but(peak=math.inf, ratio=ratio)
        try:
            found = _through_revolutions(loose, first(loose, log), log)
        except NotConverged as reason:
            log.given_up.append(f"the unbounded problem: {reason}")
            continue
        found.sort(key=value)
        for j, known in enumerate(_kept(setting, found, log)):
            try:
                roots.append(bounded(setting, loose.but(lead=known.lead), known.root))
            except (NotConverged, Infeasible) as reason:
                short = short or isinstance(reason, Infeasible)
                log.given_up.append(f"extremal {j + 1} of the unbounded problem: {reason}")
    if roots:
        return roots
    reasons = "; ".join(log.given_up)
    if short and not setting.free:
        raise Infeasible(f"no extremal of this duration stays within the peak: {reasons}")
    raise NotConverged(f"no extremal was reached: {reasons}", float("inf"))


def _kept(setting: Setting, found: list["Found"], log: Search) -> list["Found"]:
    """Those that are taken on to the bound, cheapest first; without one all of them."""
    most = len(found) if setting.peak == math.inf else 2 if setting.bang else KEPT
    if most < len(found):
        log.given_up.append(
            f"{len(found) - most} extremals of the unbounded problem were not taken to the bound: of it they "
            "are the dearest"
        )
    return found[:most]


def _loose_ratios(setting: Setting) -> list[float]:
    """alpha1/alpha2 of the unbounded problems that are solved first."""
    return [(share * setting.peak) ** 2 for share in END_SHARES] if setting.bang else [setting.ratio]


@dataclass(frozen=True)
class Found:
    """An extremal of the unbounded problem and the lead it belongs to."""

    root: Root
    lead: float
    ratio: float


def value(found: Found) -> float:
    """Its cost, alpha2 = 1."""
    flight = found.root.flight
    return found.ratio * flight.duration + energy(flight)


def _through_revolutions(setting: Setting, first: Root, log: Search) -> list[Found]:
    """Extremals with more revolutions and with fewer, along the curve on which the target's orbit turns."""
    found = [Found(first, 0.0, setting.ratio)]
    log.revolutions.append(0)
    for sign in (1, -1):
        found += _walk(setting, first, sign, log, value(found[0]))
    return found


def _walk(setting: Setting, first: Root, sign: int, log: Search, best: float) -> list[Found]:
    found: list[Found] = []
    last: Point | None = None
    cost, end = best, ""
    family = turning(setting.but(rough=True))
    for point in follow(family, first.unknowns, 0.0, sign, step=0.3, steps=WALK, largest=1.5):
        for j, guess in _passed(last, point):
            lead = TAU * j
            try:
                root = newton(setting.but(lead=lead), guess)
            except NotConverged as reason:
                log.given_up.append(f"{j} revolutions more: {reason}")
                continue
            found.append(Found(root, lead, setting.ratio))
            log.revolutions.append(j)
            cost = value(found[-1])
            best = min(best, cost)
        end = _end(point, cost, best)
        if end:
            break
        last = point
    way = "forwards" if sign > 0 else "backwards"
    log.ends.append(f"{way}, to {point.parameter / TAU:+.2f}: {end or 'the curve could not be followed on'}")
    return found


def _end(point: Point, cost: float, best: float) -> str:
    """Why the walk through the revolutions goes no farther; empty if it does."""
    if abs(point.parameter) > TAU * (REVOLUTIONS + 0.5):
        return f"{REVOLUTIONS} revolutions were looked at"
    return f"the last meeting cost more than {WORSE:g} times the best" if cost > WORSE * best else ""


def _passed(last: Point | None, point: Point) -> list[tuple[int, Array]]:
    """Whole revolutions between two points of a curve, and unknowns there; the start is known already."""
    if last is None:
        return []
    low, high = sorted((last.parameter / TAU, point.parameter / TAU))
    turns = [j for j in range(math.ceil(low), math.floor(high) + 1) if j or last.parameter]
    return [(j, between(last, point, TAU * j)) for j in turns]


def turning(setting: Setting):
    """The family over the lead."""

    def family(unknowns: Array, parameter: float) -> tuple[Equations, Array]:
        values = equations(setting.but(lead=parameter), unknowns)
        return values, values.by_lead

    return family
