"""From SymPy expressions to numeric functions; from one problem to a stack of a million.

`function` makes a NumPy function of named expressions, `source` writes the same as readable text for a
paper's `kernels.py`, and `batched` runs a plain scalar solver over a stack, compiled by Numba.
"""

import functools
import hashlib
import importlib.util
import inspect
import math
import os
import sys
import tempfile
import textwrap
import types
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

COMPILE_FROM = 512
"""Stacks at least this large are worth the half second that Numba takes to load."""


def function(name: str, arguments: Sequence, outputs: Mapping[str, object]) -> Callable[..., tuple]:
    """Compile named SymPy expressions into one NumPy function.

    Common subexpressions are evaluated once; every output has the broadcast shape of the arguments, also
    where its expression is constant; a matrix gains its own axes at the end.

    Parameters
    ----------
    name : str
        Name of the function made.
    arguments : sequence of sympy.Symbol
        Its positional arguments, in order.
    outputs : mapping of str to sympy.Expr or sympy.Matrix
        What it returns, as a tuple in this order.

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
    flat: list = []
    for key, value in outputs.items():
        matrix = matrices[key]
        flat += [sp.sympify(value)] if matrix is None else list(matrix)
    _require_known_symbols(name, arguments, flat)
    evaluate = sp.lambdify(list(arguments), flat, modules="numpy", cse=True)

    def call(*values: ArrayLike) -> tuple[NDArray[np.float64], ...]:
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


def columns(name: str, arguments: Sequence, expressions: Sequence) -> Callable[..., tuple]:
    """Compile SymPy expressions into a plain function that leaves broadcasting to NumPy.

    Where `function` first brings all arguments to one shape, here a subexpression is evaluated at the shape
    of the arguments in it alone, and a constant stays a number: what inner loops call.

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
    call = sp.lambdify(list(arguments), tuple(flat), modules="numpy", cse=True)
    call.__name__ = call.__qualname__ = name
    return call


def _as_pieces(extreme):
    """Max or Min as Piecewise: NumPy's own would need arguments of one shape."""
    import sympy as sp

    return extreme.rewrite(sp.Piecewise)


def _real(name: str, value: object) -> NDArray[np.float64]:
    array = np.asarray(value)
    if np.iscomplexobj(array):
        raise TypeError(f"{name}: an expression takes complex values")
    return array.astype(float, copy=False)


def source(name: str, arguments: Sequence, outputs: Mapping[str, object], doc: str) -> str:
    """Write named scalar SymPy expressions as the text of one Python function.

    The text uses arithmetic and the `math` module only, so that it runs on floats as it is and under Numba.

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


def _require_known_symbols(name: str, arguments: Sequence, expressions: Sequence) -> None:
    unknown = set().union(*(e.free_symbols for e in expressions)) - set(arguments)
    if unknown:
        names = ", ".join(sorted(map(str, unknown)))
        raise ValueError(f"{name}: expressions hold symbols that are not arguments: {names}")


@functools.cache
def _scalar_printer():
    from sympy.printing.precedence import PRECEDENCE
    from sympy.printing.pycode import PythonCodePrinter

    class ScalarPrinter(PythonCodePrinter):
        """Plain Python with small integer powers written as products: three times faster than `**`."""

        def _print_Pow(self, expr, rational=False):
            base, exponent = expr.base, expr.exp
            if exponent.is_Integer and 1 < abs(exponent) <= 4:
                factor = self.parenthesize(base, PRECEDENCE["Pow"])
                product = "*".join([factor] * abs(int(exponent)))
                return f"({product})" if exponent > 0 else f"1/({product})"
            return super()._print_Pow(expr, rational)

    return ScalarPrinter({"fully_qualified_modules": False})


@dataclass(frozen=True)
class Batched:
    """A scalar solver that runs over a stack of problems; see `batched`.

    Attributes
    ----------
    kernel : function of n floats returning a tuple of floats
        The plain source.
    outputs : int
        How many floats it returns.
    """

    kernel: Callable[..., tuple]
    outputs: int

    def __call__(self, *columns: NDArray[np.float64]) -> NDArray[np.float64]:
        """Solve the problems given by n equally long 1-D arrays, as (problems, outputs)."""
        count = len(columns[0])
        result = np.empty((count, self.outputs))
        if (count >= COMPILE_FROM or self.kernel in _LOADED) and has_numba():
            compiled_loop(self.kernel, len(columns), self.outputs).loop(result, *columns)
        else:
            for i, values in enumerate(zip(*(column.tolist() for column in columns), strict=True)):
                result[i] = self._plain(*values)
        return result

    def _plain(self, *values: float) -> tuple[float, ...]:
        """The plain source, with nan where it overflows or divides by zero, as the compiled one has."""
        try:
            return self.kernel(*values)
        except ArithmeticError:
            return (math.nan,) * self.outputs

    def one(self, *values: float) -> NDArray[np.float64]:
        """Solve one problem, as (outputs,); compiled only if a large stack was solved before."""
        if self.kernel not in _LOADED:
            return np.array(self._plain(*values))
        result = np.empty(self.outputs)
        _LOADED[self.kernel].one(result, *values)
        return result


def batched(kernel: Callable[..., tuple], outputs: int) -> Batched:
    """Run a scalar solver over a stack of problems.

    Small stacks run the plain Python source; large ones the same source compiled by Numba and cached on
    disk under the hash of that source, so that an edited kernel is never served stale. What is compiled
    already serves small stacks and single problems too.

    Parameters
    ----------
    kernel : function of n floats returning a tuple of floats
        Written in plain arithmetic and the `math` module; what it calls must be so too.
    outputs : int
        How many floats it returns.

    Examples
    --------
    >>> def halves(x):
    ...     return x / 2, x / 4
    >>> batched(halves, outputs=2)(np.array([1.0, 2.0]))
    array([[0.5 , 0.25],
           [1.  , 0.5 ]])
    """
    return Batched(kernel, outputs)


_LOADED: dict[Callable, types.ModuleType] = {}


@functools.cache
def has_numba() -> bool:
    """Whether Numba can be imported; said once if it cannot."""
    if importlib.util.find_spec("numba") is None:
        print("pontryagin: numba is not installed; large stacks run as plain Python, slowly", file=sys.stderr)
        return False
    return True


def compiled_loop(kernel: Callable[..., tuple], inputs: int, outputs: int) -> types.ModuleType:
    """Numba-compiled ``loop(result, *columns)`` and ``one(result, *values)`` over a scalar kernel."""
    if kernel in _LOADED:
        return _LOADED[kernel]
    arguments = ", ".join(f"a{i}" for i in range(inputs))
    items = ", ".join(f"a{i}[i]" for i in range(inputs))
    in_row, alone = (
        ", ".join(f"result[{row}{j}]" for j in range(outputs)) + ("," if outputs == 1 else "")
        for row in ("i, ", "")
    )
    of_columns = "types.void(types.float64[:, ::1], " + ", ".join(["column"] * inputs) + ")"
    of_values = "types.void(types.float64[::1], " + ", ".join(["types.float64"] * inputs) + ")"
    options = 'cache=True, nogil=True, error_model="numpy"'
    text = _closure_source(kernel) + (
        '\n\ncolumn = types.Array(types.float64, 1, "A", readonly=True)\n'
        f"\n\n@njit({of_columns}, {options})\n"
        f"def loop(result, {arguments}):\n"
        f"    for i in range(result.shape[0]):\n"
        f"        {in_row} = {kernel.__name__}({items})\n"
        f"\n\n@njit({of_values}, {options})\n"
        f"def one(result, {arguments}):\n"
        f"    {alone} = {kernel.__name__}({arguments})\n"
    )
    _LOADED[kernel] = _load(text)
    return _LOADED[kernel]


@functools.cache
def compiled(kernel: Callable, signature: str) -> Callable:
    """Compile a plain function of arrays by Numba for one signature, cached on disk like `batched`.

    Parameters
    ----------
    kernel : function
        Written in plain arithmetic, loops over arrays, the `math` module and ``np.empty`` and its kin.
    signature : str
        Its types in Numba's notation, such as ``"void(float64[::1], float64[:, ::1])"``.

    Returns
    -------
    function
        The compiled kernel, or the kernel itself where Numba is not installed.
    """
    if not has_numba():
        return kernel
    text = _closure_source(kernel) + (
        f'\n\ncompiled = njit({signature!r}, cache=True, nogil=True, error_model="numpy")'
        f"({kernel.__name__}.py_func)\n"
    )
    return _load(text).compiled


def _closure_source(kernel: Callable) -> str:
    """The kernel's source and that of everything it calls, as the text of one module."""
    functions: dict[str, Callable] = {}
    constants: dict[str, float] = {}
    imported: set[str] = set()
    arrays = False

    def visit(target: Callable) -> None:
        nonlocal arrays
        if functions.get(target.__name__) is target:
            return
        for name in _names(target.__code__):
            if name not in target.__globals__:
                continue
            value = target.__globals__[name]
            if isinstance(value, types.FunctionType):
                visit(value)
            elif isinstance(value, int | float):
                if constants.setdefault(name, value) != value:
                    raise TypeError(f"two numbers called {name} meet in {kernel.__name__}")
            elif getattr(math, name, None) is value:
                imported.add(name)
            elif value is np:
                arrays = True
            else:
                raise TypeError(
                    f"{target.__name__} uses {name}, which is neither a number nor a plain function"
                )
        if functions.setdefault(target.__name__, target) is not target:
            raise TypeError(f"two functions called {target.__name__} meet in {kernel.__name__}")

    visit(kernel)
    parts = ["from numba import njit, types"]
    if arrays:
        parts.append("import numpy as np")
    if imported:
        parts.append("from math import " + ", ".join(sorted(imported)))
    parts += [f"{name} = {value!r}" for name, value in sorted(constants.items())]
    for target in functions.values():
        parts.append('\n@njit(cache=True, nogil=True, error_model="numpy")\n' + inspect.getsource(target))
    return "\n".join(parts)


def _names(code: types.CodeType) -> tuple[str, ...]:
    return code.co_names


def _load(text: str) -> types.ModuleType:
    """Import a module from its text, kept in the user's cache under the hash of the text."""
    digest = hashlib.sha256(text.encode()).hexdigest()[:20]
    path = _cache_folder() / f"kernel_{digest}.py"
    if not path.exists():
        scratch = path.with_suffix(f".{os.getpid()}.tmp")
        scratch.write_text(text)
        scratch.replace(path)
    spec = importlib.util.spec_from_file_location(f"pontryagin_{path.stem}", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


@functools.cache
def _cache_folder() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    folder = Path(base).expanduser() / "pontryagin"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return Path(tempfile.mkdtemp(prefix="pontryagin-"))
