"""A batch of problems from a CSV file, read, solved and put aside block by block, and written at the end.

The memory that a batch takes does not grow with its rows: answers wait in a file. A row without an answer
comes back with the reason in its column ``error``; the others do not suffer from it. After an interruption
the result holds the rows that were done; an interrupted or killed batch goes on when it is started again.
"""

import re
import signal
import sys
import threading
from collections.abc import Callable, Collection, Iterator
from contextlib import closing, contextmanager
from functools import partial
from pathlib import Path

import typer

from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, Infeasible, NotConverged
from pontryagin.io import files
from pontryagin.io.rows import Rows
from pontryagin.progress import report
from pontryagin.terminal import bar, console
from pontryagin.terminal.spool import Answers, Part, Spool, rows_done

Solver = Callable[[Rows], tuple[Answers, Certificate | None]]
"""Returns the answers of a block and, if it is to hold in every row, their certificate."""
Unsolved = (console.Refusal, ArgumentTypeError, ArgumentValueError, Infeasible, NotConverged)
"""What a solver raises where a row of a block has no answer."""


def run(
    path: Path,
    out: str,
    blocks: Iterator[Rows],
    solve: Solver,
    as_json: bool = False,
    shared: Collection[str] = (),
    settings: object = None,
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
        See `Solver`. Where it raises for several rows, it is called for parts of them.
    as_json : bool
        Whether a JSON object is written for each row, in place of CSV.
    shared : collection of str
        Options whose values are those of all rows: an error about one of them is not that of a row.
    settings : object
        All that the answers depend on beside the rows; its `repr` tells it from other settings.

    Raises
    ------
    typer.Exit
        With the code 130 after Ctrl-C, when the rows done are written.
    typer.TyperException
        When rows are without answer: with the first reason, and the number of its line.
    """
    with closing(Spool(out, f"{solve.__module__} {settings!r}", as_json)) as spool:
        try:
            stopped = _solved(path, blocks, partial(_parts, solve, frozenset(shared)), spool, as_json, out)
            if spool.answered:
                _write(out, spool.texts())
        except BaseException:
            if not spool.answered:
                spool.remove()
            raise
        if stopped and spool.answered:
            further = "; the same command goes on from there" if spool.lasting else ""
            raise console.interrupted(f"the first {spool.rows} rows are done and written{further}")
        spool.remove()
        if stopped:
            raise console.interrupted("no row is done")
        if spool.first:
            line, error, status = spool.first
            some = f"{spool.errors} of {spool.rows} rows, the first of them in " if spool.answered else ""
            failure = typer.TyperException(f"--batch: {path}, {some}line {line}: {error}")
            failure.exit_code = 1 if spool.answered else status
            raise failure


def _solved(
    path: Path,
    blocks: Iterator[Rows],
    parts: Callable[[Rows], Iterator[Part]],
    spool: Spool,
    as_json: bool,
    out: str,
) -> bool:
    """Put aside the answers of all blocks, or of those before an interruption; whether there was one."""
    try:
        with _pressed() as pressed, bar.shown():
            total = _lines(path) if sys.stderr.isatty() else None
            for block in _read(path, blocks):
                with console.writable("--out", Path(out)):
                    known = spool.recall(block)
                if not known:
                    _tell(spool)
                    solved = list(parts(block))
                    with console.reading("--batch", path):
                        done = rows_done(block, solved, as_json)
                    with console.writable("--out", Path(out)):
                        spool.keep(block, done)
                report("rows done", block.lines[-1], total)
                if pressed():
                    return True
    except KeyboardInterrupt:
        return True
    return False


def _tell(spool: Spool) -> None:
    """Say once that rows of an earlier process are taken."""
    if spool.earlier:
        typer.echo(f"Goes on after {spool.earlier} rows that were done before", err=True)
        spool.earlier = 0


def _read(path: Path, blocks: Iterator[Rows]) -> Iterator[Rows]:
    with console.reading("--batch", path):
        yield from blocks


def _parts(solve: Solver, shared: frozenset[str], block: Rows) -> Iterator[Part]:
    """A block in parts: the rows that cannot be read, and the others with their answers or errors."""
    if block.faults:
        faults = list(block.faults.values())
        yield Part(list(block.faults), None, dict(enumerate(faults)), 2)
    good = [i for i in range(len(block.rows)) if i not in block.faults]
    if good:
        yield from _answers(solve, shared, block, good)


def _answers(solve: Solver, shared: frozenset[str], block: Rows, places: list[int]) -> Iterator[Part]:
    """The rows at some places of a block, in parts that are solved whole, and those that are not.

    Where an error in a stack of problems does not tell which of them it is about, the stack is halved until
    one is left. Those that it is about are solved each for itself, which gives the reason for each.
    """
    part = block.part(places)
    try:
        answers, proof = solve(part)
    except Unsolved as reason:
        if _about(reason) in shared:
            raise
        lost = set(reason.members) & set(range(len(places)))
        if len(places) == 1:
            infeasible = isinstance(reason, Infeasible | NotConverged)
            yield Part(places, None, {0: _of_row(reason)}, 1 if infeasible else 2)
        elif lost:
            for i in sorted(lost):
                yield from _answers(solve, shared, block, [places[i]])
            if others := [place for i, place in enumerate(places) if i not in lost]:
                yield from _answers(solve, shared, block, others)
        else:
            half = len(places) // 2
            yield from _answers(solve, shared, block, places[:half])
            yield from _answers(solve, shared, block, places[half:])
    else:
        yield Part(places, answers, {} if proof is None else console.unproved(proof), 1)


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
