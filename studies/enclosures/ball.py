"""Balls: exact numbers from floats, small linear algebra, and intervals of an optimum with proven digits."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx

PRECISION = 200
"""Bits of the balls' midpoints."""

MOST_DIGITS = 16.0
"""A double has no more digits, however small the proven error of its value is."""


def exact(number: Any) -> arb:
    """A float as the rational that it is."""
    return arb(float(number))


def row(numbers: Any) -> list[arb]:
    """Floats (n,) as exact numbers."""
    return [exact(number) for number in np.asarray(numbers).ravel().tolist()]


def dot(left: Sequence[arb], right: Sequence[arb]) -> arb:
    """The sum of products."""
    return sum((x * y for x, y in zip(left, right, strict=True)), arb(0))


def length(vector: Sequence[arb]) -> arb:
    """The Euclidean norm."""
    return dot(vector, vector).sqrt()


def greatest(balls: Sequence[arb]) -> arb:
    """The greatest of balls."""
    top = balls[0]
    for ball in balls[1:]:
        top = top.max(ball)
    return top


def solved(matrix: Sequence[Sequence[arb]], right: Sequence[arb]) -> list[arb]:
    """x with matrix x = right."""
    found = arb_mat([list(line) for line in matrix]).solve(arb_mat([[entry] for entry in right]))
    return [found[i, 0] for i in range(len(right))]


@dataclass(frozen=True)
class Enclosure:
    """A proved interval of an optimum, and the value that a solver returned.

    Attributes
    ----------
    value : float
        What the solver returned.
    lower, upper : arb
        The optimum is not below the least number of `lower`, nor above the greatest of `upper`.
    size : float, optional
        What errors are measured by; by default the value itself.
    """

    value: float
    lower: arb
    upper: arb
    size: float | None = None

    @property
    def error(self) -> float:
        """The largest distance of the value from a number of the interval, relative to the size."""
        value = exact(self.value)
        low, high = self.lower.lower(), self.upper.upper()
        if low > high:
            raise AssertionError(f"the bounds contradict each other: {low} above {high}")
        if not (low.is_finite() and high.is_finite()):
            return math.inf
        distance = (value - low).abs_upper().max((high - value).abs_upper())
        size = abs(value) if self.size is None else exact(self.size)
        return float((distance / size).upper())

    @property
    def digits(self) -> float:
        """How many decimal digits of the value are proved."""
        return min(MOST_DIGITS, -math.log10(max(self.error, 1e-300)))


def precise() -> Any:
    """The context in which balls have `PRECISION` bits."""
    return ctx.workprec(PRECISION)
