"""Units, words and colours that the figures of this paper share."""

from dataclasses import dataclass

from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    RED,
)
from pontryagin.rendezvous.problem.cases import (
    ASTRONOMICAL_UNIT,
    DAY,
    SUN,
)
from pontryagin.rendezvous.problem.rendezvous import Rendezvous

COMPONENTS = (BLUE, GREEN, ORANGE)
CRAFT, TARGET, START, THRUST, BOUND, OTHER = BLUE, GREEN, "#888888", RED, INK, PURPLE
PHANTOM = ORANGE
"""Where the target would be if a false meeting were true."""


@dataclass(frozen=True)
class Units:
    """What the numbers of a problem are divided by for a picture, and what is then written at an axis."""

    length: float
    time: float
    acceleration: float
    length_name: str
    time_name: str
    acceleration_name: str

    def axis(self, symbol: str, quantity: str) -> str:
        """A symbol with its unit, where it has one."""
        name = getattr(self, f"{quantity}_name")
        return f"{symbol} [{name}]" if name else symbol


def units(problem: Rendezvous) -> Units:
    """Of a problem in km and s that of its trade, of any other none."""
    if problem.gravity == 1:
        return Units(1.0, 1.0, 1.0, "", "", "")
    if problem.gravity == SUN:
        return Units(ASTRONOMICAL_UNIT, DAY, 1e-6, "AU", "d", r"mm/s$^2$")
    return Units(1000.0, 3600.0, 1e-6, r"$10^3$ km", "h", r"mm/s$^2$")


def power(value: float) -> str:
    r"""A small number for a picture, to one digit.

    Examples
    --------
    >>> print(power(3.2e-15))
    $3\times10^{-15}$
    """
    digits, exponent = f"{value:.0e}".split("e")
    return rf"${digits}\times10^{{{int(exponent)}}}$" if value else "0"
