"""A safe parser of the numbers and formulas that a user types.

A formula holds numbers, ``pi``, the variables that the caller names, ``+ - * / **`` (``^`` is a power too),
parentheses and the functions of `FUNCTIONS`. Anything else raises `ValueError`, and nothing is passed to
``eval``, so that text from any source can be read.
"""

import ast
import math
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array

if TYPE_CHECKING:
    import sympy as sp

FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    name: getattr(np, name)
    for name in ("abs", "sign", "sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh")
} | {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan}
"""The functions of one argument that a formula may hold; ``log`` is natural."""

OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}

LONGEST = 500
"""Largest number of characters of a formula."""

HIGHEST = 12
"""Largest modulus of an exponent in `expression`: SymPy takes long to expand higher powers."""


@dataclass(frozen=True)
class Formula:
    """A function of one variable that was read from a text.

    Examples
    --------
    >>> f = read("0.1*sin(t) + t^2", "t")
    >>> str(f), f([0.0, 2.0]).round(6).tolist()
    ('0.1*sin(t) + t^2', [0.0, 4.09093])
    """

    text: str
    variable: str
    tree: ast.expr = field(repr=False, compare=False)

    def __call__(self, values: ArrayLike) -> Array:
        """The formula at values (...) of the variable, (...); nan or infinite where it has no value."""
        with np.errstate(all="ignore"):
            return np.asarray(_value(self.tree, {self.variable: np.asarray(values, dtype=float)}))

    def __str__(self) -> str:
        return self.text


def read(text: str, variable: str | None = None) -> float | Formula:
    """Parse a text into a number or a function of one variable.

    Parameters
    ----------
    text : str
        For instance ``"1/3"``, ``"-pi/2"``, ``"0.1*sin(t)"``.
    variable : str, optional
        Name of the variable that may occur; by default none may.

    Returns
    -------
    float or Formula
        A float if the variable does not occur.

    Raises
    ------
    ValueError
        If the text holds anything else, or is a number that is not finite.

    Examples
    --------
    >>> read("-3*2^2/4")
    -3.0
    >>> read("__import__('os')", "t")
    Traceback (most recent call last):
        ...
    ValueError: "__import__('os')" is not a formula: functions are abs, sign, ... of one argument each
    """
    tree = _parsed(text, () if variable is None else (variable,))
    return Formula(text.strip(), str(variable), tree) if _varies(tree) else _constant(tree, text)


def expression(text: str, *variables: str) -> "float | sp.Expr":
    """Parse a text into a number, or into a SymPy expression in real symbols named as the variables.

    Decimals in the text become the rational numbers they denote; constant subexpressions are evaluated in
    floating point first. Exponents of variables are limited to `HIGHEST`, so that SymPy can expand the
    expression in reasonable time.

    Raises
    ------
    ValueError
        As `read`, or if an exponent exceeds `HIGHEST`.

    Examples
    --------
    >>> expression("1 + 0.2*cos(x)^2 - v/4", "x", "v")
    -v/4 + cos(x)**2/5 + 1
    """
    tree = _parsed(text, variables)
    return _symbolic(tree, text) if _varies(tree) else _constant(tree, text)


def _parsed(text: str, variables: Sequence[str]) -> ast.expr:
    """The syntax tree of a text, in which only permitted nodes occur."""
    if len(text) > LONGEST:
        raise ValueError(f"a formula has at most {LONGEST} characters, got {len(text)}")
    try:
        tree = ast.parse(text.strip().replace("^", "**"), mode="eval").body
        _check(tree, variables)
    except (SyntaxError, RecursionError, MemoryError):
        raise ValueError(f"{text!r} is not a formula") from None
    return tree


def _varies(tree: ast.expr) -> bool:
    """Whether a variable occurs in a checked tree."""
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    return bool(names - {"pi", *FUNCTIONS})


def _constant(tree: ast.expr, text: str) -> float:
    with np.errstate(all="ignore"):
        value = float(_value(tree, {}))
    if not np.isfinite(value):
        raise ValueError(f"{text!r} has no finite real value")
    return value


def _symbolic(node: ast.expr, text: str) -> "sp.Expr":
    """A checked tree as a SymPy expression."""
    import sympy as sp

    if not _varies(node):
        return sp.Rational(repr(_constant(node, ast.unparse(node))))
    match node:
        case ast.Name(id=name):
            return sp.Symbol(name, real=True)
        case ast.UnaryOp(op=op, operand=operand):
            return OPERATORS[type(op)](_symbolic(operand, text))
        case ast.BinOp(left=left, op=op, right=right):
            base, second = _symbolic(left, text), _symbolic(right, text)
            if isinstance(op, ast.Pow) and not (second.is_number and abs(second) <= HIGHEST):
                raise ValueError(
                    f"{text!r} has an exponent that is not a number from -{HIGHEST} to {HIGHEST}"
                )
            return OPERATORS[type(op)](base, second)
        case ast.Call(func=ast.Name(id=name), args=[argument]):
            return getattr(sp, "Abs" if name == "abs" else name)(_symbolic(argument, text))
    raise AssertionError(ast.dump(node))


def is_broad(formula: Formula) -> bool:
    """Whether a formula has no kink, and nothing in it is narrow that does not recur.

    It is then made of sums, products, whole powers up to `HIGHEST`, sines and cosines.

    Examples
    --------
    >>> [is_broad(read(text, "t")) for text in ("0.1*sin(3*t) + t^2", "exp(-1e6*t^2)", "abs(t - 1)")]
    [True, False, False]
    """
    return all(map(_is_broad, ast.walk(formula.tree)))


def _is_broad(node: ast.AST) -> bool:
    match node:
        case ast.BinOp(op=ast.Pow(), right=exponent):
            return not _varies(exponent) and _value(exponent, {}) in range(HIGHEST + 1)
        case ast.BinOp(op=ast.Div(), right=divisor):
            return not _varies(divisor)
        case ast.Call(func=ast.Name(id=name)):
            return name in ("sin", "cos")
    return True


def number(text: str) -> float:
    """Parse a text into a finite number.

    Raises
    ------
    ValueError
        If the text is no formula without variables, or has no finite real value.

    Examples
    --------
    >>> number("pi/2 - 1e-3")
    1.5697963267948967
    """
    try:
        value: float | Formula = float(text)
    except ValueError:
        value = read(text)
    if not isinstance(value, float) or not math.isfinite(value):
        raise ValueError(f"{text!r} has no finite real value")
    return value


def _check(node: ast.expr, variables: Sequence[str]) -> None:
    """Raise `ValueError` at the first node that a formula may not hold."""
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return
        case ast.Name(id=name) if name in ("pi", *variables):
            return
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
            parts = [operand]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            parts = [left, right]
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
            parts = [argument]
        case ast.Call():
            names = ", ".join(FUNCTIONS)
            raise ValueError(
                f"{ast.unparse(node)!r} is not a formula: functions are {names}, of one argument each"
            )
        case _:
            symbols = ", ".join([*variables, "pi"])
            raise ValueError(
                f"{ast.unparse(node)!r} is not a formula: takes numbers, {symbols}, + - * / ^ and functions"
            )
    for part in parts:
        _check(part, variables)


def _value(node: ast.expr, variables: dict[str, Array]) -> Any:
    """Value of a checked tree, in floating point throughout: integer powers of powers would never end."""
    match node:
        case ast.Constant(value=constant):
            return _float(constant)
        case ast.Name(id=name):
            return variables.get(name, np.float64(np.pi))
        case ast.UnaryOp(op=op, operand=operand):
            return OPERATORS[type(op)](_value(operand, variables))
        case ast.BinOp(left=left, op=op, right=right):
            return OPERATORS[type(op)](_value(left, variables), _value(right, variables))
        case ast.Call(func=ast.Name(id=name), args=[argument]):
            return FUNCTIONS[name](_value(argument, variables))
    raise AssertionError(ast.dump(node))


def _float(constant: Any) -> np.float64:
    try:
        return np.float64(constant)
    except OverflowError:
        return np.float64(np.inf)
