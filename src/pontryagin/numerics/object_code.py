"""Object code on disk: made by LLVM once per machine, opened by later processes in less than a millisecond.

Where the machine has a linker, a file is a shared library, which the system opens. Elsewhere llvmlite loads
the object, which costs 70 ms of a process, mostly to import llvmlite. Files lie in the user's cache folder
under a hash of all that they are made from. A process writes beside a file and then puts it in place, so that
no other one sees a part of it, and a file that is damaged is made anew. What is opened is run: only files are
opened that belong to the user, or to the superuser, and that nobody else may write.
"""

import atexit
import ctypes
import hashlib
import os
import platform
import shutil
import stat
import subprocess
import sys
import tempfile
import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

DIGEST = hashlib.sha256().digest_size
"""The length of the checksum with which each file ends: the system ignores what follows a library."""

Externals = Callable[[], Mapping[str, int]]
"""A function that finds the addresses in this process of what the code uses and does not hold."""


class Opened(NamedTuple):
    """Code in memory: the addresses of its functions, and the object that keeps it there."""

    addresses: tuple[int, ...]
    code: object


def nothing() -> dict[str, int]:
    """No addresses: the code uses the C library alone."""
    return {}


def kept_path(*parts: str) -> Path:
    """Where code made from these texts is kept, without the suffix that tells the form.

    Raises
    ------
    ImportError
        If llvmlite is missing.
    """
    import llvmlite

    whole = (*parts, llvmlite.__version__, sys.platform, platform.machine())
    return cache_folder() / f"native_{hashlib.sha256(chr(10).join(whole).encode()).hexdigest()[:20]}"


def kept(
    path: Path, symbols: Sequence[str], externals: Externals = nothing, quick: bool = False
) -> Opened | None:
    """The functions that are on disk, or None; if `quick`, only what opens at once."""
    for suffix, opened in FORMS.items():
        file = path.with_suffix(suffix)
        if not (quick and suffix == ".o") and intact(file):
            try:
                return opened(file, symbols, externals)
            except (OSError, RuntimeError):  # Made on another system that shares the folder.
                continue
    return None


def store(code: bytes, path: Path, symbols: Sequence[str], externals: Externals = nothing) -> Opened:
    """Keep object code, and open it."""
    try:
        return _stored(code, path, symbols, externals)
    except OSError:  # The disk is full, or something that is no file lies in this place.
        elsewhere = passing_folder() / path.name
        return _stored(code, elsewhere, symbols, externals)


def _stored(code: bytes, path: Path, symbols: Sequence[str], externals: Externals) -> Opened:
    """Keep object code, as a shared library where that can be made and opened."""
    target = path.with_suffix(".o")
    scratch = scratch_of(target)
    scratch.write_bytes(code)
    linked = scratch.with_suffix(".so.tmp")
    if link(scratch, linked):
        library = target.with_suffix(".so")
        seal(linked, library)
        try:
            opened = open_library(library, symbols, externals)
        except OSError:  # Nothing in this folder may be executed.
            library.unlink(missing_ok=True)
        else:
            scratch.unlink()
            return opened
    seal(scratch, target)
    return open_object(target, symbols, externals)


def object_code(texts: Sequence[str], symbols: Sequence[str], vectors: bool = False) -> bytes:
    """Modules of LLVM's text as one object, in which only the given functions can be seen from outside.

    It runs on every processor of this architecture. With ``vectors`` it uses all instructions of this one,
    if `instructions` tells them: vectors are then added and multiplied several times faster.
    """
    from llvmlite import binding

    start_llvm()
    first, *others = (binding.parse_assembly(text) for text in texts)
    for module in others:
        first.link_in(module)
    for part in (*first.functions, *first.global_variables):
        if not part.is_declaration and part.name not in symbols:
            part.linkage = "internal"
    first.verify()
    host = {}
    if vectors and instructions():
        host = {
            "cpu": binding.get_host_cpu_name(),
            "features": binding.get_host_cpu_features().flatten(),
        }
    machine = binding.Target.from_default_triple().create_target_machine(opt=3, reloc="pic", **host)
    builder = binding.create_pass_builder(machine, binding.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(first, builder)
    return bytes(machine.emit_object(first))


@cache
def instructions() -> str:
    """The extensions that the processor has, as Linux names them for x86; empty where it does not."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return ""
    return next((line for line in lines if line.startswith("flags")), "")


def start_llvm() -> None:
    """Make llvmlite ready for this machine."""
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()


def open_library(path: Path, symbols: Sequence[str], _: Externals) -> Opened:
    """Functions of a shared library."""
    library = ctypes.CDLL(str(path))
    found = (ctypes.cast(library[symbol], ctypes.c_void_p).value for symbol in symbols)
    return Opened(tuple(address or 0 for address in found), library)


def open_object(path: Path, symbols: Sequence[str], externals: Externals) -> Opened:
    """Functions of object code, by llvmlite."""
    from llvmlite import binding

    start_llvm()
    for symbol, address in externals().items():
        binding.add_symbol(symbol, address)
    machine = binding.Target.from_default_triple().create_target_machine()
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), machine)
    engine.add_object_file(binding.ObjectFileRef.from_data(path.read_bytes()[:-DIGEST]))
    engine.finalize_object()
    return Opened(tuple(engine.get_function_address(symbol) for symbol in symbols), engine)


FORMS: dict[str, Callable[[Path, Sequence[str], Externals], Opened]] = {
    ".so": open_library,
    ".o": open_object,
}
"""How to open each form in which native code is kept, the quickest first."""


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
    scratch.chmod(stat.S_IRUSR | stat.S_IWUSR | stat.S_IXUSR)
    scratch.replace(path)


def intact(path: Path) -> bool:
    """Whether a file is there, is nobody else's, and ends with its checksum."""
    try:
        text, state = path.read_bytes(), path.stat()
    except OSError:
        return False
    return trusted(state) and hashlib.sha256(text[:-DIGEST]).digest() == text[-DIGEST:]


def holds(path: Path, text: str) -> bool:
    """Whether a file is there, is nobody else's, and holds a text."""
    try:
        return trusted(path.stat()) and path.read_text() == text
    except (OSError, UnicodeDecodeError):
        return False


def trusted(state: os.stat_result) -> bool:
    """Whether a file belongs to the user or the superuser and nobody else may write it."""
    user: Any = getattr(os, "getuid", None)  # Windows has no such numbers.
    if user is None:
        return True
    return state.st_uid in (0, user()) and not state.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def scratch_of(path: Path) -> Path:
    """A name beside a file that no other thread and no other process uses."""
    return path.with_suffix(f".{os.getpid()}.{threading.get_ident()}.tmp")


@cache
def cache_folder() -> Path:
    """The user's cache; where it cannot be written, a folder of this process alone, and a warning."""
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        folder = Path(base).expanduser() / "pontryagin"
        folder.mkdir(parents=True, exist_ok=True)
        close_to_others(folder)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except (OSError, RuntimeError) as reason:  # RuntimeError: neither HOME nor the system tells the home.
        warnings.warn(
            f"native code cannot be kept in {base}/pontryagin, so that each process makes its own: {reason}; "
            "XDG_CACHE_HOME names another folder",
            RuntimeWarning,
            stacklevel=2,
        )
        return passing_folder()


def close_to_others(folder: Path) -> None:
    """Take from others the right to write into a folder from which code is run.

    Raises
    ------
    OSError
        If the folder is somebody else's.
    """
    state = folder.stat()
    if not trusted(state):
        folder.chmod(stat.S_IMODE(state.st_mode) & ~(stat.S_IWGRP | stat.S_IWOTH))
        if not trusted(folder.stat()):
            raise PermissionError(f"{folder} belongs to another user, whose code would be run")


def passing_folder() -> Path:
    """A new temporary folder, removed when this process ends."""
    folder, owner = Path(tempfile.mkdtemp(prefix="pontryagin-")), os.getpid()

    def remove() -> None:
        if os.getpid() == owner:  # A process that this one started as its copy leaves the folder alone.
            shutil.rmtree(folder, ignore_errors=True)

    atexit.register(remove)
    return folder
