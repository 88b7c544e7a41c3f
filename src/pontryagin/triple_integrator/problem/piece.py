"""A piece of time on which an expression is analytic."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ulp
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.triple_integrator.problem.zeros import numeric

ULPS = 4
"""Zeros so near to an end are at it."""

INSIDE = 0.43301270189
"""Share of a piece at which it is tried: an irrational one, where no user puts a zero."""


@dataclass(frozen=True)
class AnalyticPiece:
    """An expression between two times that is analytic there.

    Attributes
    ----------
    low, high : float
        The times.
    expression : sympy.Expr
        In `t` and the parameters.
    values : dict
        The value of each parameter.
    singular : pair of bool
        Whether the expression is singular at the ends.
    """

    low: float
    high: float
    expression: Any
    values: dict[Any, float]
    singular: tuple[bool, bool] = (False, False)

    def at_inside(self, expression: Any) -> float:
        """The value of an expression at a time inside."""
        return self.at(self.low + INSIDE * (self.high - self.low), expression)

    def at(self, time: float, expression: Any) -> float:
        """The value of an expression at a time."""
        names = sorted(self.values, key=str)
        arguments = (np.array([x]) for x in (time, *(self.values[name] for name in names)))
        return float(numeric(expression, *names)(*arguments)[0])

    @property
    def reach(self) -> tuple[float, float]:
        """The ends, moved outwards by their rounding."""
        return self.low - ULPS * ulp(self.low), self.high + ULPS * ulp(self.high)

    def begins_at(self, times: Array) -> bool:
        """Whether one of the times (k,) is the start, but for rounding."""
        return bool((np.abs(times - self.low) <= ULPS * ulp(self.low)).any())

    def ends_at(self, times: Array) -> bool:
        """Whether one of the times (k,) is the end, but for rounding."""
        return bool((np.abs(times - self.high) <= ULPS * ulp(self.high)).any())

    def parts(self, cuts: Array) -> Iterator["AnalyticPiece"]:
        """The piece cut at those of the times (k,), ascending, that lie inside."""
        first, last = self.low + ULPS * ulp(self.low), self.high - ULPS * ulp(self.high)
        inner = cuts[(cuts > first) & (cuts < last)].tolist()
        for low, high in zip([self.low, *inner], [*inner, self.high], strict=True):
            yield replace(self, low=low, high=high)
