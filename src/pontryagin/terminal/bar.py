"""A bar on standard error that shows what a long computation is doing."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from pontryagin.progress import listening


@contextmanager
def shown() -> Iterator[None]:
    """Show what is reported to `pontryagin.progress` within the block, if standard error is a terminal.

    The bar is removed at the end.
    """
    if not sys.stderr.isatty():
        yield
        return
    from rich import progress
    from rich.console import Console

    columns = (
        progress.SpinnerColumn(),
        progress.TextColumn("{task.description}", markup=False),
        progress.BarColumn(),
        progress.MofNCompleteColumn(),
        progress.TimeElapsedColumn(),
        progress.TimeRemainingColumn(),
    )
    # What goes to standard output belongs to the answer, and must not be sent to the bar's stream.
    with progress.Progress(
        *columns, console=Console(stderr=True), transient=True, redirect_stdout=False
    ) as bar:
        task = bar.add_task("", total=None)

        def update(doing: str, done: int | None, total: int | None) -> None:
            bar.tasks[0].total = total
            bar.update(task, description=doing, completed=done or 0)

        with listening(update):
            yield
