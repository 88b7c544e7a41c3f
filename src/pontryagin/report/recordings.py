"""The papers' recordings: which there are, and their files, written again only when their makers change.

A paper that plays back has a module ``playback`` with ``recordings() -> dict[str, Callable[[Path], None]]``:
for each name a function that writes the file. The first line of its docstring is the recording's title,
the paragraph after it the description.
"""

import importlib
import inspect
import json
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from pontryagin.io import files
from pontryagin.papers import packages
from pontryagin.report import dependencies
from pontryagin.report.environment import environment
from pontryagin.report.workspace import Workspace


class RecordingFailure(RuntimeError):
    """A recording could not be written; the message names it and the error."""


@dataclass(frozen=True)
class Clip:
    """A recording: its paper's package, its name, its title and what it shows."""

    package: str
    name: str
    title: str
    description: str


def modules(workspace: Workspace) -> list[str]:
    """The papers' playback modules, those that exist."""
    source = dependencies.Source(workspace.source)
    names = [f"{source.folder.name}.{package}.playback" for package in packages()]
    return [name for name in names if name in source.modules]


def record_all(workspace: Workspace, workers: int, done: Callable[[Clip, bool], None]) -> list[Clip]:
    """Bring ``build/recordings`` up to date.

    Parameters
    ----------
    workspace : Workspace
        Where the package and the recordings are.
    workers : int
        How many are written at a time.
    done : callable
        Told of each recording, and whether it was written anew.

    Raises
    ------
    RecordingFailure
        When a writer raises.
    """
    clips: list[Clip] = []
    for module in modules(workspace):
        key = _key(workspace, module)
        clips += (listed := _listed(workspace, module, key))
        with ThreadPoolExecutor(max_workers=workers) as pool:
            written = pool.map(lambda clip, m=module, k=key: _write(workspace, m, clip.name, k), listed)
            for clip, fresh in zip(listed, written, strict=True):
                done(clip, fresh)
    return clips


def clips_of(module: str) -> list[Clip]:
    """The recordings that an imported playback module offers, titled by their writers' docstrings."""
    package = module.split(".")[-2]
    clips = []
    for name, writer in importlib.import_module(module).recordings().items():
        title, _, description = (inspect.getdoc(writer) or name.replace("-", " ").capitalize()).partition(
            "\n"
        )
        paragraph = description.strip().split("\n\n")[0]
        clips.append(Clip(package, name, title.strip().rstrip("."), " ".join(paragraph.split())))
    return clips


def _key(workspace: Workspace, module: str) -> str:
    source = dependencies.Source(workspace.source)
    parts = sorted(dependencies.closure(source, [f"import {module}"]))
    return dependencies.digest(*parts, workspace.lock_text, sys.version, root=workspace.root)


def _listed(workspace: Workspace, module: str, key: str) -> list[Clip]:
    kept = workspace.cache / "recordings" / f"{module}.{key}.json"
    if not kept.is_file():
        files.write(kept, _call(workspace, module, "list"))
    return [Clip(**clip) for clip in json.loads(kept.read_text(encoding="utf-8"))]


def _write(workspace: Workspace, module: str, name: str, key: str) -> bool:
    target = workspace.recordings / f"{name}.rrd"
    stamp = workspace.cache / "recordings" / f"{name}.key"
    if target.is_file() and stamp.is_file() and stamp.read_text() == key:
        return False
    _call(workspace, module, "write", name, str(target))
    files.write(stamp, key)
    return True


def _call(workspace: Workspace, module: str, *arguments: str) -> str:
    command = [sys.executable, "-m", "pontryagin.report.recordings", module, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, env=environment(workspace))
    if done.returncode:
        error = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise RecordingFailure(f"recording {' '.join(arguments[1:2]) or 'list'} of {module}: {error}")
    return done.stdout


def _main(arguments: Sequence[str]) -> None:
    module, action, *rest = arguments
    if action == "list":
        print(json.dumps([asdict(clip) for clip in clips_of(module)]))
    else:
        name, path = rest
        with files.replacing(Path(path)) as draft:
            importlib.import_module(module).recordings()[name](draft)


if __name__ == "__main__":
    _main(sys.argv[1:])
