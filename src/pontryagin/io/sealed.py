"""Files that are kept for later processes, with checksums: a damaged one is not taken for what was kept.

A writer that is killed leaves no part of a file (`files.replacing`), but a disk may lose what it was given,
and a hand or another program may change it.
"""

import hashlib
from pathlib import Path

from pontryagin.io import files

LENGTH = hashlib.sha256().digest_size
"""Number of bytes of the checksum at the end of a sealed file."""
SUM = "sum"
"""The file in a sealed folder that holds its checksum."""


def write(path: Path, content: str | bytes) -> None:
    """Keep a content in a file that ends with its checksum.

    Examples
    --------
    >>> import tempfile
    >>> kept = Path(tempfile.mkdtemp()) / "answer"
    >>> write(kept, "32")
    >>> read(kept), read(kept.with_name("question"))
    (b'32', None)
    >>> _ = kept.write_bytes(kept.read_bytes()[1:])
    >>> read(kept) is None
    True
    """
    data = content.encode() if isinstance(content, str) else content
    files.write(path, data + hashlib.sha256(data).digest())


def read(path: Path) -> bytes | None:
    """The content that was kept in a file; None if there is none, or it was damaged."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    content = data[:-LENGTH]
    return content if hashlib.sha256(content).digest() == data[-LENGTH:] else None


def close_folder(folder: Path) -> None:
    """Write into a folder the checksum of all files below it.

    Examples
    --------
    >>> import tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> _ = (folder / "answer").write_text("32")
    >>> close_folder(folder)
    >>> whole_folder(folder)
    True
    >>> _ = (folder / "answer").write_text("33")
    >>> whole_folder(folder)
    False
    """
    (folder / SUM).write_text(_of_folder(folder))


def whole_folder(folder: Path) -> bool:
    """Whether the files below a folder are those that `close_folder` found."""
    place = folder / SUM
    return place.is_file() and place.read_bytes() == _of_folder(folder).encode()


def _of_folder(folder: Path) -> str:
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path != folder / SUM)
    whole = hashlib.sha256()
    for path in paths:
        whole.update(f"{path.relative_to(folder)}\0{_of(path)}\0".encode())
    return whole.hexdigest()


def stamp(target: Path, place: Path, key: str) -> None:
    """Note, in a file of its own, under which key a target was made, and its checksum.

    Examples
    --------
    >>> import tempfile
    >>> target, place = (Path(tempfile.mkdtemp()) / name for name in ("page", "stamp"))
    >>> _ = target.write_text("32")
    >>> stamp(target, place, "first")
    >>> is_stamped(target, place, "first"), is_stamped(target, place, "second")
    (True, False)
    >>> _ = target.write_text("33")
    >>> is_stamped(target, place, "first")
    False
    """
    files.write(place, f"{key} {_of(target)}")


def is_stamped(target: Path, place: Path, key: str) -> bool:
    """Whether a target was made under this key, and is as it was then."""
    known = place.is_file() and target.is_file()
    return known and place.read_bytes() == f"{key} {_of(target)}".encode()


def _of(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
