"""A disturbance given as an expression in t, taken apart at its kinks into pieces that are analytic."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.problem import balance, kinks
from pontryagin.triple_integrator.problem.piece import AnalyticPiece
from pontryagin.triple_integrator.problem.zeros import t, zeros


def pieces(
    expression: Any, low: Array, high: Array, most: int
) -> tuple[list[AnalyticPiece], dict[float, float]]:
    """The pieces of an expression on disjoint intervals, in order, and the rests of `zeros`.

    Parameters
    ----------
    expression : sympy.Expr in `t` alone
    low, high : (n,) arrays
        Ends of the intervals.
    most : int
        Largest number of pieces.

    Raises
    ------
    ValueError
        If the expression holds an impulse, a condition that compares nothing, or an infinite value, or has
        more pieces.
    """
    for kind in (sp.DiracDelta, sp.Subs, sp.Derivative):
        if expression.has(kind):
            raise ArgumentValueError(
                f"disturbance must be a function of time without impulses, got {expression}", "disturbance"
            )
    known: dict[Any, Any] = {}
    rests: dict[float, float] = {}
    symbols: dict[Any, Any] = {}

    def zeros_of(g: Any, piece: AnalyticPiece) -> Array:
        """The zeros of g in a piece and at its ends."""
        first, last = piece.reach
        ends = (np.array([first]), np.array([last]))
        if piece.values.keys() & g.free_symbols:
            return zeros(g.xreplace({s: sp.Rational(v) for s, v in piece.values.items()}), *ends, rests)
        if g not in known:
            try:
                known[g] = zeros(g, low, high, rests)
            except ArgumentValueError:  # Beyond the piece it may have zeros without end.
                known[g] = None
        if known[g] is None:
            return zeros(g, *ends, rests)
        found: Array = known[g]
        return found[slice(*np.searchsorted(found, [first, np.nextafter(last, np.inf)]))]

    def cuts_of(deciding: list[Any], piece: AnalyticPiece) -> Array:
        return np.unique(np.concatenate([np.empty(0), *(zeros_of(g, piece) for g in deciding)]))

    todo = [AnalyticPiece(a, b, expression, {}) for a, b in zip(low.tolist(), high.tolist(), strict=True)]
    done: list[AnalyticPiece] = []
    while todo:
        if len(todo) + len(done) > most:
            message = f"disturbance must have at most {most} kinks, got {expression}"
            raise ArgumentValueError(message, "disturbance")
        piece = todo.pop()
        node = kinks.innermost(piece.expression)
        if node is not None:
            for part in piece.parts(cuts_of(kinks.deciding(node), piece)):
                form, values = kinks.form(node, part, symbols)
                whole = part.expression.xreplace({node: form})
                todo.append(replace(part, expression=whole, values={**part.values, **values}))
            continue
        node = balance.unbalanced(piece)
        if node is None:
            done += _between_singularities(piece, zeros_of)
            continue
        for part in piece.parts(cuts_of(balance.deciding(node), piece)):
            todo.append(replace(part, expression=part.expression.xreplace({node: balance.form(node, part)})))
    return sorted(done, key=lambda piece: piece.low), rests


def _between_singularities(
    piece: AnalyticPiece, zeros_of: Callable[[Any, AnalyticPiece], Array]
) -> list[AnalyticPiece]:
    """A piece cut where the base of a power that is not whole and positive, or such an argument, is zero."""
    bases = [(base, pole) for node in sp.preorder_traversal(piece.expression) for base, pole in _bases(node)]
    found = [(zeros_of(base, piece), pole) for base, pole in bases if t in base.free_symbols]
    cuts = np.unique(np.concatenate([places for places, _ in found])) if found else np.empty(0)
    poles = [x for places, pole in found if pole for x in places.tolist() if piece.low < x < piece.high]
    for place in poles:
        value = piece.at(place, piece.expression)
        if np.isinf(value):
            raise ArgumentValueError(f"disturbance must be finite: f({place:.6g}) = {value}", "disturbance")
    return [replace(x, singular=(x.begins_at(cuts), x.ends_at(cuts))) for x in piece.parts(cuts)]


def _bases(node: Any) -> list[tuple[Any, bool]]:
    """What makes a node singular where it is zero, and whether that is a pole."""
    if isinstance(node, sp.Pow) and not (node.exp.is_Integer and node.exp > 0):
        return [(node.base, bool(node.exp.is_Integer))]
    if isinstance(node, sp.log):
        return [(node.args[0], False)]
    if isinstance(node, sp.asin | sp.acos | sp.atanh):
        return [(1 - node.args[0], False), (1 + node.args[0], False)]
    return [(node.args[0] - 1, False)] if isinstance(node, sp.acosh) else []
