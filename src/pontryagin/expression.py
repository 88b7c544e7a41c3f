"""Numbers and expressions as a user types them, read without running them.

What is understood: numbers, ``pi``, one variable, ``+ - * / **`` (``^`` is a power too), parentheses and the
functions of `FUNCTIONS`. Everything else is refused by name, so that text from anywhere can be read.
"""

import ast
import math
import operator
from collections.abc import Callable
from typing import Any

FUNCTIONS: dict[str, Callable[[float], float]] = {
    "abs": math.fabs,
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "exp", "log", "sqrt")},
}
"""The functions of one argument that an expression may hold; ``log`` is natural."""

LONGEST = 500
"""Characters beyond which nobody typed it."""


def read(text: str, variable: str | None = None) -> Any:
    """The number or the SymPy expression that a text stands for.

    Parameters
    ----------
    text : str
        For instance ``"1/3"``, ``"-pi/2"``, ``"0.1*sin(t)"``.
    variable : str, optional
        The one symbol that it may hold.

    Returns
    -------
    float or sympy.Expr
        A float where the variable does not occur; SymPy is not imported for it.

    Raises
    ------
    ValueError
        If the text holds anything else, or has no finite value.

    Examples
    --------
    >>> read("-3*2^2/4")
    -3.0
    >>> read("0.1*sin(2*t) + t^2", "t")
    t**2 + 0.1*sin(2*t)
    >>> read("__import__('os')", "t")
    Traceback (most recent call last):
        ...
    ValueError: "__import__('os')" is not a formula: functions are abs, sin, cos, ...
    """
    if len(text) > LONGEST:
        raise ValueError(f"{len(text)} characters are too long for a formula, at most {LONGEST} are read")
    try:
        tree = ast.parse(text.strip().replace("^", "**"), mode="eval").body
        value = _value(tree, variable)
        free = getattr(value, "free_symbols", None)
        return value if free and _finite(value) else _real(value)
    except (SyntaxError, RecursionError, MemoryError):
        raise ValueError(f"{text!r} is not a formula") from None
    except (ArithmeticError, _NoValue):
        raise ValueError(f"{text!r} has no finite real value") from None


class _NoValue(Exception):
    """A formula without a finite real value."""


def _value(node: ast.expr, variable: str | None) -> Any:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return number
        case ast.Name(id="pi"):
            return math.pi
        case ast.Name(id=name) if name == variable:
            return _symbol(name)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_value(operand, variable)
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return _value(operand, variable)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_value(left, variable), _value(right, variable))
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
            return _applied(name, _value(argument, variable))
    raise ValueError(f"{ast.unparse(node)!r} is not a formula: {_reason(node, variable)}")


def _reason(node: ast.expr, variable: str | None) -> str:
    if isinstance(node, ast.Call):
        return f"functions are {', '.join(FUNCTIONS)}, of one argument each"
    symbols = f"{variable} and pi" if variable else "pi"
    return f"takes numbers, {symbols}, + - * / ^ and functions"


def _symbol(name: str) -> Any:
    import sympy as sp

    return sp.Symbol(name, real=True)


def _applied(name: str, argument: Any) -> Any:
    if not isinstance(argument, int | float):
        import sympy as sp

        return getattr(sp, {"abs": "Abs"}.get(name, name))(argument)
    try:
        return FUNCTIONS[name](argument)
    except ValueError:
        raise _NoValue from None


def _power(base: Any, exponent: Any) -> Any:
    """A power; of numbers in floating point, where no tower of exponents runs for ever."""
    if not isinstance(base, int | float) or not isinstance(exponent, int | float):
        return base**exponent
    try:
        return math.pow(base, exponent)
    except ValueError:
        raise _NoValue from None


_OPERATORS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: _power,
}


def _real(value: Any) -> float:
    try:
        number = float(value)
    except TypeError:
        raise _NoValue from None
    if not math.isfinite(number):
        raise _NoValue
    return number


def _finite(expression: Any) -> bool:
    import sympy as sp

    if expression.has(sp.zoo, sp.nan, sp.oo, sp.I):
        raise _NoValue
    return True
