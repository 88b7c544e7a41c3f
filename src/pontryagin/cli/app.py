"""The application ``pontryagin`` and its entry point."""

import sys
from typing import Annotated

import typer

from pontryagin import __version__
from pontryagin.cli.failures import OneLine
from pontryagin.cli.ledger import ledger
from pontryagin.cli.problems import Problems
from pontryagin.cli.report import report

app = typer.Typer(cls=OneLine, add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
problems = typer.Typer(cls=Problems, rich_markup_mode=None)
app.add_typer(problems, name="solve")
app.command()(ledger)
app.command()(report)


def main() -> None:
    """Entry point of ``pontryagin``."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    app()


@app.callback(invoke_without_command=True)
def pontryagin(
    ctx: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version and exit.")] = False,
) -> None:
    """Optimal spacecraft control from four papers: solved with certificates, compared with the print.

    \b
    Example:
      pontryagin solve triple-integrator --norm inf --x0 0,0,0 --xf 1,0,0 --duration 2
    """
    if version:
        typer.echo(f"pontryagin {__version__}")
    elif ctx.invoked_subcommand is None:
        typer.echo(ctx.get_help())


@problems.callback(invoke_without_command=True)
def solve(ctx: typer.Context) -> None:
    """Solve a problem of one of the papers; the answer comes with its certificate.

    \b
    Example:
      pontryagin solve triple-integrator --norm inf --x0 0,0,0 --xf 1,0,0 --duration 2
    """
    if ctx.invoked_subcommand is None:
        typer.echo(ctx.get_help())
