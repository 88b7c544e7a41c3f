"""Dear results, computed beside the notebooks that will need them; see `kept_results.kept`."""

import ast
import subprocess
import sys
from collections.abc import Mapping, Sequence

from pontryagin.io import files
from pontryagin.report import dependencies, execute, recordings
from pontryagin.report.environment import environment
from pontryagin.report.workspace import Workspace

FUNCTION = "ahead"
"""The function by which a module has its dear results computed."""
_SCRIPT = f"import sys, importlib as i; i.import_module(sys.argv[1]).{FUNCTION}(); print(*sys.modules)"
"""Calls it, and tells which modules were loaded."""


class AheadFailure(RuntimeError):
    """A result could not be computed, or not be kept; the message names the module and says why."""


def modules(workspace: Workspace, keys: Mapping[str, str]) -> list[str]:
    """The modules that have dear results computed ahead, and did not do so under their keys.

    Parameters
    ----------
    workspace : Workspace
        Where the package and the results are.
    keys : mapping
        Dotted name of each module that keeps results -> its key.
    """
    source = dependencies.Source(workspace.source)
    offering = [module for module in keys if _offers(source.modules[module].read_text(encoding="utf-8"))]
    return [module for module in offering if not _is_done(workspace, module, keys[module])]


def users(workspace: Workspace, dear: Sequence[str]) -> set[str]:
    """The notebooks and the papers' playback modules, by name, that may use results of some modules."""
    source = dependencies.Source(workspace.source)
    wanted = {source.modules[module] for module in dear}
    if not wanted:
        return set()
    files_read = {
        path.stem: execute.files_of(workspace, execute.read_notebook(path)) for path in workspace.notebooks
    }
    files_read |= {name: dependencies.reached(source, [name]) for name in recordings.modules(workspace)}
    return {name for name, known in files_read.items() if known & wanted}


def compute(workspace: Workspace, module: str, key: str) -> None:
    """Have a module's dear results computed in a process of their own.

    Raises
    ------
    AheadFailure
        When one cannot be computed, or when a module was loaded that is not in the key.
    """
    command = [sys.executable, "-c", _SCRIPT, module]
    done = subprocess.run(command, capture_output=True, text=True, env=environment(workspace))
    if done.returncode:
        error = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise AheadFailure(f"the results of {module}: {error}")
    source = dependencies.Source(workspace.source)
    if missing := dependencies.uncounted(source, done.stdout.split(), dependencies.reached(source, [module])):
        raise AheadFailure(
            f"{module} loads {', '.join(missing)}, but no import that can be followed leads there: its "
            "results would be kept when that changes"
        )
    files.write(workspace.results / module / FUNCTION, key)


def _is_done(workspace: Workspace, module: str, key: str) -> bool:
    note = workspace.results / module / FUNCTION
    return note.is_file() and note.read_text() == key


def _offers(text: str) -> bool:
    return any(isinstance(node, ast.FunctionDef) and node.name == FUNCTION for node in ast.parse(text).body)
