"""Results that are dear to compute, kept between the processes of one build under the hash of their sources.

The report makes a folder for them and writes into it a key for each module whose functions are `kept`: a hash
of all the files that the module depends on, the pinned packages and the interpreter. What was computed under
another key is not read. Without such a folder a result is kept in its process alone.
"""

import hashlib
import json
import os
import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache, update_wrapper
from pathlib import Path
from typing import Any, Generic, ParamSpec, TypeVar, cast

from pontryagin.io import sealed

FOLDER = "PONTRYAGIN_KEPT"
"""The environment variable that names the folder."""
KEYS = "keys.json"
"""The file in it that holds the key of each module."""
STATES = 4
"""How many keys' results are left in the folder: those of a few branches."""

P = ParamSpec("P")
T = TypeVar("T")


class Kept(Generic[P, T]):
    """A function whose results are kept; see `kept`."""

    def __init__(self, function: Callable[P, T]) -> None:
        self._function = function
        self._here = cast(Callable[P, T], cache(self._between_processes))
        update_wrapper(self, function)

    def __call__(self, *arguments: P.args, **named: P.kwargs) -> T:
        """The result, computed if no process of this build did so."""
        return self._here(*arguments, **named)

    def _between_processes(self, *arguments: P.args, **named: P.kwargs) -> T:
        return between_processes(*self._names(arguments, named), lambda: self._function(*arguments, **named))

    def ahead(self, *arguments: P.args, **named: P.kwargs) -> None:
        """Compute a result that will be needed, unless it is there or another process computes it now."""
        module, name = self._names(arguments, named)
        with suppress(Busy):
            between_processes(module, name, lambda: self._function(*arguments, **named), waits=False)

    def _names(self, arguments: tuple[Any, ...], named: dict[str, Any]) -> tuple[str, str]:
        name = f"{self._function.__qualname__} {arguments!r} {sorted(named.items())!r}"
        return self._function.__module__, name


class Busy(RuntimeError):
    """Another process computes the result."""


def kept(function: Callable[P, T]) -> Kept[P, T]:
    """Compute a result once: in each process, and once for all processes that a build starts.

    A module may offer a function ``ahead()`` that calls the method `Kept.ahead` for the dear ones, those that
    are needed last first: a build runs it beside the notebooks.

    Parameters
    ----------
    function : function
        Its arguments are hashable and have a `repr` that tells them apart; its results can be pickled.
        Everything that they depend on is imported by its module, or by what that imports.

    Examples
    --------
    >>> @kept
    ... def square(x):
    ...     print("computed")
    ...     return x * x
    >>> square(3), square(3)
    computed
    (9, 9)
    """
    return Kept(function)


def between_processes(module: str, name: str, compute: Callable[[], T], waits: bool = True) -> T:
    """The result of that name, from the folder if it was computed under the module's key, or computed now.

    Parameters
    ----------
    module : str
        Dotted name of a module that imports all that the result depends on.
    name : str
        What tells the result from the module's others.
    compute : callable
        Computes it, while other processes that need it wait.
    waits : bool
        Whether to wait for a process that computes it; if not, `Busy` is raised.
    """
    folder = os.environ.get(FOLDER)
    key = _keys(Path(folder)).get(module) if folder else None
    if not folder or not key:
        return compute()
    place = Path(folder) / module / hashlib.sha256(name.encode()).hexdigest()[:24]
    target = place / f"{key}.pickle"
    kept = sealed.read(target)
    if kept is None:
        with _alone(place, waits):
            kept = sealed.read(target)
            if kept is None:
                kept = pickle.dumps(compute())
                sealed.write(target, kept)
                _forget_old(place)
    found: T = pickle.loads(kept)
    return found


@cache
def _keys(folder: Path) -> dict[str, str]:
    with suppress(OSError, ValueError):
        keys: dict[str, str] = json.loads((folder / KEYS).read_text(encoding="utf-8"))
        return keys
    return {}


@contextmanager
def _alone(folder: Path, waits: bool) -> Iterator[None]:
    """Hold a folder for this process; freed by the system when it is killed."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / ".lock").open("w") as held:
        with suppress(ImportError):
            import fcntl

            try:
                fcntl.flock(held, fcntl.LOCK_EX if waits else fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise Busy(str(folder)) from None
        yield


def _forget_old(folder: Path) -> None:
    entries = sorted(folder.glob("*.pickle"), key=lambda entry: entry.stat().st_mtime)
    for entry in entries[:-STATES]:
        entry.unlink(missing_ok=True)
