"""Numeric functions made from SymPy expressions.

`function` makes a NumPy function of named expressions, `columns` one with less overhead for inner loops, and
`source` writes named expressions as readable text for a paper's `kernels.py`.
"""

import functools
import textwrap
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array


def function(
    name: str, arguments: Sequence[Any], outputs: Mapping[str, Any]
) -> Callable[..., tuple[Array, ...]]:
    """Compile named SymPy expressions into one NumPy function.

    Common subexpressions are evaluated once. Every output has the broadcast shape of the arguments, even if
    its expression is constant; a matrix has its own axes after these.

    Parameters
    ----------
    name : str
        Name of the function that is made.
    arguments : sequence of sympy.Symbol
        Its positional arguments, in order.
    outputs : mapping of str to sympy.Expr or sympy.Matrix
        The outputs, returned as a tuple in this order.

    Raises
    ------
    ValueError
        If an expression holds a symbol that is not an argument.

    Examples
    --------
    >>> import sympy as sp
    >>> x = sp.Symbol("x")
    >>> value, slope = function("f", [x], {"value": x**2, "slope": sp.Integer(2)})([1.0, 3.0])
    >>> value.tolist(), slope.tolist()
    ([1.0, 9.0], [2.0, 2.0])
    """
    import sympy as sp

    matrices = {key: sp.Matrix(value) if hasattr(value, "shape") else None for key, value in outputs.items()}
    flat: list[Any] = []
    for key, value in outputs.items():
        matrix = matrices[key]
        flat += [sp.sympify(value)] if matrix is None else list(matrix)
    _require_known_symbols(name, arguments, flat)
    evaluate = sp.lambdify(list(arguments), flat, modules="numpy", cse=True)

    def call(*values: ArrayLike) -> tuple[Array, ...]:
        arrays = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in values))
        shape = arrays[0].shape if arrays else ()
        with np.errstate(divide="ignore", invalid="ignore"):
            columns = [_real(name, column) for column in evaluate(*arrays)]
        columns = [c if c.shape == shape else np.broadcast_to(c, shape) for c in columns]
        results, position = [], 0
        for matrix in matrices.values():
            if matrix is None:
                results.append(columns[position])
                position += 1
            else:
                count = matrix.rows * matrix.cols
                stacked = np.stack(columns[position : position + count], axis=-1)
                results.append(stacked.reshape(*shape, *matrix.shape))
                position += count
        return tuple(results)

    call.__name__ = call.__qualname__ = name
    signature = ", ".join(str(argument) for argument in arguments)
    call.__doc__ = f"{name}({signature})\n\n" + "\n".join(f"{k} = {v}" for k, v in outputs.items())
    return call


def columns(
    name: str, arguments: Sequence[Any], expressions: Sequence[Any]
) -> Callable[..., tuple[Any, ...]]:
    """Compile SymPy expressions into a plain function that leaves broadcasting to NumPy.

    `function` first broadcasts all arguments to one shape. Here each subexpression has the shape of its own
    arguments only, and a constant stays a number, which is faster in inner loops.

    Examples
    --------
    >>> import sympy as sp
    >>> x, y = sp.symbols("x y")
    >>> columns("f", [x, y], [x**2, sp.Max(x, y), sp.Integer(3)])(np.array([1.0, 4.0]), 2.0)
    (array([ 1., 16.]), array([2., 4.]), 3)
    """
    import sympy as sp

    flat = [sp.sympify(e).replace(lambda e: isinstance(e, sp.Max | sp.Min), _as_pieces) for e in expressions]
    _require_known_symbols(name, arguments, flat)
    call: Callable[..., tuple[Any, ...]] = sp.lambdify(
        list(arguments), tuple(flat), modules="numpy", cse=True
    )
    call.__name__ = call.__qualname__ = name
    return call


def _as_pieces(extreme: Any) -> Any:
    """Max or Min rewritten as Piecewise, since SymPy's NumPy code for them needs arguments of one shape."""
    import sympy as sp

    return extreme.rewrite(sp.Piecewise)


def _real(name: str, value: object) -> Array:
    array = np.asarray(value)
    if np.iscomplexobj(array):
        raise TypeError(f"{name}: an expression takes complex values, where real ones are needed")
    return array.astype(float, copy=False)


def source(name: str, arguments: Sequence[Any], outputs: Mapping[str, Any], doc: str) -> str:
    """Write named scalar SymPy expressions as the text of one Python function.

    The text uses arithmetic and the `math` module only, so that it runs on floats in plain Python and Numba.

    Examples
    --------
    >>> import sympy as sp
    >>> x, y = sp.symbols("x y")
    >>> print(source("f", [x, y], {"value": (x + y) ** 2 / 3}, "A square."))
    def f(x, y):
        \"\"\"A square.\"\"\"
        value = (1/3)*((x + y)*(x + y))
        return value
    """
    import sympy as sp

    expressions = [sp.sympify(value) for value in outputs.values()]
    _require_known_symbols(name, arguments, expressions)
    taken = {str(argument) for argument in arguments} | set(outputs)
    fresh = (sp.Symbol(f"x{i}") for i in range(10_000) if f"x{i}" not in taken)
    shared, reduced = sp.cse(expressions, symbols=fresh, order="canonical")
    write = _scalar_printer().doprint
    lines = [f"{symbol} = {write(expression)}" for symbol, expression in shared]
    lines += [f"{key} = {write(expression)}" for key, expression in zip(outputs, reduced, strict=True)]
    lines.append("return " + ", ".join(outputs))
    head = f"def {name}({', '.join(str(argument) for argument in arguments)}):"
    text = '"""' + doc + '"""'
    return "\n".join([head, textwrap.indent("\n".join([text, *lines]), "    ")])


def _require_known_symbols(name: str, arguments: Sequence[Any], expressions: Sequence[Any]) -> None:
    empty: set[Any] = set()
    unknown = empty.union(*(e.free_symbols for e in expressions)) - set(arguments)
    if unknown:
        names = ", ".join(sorted(map(str, unknown)))
        raise ValueError(f"{name}: the expressions hold symbols that are not arguments: {names}")


@functools.cache
def _scalar_printer() -> Any:
    from sympy.printing.precedence import PRECEDENCE
    from sympy.printing.pycode import PythonCodePrinter

    class ScalarPrinter(PythonCodePrinter):  # type: ignore[misc]
        """Prints plain Python with small integer powers as products, three times faster than `**`."""

        def _print_Pow(self, expr: Any, rational: bool = False) -> str:
            base, exponent = expr.base, expr.exp
            if exponent.is_Integer and 1 < abs(exponent) <= 4:
                factor = self.parenthesize(base, PRECEDENCE["Pow"])
                product = "*".join([factor] * abs(int(exponent)))
                return f"({product})" if exponent > 0 else f"1/({product})"
            return str(super()._print_Pow(expr, rational))

    return ScalarPrinter({"fully_qualified_modules": False})
