"""The unit turn, from rest to rest by an angle of 1 in unit time: examples 1 and 2 in certified numbers."""

import sympy as sp

from pontryagin.triple_integrator.derivation.model import T, c

TURN = sp.Matrix([1, 0, 0])
"""The moments of the unit turn."""

BANG_BANG = [(sp.Rational(1, 4), 32), (sp.Rational(1, 2), -32), (sp.Rational(1, 4), 32)]
"""The least-peak control of the unit turn, as pieces (duration, level)."""

PEAK_DUAL = sp.Matrix([1, sp.Rational(-1, 2), sp.Rational(3, 32)])
"""Multipliers whose h proves that no control of the unit turn has a smaller peak."""

IMPULSE_DUAL = sp.Matrix([1, sp.Rational(-1, 2), sp.Rational(1, 16)])
"""Multipliers whose h proves that no control of the unit turn has a total impulse below 16."""


def unit_turn() -> dict[sp.Symbol, sp.Expr]:
    """T = 1 and c = (1, 0, 0), for substitution."""
    return {T: sp.S.One, **dict(zip(c, TURN, strict=True))}
