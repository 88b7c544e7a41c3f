"""A disturbance given as an expression in t, taken apart at its kinks into pieces that are analytic."""

import operator
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.problem.zeros import numeric, t, zeros

KINKED = (
    *(sp.Abs, sp.sign, sp.Heaviside, sp.Max, sp.Min, sp.Piecewise),
    *(sp.floor, sp.ceiling, sp.frac, sp.Mod, sp.atan2),
)
"""Functions that are analytic only between the zeros of something."""

COMPARISONS = {
    ">": operator.gt,
    ">=": operator.ge,
    "<": operator.lt,
    "<=": operator.le,
    "==": operator.eq,
    "!=": operator.ne,
}

PIECES = 4096
"""Largest number of pieces on one interval."""

INSIDE = 0.43301270189
"""Share of a piece at which it is tried: an irrational one, where no user puts a zero."""


@dataclass(frozen=True)
class Piece:
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
        time = self.low + INSIDE * (self.high - self.low)
        names = sorted(self.values, key=str)
        arguments = (np.array([x]) for x in (time, *(self.values[name] for name in names)))
        return float(numeric(expression, *names)(*arguments)[0])


def pieces(expression: Any, low: Array, high: Array) -> list[Piece]:
    """The pieces of an expression on disjoint intervals, in order.

    Parameters
    ----------
    expression : sympy.Expr in `t` alone
    low, high : (n,) arrays
        Ends of the intervals.

    Raises
    ------
    ValueError
        If the expression holds an impulse, a condition that compares nothing or an infinite value, or has more
        than 4096 pieces on an interval.
    """
    for kind in (sp.DiracDelta, sp.Subs, sp.Derivative):
        if expression.has(kind):
            raise ArgumentValueError(
                f"disturbance must be a function of time without impulses, got {expression}", "disturbance"
            )
    known: dict[Any, Array] = {}
    symbols: dict[Any, Any] = {}

    def zeros_of(g: Any, piece: Piece) -> Array:
        """The zeros of g in a piece, its ends included."""
        if piece.values.keys() & g.free_symbols:
            ends = (np.array([piece.low]), np.array([piece.high]))
            return zeros(g.xreplace({s: sp.Rational(v) for s, v in piece.values.items()}), *ends)
        if g not in known:
            known[g] = zeros(g, low, high)
        return known[g][slice(*np.searchsorted(known[g], [piece.low, np.nextafter(piece.high, np.inf)]))]

    todo = [Piece(a, b, expression, {}) for a, b in zip(low.tolist(), high.tolist(), strict=True)]
    done: list[Piece] = []
    while todo:
        piece = todo.pop()
        node = _innermost(piece.expression)
        if node is None:
            done += _between_singularities(piece, zeros_of)
        else:
            cuts = np.unique(np.concatenate([zeros_of(g, piece) for g in _deciding(node)] or [np.empty(0)]))
            for part in _parts(piece, cuts):
                form, values = _form(node, part, symbols)
                whole = part.expression.xreplace({node: form})
                todo.append(replace(part, expression=whole, values={**part.values, **values}))
        if len(todo) + len(done) > PIECES * len(low):
            raise ArgumentValueError(
                f"disturbance must have at most {PIECES} kinks on an interval, got {expression}",
                "disturbance",
            )
    return sorted(done, key=lambda piece: piece.low)


def _innermost(expression: Any) -> Any:
    """A part of an expression that has kinks, whose arguments have none."""
    for node in sp.postorder_traversal(expression):
        if isinstance(node, KINKED) and node.free_symbols:
            return node
    return None


def _parts(piece: Piece, cuts: Array) -> Iterator[Piece]:
    inner = cuts[(cuts > piece.low) & (cuts < piece.high)].tolist()
    for low, high in zip([piece.low, *inner], [*inner, piece.high], strict=True):
        yield replace(piece, low=low, high=high)


def _deciding(node: Any) -> list[Any]:
    """The expressions at whose zeros a function with kinks may change its form."""
    if isinstance(node, sp.Max | sp.Min):
        return [a - b for i, a in enumerate(node.args) for b in node.args[:i]]
    if isinstance(node, sp.floor | sp.ceiling | sp.frac | sp.Mod):
        return [sp.sin(sp.pi * _counted(node))]
    if isinstance(node, sp.Piecewise):
        compared = [atom for _, condition in node.args for atom in condition.atoms(Relational)]
        return [a.lhs - a.rhs for a in compared]
    if isinstance(node, sp.atan2):
        y, x = node.args
        return [y, x - y, x + y]
    return [node.args[0]]


def _counted(node: Any) -> Any:
    """The argument of a function that jumps where it is a whole number."""
    return node.args[0] / node.args[1] if isinstance(node, sp.Mod) else node.args[0]


def _form(node: Any, piece: Piece, symbols: dict[Any, Any]) -> tuple[Any, dict[Any, float]]:
    """The analytic form of a function with kinks within a piece, and the values of its parameters."""
    if isinstance(node, sp.Max | sp.Min):
        values = [piece.at_inside(a) for a in node.args]
        return node.args[int(np.argmax(values) if isinstance(node, sp.Max) else np.argmin(values))], {}
    if isinstance(node, sp.floor | sp.ceiling | sp.frac | sp.Mod):
        count = symbols.setdefault(node, sp.Dummy("n", real=True))
        whole = np.ceil if isinstance(node, sp.ceiling) else np.floor
        value = {count: float(whole(piece.at_inside(_counted(node))))}
        if isinstance(node, sp.frac):
            return node.args[0] - count, value
        return (node.args[0] - node.args[1] * count if isinstance(node, sp.Mod) else count), value
    if isinstance(node, sp.Piecewise):
        return _valid(node, piece), {}
    if isinstance(node, sp.atan2):
        return _sector(node.args[0], node.args[1], piece), {}
    side = np.sign(piece.at_inside(node.args[0]))
    if isinstance(node, sp.Abs):
        return node.args[0] * (-1 if side < 0 else 1), {}
    if isinstance(node, sp.sign):
        return sp.Integer(int(side)), {}
    return (sp.Integer(int(side > 0)) if side else node.func(0, *node.args[1:])), {}


def _valid(node: Any, piece: Piece) -> Any:
    """The value of a Piecewise within a piece."""
    for value, condition in node.args:
        decided = condition.xreplace({atom: _holds(atom, piece) for atom in condition.atoms(Relational)})
        if decided not in (sp.true, sp.false):
            raise ArgumentValueError(
                f"disturbance must have conditions that compare expressions in t, got {condition}",
                "disturbance",
            )
        if decided:
            return value
    raise ArgumentValueError(
        f"disturbance must be finite: no condition of {node} holds for t from {piece.low} to {piece.high}",
        "disturbance",
    )


def _holds(comparison: Any, piece: Piece) -> Any:
    """Whether a comparison holds within a piece."""
    left, right = (piece.at_inside(side) for side in (comparison.lhs, comparison.rhs))
    return sp.sympify(COMPARISONS[comparison.rel_op](left, right))


def _sector(y: Any, x: Any, piece: Piece) -> Any:
    """The angle of (x, y) by inverse tangents that are analytic in the sector of a piece and beyond its ends."""
    at_y, at_x = piece.at_inside(y), piece.at_inside(x)
    if at_x > abs(at_y):
        return sp.atan(y / x)
    if abs(at_y) >= abs(at_x):
        return sp.pi / 2 * int(np.sign(at_y)) - sp.atan(x / y)
    return sp.atan(y / x) + sp.pi * (1 if at_y >= 0 else -1)


def _between_singularities(piece: Piece, zeros_of: Callable[[Any, Piece], Array]) -> list[Piece]:
    """A piece cut where the base of a power that is not whole and positive, or such an argument, is zero."""
    bases = [(base, pole) for node in sp.preorder_traversal(piece.expression) for base, pole in _bases(node)]
    found = [(zeros_of(base, piece), pole) for base, pole in bases if t in base.free_symbols]
    cuts = np.unique(np.concatenate([places for places, _ in found])) if found else np.empty(0)
    poles = [x for places, pole in found if pole for x in places.tolist() if piece.low < x < piece.high]
    names = sorted(piece.values, key=str)
    for place in poles:
        at = (np.array([x]) for x in (place, *(piece.values[name] for name in names)))
        value = float(numeric(piece.expression, *names)(*at)[0])
        if np.isinf(value):
            raise ArgumentValueError(f"disturbance must be finite: f({place:.6g}) = {value}", "disturbance")
    return [replace(x, singular=(x.low in cuts, x.high in cuts)) for x in _parts(piece, cuts)]


def _bases(node: Any) -> list[tuple[Any, bool]]:
    """What makes a node singular where it is zero, and whether that is a pole."""
    if isinstance(node, sp.Pow) and not (node.exp.is_Integer and node.exp > 0):
        return [(node.base, bool(node.exp.is_Integer))]
    if isinstance(node, sp.log):
        return [(node.args[0], False)]
    if isinstance(node, sp.asin | sp.acos | sp.atanh):
        return [(1 - node.args[0], False), (1 + node.args[0], False)]
    return [(node.args[0] - 1, False)] if isinstance(node, sp.acosh) else []
