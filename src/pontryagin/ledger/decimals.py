"""Evidence for printed numbers: they agree with the computed ones to one unit of the last printed digit."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from pontryagin.ledger.evidence import Evidence, Steps, require
from pontryagin.ledger.verdict import Unsupported, Verdict

ROUNDING = 1e-11
"""Largest distance between a printed whole number and the computed one; relative slack for the others."""


def unit(number: str) -> float:
    """The unit of the last digit of a printed number; 0 for a whole number, which is taken as exact.

    Examples
    --------
    >>> unit("-0.37787e-2")
    1e-07
    """
    exponent = int(Decimal(number).as_tuple().exponent)
    return float(Decimal(1).scaleb(exponent)) if exponent < 0 else 0.0


@dataclass(frozen=True)
class Decimals(Evidence):
    """Printed numbers that agree with computed ones, whose certificate is checked each time: `holds`.

    Parameters
    ----------
    printed : mapping of str to str
        The numbers as printed, with a power of ten as an exponent ("-0.37787e-2").
    derived : callable
        Returns the computed numbers for the same left-hand sides.
    certificate : callable
        Returns the steps that prove the computed numbers.
    display : optional
        LaTeX that the report shows in place of the numbers.

    Examples
    --------
    >>> def proof():
    ...     yield "it is between 1.41 and 1.42", 1.41**2 < 2 < 1.42**2
    >>> Decimals({"x": "1.41"}, lambda: {"x": 2**0.5}, proof).finding()
    'holds'
    """

    printed: Mapping[str, str]
    derived: Callable[[], Mapping[str, float]]
    certificate: Callable[[], Steps]
    display: str = ""

    def derivation(self) -> Mapping[str, float]:
        """The computed numbers."""
        return self.derived()

    def deviations(self) -> dict[str, float]:
        """Distance of each printed number from the computed one, in units of its last digit (0 if whole)."""
        computed = self.derived()
        if list(computed) != list(self.printed):
            raise Unsupported(
                f"the printed numbers are {list(self.printed)}, the computed ones {list(computed)}"
            )
        found = {}
        for left, number in self.printed.items():
            distance, scale = abs(float(number) - computed[left]), unit(number)
            if not distance <= (scale or ROUNDING) * (1 + ROUNDING):
                raise Unsupported(f"{left} is printed as {number}, but is {computed[left]!r}")
            found[left] = distance / scale if scale else 0.0
        return found

    def finding(self) -> Verdict:
        """`holds`, if the certificate does and no number deviates by more than one unit."""
        require(self.certificate())
        self.deviations()
        return "holds"

    def steps(self) -> Steps:
        """The steps of the certificate, then one for each number."""
        yield from self.certificate()
        computed = self.derived()
        for left, share in self.deviations().items():
            words = f"printed {self.printed[left]}: {share:.2f} of a unit off" if share else "as printed"
            yield f"${left}$ is {computed[left]:.8g}, {words}", True

    def latex(self, sides: Any) -> str:
        """Each number as it is, with powers of ten written out."""
        return r",\quad ".join(f"{left} = {_power_of_ten(side)}" for left, side in sides.items())


def _power_of_ten(number: str | float) -> str:
    text = number if isinstance(number, str) else f"{number + 0.0:.8g}"
    digits, _, exponent = text.partition("e")
    return rf"{digits} \cdot 10^{{{int(exponent)}}}" if exponent else digits
