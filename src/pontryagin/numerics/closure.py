"""What a plain Python kernel is made of: the functions that it calls and the numbers that it uses."""

import inspect
import math
import types
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Closure:
    """A kernel with everything that it uses, which has one namespace here.

    Attributes
    ----------
    kernel : function
        The kernel.
    functions : dict of str to function
        All plain functions that it calls, and itself as the last.
    constants : dict of str to number
        The numbers that they take from their modules.
    imported : set of str
        The names that they take from the `math` module, or from NumPy for what both have.
    arrays : bool
        Whether they use NumPy, as ``np``.
    """

    kernel: Callable[..., Any]
    functions: dict[str, types.FunctionType]
    constants: dict[str, float]
    imported: set[str]
    arrays: bool

    @property
    def identity(self) -> str:
        """A text that changes with the kernel, with a function that it calls and with a number it uses."""
        parts: list[object] = [sorted(self.constants.items()), sorted(self.imported)]
        for name, function in self.functions.items():
            parts.append((name, function.__defaults__, _instructions(function.__code__)))
        return repr(parts)

    @property
    def namespace(self) -> dict[str, Any]:
        """The numbers and the functions of the `math` module by name."""
        return dict(self.constants) | {name: getattr(math, name) for name in self.imported}

    @property
    def source(self) -> str:
        """The text of a module in which every function is compiled by Numba."""
        parts = ["from __future__ import annotations", "from numba import njit, types"]
        if self.arrays:
            parts.append("import numpy as np")
        if self.imported:
            parts.append("from math import " + ", ".join(sorted(self.imported)))
        parts += [f"{name} = {value!r}" for name, value in sorted(self.constants.items())]
        decorator = '\n@njit(cache=True, nogil=True, error_model="numpy")\n'
        parts += [decorator + inspect.getsource(function) for function in self.functions.values()]
        return "\n".join(parts)


def closure_of(kernel: Callable[..., Any]) -> Closure:
    """A kernel with all plain functions and numbers that it uses.

    Raises
    ------
    TypeError
        If it uses anything else, or two different things of one name.
    """
    found = Closure(kernel, {}, {}, set(), False)
    arrays = _visit(kernel, found)
    return Closure(kernel, found.functions, found.constants, found.imported, arrays)


def _visit(target: Any, found: Closure) -> bool:
    """Add a function and all that it uses to what is found; whether any of it uses NumPy."""
    arrays, kernel = False, found.kernel.__name__
    if found.functions.get(target.__name__) is target:
        return arrays
    for name in _names(target.__code__):
        if name not in target.__globals__:
            continue
        value = target.__globals__[name]
        if isinstance(value, types.FunctionType):
            arrays |= _visit(value, found)
        elif getattr(math, name, None) is value or (isinstance(value, np.ufunc) and hasattr(math, name)):
            found.imported.add(name)
        elif isinstance(value, int | float):
            if found.constants.setdefault(name, value) != value:
                raise TypeError(f"{kernel} uses two different numbers called {name}")
        elif value is np:
            arrays = True
        else:
            raise TypeError(f"{target.__name__} uses {name}, which is neither a number nor a plain function")
    if found.functions.setdefault(target.__name__, target) is not target:
        raise TypeError(f"{kernel} uses two different functions called {target.__name__}")
    return arrays


def _inner(code: types.CodeType) -> list[types.CodeType]:
    """The code of the comprehensions and functions inside."""
    return [constant for constant in code.co_consts if isinstance(constant, types.CodeType)]


def _names(code: types.CodeType) -> list[str]:
    """The names that code looks up, also those inside."""
    return [*code.co_names, *(name for part in _inner(code) for name in _names(part))]


def _instructions(code: types.CodeType) -> tuple[object, ...]:
    """What code does, without where it stands."""
    constants = [part for part in code.co_consts if not isinstance(part, types.CodeType)]
    inner = [_instructions(part) for part in _inner(code)]
    return code.co_code, constants, inner, code.co_names, code.co_varnames, code.co_argcount
