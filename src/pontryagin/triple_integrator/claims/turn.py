"""The unit turn, by 1 in unit time from rest to rest: examples 1 and 2 in numbers, certified."""

import sympy as sp

from pontryagin.triple_integrator.derivation.model import T, c

TURN = sp.Matrix([1, 0, 0])
"""Its moments."""

BANG_BANG = [(sp.Rational(1, 4), 32), (sp.Rational(1, 2), -32), (sp.Rational(1, 4), 32)]
"""Its least-peak control, (duration, level) by pieces."""

PEAK_DUAL = sp.Matrix([1, sp.Rational(-1, 2), sp.Rational(3, 32)])
"""Multipliers whose h proves that no smaller peak will do."""

IMPULSE_DUAL = sp.Matrix([1, sp.Rational(-1, 2), sp.Rational(1, 16)])
"""Multipliers whose h proves that no total impulse below 16 will do."""


def unit_turn() -> dict[sp.Symbol, sp.Expr]:
    """T = 1 and c = (1, 0, 0), for substitution."""
    return {T: sp.S.One, **dict(zip(c, TURN, strict=True))}
