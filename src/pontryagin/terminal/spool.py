"""The rows of a batch that are done, kept beside its target until all are: a killed batch goes on from there.

The file holds frames: the checksum of what a frame is about, the length of its content, the content as JSON,
and its checksum. The first frame is about the settings of the batch and the code that solves it,
each one after it about a block of rows as it was read. A frame that a killed writer left in part is not read.
"""

import glob
import hashlib
import os
import stat
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import IO, Any, NamedTuple
from zlib import crc32

import numpy as np
import orjson

import pontryagin
from pontryagin.io import files, rows
from pontryagin.io.rows import Rows

SIZE = hashlib.sha256().digest_size
"""Number of bytes of a checksum."""
LENGTH, SUM = 8, 4
"""Numbers of bytes in which the length of a frame's content and its own checksum are written."""


Answers = Mapping[str, Any]
"""The columns of answers, (n,) or (n, k) each."""


class Part(NamedTuple):
    """Some rows of a block, by their places in it, which grow.

    Attributes
    ----------
    places : list of int
    answers : mapping or None
        None if the rows have no answer.
    errors : mapping of int to str
        What is to be said of rows, by their index in `places`.
    status : int
        The exit code if these errors are the first and no row of the batch has an answer.
    """

    places: list[int]
    answers: Answers | None
    errors: Mapping[int, str]
    status: int


@dataclass(frozen=True)
class RowsDone:
    """The rows of a block done: their lines of text, and the errors of rows by their index."""

    header: list[str]
    lines: list[str]
    answered: int
    errors: list[tuple[int, str]] = field(default_factory=list)
    first: tuple[int, str, int] | None = None
    """The line of the first row with an error, the error, and the exit code if no row has an answer."""


def rows_done(block: Rows, parts: Sequence[Part], as_json: bool) -> RowsDone:
    """The rows of a block with their answers if they have some, and with their errors.

    Raises
    ------
    ValueError
        If an answer has the name of a column that was read.
    """
    rows.require_new(block.header, [rows.ERROR])
    written = [_written(block, part, as_json) for part in parts]
    header = max((columns for columns, _ in written), key=len)
    lines = [""] * len(block.rows)
    errors: dict[int, tuple[str, int]] = {}
    for part, (columns, texts) in zip(parts, written, strict=True):
        empty = "" if as_json else "," * (len(header) - len(columns))
        for place, text in zip(part.places, texts, strict=True):
            lines[place] = text + empty
        errors |= {part.places[i]: (error, part.status) for i, error in part.errors.items()}
    said = sorted((place, error) for place, (error, _) in errors.items())
    first = (block.lines[said[0][0]], *errors[said[0][0]]) if said else None
    answered = sum(len(part.places) for part in parts if part.answers is not None)
    return RowsDone(header, lines, answered, said, first)


def _written(block: Rows, part: Part, as_json: bool) -> tuple[list[str], list[str]]:
    """The names of all columns of a part, and its lines."""
    some = block.part(part.places)
    if as_json:
        return block.header, rows.as_json(some, part.answers or {}, part.errors)
    if part.answers is None:
        return block.header, rows.unanswered(some)
    columns, lines = rows.answered(some, part.answers)
    return [*block.header, *columns], lines


class Spool:
    """The blocks that are done, in a file.

    In CSV, a block may have more columns than those before it; its first ones are the same.

    Parameters
    ----------
    out : str
        The target. Where it is no file that can be replaced, blocks are kept for this process alone.
    settings : str
        All that the answers depend on beside the rows.
    as_json : bool
        Whether lines are objects of JSON.

    Attributes
    ----------
    rows, answered, errors : int
        Number of the rows done, of those with an answer, and of those with an error.
    earlier : int
        Number of the rows that were done by a process before this one.
    first : tuple or None
        `RowsDone.first` of the first row with an error.
    """

    def __init__(self, out: str, settings: str, as_json: bool) -> None:
        self._out, self._json = Path(out), as_json
        self._about = _checksum(f"{settings} {as_json} {_code()}".encode())
        self._header: list[str] = []
        self._done: list[int] = []
        self.rows = self.answered = self.errors = self.earlier = 0
        self.first: tuple[int, str, int] | None = None

    @cached_property
    def _file(self) -> IO[bytes]:
        """The file, at the end of its first frame."""
        if self._out == Path("-") or not files.replaceable(self._out):
            return tempfile.TemporaryFile()
        target = Path(os.path.realpath(self._out))
        target.parent.mkdir(parents=True, exist_ok=True)
        file = _opened(target.with_name(f".{target.name}.rows"))
        if file is None:
            return tempfile.TemporaryFile(dir=target.parent)
        if _next(file, self._about) is None:
            file.seek(0)
            file.truncate()
            try:
                _append(file, self._about, b"")
            except OSError:
                Path(file.name).unlink()
                raise
        return file

    @property
    def lasting(self) -> bool:
        """Whether the file outlives this process when it is killed."""
        return isinstance(self._file.name, str)

    def recall(self, block: Rows) -> bool:
        """Whether a process before this one has done this block, which is then counted.

        If it was another block, the file forgets this one and all after it.
        """
        if not self.lasting:
            return False
        start = self._file.tell()
        content = _next(self._file, _of(block))
        if content is None:
            self._file.seek(start)
            self._file.truncate()
            return False
        self._count(start, RowsDone(**orjson.loads(content)))
        self.earlier = self.rows
        return True

    def keep(self, block: Rows, done: RowsDone) -> None:
        """Put a block aside."""
        start = self._file.tell()
        _append(self._file, _of(block), orjson.dumps(vars(done)))
        self._count(start, done)

    def _count(self, start: int, done: RowsDone) -> None:
        self._done.append(start)
        self._header = max(self._header, done.header, key=len)
        self.rows += len(done.lines)
        self.errors += len(done.errors)
        self.answered += done.answered
        self.first = self.first or done.first

    def texts(self) -> Iterator[str]:
        """All rows as lines of JSON, or as CSV below a header, where narrower rows end with empty cells."""
        if not self._json:
            yield rows.header_line([*self._header, *([rows.ERROR] if self.errors else [])]) + "\n"
        for start in self._done:
            self._file.seek(start + SIZE)
            length = int.from_bytes(self._file.read(LENGTH))
            yield self._text(RowsDone(**orjson.loads(self._file.read(length))))

    def _text(self, done: RowsDone) -> str:
        if self._json:
            return "\n".join([*done.lines, ""])
        empty = "," * (len(self._header) - len(done.header) + bool(self.errors))
        cells = {i: rows.header_line([error]) for i, error in done.errors}
        ends = {i: f"{empty}{cell}\n" for i, cell in cells.items()}
        if not ends:
            return f"{empty}\n".join([*done.lines, ""])
        return "".join(line + ends.get(i, f"{empty}\n") for i, line in enumerate(done.lines))

    def remove(self) -> None:
        """Remove the file, when all is written or nothing is there."""
        if "_file" not in self.__dict__:
            return
        if self.lasting:
            Path(self._file.name).unlink(missing_ok=True)
            self._remove_drafts()
        self.close()

    def close(self) -> None:
        """Leave the file to the next process, or to the next batch of this one."""
        if "_file" in self.__dict__:
            with suppress(OSError):  # What could not be written before cannot be written now.
                self._file.close()

    def _remove_drafts(self) -> None:
        """Remove what processes that were killed at the end had written of the target."""
        target = Path(os.path.realpath(self._out))
        for draft in target.parent.glob(f".{glob.escape(target.stem)}.*.partial{glob.escape(target.suffix)}"):
            writer = draft.name.removeprefix(f".{target.stem}.").partition("-")[0]
            with suppress(PermissionError):
                try:
                    os.kill(int(writer), 0)
                except (ProcessLookupError, ValueError):
                    draft.unlink(missing_ok=True)


def _opened(path: Path) -> IO[bytes] | None:
    """The file of a batch, held by this process alone; None where that cannot be had."""
    try:
        import fcntl

        number = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
    except (ImportError, OSError):
        return None
    file = open(str(path), "r+b", opener=lambda *_: number)  # noqa: SIM115
    state = os.fstat(number)
    with suppress(OSError):
        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if stat.S_ISREG(state.st_mode) and state.st_uid == os.getuid():
            return file
    file.close()
    return None


def _append(file: IO[bytes], about: bytes, content: bytes) -> None:
    file.write(b"".join([about, len(content).to_bytes(LENGTH), content, _sum(content)]))
    file.flush()


def _next(file: IO[bytes], about: bytes) -> bytes | None:
    """The content of the next frame, if it is whole and about this."""
    head = file.read(SIZE + LENGTH)
    if len(head) < SIZE + LENGTH or head[:SIZE] != about:
        return None
    length = int.from_bytes(head[SIZE:])
    content = file.read(length)
    return content if file.read(SUM) == _sum(content) and len(content) == length else None


def _of(block: Rows) -> bytes:
    """The checksum of rows as they were read, and of the numbers of their lines."""
    parts = [block.header, *block.rows]
    text = "\0".join(map("\1".join, parts))
    return _checksum(f"{text}\0{block.lines[0]} {block.lines[-1]}".encode())


def _sum(content: bytes) -> bytes:
    return crc32(content).to_bytes(SUM)


def _checksum(content: bytes) -> bytes:
    return hashlib.sha256(content).digest()


def _code() -> str:
    """What tells the code that solves from every other: versions, and sizes and times of its files."""
    folder = Path(pontryagin.__file__).parent
    states = [f"{path} {path.stat().st_size} {path.stat().st_mtime_ns}" for path in folder.rglob("*.py")]
    return " ".join([pontryagin.__version__, np.__version__, sys.version, *sorted(states)])
