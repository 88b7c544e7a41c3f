"""Functions with kinks: where they change their form, and their analytic forms between."""

import operator
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.problem.piece import AnalyticPiece

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


def innermost(expression: Any) -> Any:
    """A part of an expression that has kinks, whose arguments have none."""
    for node in sp.postorder_traversal(expression):
        if isinstance(node, KINKED) and node.free_symbols:
            return node
    return None


def deciding(node: Any) -> list[Any]:
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


def form(node: Any, piece: AnalyticPiece, symbols: dict[Any, Any]) -> tuple[Any, dict[Any, float]]:
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


def _valid(node: Any, piece: AnalyticPiece) -> Any:
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


def _holds(comparison: Any, piece: AnalyticPiece) -> Any:
    """Whether a comparison holds within a piece."""
    left, right = (piece.at_inside(side) for side in (comparison.lhs, comparison.rhs))
    return sp.sympify(COMPARISONS[comparison.rel_op](left, right))


def _sector(y: Any, x: Any, piece: AnalyticPiece) -> Any:
    """The angle of (x, y) by an inverse tangent that is analytic also beyond the sector of a piece."""
    at_y, at_x = piece.at_inside(y), piece.at_inside(x)
    if at_x > abs(at_y):
        return sp.atan(y / x)
    if abs(at_y) >= abs(at_x):
        return sp.pi / 2 * int(np.sign(at_y)) - sp.atan(x / y)
    return sp.atan(y / x) + sp.pi * (1 if at_y >= 0 else -1)
