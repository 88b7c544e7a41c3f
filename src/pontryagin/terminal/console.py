"""What the papers' commands share: options and their values, files, answers, and errors about options.

Every `Refusal` begins with the name of an option; `pontryagin.cli` prints it in one line and exits with 2.
"""

import csv
import io
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from pontryagin.certificate import ACCEPTED, Certificate
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, Infeasible, NotConverged
from pontryagin.io import files, json_io
from pontryagin.io import formula as formulas
from pontryagin.io.json_io import Report

Text = str | None
File = Path | None
"""Types of options that may be left out."""
Json = Annotated[
    bool, typer.Option("--json", help="JSON instead of a table; with --batch an object in each line.")
]
Out = Annotated[
    str,
    typer.Option(
        metavar="FILE",
        help="With --batch: where the results go, all at the end; - prints them. A row without an answer has "
        "the reason in its column error. After Ctrl-C the rows done are there.",
    ),
]
"""Options that are the same in several commands."""

FIGURES = (".svg", ".pdf", ".png")
RECORDINGS = (".rrd",)
UNPROVED = f"the certificate does not hold to {ACCEPTED:g}: rounding errors are too large"


class Refusal(typer.TyperException):
    """An error about an option; its message begins with the option's name.

    Its `members` are those of the error about an argument that it stands for.
    """

    exit_code = 2

    def __init__(self, option: str, message: str, members: Sequence[int] = ()) -> None:
        self.option, self.members = option, members
        super().__init__(f"{option}{'' if message.startswith(':') else ' '}{message}")


def interrupted(kept: str) -> typer.Exit:
    """Say on standard error what is kept after Ctrl-C; what is to be raised, with the exit code of shells."""
    typer.echo(f"Interrupted: {kept}", err=True)
    return typer.Exit(130)


def number(option: str, text: str, takes: str = "a number", at_least: float = -math.inf) -> float:
    """The finite number that an option's text stands for, such as ``0.5``, ``1e-3`` or ``pi/4``."""
    value = _number(text)
    if not value >= at_least:
        raise Refusal(option, f"takes {takes}, got {text!r}")
    return value


def positive(option: str, text: str) -> float:
    """The finite number greater than 0 that an option's text stands for."""
    return number(option, text, "a positive number", at_least=math.nextafter(0.0, 1.0))


def vector(option: str, text: str, length: int) -> list[float]:
    """The numbers that an option's text holds, separated by commas."""
    values = [_number(part) for part in text.split(",")]
    if len(values) != length or not np.isfinite(values).all():
        raise Refusal(option, f"takes {length} numbers separated by commas, got {text!r}")
    return values


def formula(option: str, text: str, variable: str) -> float | formulas.Formula:
    """The number, or the function of one variable, that an option's text stands for."""
    try:
        return formulas.read(text, variable)
    except ValueError as reason:
        raise Refusal(option, f": {reason}") from None


def _number(text: str) -> float:
    """The number that a text stands for; nan if it is no number."""
    try:
        return formulas.number(text)
    except ValueError:
        return math.nan


def required(given: Mapping[str, object]) -> None:
    """Refuse the first option that is None."""
    for option, value in given.items():
        if value is None:
            raise Refusal(option, "is missing")


def excluded(by: str, given: Mapping[str, object]) -> None:
    """Refuse the first given option, which cannot be combined with `by`."""
    for option, value in given.items():
        if value:
            raise Refusal(option, f"cannot be combined with {by}")


def together(given: Mapping[str, object], other: str, there: bool) -> None:
    """Refuse the first given option unless the option `other`, which it needs, is `there`."""
    for option, value in given.items():
        if value and not there:
            raise Refusal(option, f"needs {other}")


@contextmanager
def refusing(options: Mapping[str, str]) -> Iterator[None]:
    """Turn an error about an argument into a refusal of the option that the argument came from.

    Parameters
    ----------
    options : mapping of str to str
        Option by argument; errors about other arguments, and problems without a solution, pass.
    """
    try:
        yield
    except Infeasible:
        raise
    except (ArgumentTypeError, ArgumentValueError) as reason:
        name = reason.argument
        if name is None or name not in options:
            raise
        message = str(reason).removeprefix(name).lstrip()
        raise Refusal(options[name], message, reason.members) from reason


@contextmanager
def solving(options: Mapping[str, str]) -> Iterator[None]:
    """Turn a solver's errors about arguments into refusals, and an overflow into `NotConverged`."""
    with np.errstate(all="ignore"), refusing(options):
        try:
            yield
        except (ArithmeticError, np.linalg.LinAlgError) as reason:
            raise NotConverged(
                f"the computation failed, as numbers became too large or too small: {reason}", math.inf
            ) from reason


def file_names(plot: Path | None, record: Path | None, out: str) -> None:
    """Refuse files of a single answer with unknown endings, and ``--out`` without ``--batch``."""
    together({"--out": out != "-"}, "--batch", False)
    ending("--plot", plot, FIGURES)
    ending("--record", record, RECORDINGS)


def ending(option: str, path: Path | None, takes: tuple[str, ...]) -> None:
    """Refuse a file name that has none of the endings `takes`."""
    if path is not None and path.suffix.lower() not in takes:
        raise Refusal(option, f"takes a file name ending in {' or '.join(takes)}, got {path}")


@contextmanager
def reading(option: str, path: Path) -> Iterator[None]:
    """Refuse an option whose file cannot be read, or whose content raises `ValueError`."""
    try:
        yield
    except OSError as reason:
        raise Refusal(option, f"cannot read {path}: {cause(reason)}") from reason
    except (ValueError, csv.Error) as reason:
        raise Refusal(option, f": {path}, {reason}") from reason


@contextmanager
def writable(option: str, path: Path) -> Iterator[None]:
    """Refuse an option whose file cannot be written."""
    try:
        yield
    except OSError as reason:
        raise Refusal(option, f"cannot write {path}: {cause(reason)}") from reason


@contextmanager
def writing(option: str, path: Path) -> Iterator[None]:
    """Refuse an option whose file cannot be written; otherwise say on standard error that it was."""
    with writable(option, path):
        yield
    typer.echo(f"wrote {path}", err=True)


def cause(reason: OSError) -> str:
    """What the system says about a file that cannot be used.

    Examples
    --------
    >>> cause(OSError(28, "No space left on device"))
    'no space left on device'
    """
    return (reason.strerror or str(reason)).lower()


def emit(option: str, target: str, text: str) -> None:
    """Write a text to a file, or to standard output if the file's name is ``-``."""
    if target == "-":
        typer.echo(text.removesuffix("\n"))
        return
    with writing(option, Path(target)):
        files.write(Path(target), text)


def save_figure(option: str, path: Path, figure: Any) -> None:
    """Write a Matplotlib figure as SVG, PDF or PNG, as the file's ending says."""
    from pontryagin.display.plotting import svg_of

    ending = path.suffix.lower()
    drawn = io.BytesIO()
    if ending == ".svg":
        drawn.write(svg_of(figure).encode())
    else:
        figure.savefig(drawn, format=ending.removeprefix("."), dpi=200)
    with writing(option, path):
        files.write(path, drawn.getvalue())


def save_recording(option: str, path: Path, save: Callable[[Path], object]) -> None:
    """Write a recording with the function `save`; one line says if rerun is not installed."""
    try:
        with writing(option, path):
            save(path)
    except RuntimeError as missing:
        raise typer.TyperException(str(missing)) from missing


def require_proof(proof: Certificate) -> None:
    """Raise `NotConverged` where a certificate does not hold to `ACCEPTED`."""
    for i in unproved(proof):
        with np.errstate(all="ignore"):
            raise NotConverged(UNPROVED, float(np.atleast_1d(proof.residual)[i]))


def unproved(proof: Certificate) -> dict[int, str]:
    """What is to be said of each certificate of a stack, or of one, that does not hold to `ACCEPTED`."""
    with np.errstate(all="ignore"):
        residuals = np.atleast_1d(proof.residual)
    return {
        i: str(NotConverged(UNPROVED, float(residuals[i])))
        for i in np.flatnonzero(~(residuals <= ACCEPTED)).tolist()
    }


def as_text(value: Any) -> str:
    """A value as the text of a table's cell; numbers have twelve digits.

    Examples
    --------
    >>> as_text([0.5, float("nan"), -0.0]), as_text(True), as_text(None)
    ('0.5, none, 0', 'yes', 'none')
    """
    value = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
    match value:
        case list() | tuple():
            return ", ".join(as_text(item) for item in value) or "none"
        case bool():
            return "yes" if value else "no"
        case None:
            return "none"
        case float():
            return "none" if math.isnan(value) else f"{value + 0.0:.12g}"
    return str(value)


def answer(as_json: bool, title: str, report: Report, conclusion: str, table: Report | None = None) -> None:
    """Print a report as JSON, or as a table: the report itself, or another one that is made for reading."""
    if as_json:
        typer.echo(json_io.to_json(report))
    else:
        show(title, table or report, conclusion)


def show(title: str, report: Report, conclusion: str = "") -> None:
    """Print a report as a table under its title, and a concluding sentence below it."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE, show_header=False, pad_edge=False)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for heading, quantities in report.items():
        table.add_section()
        table.add_row(Text(heading, style="bold"), "")
        for name, value in quantities.items():
            table.add_row(Text(f"  {name.replace('_', ' ')}"), Text(as_text(value)))
    console = Console(highlight=False)
    console.print(Text(title, style="bold"), table, Text(conclusion), sep="\n")
