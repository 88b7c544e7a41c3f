"""Jets: a function with its gradient and Hessian, as columns of a compiled kernel and as arrays."""

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array

if TYPE_CHECKING:
    import sympy as sp

Kernel = Callable[..., tuple[Any, ...]]
"""A function from numbers or arrays to a tuple of them, by arithmetic and NumPy's elementary functions."""


@dataclass(frozen=True)
class Jet:
    """Value (...), gradient (..., k) and Hessian (..., k, k) of one function."""

    value: Array
    gradient: Array
    hessian: Array

    def __getitem__(self, members: NDArray[np.intp] | NDArray[np.bool_]) -> "Jet":
        return Jet(self.value[members], self.gradient[members], self.hessian[members])

    def padded(self, size: int) -> "Jet":
        """The same function with the variables extended to `size`; it does not depend on the added ones."""
        count, shape = self.gradient.shape[-1], self.value.shape
        gradient, hessian = np.zeros((*shape, size)), np.zeros((*shape, size, size))
        gradient[..., :count], hessian[..., :count, :count] = self.gradient, self.hessian
        return Jet(self.value, gradient, hessian)

    def __add__(self, other: "Jet") -> "Jet":
        return Jet(self.value + other.value, self.gradient + other.gradient, self.hessian + other.hessian)

    def times(self, factor: Array) -> "Jet":
        """The function times a constant (...)."""
        return Jet(
            factor * self.value, factor[..., None] * self.gradient, factor[..., None, None] * self.hessian
        )

    def __truediv__(self, other: "Jet") -> "Jet":
        value = self.value / other.value
        gradient = (self.gradient - value[..., None] * other.gradient) / other.value[..., None]
        cross = gradient[..., :, None] * other.gradient[..., None, :]
        hessian = self.hessian - value[..., None, None] * other.hessian - cross - np.swapaxes(cross, -1, -2)
        return Jet(value, gradient, hessian / other.value[..., None, None])


def width(variables: int) -> int:
    """Number of columns of a jet in that many variables."""
    return 1 + variables + variables * (variables + 1) // 2


def expressions(function: "sp.Expr", variables: Sequence["sp.Symbol"]) -> list["sp.Expr"]:
    """The columns of a SymPy expression: value, gradient, upper triangle of the Hessian by rows.

    Signs are differentiated as constants, so that the derivatives hold on either side of a kink.
    """
    function, signs = with_constant_signs(function)
    gradient = [function.diff(variable) for variable in variables]
    count = len(variables)
    hessian = [gradient[i].diff(variables[j]) for i in range(count) for j in range(i, count)]
    return [restored(column, signs) for column in (function, *gradient, *hessian)]


def with_constant_signs(function: "sp.Expr") -> tuple["sp.Expr", dict["sp.Expr", "sp.Dummy"]]:
    """Replace every sign(g) by a constant and |g| by g times it; returns the function and constants by g.

    Max and Min are written with moduli before.
    """
    import sympy as sp

    signs: dict[sp.Expr, sp.Dummy] = {}

    def constant(g: sp.Expr) -> sp.Dummy:
        return signs.setdefault(g, sp.Dummy("sign", real=True))

    function = sp.sympify(function).rewrite((sp.Max, sp.Min), sp.Abs)
    function = function.replace(sp.Abs, lambda g: g * constant(g))
    return function.replace(sp.sign, constant), signs


def restored(expression: "sp.Expr", signs: dict["sp.Expr", "sp.Dummy"]) -> "sp.Expr":
    """The expression with the constants replaced by their signs, outer ones before those inside them."""
    from sympy import sign

    for g, constant in reversed(signs.items()):
        expression = expression.xreplace({constant: sign(g)})
    return expression


@functools.cache
def _triangle(variables: int) -> NDArray[np.intp]:
    place = np.zeros((variables, variables), dtype=np.intp)
    rows, columns = np.triu_indices(variables)
    place[rows, columns] = place[columns, rows] = np.arange(len(rows))
    return place + 1 + variables


def jet(columns: Array, variables: int) -> Jet:
    """The `Jet` that columns (..., width) hold."""
    return Jet(columns[..., 0], columns[..., 1 : 1 + variables], columns[..., _triangle(variables)])


def evaluate(kernel: Kernel, *arguments: Array) -> Array:
    """All columns of a kernel at arrays of arguments, (..., columns); nan where it is not defined."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        columns = kernel(*arguments)
    columns = columns if isinstance(columns, tuple) else (columns,)
    shape = np.broadcast(*arguments).shape
    result = np.empty((*shape, len(columns)))
    for i, column in enumerate(columns):
        result[..., i] = column
    return result
