"""Controls that jump or bend, written as smooth expressions between switches.

A mode is a symbol that holds the sign of a switching function. Between switches it is constant, so that the
equations are smooth there and an integrator of high order follows them arc by arc.
"""

from collections.abc import Callable, Sequence

import sympy as sp

Rewriting = Callable[[sp.Expr], sp.Expr]
Modes = tuple[tuple[sp.Symbol, sp.Expr], ...]


def modal(expressions: Sequence[sp.Expr]) -> tuple[tuple[sp.Expr, ...], Modes]:
    """Replace sign, Abs, Max, Min and Piecewise by modes.

    Returns
    -------
    tuple of expressions, tuple of (mode, switching function)
        A switching function may contain modes that stand before it in the tuple.

    Raises
    ------
    ValueError
        If a Piecewise is not decided by one inequality.

    Examples
    --------
    >>> s = sp.Symbol("s", real=True)
    >>> modal([2 * sp.sign(s), sp.Abs(s)])
    ((2*mode_0, mode_0*s), ((mode_0, s),))
    """
    found: dict[sp.Expr, sp.Symbol] = {}

    def sign_of(switching: sp.Expr) -> sp.Expr:
        if switching.is_positive or switching.is_negative:
            return sp.sign(switching)
        if -switching in found:
            return -found[-switching]
        return found.setdefault(switching, sp.Symbol(f"mode_{len(found)}", real=True))

    def rewrite(e: sp.Expr) -> sp.Expr:
        if isinstance(e, sp.sign):
            return sign_of(rewrite(e.args[0]))
        if isinstance(e, sp.Abs):
            inner = rewrite(e.args[0])
            return sign_of(inner) * inner
        if isinstance(e, sp.Max | sp.Min):
            return _largest([rewrite(part) for part in e.args], isinstance(e, sp.Max), sign_of)
        if isinstance(e, sp.Piecewise):
            return _alternative(e, rewrite, sign_of)
        return e.func(*(rewrite(part) for part in e.args)) if e.args else e

    rewritten = tuple(rewrite(sp.sympify(e)) for e in expressions)
    return rewritten, tuple((mode, switching) for switching, mode in found.items())


def _largest(parts: Sequence[sp.Expr], largest: bool, sign_of: Rewriting) -> sp.Expr:
    first, *rest = parts
    for second in rest:
        half = sign_of(first - second) * (first - second) / 2
        first = (first + second) / 2 + (half if largest else -half)
    return first


def _alternative(e: sp.Piecewise, rewrite: Rewriting, sign_of: Rewriting) -> sp.Expr:
    if len(e.args) != 2 or not isinstance(e.args[0].cond, sp.StrictLessThan | sp.LessThan):
        if len(e.args) == 2 and isinstance(e.args[0].cond, sp.StrictGreaterThan | sp.GreaterThan):
            (inside, cond), (outside, _) = e.args
            return _blend(rewrite(outside), rewrite(inside), sign_of(rewrite(cond.lhs - cond.rhs)))
        raise ValueError(f"a Piecewise must have two branches that one inequality decides, got {e}")
    (inside, cond), (outside, _) = e.args
    return _blend(rewrite(inside), rewrite(outside), sign_of(rewrite(cond.lhs - cond.rhs)))


def _blend(below: sp.Expr, above: sp.Expr, mode: sp.Expr) -> sp.Expr:
    return (below * (1 - mode) + above * (1 + mode)) / 2
