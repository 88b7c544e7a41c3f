"""A batch of problems from a CSV file, read, solved and put aside block by block, and written at the end.

The memory that a batch takes does not grow with its rows: answers wait in a temporary file. The result is
complete or, after an interruption, holds the rows that were done; after an error there is none.
"""

import math
import os
import pickle
import re
import signal
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import IO, Any

import numpy as np
import typer

from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.io import files
from pontryagin.io.rows import Rows, answered, header_line
from pontryagin.progress import report
from pontryagin.terminal import bar, console

Answers = Mapping[str, Any]
"""The columns of the answers of a block, (n,) or (n, k) each."""


class Spool:
    """The rows done so far, with their answers, as lines of CSV in a temporary file beside the target.

    A block may have more columns than the blocks before it; its first ones are the same.
    """

    def __init__(self, out: str) -> None:
        self._out = Path(out)
        self._header: list[str] = []
        self._places: list[tuple[int, int, int]] = []

    @cached_property
    def _file(self) -> IO[bytes]:
        if self._out == Path("-"):
            return tempfile.TemporaryFile()
        self._out.parent.mkdir(parents=True, exist_ok=True)
        return tempfile.TemporaryFile(dir=self._out.parent)

    @property
    def rows(self) -> int:
        """Number of the rows done."""
        return sum(count for _, _, count in self._places)

    def add(self, block: Rows, answers: Answers) -> None:
        """Put a block of rows with its answers aside."""
        columns, lines = answered(block, answers)
        header = [*block.header, *columns]
        with console.writable("--out", self._out):
            place = self._file.seek(0, os.SEEK_END)
            pickle.dump(lines, self._file)
        self._header = max(self._header, header, key=len)
        self._places.append((place, len(header), len(lines)))

    def texts(self) -> Iterator[str]:
        """The header and all rows as CSV; rows of narrower blocks end with empty cells."""
        yield header_line(self._header) + "\n"
        for place, width, _ in self._places:
            self._file.seek(place)
            end = "," * (len(self._header) - width) + "\n"
            yield end.join([*pickle.load(self._file), ""])


class Proofs:
    """Certificates of all blocks, of which only the worst ones are remembered."""

    def __init__(self) -> None:
        self._open, self._all, self._worst = 0, 0, -math.inf

    def add(self, proof: Certificate) -> None:
        """Count those of a stack that do not hold."""
        left = console.unproved(proof)
        self._open, self._all = self._open + left.size, self._all + proof.primal_residual.size
        self._worst = float(np.max(left, initial=self._worst))

    def require(self) -> None:
        """Raise `NotConverged` if one did not hold."""
        if self._open:
            raise console.without_proof(f"{self._open} of {self._all} certificates do", self._worst)


def run(
    path: Path, out: str, blocks: Iterator[Rows], solve: Callable[[Rows], tuple[Answers, Certificate | None]]
) -> None:
    """Solve blocks of problems, and write all their rows with the answers.

    Parameters
    ----------
    path : Path
        The file that ``blocks`` reads.
    out : str
        The file to write, or ``-`` for standard output. Nothing is written if a row is at fault.
    blocks : iterator of Rows
        What `pontryagin.io.rows.blocks` returned.
    solve : function of Rows
        Returns the answers and, if it is to hold in every row, their certificate.

    Raises
    ------
    typer.Exit
        With the code 130 after Ctrl-C, when the rows done are written.
    """
    spool, proofs = Spool(out), Proofs()
    stopped = _solved(path, blocks, solve, spool, proofs)
    if spool.rows:
        _write(out, spool.texts())
    if stopped:
        raise console.interrupted(
            f"the first {spool.rows} rows are done and written" if spool.rows else "no row is done"
        )
    proofs.require()


def _solved(
    path: Path,
    blocks: Iterator[Rows],
    solve: Callable[[Rows], tuple[Answers, Certificate | None]],
    spool: Spool,
    proofs: Proofs,
) -> bool:
    """Put aside the answers of all blocks, or of those before an interruption; whether there was one."""
    try:
        with _pressed() as pressed, bar.shown():
            total = _lines(path) if sys.stderr.isatty() else None
            for block in _read(path, blocks):
                with _placed(block, spool.rows):
                    answers, proof = solve(block)
                spool.add(block, answers)
                if proof is not None:
                    proofs.add(proof)
                report("rows done", block.lines[-1], total)
                if pressed():
                    return True
    except KeyboardInterrupt:
        return True
    return False


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


def _read(path: Path, blocks: Iterator[Rows]) -> Iterator[Rows]:
    with console.reading("--batch", path):
        yield from blocks


@contextmanager
def _placed(block: Rows, before: int) -> Iterator[None]:
    """Errors that name a row by its index in the block name its index in the file, and its line."""

    def in_file(found: re.Match[str]) -> str:
        index = int(found["row"])
        return f"{found[1]}{before + index}{found[3]}, line {block.lines[index]}"

    def placed(message: str) -> str:
        return re.sub(r"(at index [\[(])(?P<row>\d+)([^\])]*[\])])", in_file, message)

    try:
        yield
    except console.Refusal as refused:
        refused.message = placed(refused.message)
        raise
    except (Infeasible, NotConverged) as reason:
        reason.args = (placed(reason.args[0]), *reason.args[1:])
        raise


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
