"""What is enclosed of a phase system: the functions that are averaged, and those that must be positive."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import sympy as sp

from pontryagin.numerics.enclosure import Enclosure, enclosure

if TYPE_CHECKING:
    from pontryagin.averaging.system.standard_form import StandardForm


@dataclass(frozen=True, eq=False)
class Bounds:
    """Expressions of a phase system whose values are enclosed along a trajectory.

    Attributes
    ----------
    system : StandardForm
    averaged : sequence of expressions
        Functions of (a, p, x, u) from which the equations follow: h0 and omega where the average is known in
        closed form; else f, the whole running cost, 1 / r and omega. Constants are left out.
    positive : mapping of str to expression
        Functions of (a, x) that must be positive, by the names of their arguments. Constants are left out.
    """

    system: "StandardForm"
    averaged: tuple[sp.Expr, ...]
    positive: dict[str, sp.Expr]

    @cached_property
    def judges(self) -> tuple[int, ...]:
        """Places in `averaged` of functions that are positive only if all of `positive` are, if known."""
        s = self.system
        if self.closed:
            known = [self.averaged.index(e) if e in self.averaged else -1 for e in self.positive.values()]
            return () if -1 in known else tuple(known)
        return tuple(self.averaged.index(e) for e in (1 / s.rate, s.omega) if e in self.averaged)

    @cached_property
    def closed(self) -> bool:
        """Whether the first function is h0."""
        return bool(self.averaged) and bool(self.averaged[0].free_symbols & set(self.system.costates))

    @cached_property
    def turning(self) -> bool:
        """Whether the averaged functions depend on the anomaly."""
        return any(e.has(self.system.phase) for e in self.averaged)

    @cached_property
    def turning_signs(self) -> bool:
        """Whether functions that must be positive depend on the anomaly."""
        return any(e.has(self.system.phase) for e in self.positive.values())

    @cached_property
    def averaged_enclosure(self) -> Enclosure:
        """Discs of `averaged`, from discs of a, p, x, u and the system's numbers."""
        s = self.system
        symbols = (*s.slow, *s.costates, s.phase, *s.control, *s.numbers)
        return enclosure(symbols, self.averaged, across=(s.phase,))

    @cached_property
    def positive_enclosure(self) -> Enclosure:
        """Discs of `positive`, from discs of a, x and the system's numbers."""
        s = self.system
        return enclosure((*s.slow, s.phase, *s.numbers), self.positive.values())


def bounds(system: "StandardForm", known: tuple[sp.Expr, sp.Expr] | None) -> Bounds:
    """The `Bounds` of a system, whose h0 and omega are `known` where the average has a closed form."""
    moving = {*system.slow, *system.costates, system.phase, *system.control}
    if known is None:
        cost = system.running_cost + system.control_set.cost(list(system.control))
        functions: Sequence[sp.Expr] = [*system.f, cost, 1 / system.rate]
        functions = [*functions, *([] if system.omega is None else [system.omega])]
    else:
        functions = known
    if system.omega is None:
        signs = {"anomaly_rate": system.rate}
    else:
        signs = {"omega": system.omega, "weight": system.weight}
    return Bounds(
        system,
        tuple(_common_factors_apart(e) for e in functions if e.free_symbols & moving),
        {name: e for name, e in signs.items() if e.free_symbols & moving},
    )


def _common_factors_apart(expression: sp.Expr) -> sp.Expr:
    """Sums written with their common factors in front: discs of p - p b are wider than those of p (1 - b)."""
    return expression.replace(
        lambda e: isinstance(e, sp.Abs), lambda e: sp.Abs(*map(sp.factor_terms, e.args))
    )
