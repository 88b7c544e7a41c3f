"""The folders of generated files, and writing a file in one step."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def repository() -> Path:
    """Root of the checkout that this package is imported from.

    Returns
    -------
    Path
        The nearest folder above the package that holds ``pyproject.toml``.

    Raises
    ------
    ValueError
        When the package was installed without its checkout.

    Examples
    --------
    >>> (repository() / "pyproject.toml").is_file()
    True
    """
    for folder in Path(__file__).resolve().parents:
        if (folder / "pyproject.toml").is_file():
            return folder
    raise ValueError("this needs a clone of the repository, but pontryagin is installed without one")


def figures_folder() -> Path:
    """Folder of figures and tables: ``PONTRYAGIN_FIGURES`` if set, else ``figures/`` of the checkout."""
    chosen = os.environ.get("PONTRYAGIN_FIGURES")
    return Path(chosen).resolve() if chosen else repository() / "figures"


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Write to a temporary file beside `path` and move it to `path` in one step.

    Even if the writer is killed, a reader of `path` sees the old file or the new one, never a part.

    Parameters
    ----------
    path : Path
        File to create or replace; its folder is created.

    Yields
    ------
    Path
        The temporary file. When the block raises, it is removed and `path` stays as it was.

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
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.stem}.{os.getpid()}.partial{path.suffix}")
    try:
        yield draft
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


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
