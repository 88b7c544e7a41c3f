"""The turn of examples 1 and 2, from rest to rest by gamma_T, and by 1 in unit time in certified numbers."""

import sympy as sp

from pontryagin.triple_integrator.derivation.model import T, c

c1, c2, c3 = c
turn = sp.Symbol("gamma_T", positive=True)

EXAMPLE_1 = {c1: turn, c2: sp.S.Zero, c3: sp.S.Zero}
"""The moments of the turn by gamma_T from rest to rest."""

TURN = sp.Matrix([1, 0, 0])
"""The moments of the unit turn."""

BANG_BANG = [(sp.Rational(1, 4), 32), (sp.Rational(1, 2), -32), (sp.Rational(1, 4), 32)]
"""The least-peak control of the unit turn, as pieces (duration, level)."""

IMPULSES = (sp.Integer(4), sp.Integer(-8), sp.Integer(4))
"""The impulses of least total that make the unit turn, at 0, 1/2 and 1."""

PEAK_DUAL = sp.Matrix([1, sp.Rational(-1, 2), sp.Rational(3, 32)])
"""Multipliers whose h proves that no control of the unit turn has a smaller peak."""

IMPULSE_DUAL = sp.Matrix([1, sp.Rational(-1, 2), sp.Rational(1, 16)])
"""Multipliers whose h proves that no control of the unit turn has a total impulse below 16."""


def in_unit_time(moments: sp.Matrix) -> dict[sp.Symbol, sp.Expr]:
    """T = 1 and given moments c, for substitution."""
    return {T: sp.S.One, **dict(zip(c, moments, strict=True))}


def unit_turn() -> dict[sp.Symbol, sp.Expr]:
    """T = 1 and c = (1, 0, 0), for substitution."""
    return in_unit_time(TURN)
