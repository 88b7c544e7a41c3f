"""Plain Python kernels compiled by Numba and cached on disk under the hash of their source.

`batched` runs a scalar solver over a stack of problems, `compiled` compiles a function of arrays. Both take
plain Python; small work runs uncompiled, as does everything where Numba is not installed.
"""

import functools
import hashlib
import importlib.util
import inspect
import math
import os
import sys
import tempfile
import types
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.packages import installed

COMPILE_FROM = 512
"""Number of problems from which a stack is worth the half second that Numba takes to load."""


@dataclass(frozen=True)
class Batched:
    """A scalar solver that runs over a stack of problems; see `batched`.

    Attributes
    ----------
    kernel : function of n floats returning a tuple of floats
        The solver in plain Python.
    outputs : int
        Number of floats that the kernel returns.
    """

    kernel: Callable[..., tuple[float, ...]]
    outputs: int

    def __call__(self, *columns: Array) -> Array:
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
        """Solve one problem in plain Python; overflow and division by zero give nan, as in compiled code."""
        try:
            return self.kernel(*values)
        except ArithmeticError:
            return (math.nan,) * self.outputs

    def one(self, *values: float) -> Array:
        """Solve one problem, as (outputs,); by compiled code if it is loaded because of a large stack."""
        if self.kernel not in _LOADED:
            return np.array(self._plain(*values))
        result = np.empty(self.outputs)
        _LOADED[self.kernel].one(result, *values)
        return result


def batched(kernel: Callable[..., tuple[float, ...]], outputs: int) -> Batched:
    """Run a scalar solver over a stack of problems.

    Small stacks run the plain Python source. Large stacks run the same source compiled by Numba and cached
    on disk under the hash of that source, so that an edited kernel is compiled again. Once a kernel is
    compiled and loaded, small stacks and single problems use it too.

    Parameters
    ----------
    kernel : function of n floats returning a tuple of floats
        Written in plain arithmetic and the `math` module, as are all functions that it calls.
    outputs : int
        Number of floats that the kernel returns.

    Examples
    --------
    >>> def halves(x):
    ...     return x / 2, x / 4
    >>> batched(halves, outputs=2)(np.array([1.0, 2.0]))
    array([[0.5 , 0.25],
           [1.  , 0.5 ]])
    """
    return Batched(kernel, outputs)


_LOADED: dict[Callable[..., Any], types.ModuleType] = {}


def has_numba() -> bool:
    """Whether Numba can be imported; if not, warn once per process."""
    return installed("numba", "large stacks run slowly, as plain Python")


def compiled_loop(kernel: Callable[..., tuple[float, ...]], inputs: int, outputs: int) -> types.ModuleType:
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


_COMPILED: dict[tuple[Callable[..., Any], str], Callable[..., Any]] = {}


def compiled(kernel: Callable[..., Any], signature: str, large: bool = True) -> Callable[..., Any]:
    """Compile a plain function of arrays by Numba for one signature, cached on disk as for `batched`.

    As in `batched`, small work runs in plain Python unless the compiled kernel is already loaded.

    Parameters
    ----------
    kernel : function
        Written in plain arithmetic, loops over arrays, the `math` module and functions like ``np.empty``.
    signature : str
        Its types in Numba's notation, such as ``"void(float64[::1], float64[:, ::1])"``.
    large : bool
        Whether there is enough work to justify the half second that Numba takes to load.

    Returns
    -------
    function
        The compiled kernel, or the kernel itself for small work and where Numba is not installed.
    """
    if (kernel, signature) in _COMPILED:
        return _COMPILED[kernel, signature]
    if not (large and has_numba()):
        return kernel
    text = _closure_source(kernel) + (
        f'\n\ncompiled = njit({signature!r}, cache=True, nogil=True, error_model="numpy")'
        f"({kernel.__name__}.py_func)\n"
    )
    _COMPILED[kernel, signature] = _load(text).compiled
    return _COMPILED[kernel, signature]


def _closure_source(kernel: Callable[..., Any]) -> str:
    """The source of a kernel and of all functions that it calls, as the text of one module."""
    functions: dict[str, Callable[..., Any]] = {}
    constants: dict[str, float] = {}
    imported: set[str] = set()
    arrays = False

    def visit(target: Callable[..., Any]) -> None:
        nonlocal arrays
        if functions.get(target.__name__) is target:
            return
        for name in target.__code__.co_names:
            if name not in target.__globals__:
                continue
            value = target.__globals__[name]
            if isinstance(value, types.FunctionType):
                visit(value)
            elif isinstance(value, int | float):
                if constants.setdefault(name, value) != value:
                    raise TypeError(f"{kernel.__name__} uses two different numbers called {name}")
            elif getattr(math, name, None) is value:
                imported.add(name)
            elif value is np:
                arrays = True
            else:
                raise TypeError(
                    f"{target.__name__} uses {name}, which is neither a number nor a plain function"
                )
        if functions.setdefault(target.__name__, target) is not target:
            raise TypeError(f"{kernel.__name__} uses two different functions called {target.__name__}")

    visit(kernel)
    parts = ["from __future__ import annotations", "from numba import njit, types"]
    if arrays:
        parts.append("import numpy as np")
    if imported:
        parts.append("from math import " + ", ".join(sorted(imported)))
    parts += [f"{name} = {value!r}" for name, value in sorted(constants.items())]
    for target in functions.values():
        parts.append('\n@njit(cache=True, nogil=True, error_model="numpy")\n' + inspect.getsource(target))
    return "\n".join(parts)


def _load(text: str) -> types.ModuleType:
    """Import a module from its text, which is stored in the user's cache under its hash."""
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
