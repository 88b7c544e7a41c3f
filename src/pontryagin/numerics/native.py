"""Native code of scalar kernels: made by Numba once per machine, kept on disk, opened without Numba.

Numba compiles a kernel, `fastcall` wraps it, and the object code goes into the user's cache under a hash of
the kernel, the wrapper, the version of llvmlite, the interpreter's binary interface and the architecture. It
is made for the oldest processor of that architecture, so that one file serves all machines that share a home
directory: newer instructions do not make scalar arithmetic faster (measured: by less than 3 %).

Where the machine has a linker, the file is a shared library. The system opens it in 0.3 ms, so that already
the first call of a process runs native code. Elsewhere llvmlite loads the object, which costs 70 ms of a
process, mostly to import llvmlite.
"""

import ctypes
import hashlib
import importlib.util
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import threading
import types
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from typing import Any

from pontryagin.numerics.closure import Closure, closure_of
from pontryagin.numerics.fastcall import python_function, wrapper
from pontryagin.numerics.readers import addresses

Loop = Callable[[Any, int, Any, Any], int]
"""The loop over a stack: (result, count, columns, strides) -> 0 where every problem succeeded."""

DIGEST = hashlib.sha256().digest_size
"""The length of the checksum with which each file ends: the system ignores what follows a library."""


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
        import llvmlite

        text = wrapper("kernel", self.groups, self.outputs, self.packed, self.tables)
        here = (EXTENSION_SUFFIXES[0], sys.platform, platform.machine())
        parts = (self.closure.identity, text, llvmlite.__version__, *here)
        digest = hashlib.sha256("\n".join(parts).encode()).hexdigest()[:20]
        return cache_folder() / f"native_{digest}"

    def kept(self, quick: bool = False) -> Native | None:
        """The native code that is on disk, or None; if `quick`, only what opens at once."""
        try:
            path = self.path
        except ImportError:
            return None
        for suffix, opened in FORMS.items():
            file = path.with_suffix(suffix)
            if not (quick and suffix == ".o") and intact(file):
                try:
                    return opened(file, self.kernel.__name__)
                except (OSError, RuntimeError):  # Made on another system that shares the folder.
                    continue
        return None

    def made(self) -> Native:
        """The native code, made by Numba and kept on disk."""
        code, path = self._object_code(), self.path
        try:
            return self._written(code, path)
        except OSError:  # The disk is full, or something that is no file lies in this place.
            return self._written(code, Path(tempfile.mkdtemp(prefix="pontryagin-")) / path.name)

    def _written(self, code: bytes, path: Path) -> Native:
        """Keep object code, as a shared library where that can be made and opened."""
        name, target = self.kernel.__name__, path.with_suffix(".o")
        scratch = scratch_of(target)
        scratch.write_bytes(code)
        linked = scratch.with_suffix(".so.tmp")
        if link(scratch, linked):
            library = target.with_suffix(".so")
            seal(linked, library)
            try:
                native = open_library(library, name)
            except OSError:  # Nothing in this folder may be executed.
                library.unlink(missing_ok=True)
            else:
                scratch.unlink()
                return native
        seal(scratch, target)
        return open_object(target, name)

    def _object_code(self) -> bytes:
        """The kernel in its wrapper, compiled for any processor of this architecture."""
        from llvmlite import binding

        name, text = self._compiled()
        start_llvm()
        module = binding.parse_assembly(text)
        module.link_in(
            binding.parse_assembly(wrapper(name, self.groups, self.outputs, self.packed, self.tables))
        )
        for part in (*module.functions, *module.global_variables):
            if not part.is_declaration and part.name not in ("call", "loop"):
                part.linkage = "internal"
        module.verify()
        machine = binding.Target.from_default_triple().create_target_machine(opt=3, reloc="pic")
        builder = binding.create_pass_builder(machine, binding.create_pipeline_tuning_options(speed_level=3))
        builder.getModulePassManager().run(module, builder)
        return bytes(machine.emit_object(module))

    def _compiled(self) -> tuple[str, str]:
        """The kernel compiled by Numba: its name and the text of a module of LLVM."""
        from numba import njit

        scope = self.closure.namespace
        for name, function in self.closure.functions.items():
            own = types.FunctionType(function.__code__, scope, name, function.__defaults__)
            scope[name] = njit(nogil=True, error_model="numpy")(own)
        kernel = scope[self.kernel.__name__]
        taken = ["float64"] * sum(self.groups) + ["CPointer(float64)"] * self.tables
        kernel.compile(f"UniTuple(float64, {self.outputs})({', '.join(taken)})")
        (given,) = kernel.signatures
        return kernel.overloads[given].fndesc.llvm_func_name, kernel.inspect_llvm(given)


def start_llvm() -> None:
    """Make llvmlite ready for this machine."""
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


def open_library(path: Path, name: str) -> Native:
    """Native code from a shared library."""
    library = ctypes.CDLL(str(path))
    call, loop = (ctypes.cast(library[symbol], ctypes.c_void_p).value for symbol in ("call", "loop"))
    return _native(name, call, loop, library)


def open_object(path: Path, name: str) -> Native:
    """Native code from object code, by llvmlite."""
    from llvmlite import binding

    start_llvm()
    for symbol, address in addresses().items():
        binding.add_symbol(symbol, address)
    machine = binding.Target.from_default_triple().create_target_machine()
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), machine)
    engine.add_object_file(binding.ObjectFileRef.from_data(path.read_bytes()[:-DIGEST]))
    engine.finalize_object()
    call, loop = (engine.get_function_address(symbol) for symbol in ("call", "loop"))
    return _native(name, call, loop, engine)


FORMS = {".so": open_library, ".o": open_object}
"""How to open each form in which native code is kept, the quickest first."""


def _native(name: str, call: int | None, loop: int | None, code: object) -> Native:
    pointer = ctypes.c_void_p
    kind = ctypes.CFUNCTYPE(ctypes.c_int32, pointer, ctypes.c_int64, pointer, pointer)
    assert call and loop
    return Native(python_function(name, call), kind(loop), code)


def link(code: Path, library: Path) -> bool:
    """Turn object code into a shared library; whether the machine has a linker that does."""
    linker = shutil.which("cc")
    if linker is None or sys.platform == "win32":
        return False
    unresolved = ["-undefined", "dynamic_lookup"] if sys.platform == "darwin" else []
    command = [linker, "-shared", *unresolved, "-o", str(library), str(code), "-lm"]
    try:
        return subprocess.run(command, capture_output=True, check=False).returncode == 0
    except OSError:  # No process may be started.
        return False


def seal(scratch: Path, path: Path) -> None:
    """Add its checksum to a file and put it in place, at once for all who look."""
    with scratch.open("r+b") as file:
        file.write(hashlib.sha256(file.read()).digest())
    scratch.replace(path)


def intact(path: Path) -> bool:
    """Whether a file is there and ends with its checksum."""
    try:
        text = path.read_bytes()
    except OSError:
        return False
    return hashlib.sha256(text[:-DIGEST]).digest() == text[-DIGEST:]


def scratch_of(path: Path) -> Path:
    """A name beside a file that no other thread and no other process uses."""
    return path.with_suffix(f".{os.getpid()}.{threading.get_ident()}.tmp")


def load_module(text: str) -> types.ModuleType:
    """Import a module from its text, which is stored in the user's cache under its hash."""
    digest = hashlib.sha256(text.encode()).hexdigest()[:20]
    path = cache_folder() / f"kernel_{digest}.py"
    if not path.exists():
        scratch = scratch_of(path)
        scratch.write_text(text)
        scratch.replace(path)
    spec = importlib.util.spec_from_file_location(f"pontryagin_{path.stem}", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


@cache
def cache_folder() -> Path:
    """The user's cache, or a temporary folder where it cannot be written."""
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    folder = Path(base).expanduser() / "pontryagin"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return Path(tempfile.mkdtemp(prefix="pontryagin-"))
