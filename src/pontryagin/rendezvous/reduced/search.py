"""Extremals of the problem without bound with more or fewer revolutions.

They lie on one curve, along which the target's orbit is turned in its plane: after every whole turn the orbit
is the original one again.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, between
from pontryagin.progress import report
from pontryagin.rendezvous.reduced.conditions import ReducedEquations, Setting
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shooting import curve, meet
from pontryagin.rendezvous.root import Root

TAU = 2 * math.pi
REVOLUTIONS = 4
"""Largest number of revolutions, more or fewer than those of the first extremal, that is tried."""
WORSE = 2.0
"""The curve is left at an extremal that costs more than this many times the best one."""


@dataclass(frozen=True)
class UnboundedExtremal:
    """An extremal of the unbounded problem, with its lead and alpha1/alpha2; see `Setting`."""

    root: Root[Flight]
    lead: float
    ratio: float

    @cached_property
    def cost(self) -> float:
        """The integral of alpha1 + alpha2 p^2 in units of alpha2."""
        flight = self.root.flight
        return self.ratio * flight.duration + energy(flight)


def through_revolutions(setting: Setting, first: Root[Flight], log: SearchLog) -> Iterator[UnboundedExtremal]:
    """The first extremal, and those with more and with fewer revolutions on the curve through it."""
    start = UnboundedExtremal(first, 0.0, setting.ratio)
    log.revolutions.append(0)
    yield start
    for sign in (1, -1):
        yield from _walk(setting, first, sign, log, start.cost)


def _walk(
    setting: Setting, first: Root[Flight], sign: int, log: SearchLog, best: float
) -> Iterator[UnboundedExtremal]:
    last: Point[ReducedEquations] | None = None
    cost, end = best, ""
    way = "towards more revolutions" if sign > 0 else "towards fewer revolutions"
    for point in curve(setting, first, "lead", sign):
        report(f"following extremals {way}: {point.parameter / TAU:+.2f}")
        for j, guess in _passed(last, point):
            lead = TAU * j
            try:
                root = meet(setting.replace(lead=lead), guess)
            except NotConverged as reason:
                log.given_up.append(f"extremal with {j:+d} revolutions: {reason}")
                continue
            found = UnboundedExtremal(root, lead, setting.ratio)
            log.revolutions.append(j)
            cost = found.cost
            best = min(best, cost)
            yield found
        end = _end(point, cost, best)
        if end:
            break
        last = point
    log.ends.append(
        f"{way}, ended at {point.parameter / TAU:+.2f}: {end or 'the curve could not be followed further'}"
    )


def _end(point: Point[ReducedEquations], cost: float, best: float) -> str:
    """The reason to leave the curve at a point; empty if it is followed further."""
    if abs(point.parameter) > TAU * (REVOLUTIONS + 0.5):
        return f"more than {REVOLUTIONS} revolutions are not tried"
    return f"the last extremal costs more than {WORSE:g} times the best" if cost > WORSE * best else ""


def _passed(last: Point[ReducedEquations] | None, point: Point[ReducedEquations]) -> list[tuple[int, Array]]:
    """Whole revolutions between two points of the curve, with unknowns there; the start is left out."""
    if last is None:
        return []
    low, high = sorted((last.parameter / TAU, point.parameter / TAU))
    turns = [j for j in range(math.ceil(low), math.floor(high) + 1) if j or last.parameter]
    return [(j, between(last, point, TAU * j)) for j in turns]
