"""Errors and warnings of the command line: one line each on standard error, and the exit code.

Exit codes: 0 done; 1 a problem without an answer, a package that is not installed, or a file system that is
full or fails otherwise; 2 a wrong command line; 130 stopped by Ctrl-C.
"""

import os
import sys
import warnings
from typing import Any, TextIO

import typer
from typer.core import TyperGroup

from pontryagin.errors import Infeasible, NotConverged
from pontryagin.terminal import console


class OneLine(TyperGroup):
    """A command whose errors and warnings are printed in one line, without a traceback."""

    def main(self, *args: Any, **options: Any) -> Any:
        """Run the command line and exit with its status."""
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            try:
                status = super().main(*args, **(options | {"standalone_mode": False}))
                _write_out()
            except typer.TyperException as refused:
                status = _failure(refused.format_message(), refused.exit_code)
            except (Infeasible, NotConverged) as reason:
                status = _failure(str(reason), 1)
            except ModuleNotFoundError as missing:
                status = _failure(f"this needs {missing.name}, which is not installed", 1)
            except MemoryError:
                status = _failure("out of memory", 1)
            except OSError as reason:
                status = _unwritten(reason)
        sys.exit(status or 0)


def _write_out() -> None:
    """Write what standard output still holds, if there is one: Python itself would fail at its end."""
    if sys.stdout is not None:
        sys.stdout.flush()


def _unwritten(reason: OSError) -> int:
    """Say why a file, or standard output, could not be used; who stops reading knows that already."""
    try:
        _write_out()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if isinstance(reason, BrokenPipeError):
        return 1
    place = f"cannot use {reason.filename}" if reason.filename else "cannot write the output"
    return _failure(f"{place}: {console.cause(reason)}", 1)


def _failure(message: str, status: int) -> int:
    _line("Error", message)
    return status


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    _line("Warning", str(message))


def _line(kind: str, message: str) -> None:
    typer.echo(f"{kind}: {' '.join(message.split())}", err=True)
