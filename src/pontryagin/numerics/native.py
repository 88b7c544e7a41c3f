"""Native code of scalar kernels: made by Numba once per machine, kept on disk, opened without Numba.

Numba compiles a kernel, `fastcall` wraps it, and `object_code` keeps it under a hash of the kernel, the
wrapper, the version of llvmlite, the interpreter's binary interface and the architecture. It is made for the
oldest processor of that architecture, so that one file serves all machines that share a home directory: newer
instructions do not make scalar arithmetic faster (measured: by less than 3 %).
"""

import ctypes
import hashlib
import sys
import types
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from typing import Any

from pontryagin.numerics import object_code
from pontryagin.numerics.closure import Closure, closure_of
from pontryagin.numerics.fastcall import python_function, wrapper
from pontryagin.numerics.object_code import Opened, scratch_of
from pontryagin.numerics.readers import addresses

Loop = Callable[[Any, int, Any, Any], int]
"""The loop over a stack: (result, count, columns, strides) -> 0 where every problem succeeded."""

SYMBOLS = ("call", "loop")
"""The functions of the wrapper."""


@dataclass(frozen=True)
class Native:
    """The native code of one kernel.

    Attributes
    ----------
    call : function
        Solves one problem: the numbers read and computed as doubles in `bytes`; None if an argument is
        neither a number nor a vector of them, or if any number is not finite.
    loop : function
        Solves a stack, without the interpreter's lock.
    code : object
        What keeps the code in memory.
    """

    call: Callable[..., bytes | None]
    loop: Loop
    code: object


@dataclass(frozen=True)
class Recipe:
    """What the native code of a kernel is made from; see `wrapper` for the fields."""

    kernel: Callable[..., tuple[float, ...]]
    groups: tuple[int, ...]
    outputs: int
    packed: bool
    tables: int = 0

    @cached_property
    def closure(self) -> Closure:
        """The kernel with all that it uses."""
        return closure_of(self.kernel)

    @cached_property
    def path(self) -> Path:
        """Where the native code is kept, without the suffix that tells the form.

        Raises
        ------
        ImportError
            If llvmlite is missing.
        """
        text = wrapper("kernel", self.groups, self.outputs, self.packed, self.tables)
        return object_code.kept_path(self.closure.identity, text, EXTENSION_SUFFIXES[0])

    def kept(self, quick: bool = False) -> Native | None:
        """The native code that is on disk, or None; if `quick`, only what opens at once."""
        try:
            path = self.path
        except ImportError:
            return None
        opened = object_code.kept(path, SYMBOLS, addresses, quick)
        return None if opened is None else self._native(opened)

    def made(self) -> Native:
        """The native code, made by Numba and kept on disk."""
        return self._native(object_code.store(self._object_code(), self.path, SYMBOLS, addresses))

    def _object_code(self) -> bytes:
        """The kernel in its wrapper, compiled for any processor of this architecture."""
        numbers = ", ".join(["float64"] * sum(self.groups) + ["CPointer(float64)"] * self.tables)
        name, text = compiled_text(self.closure, f"UniTuple(float64, {self.outputs})({numbers})")
        around = wrapper(name, self.groups, self.outputs, self.packed, self.tables)
        return object_code.object_code([text, around], SYMBOLS)

    def _native(self, opened: Opened) -> Native:
        call, loop = opened.addresses
        pointer = ctypes.c_void_p
        kind = ctypes.CFUNCTYPE(ctypes.c_int32, pointer, ctypes.c_int64, pointer, pointer)
        return Native(python_function(self.kernel.__name__, call), kind(loop), opened.code)


def compiled_text(
    closure: Closure, signature: Any, replaced: Mapping[str, Any] | None = None
) -> tuple[str, str]:
    """A kernel compiled by Numba: its name and the text of a module of LLVM.

    Functions of the kernel that are ``replaced`` are taken as given there.
    """
    from numba import njit

    scope = closure.namespace
    for name, function in closure.functions.items():
        own = types.FunctionType(function.__code__, scope, name, function.__defaults__)
        scope[name] = (replaced or {}).get(name) or njit(nogil=True, error_model="numpy")(own)
    kernel = scope[closure.kernel.__name__]
    kernel.compile(signature)
    (given,) = kernel.signatures
    return kernel.overloads[given].fndesc.llvm_func_name, kernel.inspect_llvm(given)


def load_module(text: str) -> types.ModuleType:
    """Run a module's text as a file of the user's cache, beside which Numba keeps what it compiles.

    What runs is the given text, whatever the file holds. What Numba kept is made anew if it was damaged.
    """
    digest = hashlib.sha256(text.encode()).hexdigest()[:20]
    path = object_code.cache_folder() / f"kernel_{digest}.py"
    if not object_code.holds(path, text):
        scratch = scratch_of(path)
        scratch.write_text(text)
        scratch.replace(path)
    try:
        return _run(text, path)
    except Exception:
        kept = list(path.parent.joinpath("__pycache__").glob(f"{path.stem}*.nb*"))
        if not kept:
            raise
        for file in kept:
            file.unlink(missing_ok=True)
        return _run(text, path)


def _run(text: str, path: Path) -> types.ModuleType:
    module = types.ModuleType(f"pontryagin_{path.stem}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module
    exec(compile(text, str(path), "exec"), module.__dict__)
    return module
