"""Values that a user gives as SymPy expressions: read without running text.

SymPy's `sympify`, which its matrices and many of its functions call, runs text as Python code, also text
inside lists, tuples and arrays. What a user gives therefore passes through `expression` before SymPy sees it.
"""

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits
from sympy.core.function import AppliedUndef
from sympy.printing.codeprinter import PrintMethodNotImplementedError

from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.validation import require_bare

KINKED = (sp.Abs, sp.sign, sp.Piecewise, sp.Heaviside)
"""Functions with kinks or jumps, between which they are differentiated."""


def expression(name: str, value: Any, argument: str | None = None) -> sp.Expr:
    """A number or SymPy expression as an expression; other things, text above all, are refused.

    Parameters
    ----------
    name : str
        What the value is called in errors.
    value : object
    argument : str, optional
        The argument that an error is about; by default `name` without an index in brackets.

    Raises
    ------
    TypeError, ValueError
        If it is neither a number nor an expression of SymPy, or holds a function that has no definition, or
        that NumPy does not evaluate with its derivatives.

    Examples
    --------
    >>> expression("mass", 2), expression("mass", np.float64(0.5))
    (2, 0.500000000000000)
    >>> expression("mass", "2")
    Traceback (most recent call last):
        ...
    pontryagin.errors.ArgumentTypeError: mass must be a SymPy expression or a number, got the text '2'
    """
    argument = argument or name.partition("[")[0]
    require_bare(argument, value, "a SymPy expression or a number")
    read = _read(value[()] if isinstance(value, np.ndarray) and not value.ndim else value)
    if read is None:
        given = "the text " if isinstance(value, str) else ""
        raise ArgumentTypeError(
            f"{name} must be a SymPy expression or a number, got {given}{value!r}", argument
        )
    if read.has(sp.nan):
        raise ArgumentValueError(f"{name} must be finite, got {read}", argument)
    for call in sorted(read.atoms(sp.Function, sp.Derivative, sp.Subs, ExprWithLimits), key=str):
        if isinstance(call, AppliedUndef):
            raise ArgumentValueError(f"{name} holds the function {call.func}, which is not defined", argument)
        if not (isinstance(call, sp.Function) and _differentiable(call.func, len(call.args))):
            raise ArgumentValueError(
                f"{name} holds {call}, which NumPy does not evaluate with its derivatives", argument
            )
    return read.replace(sp.Heaviside, lambda value, *_: (1 + sp.sign(value)) / 2)


@cache
def _differentiable(function: type[sp.Function], count: int) -> bool:
    """Whether NumPy evaluates a function and its derivatives; on either side of a kink if it has some."""
    if issubclass(function, KINKED):
        return True
    places = sp.symbols(f"z:{count}", real=True)
    value = function(*places)
    slopes = [value.diff(place) for place in places]
    try:
        sp.lambdify(places, [value, *slopes, *(slope.diff(places[0]) for slope in slopes)], "numpy")(
            *[np.full(2, 0.5)] * count
        )
    except (NameError, TypeError, NotImplementedError, PrintMethodNotImplementedError):
        return False
    return True


def _read(value: Any) -> sp.Expr | None:
    """The expression of SymPy's own or of a number; None for all else."""
    if isinstance(value, sp.Basic):
        return value if isinstance(value, sp.Expr) else None
    if isinstance(value, str | bytes) or not hasattr(value, "__float__") or hasattr(value, "__iter__"):
        return None
    if isinstance(value, np.generic) and value.dtype.kind not in "fiu":
        return None
    try:
        read = sp.sympify(value, strict=True)
    except (sp.SympifyError, TypeError, ValueError):
        return None
    return read if isinstance(read, sp.Expr) else None


def real_expression(name: str, value: Any, argument: str | None = None) -> sp.Expr:
    """`expression`, which must be finite and real.

    Examples
    --------
    >>> real_expression("mass", sp.oo)
    Traceback (most recent call last):
        ...
    pontryagin.errors.ArgumentValueError: mass must be finite, got oo
    """
    read = expression(name, value, argument)
    argument = argument or name.partition("[")[0]
    if read.has(sp.nan, sp.oo, sp.zoo):
        raise ArgumentValueError(f"{name} must be finite, got {read}", argument)
    if read.has(sp.I):
        raise ArgumentValueError(f"{name} must be real, got {read}", argument)
    return read


def matrix(name: str, value: Any, argument: str) -> sp.ImmutableMatrix:
    """A matrix of SymPy, an array, or rows of numbers and expressions, each read by `expression`.

    Examples
    --------
    >>> matrix("weight", [[2, 0], [0, sp.Symbol("r")]], "weight")
    Matrix([
    [2, 0],
    [0, r]])
    """
    require_bare(argument, value, "a number or a matrix")
    rows = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(rows, list | tuple) and all(isinstance(row, list | tuple) for row in rows):
        if len({len(row) for row in rows}) > 1:
            raise ArgumentValueError(f"{name} must have rows of one length, got {value!r}", argument)
        read = [[expression(name, entry, argument) for entry in row] for row in rows]
    elif isinstance(rows, list | tuple):
        read = [[expression(name, entry, argument)] for entry in rows]
    else:
        raise ArgumentTypeError(f"{name} must be a number or a matrix, got {value!r}", argument)
    return sp.ImmutableMatrix(read)


def vector(name: str, values: Sequence[Any]) -> list[sp.Expr]:
    """Numbers and expressions as a list of expressions.

    Examples
    --------
    >>> vector("s", [1, sp.Symbol("p")])
    [1, p]
    """
    require_bare(name, values, "a sequence of numbers or expressions")
    entries = values if isinstance(values, list | tuple) else getattr(values, "tolist", lambda: None)()
    if entries is None:
        raise ArgumentTypeError(f"{name} must be a sequence of numbers or expressions, got {values!r}", name)
    flat = [part for row in entries for part in (row if isinstance(row, list) else [row])]
    return [expression(name, part) for part in flat]
