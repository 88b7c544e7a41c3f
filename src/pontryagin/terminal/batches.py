"""A batch of problems from a CSV file, read, solved and put aside block by block, and written at the end.

The memory that a batch takes does not grow with its rows: answers wait in a temporary file. A row without an
answer comes back with the reason in its column ``error``; the others do not suffer from it. After an
interruption the result holds the rows that were done.
"""

import os
import pickle
import re
import signal
import sys
import tempfile
import threading
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import IO, Any, NamedTuple

import typer

from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, Infeasible, NotConverged
from pontryagin.io import files, rows
from pontryagin.io.rows import Rows
from pontryagin.progress import report
from pontryagin.terminal import bar, console

Answers = Mapping[str, Any]
"""The columns of the answers of a block, (n,) or (n, k) each."""
Solver = Callable[[Rows], tuple[Answers, Certificate | None]]
"""Returns the answers of a block and, if it is to hold in every row, their certificate."""
Unsolved = (console.Refusal, ArgumentTypeError, ArgumentValueError, Infeasible, NotConverged)
"""What a solver raises where a row of a block has no answer."""


class Place(NamedTuple):
    """Where some rows lie in the temporary file: their number, the width of their lines, and their errors."""

    start: int
    rows: int
    width: int
    errors: Mapping[int, str]


class Spool:
    """The rows done so far, with their answers, as lines of text in a temporary file beside the target.

    In CSV, a block may have more columns than the blocks before it; its first ones are the same.

    Attributes
    ----------
    rows, answered : int
        Number of the rows done, and of those that have an answer.
    errors : int
        Number of the rows with an error.
    """

    def __init__(self, out: str, as_json: bool) -> None:
        self._out, self._json = Path(out), as_json
        self._header: list[str] = []
        self._places: list[Place] = []
        self.rows = self.answered = self.errors = 0

    @cached_property
    def _file(self) -> IO[bytes]:
        if self._out == Path("-") or not files.replaceable(self._out):
            return tempfile.TemporaryFile()
        folder = Path(os.path.realpath(self._out)).parent
        folder.mkdir(parents=True, exist_ok=True)
        return tempfile.TemporaryFile(dir=folder)

    def add(self, block: Rows, answers: Answers | None, errors: Mapping[int, str]) -> None:
        """Put rows aside, with their answers if they have some, and with errors by the index of their row."""
        rows.require_new(block.header, [rows.ERROR])
        header, lines = block.header, []
        if self._json:
            lines = rows.as_json(block, answers or {}, errors)
        elif answers is None:
            lines = rows.unanswered(block)
        else:
            columns, lines = rows.answered(block, answers)
            header = [*header, *columns]
        with console.writable("--out", self._out):
            start = self._file.seek(0, os.SEEK_END)
            pickle.dump(lines, self._file)
        self._header = max(self._header, header, key=len)
        self._places.append(Place(start, len(lines), len(header), errors))
        self.rows, self.errors = self.rows + len(lines), self.errors + len(errors)
        self.answered += len(lines) if answers is not None else 0

    def texts(self) -> Iterator[str]:
        """All rows as lines of JSON, or as CSV below a header, where narrower rows end with empty cells."""
        if not self._json:
            yield rows.header_line([*self._header, *([rows.ERROR] if self.errors else [])]) + "\n"
        for place in self._places:
            self._file.seek(place.start)
            lines = pickle.load(self._file)
            if not self._json:
                empty = "," * (len(self._header) - place.width + bool(self.errors))
                cells = {i: rows.header_line([error]) for i, error in place.errors.items()}
                lines = [f"{line}{empty}{cells.get(i, '')}" for i, line in enumerate(lines)]
            yield "\n".join([*lines, ""])


def run(
    path: Path,
    out: str,
    blocks: Iterator[Rows],
    solve: Solver,
    as_json: bool = False,
    shared: Collection[str] = (),
) -> None:
    """Solve blocks of problems, and write all their rows with the answers.

    Parameters
    ----------
    path : Path
        The file that ``blocks`` reads.
    out : str
        The file to write, or ``-`` for standard output. Nothing is written if no row has an answer.
    blocks : iterator of Rows
        What `pontryagin.io.rows.blocks` returned.
    solve : function of Rows
        See `Solver`. Where it raises for a block of several rows, it is called for each half.
    as_json : bool
        Whether a JSON object is written for each row, in place of CSV.
    shared : collection of str
        Options whose values are those of all rows: an error about one of them is not that of a row.

    Raises
    ------
    typer.Exit
        With the code 130 after Ctrl-C, when the rows done are written.
    typer.TyperException
        When rows are without answer: with the first reason, and the number of its line.
    """
    spool, first = Spool(out, as_json), _First()
    stopped = _solved(path, blocks, partial(_parts, solve, frozenset(shared)), spool, first)
    if spool.answered:
        _write(out, spool.texts())
    if stopped:
        raise console.interrupted(
            f"the first {spool.rows} rows are done and written" if spool.answered else "no row is done"
        )
    if spool.errors:
        some = f"{spool.errors} of {spool.rows} rows, the first of them in " if spool.answered else ""
        message = f"--batch: {path}, {some}line {first.line}: {first.error}"
        failure = typer.TyperException(message)
        failure.exit_code = 1 if spool.answered else first.status
        raise failure


@dataclass
class _First:
    """The first error of a batch, the line of its row, and the exit code if no row has an answer."""

    line: int = 0
    error: str = ""
    status: int = 0


def _solved(
    path: Path,
    blocks: Iterator[Rows],
    parts: Callable[[Rows], Iterator[tuple[Rows, Answers | None, dict[int, str], int]]],
    spool: Spool,
    first: _First,
) -> bool:
    """Put aside the answers of all blocks, or of those before an interruption; whether there was one."""
    try:
        with _pressed() as pressed, bar.shown():
            total = _lines(path) if sys.stderr.isatty() else None
            for block in _read(path, blocks):
                for part, answers, errors, status in parts(block):
                    with console.reading("--batch", path):
                        spool.add(part, answers, errors)
                    if errors and not first.error:
                        i = min(errors)
                        first.line, first.error, first.status = part.lines[i], errors[i], status
                report("rows done", block.lines[-1], total)
                if pressed():
                    return True
    except KeyboardInterrupt:
        return True
    return False


def _read(path: Path, blocks: Iterator[Rows]) -> Iterator[Rows]:
    with console.reading("--batch", path):
        yield from blocks


def _parts(
    solve: Solver, shared: frozenset[str], block: Rows
) -> Iterator[tuple[Rows, Answers | None, dict[int, str], int]]:
    """A block in parts that are solved whole, and the rows that are not: answers, errors and the exit code.

    An error in a stack of problems does not tell which of them it is about: it is halved until one is left.
    """
    reason: Exception | None = None
    if not block.faults:
        try:
            answers, proof = solve(block)
        except Unsolved as raised:
            if _about(raised) in shared:
                raise
            reason = raised
        else:
            yield block, answers, {} if proof is None else console.unproved(proof), 1
            return
    count = len(block.rows)
    if count > 1:
        yield from _parts(solve, shared, block.part(0, count // 2))
        yield from _parts(solve, shared, block.part(count // 2, count))
    elif reason is None:
        yield block, None, dict(block.faults), 2
    else:
        yield block, None, {0: _of_row(reason)}, 1 if isinstance(reason, Infeasible | NotConverged) else 2


def _about(reason: Exception) -> str:
    """The option that an error is about, as far as it tells."""
    return reason.option if isinstance(reason, console.Refusal) else f"--{str(reason).partition(' ')[0]}"


def _of_row(reason: Exception) -> str:
    """What an error about a stack of one problem says about that problem."""
    text = reason.message if isinstance(reason, console.Refusal) else str(reason)
    text = re.sub(r"^--(batch: *)?", "", text)
    text = re.sub(r" at index [\[(]0,?[\])]", "", text)
    return re.sub(r"(at index [\[(])0, ", r"\1", text)


@contextmanager
def _pressed() -> Iterator[Callable[[], bool]]:
    """A function that tells whether Ctrl-C was pressed, even where the exception was swallowed on its way.

    Python drops an exception that is raised in a destructor or in a callback from compiled code.
    """
    signals: list[int] = []

    def note(number: int, frame: object) -> None:
        signals.append(number)
        raise KeyboardInterrupt

    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield lambda: bool(signals)
    finally:
        signal.signal(signal.SIGINT, before)


def _write(out: str, texts: Iterator[str]) -> None:
    """Write texts to a file in one step, or to standard output if its name is ``-``."""
    if out == "-":
        for text in texts:
            typer.echo(text, nl=False)
        return
    with (
        console.writing("--out", Path(out)),
        files.replacing(Path(out)) as draft,
        draft.open("w", encoding="utf-8", newline="") as file,
    ):
        file.writelines(texts)


def _lines(path: Path) -> int | None:
    """Number of lines of a file; None for a pipe, which can be read only once."""
    if not path.is_file():
        return None
    with path.open("rb") as file:
        return sum(part.count(b"\n") for part in iter(lambda: file.read(1 << 20), b""))
