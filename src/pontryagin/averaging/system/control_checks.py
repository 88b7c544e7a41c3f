"""Checks that control sets share: one number for each control, positive numbers, known symbols."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.averaging.system.expressions import expression
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics import compile as compiler

Numbers = Mapping[sp.Symbol, Array]
"""Values of the symbols that stand for numbers of a system."""


def refusal(message: str) -> ArgumentValueError:
    """The error to raise for an invalid control set."""
    return ArgumentValueError(message, "control_set")


def require_positive(
    name: str, values: Sequence[object], numbers: Numbers, dimension: int | None = None
) -> None:
    """Raise ValueError unless the values are positive for every problem of the stack.

    With a dimension there must also be one value for each control.
    """
    if dimension is not None and len(values) != dimension:
        raise refusal(f"{name} must hold one number for each of {dimension} controls, got {len(values)}")
    for value in numeric(name, values, numbers):
        least = value.min()
        if not (np.isfinite(least) and least > 0):
            raise refusal(f"{name} must be positive, got {least:g}")


def numeric(name: str, values: Sequence[object], numbers: Numbers) -> tuple[Array, ...]:
    """The values as arrays of the shape that the numbers in them broadcast to."""
    expressions = [expression(name, value, "control_set") for value in values]
    used = set().union(*(each.free_symbols for each in expressions))
    unknown = used - set(numbers)
    if unknown:
        raise refusal(
            f"{name} holds unknown symbols {listed(unknown)}; it may hold {listed(numbers) or 'numbers only'}"
        )
    symbols = sorted(used, key=str)
    evaluate = compiler.function("values", symbols, {f"v{i}": e for i, e in enumerate(expressions)})
    return evaluate(*(numbers[symbol] for symbol in symbols))


def listed(symbols: Iterable[sp.Symbol]) -> str:
    """Symbols in alphabetical order, with commas between."""
    return ", ".join(sorted(map(str, symbols)))
