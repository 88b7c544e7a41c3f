"""What the build says while it works: a line per step, and bars where the output is a terminal."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

console = Console(highlight=False, soft_wrap=True)


def step(name: str, what: str) -> None:
    """A step of the build, and what came of it."""
    console.print(f"[bold cyan]{name:>10}[/]  {_plain(what)}")


def note(text: str) -> None:
    """Something that the reader of the output should know; the build goes on."""
    console.print(f"[yellow]{'note':>10}[/]  {_plain(text)}")


def failure(text: str) -> None:
    """Why the build stops."""
    console.print(f"[bold red]{'failed':>10}[/]  {_plain(text)}")


@contextmanager
def bars() -> Iterator[Progress]:
    """Bars of the notebooks that run, gone when they are done; nothing where there is no terminal."""
    columns = (
        TextColumn("            {task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        yield progress


class Stopwatch:
    """Seconds since it was made."""

    def __init__(self) -> None:
        self._start = time.perf_counter()

    def __str__(self) -> str:
        return f"{time.perf_counter() - self._start:.1f} s"


def _plain(text: str) -> str:
    return text.replace("[", r"\[")
