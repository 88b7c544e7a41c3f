"""Units and colours that the figures of this paper share."""

import itertools
from dataclasses import dataclass

from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    RED,
)
from pontryagin.rendezvous.elements.solution import ElementsExtremal
from pontryagin.rendezvous.problem.cases import (
    ASTRONOMICAL_UNIT,
    DAY,
    SUN,
)
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.solution import Extremal

COMPONENTS = (BLUE, GREEN, ORANGE)
CRAFT, TARGET, START, THRUST, BOUND, OTHER = BLUE, GREEN, GREY, RED, INK, PURPLE
ROTATED = ORANGE
"""Colour of the target rotated about nu*, which a false meeting reaches."""


@dataclass(frozen=True)
class Units:
    """The units in which a figure shows a problem's numbers, and their names; a name may be empty."""

    length: float
    time: float
    acceleration: float
    length_name: str
    time_name: str
    acceleration_name: str

    def axis(self, symbol: str, quantity: str) -> str:
        """A symbol for an axis, with its unit if it has one."""
        name = getattr(self, f"{quantity}_name")
        return f"{symbol} [{name}]" if name else symbol


def units(problem: Rendezvous) -> Units:
    """Astronomical units and days, or megametres and hours, for a problem in km and s; else no units."""
    if problem.gravity == 1:
        return Units(1.0, 1.0, 1.0, "", "", "")
    if problem.gravity == SUN:
        return Units(ASTRONOMICAL_UNIT, DAY, 1e-6, "AU", "d", r"mm/s$^2$")
    return Units(1000.0, 3600.0, 1e-6, r"$10^3$ km", "h", r"mm/s$^2$")


def saturated_arcs(extremal: Extremal | ElementsExtremal) -> list[tuple[float, float]]:
    """Begin and end, since the start, of each arc with the thrust at its bound."""
    edges = itertools.pairwise([0.0, *extremal.switch_times, extremal.duration])
    return [ends for mode, ends in zip(extremal.modes, edges, strict=True) if mode == "saturated"]


def power(value: float) -> str:
    r"""A small number with one digit, as a power of ten in TeX.

    Examples
    --------
    >>> print(power(3.2e-15))
    $3\times10^{-15}$
    """
    digits, exponent = f"{value:.0e}".split("e")
    return rf"${digits}\times10^{{{int(exponent)}}}$" if value else "0"
