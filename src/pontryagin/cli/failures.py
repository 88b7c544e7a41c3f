"""Errors and warnings of the command line: one line each on standard error, and the exit code.

Exit codes: 0 done; 1 a problem without an answer, or a package that is not installed; 2 a wrong command line;
130 stopped by Ctrl-C.
"""

import sys
import warnings
from typing import Any, TextIO

import typer
from typer.core import TyperGroup

from pontryagin.errors import Infeasible, NotConverged


class OneLine(TyperGroup):
    """A command whose errors and warnings are printed in one line, without a traceback."""

    def main(self, *args: Any, **options: Any) -> Any:
        """Run the command line and exit with its status."""
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            try:
                status = super().main(*args, **(options | {"standalone_mode": False}))
            except typer.TyperException as refused:
                status = _failure(refused.format_message(), refused.exit_code)
            except (Infeasible, NotConverged) as reason:
                status = _failure(str(reason), 1)
            except ModuleNotFoundError as missing:
                status = _failure(f"this needs {missing.name}, which is not installed", 1)
            except MemoryError:
                status = _failure("out of memory", 1)
        sys.exit(status or 0)


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
