"""Dear results, computed beside the notebooks that will need them; see `kept_results.kept`."""

import ast
import importlib
import subprocess
import sys
from collections.abc import Mapping

from pontryagin.io import files
from pontryagin.report import dependencies
from pontryagin.report.environment import environment
from pontryagin.report.workspace import Workspace

FUNCTION = "ahead"
"""The function by which a module has its dear results computed."""


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


def compute(workspace: Workspace, module: str, key: str) -> None:
    """Have a module's dear results computed in a process of their own.

    Raises
    ------
    AheadFailure
        When one cannot be computed, or when a module was loaded that is not in the key.
    """
    command = [sys.executable, "-m", "pontryagin.report.ahead", module]
    done = subprocess.run(command, capture_output=True, text=True, env=environment(workspace))
    if done.returncode:
        error = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise AheadFailure(f"the results of {module}: {error}")
    source = dependencies.Source(workspace.source)
    loaded = [name for name in done.stdout.split() if not name.startswith(__package__)]
    if missing := dependencies.uncounted(source, loaded, dependencies.reached(source, [module])):
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


if __name__ == "__main__":
    getattr(importlib.import_module(sys.argv[1]), FUNCTION)()
    print(*sys.modules)
