"""Whether anything changed since the last complete build: the contents of all that it read and wrote.

A file's hash is remembered with its size, times and inode, and taken from there while these stay: then a
build that finds nothing to do reads no file. A file that changed within `GRAIN` of the moment when it was
read is read again, since a later change may have left the same times.
"""

import hashlib
import json
import os
import platform
import sys
import time
from collections.abc import Iterable
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from pontryagin.io import files
from pontryagin.report import browser, execute, provenance, study_keys
from pontryagin.report.environment import FIXED_KEY
from pontryagin.report.workspace import Workspace

GRAIN = 2_000_000_000
"""Nanoseconds that the times of a file may lag behind the clock."""
ABSENT = "absent"

State = dict[str, Any]


def is_current(workspace: Workspace, stage: str) -> bool:
    """Whether the last build up to `stage` was complete, and all that it read and wrote is as it was."""
    last = _read(_place(workspace, stage))
    if not last:
        return False
    candidates = [workspace.root / name for name in last["named"]]
    return bool(last["read"] == inputs(workspace, candidates) and last["wrote"] == _outputs(workspace))


def forget(workspace: Workspace) -> None:
    """Forget the last complete builds: what they wrote is about to change."""
    for place in workspace.cache.glob(_place(workspace, "*").name):
        place.unlink()


def remember(workspace: Workspace, stage: str, read: State, candidates: Iterable[Path]) -> None:
    """Note that a build up to `stage` is complete.

    Parameters
    ----------
    workspace : Workspace
        What was built.
    stage : str
        How far.
    read : dict
        `inputs` as they were before the build began: a change since then calls for another build.
    candidates : iterable of Path
        What was handed to `inputs`.
    """
    named = sorted(str(path.relative_to(workspace.root)) for path in candidates)
    state = {"named": named, "read": read, "wrote": _outputs(workspace)}
    files.write(_place(workspace, stage), json.dumps(state))


def inputs(workspace: Workspace, candidates: Iterable[Path]) -> State:
    """The contents of all that a build reads, and the environment that the report states.

    Parameters
    ----------
    workspace : Workspace
        The checkout.
    candidates : iterable of Path
        Files that the notebooks name, whether they exist or not.
    """
    measured = [workspace.figures / name for name in ("benchmarks", "studies")]
    beside = [workspace.root / name for name in ("notebooks", *study_keys.BESIDE)]
    folders = [workspace.source, *beside, *measured]
    found = [path for folder in folders for path in folder.rglob("*") if "__pycache__" not in path.parts]
    contents = _hashes(workspace, [*found, workspace.root / "requirements.lock", *candidates])
    return contents | {"environment": _environment(workspace)}


def named_by_notebooks(workspace: Workspace) -> list[Path]:
    """All places below the root that strings in the notebooks' code may name."""
    found: set[Path] = set()
    for path in workspace.notebooks:
        found |= execute.places_named_in(execute.plain_code(execute.read_notebook(path)), workspace.root)
    return sorted(found)


def _outputs(workspace: Workspace) -> State:
    folders = [workspace.figures, workspace.build / "notebooks", workspace.recordings, workspace.report]
    return _hashes(workspace, [path for folder in folders for path in folder.rglob("*")])


def _environment(workspace: Workspace) -> list[str]:
    packages = [f"{package} {provenance.version(package)}" for package in provenance.PACKAGES]
    tools = [str(find_spec(name) is not None) for name in ("rerun", "typst")]
    machine = [sys.version, platform.platform(), str(os.cpu_count()), str(browser.find()), FIXED_KEY]
    return [provenance.commit(workspace), *packages, *tools, *machine]


def _hashes(workspace: Workspace, paths: Iterable[Path]) -> dict[str, str]:
    place = workspace.cache / "hashes.json"
    known = _read(place)
    now: dict[str, list[Any]] = {}
    for path in paths:
        name = str(path.relative_to(workspace.root))
        if path.is_file():
            now[name] = _hashed(path, known.get(name))
        elif not path.exists():
            now[name] = [ABSENT]
    if any(entry != known.get(name) for name, entry in now.items()):
        files.write(place, json.dumps(known | now))
    return {name: str(entry[0]) for name, entry in now.items()}


def _hashed(path: Path, known: list[Any] | None) -> list[Any]:
    """The hash of a file, what it was read at, and when: as known, where that cannot have changed."""
    clock, seen = time.time_ns(), path.stat()
    marks = [seen.st_size, seen.st_mtime_ns, seen.st_ctime_ns, seen.st_ino]
    if known and known[1:5] == marks and max(seen.st_mtime_ns, seen.st_ctime_ns) + GRAIN < known[5]:
        return known
    return [hashlib.sha256(path.read_bytes()).hexdigest()[:24], *marks, clock]


def _place(workspace: Workspace, stage: str) -> Path:
    return workspace.cache / f"complete-{stage}.json"


def _read(place: Path) -> dict[str, Any]:
    with suppress(OSError, ValueError):
        known: dict[str, Any] = json.loads(place.read_text(encoding="utf-8"))
        return known
    return {}
