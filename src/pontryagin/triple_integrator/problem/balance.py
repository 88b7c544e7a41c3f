"""Quotients of exponentials, rewritten so that none overflows although the quotient is small.

1/cosh(x) is 2 exp(-x)/(1 + exp(-2x)) for x >= 0: a sum of exponentials under a fraction is divided by its
largest term, which changes from piece to piece.
"""

from typing import Any

import sympy as sp

from pontryagin.triple_integrator.problem.piece import AnalyticPiece

LARGEST = 20.0
"""Exponents up to this are left as they are."""

TRIED = 17
"""At so many times of a piece exponents are compared with it."""


def unbalanced(piece: AnalyticPiece) -> Any:
    """A negative power of a sum whose exponentials become too large within a piece; None if there is none."""
    for node in sp.preorder_traversal(piece.expression):
        if isinstance(node, sp.Pow) and node.exp.is_negative and node.base.has(sp.exp, sp.cosh, sp.sinh):
            exponents = {exponent for _, exponent in _terms(node.base)}
            places = [piece.low + (piece.high - piece.low) * k / (TRIED - 1) for k in range(TRIED)]
            tried = (piece.at(time, g) for g in exponents - {0} for time in places)
            if len(exponents) > 1 and max(tried, default=0.0) > LARGEST:
                return node
    return None


def deciding(node: Any) -> list[Any]:
    """The expressions at whose zeros another term of the sum becomes the largest."""
    exponents = list(dict.fromkeys(exponent for _, exponent in _terms(node.base)))
    return [a - b for i, a in enumerate(exponents) for b in exponents[:i]]


def form(node: Any, piece: AnalyticPiece) -> Any:
    """The power with the sum divided by its largest term within a piece."""
    terms = _terms(node.base)
    largest = max((exponent for _, exponent in terms), key=piece.at_inside)
    rest = sp.Add(*(factor * sp.exp(sp.expand(exponent - largest)) for factor, exponent in terms))
    return sp.exp(node.exp * largest) * rest**node.exp


def _terms(base: Any) -> list[tuple[Any, Any]]:
    """The terms of a sum as factors and exponents of exponentials."""
    expanded = sp.expand(base.rewrite([sp.cosh, sp.sinh], sp.exp))
    return [_factored(term) for term in sp.Add.make_args(expanded)]


def _factored(term: Any) -> tuple[Any, Any]:
    powers = [factor for factor in sp.Mul.make_args(term) if isinstance(factor, sp.exp)]
    return term / sp.Mul(*powers), sp.Add(*(power.args[0] for power in powers))
