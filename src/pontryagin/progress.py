"""What a long computation is doing: solvers report it here, and whoever listens shows it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Listener = Callable[[str, int | None, int | None], None]
"""A function of what is done, how much of it is done, and how much there is; None where that is unknown."""

_LISTENER: ContextVar[Listener | None] = ContextVar("listener", default=None)


def report(doing: str, done: int | None = None, total: int | None = None) -> None:
    """Tell the listener, if there is one, what is being done.

    Examples
    --------
    >>> with listening(lambda *what: print(*what)):
    ...     report("families followed", 2, 5)
    families followed 2 5
    """
    listener = _LISTENER.get()
    if listener is not None:
        listener(doing, done, total)


@contextmanager
def listening(listener: Listener) -> Iterator[None]:
    """Within the block, `report` calls the listener."""
    token = _LISTENER.set(listener)
    try:
        yield
    finally:
        _LISTENER.reset(token)
