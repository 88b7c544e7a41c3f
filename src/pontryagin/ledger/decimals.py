"""Evidence for printed numbers: they are the computed ones to one unit of the last printed digit."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from pontryagin.ledger import Unsupported, Verdict
from pontryagin.ledger.evidence import (
    Evidence,
    Steps,
    followed,
)

ROUNDING = 1e-11
"""How far a computed number may be from a printed whole one."""


def unit(number: str) -> float:
    """The unit of the last digit of a printed number; 0 for a whole one, which is meant exactly.

    Examples
    --------
    >>> unit("-0.37787e-2")
    1e-07
    """
    exponent = int(Decimal(number).as_tuple().exponent)
    return float(Decimal(1).scaleb(exponent)) if exponent < 0 else 0.0


@dataclass(frozen=True)
class Decimals(Evidence):
    """Printed numbers are the computed ones, whose certificate is checked anew: `holds`.

    Parameters
    ----------
    printed : mapping of str to str
        The numbers as printed, with a power of ten as an exponent ("-0.37787e-2").
    derived : callable
        Returns the same left-hand sides with the computed numbers.
    certificate : callable
        Steps that prove the computed numbers.
    display : optional
        What the report shows in place of the numbers.

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

    def off(self) -> dict[str, float]:
        """How far each printed number is from the computed one, in units of its last digit (0 if whole)."""
        computed = self.derived()
        if list(computed) != list(self.printed):
            raise Unsupported(f"printed {list(self.printed)}, but computed {list(computed)}")
        found = {}
        for left, number in self.printed.items():
            distance, scale = abs(float(number) - computed[left]), unit(number)
            if not distance <= (scale or ROUNDING) * (1 + ROUNDING):
                raise Unsupported(f"{left} is printed as {number}, but is {computed[left]!r}")
            found[left] = distance / scale if scale else 0.0
        return found

    def finding(self) -> Verdict:
        """`holds` when the certificate does and no number is off by more than one unit."""
        followed(self.certificate())
        self.off()
        return "holds"

    def steps(self) -> Steps:
        """The certificate's steps, then one per number."""
        yield from self.certificate()
        computed = self.derived()
        for left, share in self.off().items():
            words = f"printed {self.printed[left]}: {share:.2f} of a unit off" if share else "as printed"
            yield f"${left}$ is {computed[left]:.8g}, {words}", True

    def latex(self, sides: Any) -> str:
        """Each number as it is, a power of ten written out."""
        return r",\quad ".join(f"{left} = {_power_of_ten(side)}" for left, side in sides.items())


def _power_of_ten(number: str | float) -> str:
    text = number if isinstance(number, str) else f"{number + 0.0:.8g}"
    digits, _, exponent = text.partition("e")
    return rf"{digits} \cdot 10^{{{int(exponent)}}}" if exponent else digits
