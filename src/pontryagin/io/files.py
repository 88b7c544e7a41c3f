"""The folders of generated files, and writing a file in one step."""

import errno
import os
import shutil
import stat
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from pathlib import Path
from typing import IO, TextIO

LINKS = 40
"""Largest number of links that are followed, one after the other, as systems do."""


def repository() -> Path:
    """Root of the checkout that this package is imported from.

    Returns
    -------
    Path
        The folder that holds ``src/pontryagin`` and ``pyproject.toml``.

    Raises
    ------
    ValueError
        When the package was installed without its checkout.

    Examples
    --------
    >>> (repository() / "pyproject.toml").is_file()
    True
    """
    *_, source, root = Path(__file__).resolve().parents[:4]
    if source.name == "src" and (root / "pyproject.toml").is_file():
        return root
    raise ValueError("this needs a clone of the repository, but pontryagin is installed without one")


def figures_folder() -> Path:
    """Folder of figures and tables: ``PONTRYAGIN_FIGURES`` if set, else ``figures/`` of the checkout."""
    chosen = os.environ.get("PONTRYAGIN_FIGURES")
    return Path(chosen).resolve() if chosen else repository() / "figures"


STANDARD_INPUT = Path("-")
"""The name that stands for standard input where a file is read."""


@contextmanager
def reading(path: Path) -> Iterator[TextIO]:
    """A file of UTF-8 text with its ends of lines as they are, or standard input if its name is ``-``.

    Examples
    --------
    >>> import tempfile
    >>> source = Path(tempfile.mkdtemp()) / "table.csv"
    >>> _ = source.write_bytes(b"a,b\\r\\n")
    >>> with reading(source) as file:
    ...     file.read()
    'a,b\\r\\n'
    """
    if path != STANDARD_INPUT:
        with path.open(newline="", encoding="utf-8-sig") as file:
            yield file
        return
    text = TextIOWrapper(sys.stdin.buffer, newline="", encoding="utf-8-sig")
    try:
        yield text
    finally:
        text.detach()


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Write to a temporary file beside `path` and move it to `path` in one step.

    Even if the writer is killed, a reader of `path` sees the old file or the new one, never a part. A link is
    followed, and a file that is replaced leaves its permissions to the new one. What is no file (a pipe, a
    device, an open descriptor like ``/dev/stdout``) stays what it is: the text is written to it at the end.

    Parameters
    ----------
    path : Path
        File to create or replace; its folder is created.

    Yields
    ------
    Path
        The temporary file. When the block raises, it is removed and `path` stays as it was.

    Raises
    ------
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "answer.txt"
    >>> with replacing(target) as draft:
    ...     _ = draft.write_text("32")
    >>> target.read_text()
    '32'
    """
    path = Path(path)
    try:
        with _replacing(path) as draft:
            yield draft
    except OSError as reason:
        if reason.filename is None:
            reason.filename = str(path)
        raise


@contextmanager
def _replacing(path: Path) -> Iterator[Path]:
    if not replaceable(path):
        with tempfile.TemporaryDirectory(prefix="pontryagin-") as folder:
            draft = Path(folder) / path.name
            yield draft
            with draft.open("rb") as file, _node(path) as node:
                shutil.copyfileobj(file, node)
        return
    target = Path(os.path.realpath(path))
    target.parent.mkdir(parents=True, exist_ok=True)
    writer = f"{os.getpid()}-{threading.get_ident()}"
    draft = target.with_name(f".{target.stem}.{writer}.partial{target.suffix}")
    try:
        yield draft
        with suppress(FileNotFoundError):
            draft.chmod(stat.S_IMODE(target.stat().st_mode))
        draft.replace(target)
    finally:
        draft.unlink(missing_ok=True)


def replaceable(path: Path) -> bool:
    """Whether a file is at this path, or may be made there, that another one can take the place of.

    Raises
    ------
    OSError
        If there is a folder, or a link that leads in a circle.

    Examples
    --------
    >>> replaceable(Path("/dev/null")), replaceable(Path("/dev/stdout"))
    (False, False)
    """
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return True
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    return stat.S_ISREG(mode) and _descriptor(path) is None


def _node(path: Path) -> IO[bytes]:
    """What is no file, opened to be written."""
    descriptor = _descriptor(path)
    if descriptor is None:
        return path.open("wb")
    sys.stdout.flush()
    return os.fdopen(os.dup(descriptor), "wb")


def _descriptor(path: Path) -> int | None:
    """The number of the open descriptor of this process that a path leads to, if it leads to one."""
    folders = {"/dev/fd", "/proc/self/fd", f"/proc/{os.getpid()}/fd"}
    for _ in range(LINKS):
        folder = str(path.parent)
        if path.name.isdecimal() and {folder, os.path.realpath(folder)} & folders:
            return int(path.name)
        if not path.is_symlink():
            return None
        path = path.parent / path.readlink()
    return None


def write(path: Path, content: str | bytes) -> bool:
    """Write `content` in one step; leave a file that already holds it untouched.

    Returns
    -------
    bool
        Whether the file changed.
    """
    data = content.encode() if isinstance(content, str) else content
    path = Path(path)
    if path.is_file() and path.read_bytes() == data:
        return False
    with replacing(path) as draft:
        draft.write_bytes(data)
    return True


def remove_drafts(folder: Path) -> None:
    """Remove the temporary files that killed writers left behind below `folder`."""
    for draft in Path(folder).rglob(".*.partial*"):
        if draft.is_dir():
            shutil.rmtree(draft, ignore_errors=True)
        else:
            draft.unlink(missing_ok=True)
