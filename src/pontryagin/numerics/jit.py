"""Plain Python kernels compiled by Numba and cached on disk under the hash of their source.

`batched` runs a scalar solver over a stack of problems and on single ones, `compiled` compiles a function of
arrays. Both take plain Python; small work runs uncompiled, as does everything where Numba is not installed.

A scalar solver becomes native code once per machine, in the first process that solves `COMPILE_FROM` problems
in stacks or one by one; this takes seconds. Later processes open what is kept on disk, without Numba. A
shared library opens in half a millisecond, so they do this before their first problem. Object code that
llvmlite must load costs as much as 1000 plain calls, so there they first solve `COMPILE_FROM` problems.
"""

import threading
from collections.abc import Callable
from itertools import accumulate, pairwise
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.closure import closure_of
from pontryagin.numerics.native import Native, Recipe, load_module
from pontryagin.numerics.packages import installed

COMPILE_FROM = 512
"""Number of problems from which compiled kernels are worth the time that it takes to load or to make them."""

_LOCK = threading.Lock()
"""Held while native code is opened or made, so that threads that start together make it once."""


class Batched:
    """A scalar solver that runs over a stack of problems; see `batched`.

    Attributes
    ----------
    kernel : function of n floats returning a tuple of floats
        The solver in plain Python.
    outputs : int
        Number of floats that the kernel returns.
    groups : tuple of int
        How many of the n floats each argument of `call` holds.
    call : function
        Solve one problem by native code, from numbers and from lists, tuples or arrays of them: the inputs
        and the outputs as doubles in `bytes`. None if an argument is anything else, if any of the numbers is
        not finite, or where there is no native code: then the caller checks the arguments and calls `one`.
    """

    call: Callable[..., bytes | None]

    def __init__(
        self,
        kernel: Callable[..., tuple[float, ...]],
        outputs: int,
        groups: tuple[int, ...],
        packed: bool,
        tables: int,
    ) -> None:
        self.kernel, self.outputs, self.groups = kernel, outputs, groups
        self.call = self._call_at_first
        self._recipe = Recipe(kernel, groups, outputs, packed, tables)
        self._native: Native | None = None
        self._problems = 0

    def __call__(self, *columns: Array, tables: tuple[bytes, ...] = ()) -> Array:
        """Solve the problems given by n equally long 1-D arrays, as (problems, outputs)."""
        count = len(columns[0])
        result = np.empty((count, self.outputs))
        if self._ready(count):
            self._loop(result, columns, tables)
        else:
            shared = [np.frombuffer(table).tolist() for table in tables]
            for i, values in enumerate(zip(*(column.tolist() for column in columns), strict=True)):
                result[i] = self._plain(*values, *shared)
        return result

    def _loop(self, result: Array, columns: tuple[Array, ...], tables: tuple[bytes, ...]) -> None:
        assert self._native is not None
        held = [np.broadcast_to(np.asarray(column, float), len(result)) for column in columns]
        shared = [np.frombuffer(table) for table in tables]
        places = np.array([column.__array_interface__["data"][0] for column in held + shared], np.intp)
        strides = np.array([column.strides[0] for column in held], np.int64)
        addresses = (array.ctypes.data for array in (places, strides))
        if self._native.loop(result.ctypes.data, len(result), *addresses):
            raise ArithmeticError(f"{self.kernel.__name__} failed on a problem of the stack")

    def _plain(self, *values: float | list[float]) -> tuple[float, ...]:
        """Solve one problem in plain Python.

        Overflow, division by zero and roots of negative numbers give nan, as in compiled code.
        """
        try:
            found = self.kernel(*values)
        except ArithmeticError:
            return (np.nan,) * self.outputs
        return tuple(np.nan if isinstance(number, complex) else number for number in found)

    def one(self, *values: float, tables: tuple[bytes, ...] = ()) -> Array:
        """Solve one problem, as (outputs,); by native code where there is some."""
        if self._native is not None:
            places = accumulate(self.groups, initial=0)
            ranges = [values[start:end] for start, end in pairwise(places)]
            given = (part[0] if len(part) == 1 else part for part in ranges)
            numbers = self.call(*given, *tables)
            if numbers is not None:
                return np.frombuffer(numbers)[-self.outputs :]
        return np.array(self._plain(*values, *(np.frombuffer(table).tolist() for table in tables)))

    def _call_at_first(self, *arguments: object) -> bytes | None:
        """`call` until there is native code."""
        return self.call(*arguments) if self._ready(1) else None

    def _ready(self, count: int) -> bool:
        """Whether native code solves the next problems; kept code is looked for before the first of all."""
        before, self._problems = self._problems, self._problems + count
        many = count >= COMPILE_FROM or before < COMPILE_FROM <= self._problems
        return self._native is not None or ((many or before == 0) and self._start(quick=not many))

    def _start(self, quick: bool = False) -> bool:
        """Whether native code runs from here on: kept code, or code made now unless `quick`."""
        with _LOCK:
            native = self._native or self._recipe.kept(quick)
            if native is None and not quick and has_numba():
                native = self._recipe.made()
            if native is not None:
                self._native, self.call = native, native.call
            return native is not None


def batched(
    kernel: Callable[..., tuple[float, ...]],
    outputs: int,
    groups: tuple[int, ...] | None = None,
    packed: bool = False,
    tables: int = 0,
) -> Batched:
    """Run a scalar solver over a stack of problems.

    The first few problems run the plain Python source. More of them run the same source compiled by Numba and
    cached on disk under a hash of that source, so that an edited kernel is compiled again. Once a kernel is
    compiled, later processes use it from the first problem on.

    Parameters
    ----------
    kernel : function of n floats returning a tuple of floats
        Written in plain arithmetic and the `math` module, or NumPy's functions of the same names, as are all
        functions that it calls.
    outputs : int
        Number of floats that the kernel returns.
    groups : tuple of int, optional
        How many of the n floats each argument of ``call`` holds; one each if left out.
    packed : bool
        Whether ``call`` also takes the `bytes` that end with its numbers.
    tables : int
        How many tables the kernel takes after its floats, which all problems of a stack share. A table is
        given as the `bytes` of doubles; the kernel takes numbers from it by their index.

    Examples
    --------
    >>> def halves(x):
    ...     return x / 2, x / 4
    >>> batched(halves, outputs=2)(np.array([1.0, 2.0]))
    array([[0.5 , 0.25],
           [1.  , 0.5 ]])
    """
    return Batched(kernel, outputs, groups or (1,) * kernel.__code__.co_argcount, packed, tables)


def has_numba() -> bool:
    """Whether Numba can be imported; if not, warn once per process."""
    return installed("numba", "large stacks run slowly, as plain Python")


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
    text = closure_of(kernel).source + (
        f'\n\ncompiled = njit({signature!r}, cache=True, nogil=True, error_model="numpy")'
        f"({kernel.__name__}.py_func)\n"
    )
    _COMPILED[kernel, signature] = load_module(text).compiled
    return _COMPILED[kernel, signature]
