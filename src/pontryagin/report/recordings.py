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
from collections.abc import Sequence
from contextlib import redirect_stdout
from dataclasses import asdict, dataclass
from pathlib import Path

from pontryagin.io import files, sealed
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


def record(workspace: Workspace, module: str) -> list[tuple[Clip, bool]]:
    """Bring the recordings of a paper up to date, in one process for all that must be written.

    Parameters
    ----------
    workspace : Workspace
        Where the package and the recordings are.
    module : str
        The paper's playback module.

    Returns
    -------
    list of (Clip, bool)
        Each recording, and whether it was written anew.

    Raises
    ------
    RecordingFailure
        When a writer raises.
    """
    key = _key(workspace, module)
    place = workspace.cache / "recordings" / f"{module}.{key}.json"
    kept = sealed.read(place)
    if kept is None:
        clips = _written(workspace, module, key)
        sealed.write(place, json.dumps([asdict(clip) for clip in clips]))
        return [(clip, True) for clip in clips]
    clips = [Clip(**clip) for clip in json.loads(kept)]
    due = [clip.name for clip in clips if not _is_current(workspace, clip.name, key)]
    if due:
        _written(workspace, module, key, *due)
    return [(clip, clip.name in due) for clip in clips]


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


def _is_current(workspace: Workspace, name: str, key: str) -> bool:
    return sealed.is_stamped(_target(workspace, name), _stamp(workspace, name), key)


def _target(workspace: Workspace, name: str) -> Path:
    return workspace.recordings / f"{name}.rrd"


def _stamp(workspace: Workspace, name: str) -> Path:
    return workspace.cache / "recordings" / f"{name}.key"


def _written(workspace: Workspace, module: str, key: str, *names: str) -> list[Clip]:
    """Write the recordings of these names, or all of them; each is stamped when it is complete."""
    arguments = [module, str(workspace.recordings), *names]
    command = [sys.executable, "-m", "pontryagin.report.recordings", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, env=environment(workspace))
    clips = [Clip(**json.loads(line)) for line in done.stdout.splitlines()]
    for clip in clips:
        sealed.stamp(_target(workspace, clip.name), _stamp(workspace, clip.name), key)
    if done.returncode:
        error = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise RecordingFailure(f"recording {error}")
    return clips


def _main(arguments: Sequence[str]) -> None:
    """Write recordings into a folder and print each as JSON when it is complete; an error names it."""
    module, folder, *names = arguments
    writers = importlib.import_module(module).recordings()
    for clip in clips_of(module):
        if names and clip.name not in names:
            continue
        try:
            target = Path(folder) / f"{clip.name}.rrd"
            with redirect_stdout(sys.stderr), files.replacing(target) as draft:
                writers[clip.name](draft)
        except Exception as error:
            sys.exit(f"{clip.name} of {module}: {type(error).__name__}: {error}")
        print(json.dumps(asdict(clip)), flush=True)


if __name__ == "__main__":
    _main(sys.argv[1:])
