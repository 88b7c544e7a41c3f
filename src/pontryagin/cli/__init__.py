"""The command line: ``pontryagin solve PROBLEM``, ``pontryagin ledger``, ``pontryagin report``.

A paper adds a problem with a module ``command.py`` in its folder and a line in `COMMANDS`. The module holds
one function ``solve`` whose annotations are its options (typer) and whose docstring is its help, with
examples at the end after a line of ``\\b``. The folder's name is the command's: ``triple_integrator`` is
``pontryagin solve triple-integrator``. It is imported when it is called for, and imports its solvers
inside ``solve``, so that no paper waits for another. `pontryagin.terminal.console` has what such functions
share.

Exit codes: 0 done; 1 a problem without an answer, or something not installed; 2 what was typed makes no
sense. Every failure is one line on standard error.
"""

import sys
from importlib import import_module
from typing import Annotated, Any

import typer
from typer.core import TyperGroup
from typer.main import get_command

from pontryagin import __version__
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.terminal import console

COMMANDS = (
    "pontryagin.triple_integrator.command",
    "pontryagin.orbit_correction.command",
    "pontryagin.averaging.command",
    "pontryagin.rendezvous.command",
)
"""Modules whose ``solve`` is a problem, a paper a line."""


class OneLine(TyperGroup):
    """A command whose failures are one line on standard error, and never a traceback."""

    def main(self, *args: Any, **options: Any) -> Any:
        """Run the command line and exit with its status."""
        try:
            status = super().main(*args, **(options | {"standalone_mode": False}))
        except typer.TyperException as refused:
            status = _failure(refused.format_message(), refused.exit_code)
        except (Infeasible, NotConverged) as none:
            status = _failure(str(none), 1)
        except ModuleNotFoundError as missing:
            status = _failure(f"this needs {missing.name}, which is not installed", 1)
        except MemoryError:
            status = _failure("out of memory", 1)
        sys.exit(status or 0)


def _failure(message: str, status: int) -> int:
    typer.echo("Error: " + " ".join(message.split()), err=True)
    return status


class Problems(TyperGroup):
    """The problems of `COMMANDS` by the names of their folders."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names in the order of `COMMANDS`."""
        return [module.split(".")[-2].replace("_", "-") for module in COMMANDS]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The command of a problem, imported now."""
        found = dict(zip(self.list_commands(ctx), COMMANDS, strict=True)).get(cmd_name)
        if found is None:
            return None
        one = typer.Typer(add_completion=False, rich_markup_mode=None)
        one.command(cmd_name)(import_module(found).solve)
        return get_command(one)


app = typer.Typer(cls=OneLine, add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
problems = typer.Typer(cls=Problems, rich_markup_mode=None)
app.add_typer(problems, name="solve")


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
    """Optimal spacecraft control from four papers: solved with certificates, checked against print.

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


Part = str | None


@app.command()
def ledger(
    paper: Annotated[Part, typer.Option(metavar="NAME", help="A paper, by (part of) its name.")] = None,
    verdict: Annotated[
        Part,
        typer.Option(metavar="VERDICT", help="holds, misprint, false, conditional, unreadable, not checked."),
    ] = None,
    csv: Annotated[Part, typer.Option(metavar="FILE", help="Write CSV, to - for standard output.")] = None,
    json: Annotated[Part, typer.Option(metavar="FILE", help="Write JSON, to - for standard output.")] = None,
) -> None:
    """What the papers print, and whether it holds: every formula, number and claim with its verdict.

    \b
    Examples:
      pontryagin ledger --verdict misprint
      pontryagin ledger --paper gorelov --csv ledger.csv
    """
    from pontryagin import ledger as book

    with console.blaming({"paper": "--paper", "verdict": "--verdict"}):
        entries = book.entries(paper, verdict)
    if csv:
        console.emit("--csv", csv, book.to_csv(entries))
    if json:
        console.emit("--json", json, book.to_json(entries) + "\n")
    if not csv and not json:
        from rich.console import Console

        Console().print(book.table(entries))


@app.command()
def report(
    stage: Annotated[
        str, typer.Argument(metavar="[STAGE]", help="How far: notebooks, figures, recordings or report.")
    ] = "report",
    workers: Annotated[
        int, typer.Option(metavar="N", min=1, help="Notebooks and recordings made at a time.")
    ] = 2,
) -> int:
    """Execute the notebooks and build the report, in a checkout of the project.

    \b
    Example:
      pontryagin report figures
    """
    from pontryagin.report import build

    if stage not in build.STAGES:
        raise console.Refusal("STAGE", f"takes {', '.join(build.STAGES)}, got {stage!r}")
    try:
        return build.main([stage, "--workers", str(workers)])
    except ValueError as reason:
        raise typer.TyperException(str(reason)) from reason
