"""Work in processes of their own: a contestant that dies loses its own rows and no others."""

import gc
import multiprocessing
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

PATIENCE = 3600.0
"""Seconds after which a process counts as one that does not answer."""


class Died(Exception):
    """A process ended, or did not answer, before it gave its result."""


class Apart:
    """A function without arguments that is called in a copy of this process, as often as it is asked for.

    Used as a context: the process ends with it.
    """

    def __init__(self, call: Callable[[], Any]) -> None:
        context = multiprocessing.get_context("fork")
        self._answers, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(call, theirs), daemon=True)
        self._process.start()
        theirs.close()

    def __enter__(self) -> "Apart":
        return self

    def __exit__(self, *raised: object) -> None:
        self._process.kill()
        self._process.join()
        self._answers.close()

    def __call__(self) -> Any:
        """The next result; what the function raises is raised here.

        Raises
        ------
        Died
            If the process ends before it gives its result.
        """
        try:
            self._answers.send(None)
            if not self._answers.poll(PATIENCE):
                raise Died(f"did not answer within {PATIENCE:.0f} s")
            result, raised = self._answers.recv()
        except (EOFError, ConnectionError):
            self._process.join()
            raise Died(f"died (exit status {self._process.exitcode})") from None
        if raised is not None:
            raise raised
        return result


def _serve(call: Callable[[], Any], answers: Connection) -> None:
    gc.freeze()  # A collection would copy all that the process began with, and be timed with the work.
    while True:
        try:
            answers.recv()
        except EOFError:
            return
        try:
            answers.send((call(), None))
        except Exception as raised:
            answers.send((None, raised))


def answer(name: str, call: Callable[[], Any], otherwise: Any) -> Any:
    """The result of a call in a process of its own; ``otherwise`` if that dies, which a line says."""
    with Apart(call) as process:
        try:
            return process()
        except Died as reason:
            print(f"{name} {reason}: its rows are empty")
            return otherwise
