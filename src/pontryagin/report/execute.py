"""Notebooks to executed notebooks, figures and tables: the same bytes every time, and only when needed.

A notebook runs in a kernel of its own, in an environment that leaves nothing to chance. What it drew is kept
with its outputs under a key made of its code, the package files it depends on and the lock; text between
the cells is no part of the key. An entry of the cache appears in one step, so a killed run leaves none. What
the kernel has loaded at the end must be among the files of the key, or nothing is kept.
"""

import os
import shutil
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode

from pontryagin.io import files, sealed
from pontryagin.report import dependencies, syntax
from pontryagin.report.environment import FIXED_KEY, environment
from pontryagin.report.progress import note
from pontryagin.report.workspace import Workspace

CELL_TIMEOUT = 1200
KEPT_ENTRIES = 4

_LOADED = "import sys; print(*(name for name in sys.modules if name.partition('.')[0] == 'pontryagin'))"
"""What the kernel is asked at the end: which modules of the package it has loaded."""

Progress = Callable[[str, int, int], None]
"""Called with a notebook's name, cells done and cells in all."""


class CellFailure(RuntimeError):
    """A cell raised; the message names the notebook, the cell and the error."""


class UncountedImport(RuntimeError):
    """A notebook loads a module that is not in its key; the message names both."""


@dataclass(frozen=True)
class Executed:
    """An executed notebook: its present text, the outputs of its code, and how long the code took."""

    name: str
    notebook: NotebookNode
    folder: Path
    seconds: float
    fresh: bool


def attempt(workspace: Workspace, path: Path, progress: Progress = lambda *_: None) -> Executed | CellFailure:
    """Execute a notebook as `execute` does; the failure of a cell is returned."""
    try:
        return execute(workspace, path, progress)
    except CellFailure as failure:
        return failure


def execute(workspace: Workspace, path: Path, progress: Progress = lambda *_: None) -> Executed:
    """Execute a notebook, or take its outputs from the cache.

    Parameters
    ----------
    workspace : Workspace
        Where the package, the lock and the cache are.
    path : Path
        The notebook.
    progress : callable
        Told how many of its cells are done.

    Raises
    ------
    CellFailure
        When a cell raises or exceeds the time limit.
    UncountedImport
        When the cells load a module that `dependencies` does not see them import.
    """
    notebook = read_notebook(path)
    entry = workspace.cache / "notebooks" / path.stem / notebook_key(workspace, notebook)
    fresh = not sealed.whole_folder(entry)
    if fresh:
        if entry.exists():
            note(f"{path.stem}: its kept outputs are damaged, and are made anew")
            shutil.rmtree(entry)
        _run_into(entry, workspace, path, notebook, progress)
    kept = nbformat.read(entry / "executed.ipynb", as_version=4)
    seconds = float((entry / "seconds").read_text())
    return Executed(path.stem, _with_outputs(notebook, kept), entry / "figures", seconds, fresh)


def read_notebook(path: Path) -> NotebookNode:
    """The notebook without outputs, its cells named by their place."""
    notebook = nbformat.read(path, as_version=4)
    for place, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{place + 1}"
        if cell.cell_type == "code":
            cell["outputs"], cell["execution_count"] = [], None
    return notebook


def notebook_key(workspace: Workspace, notebook: NotebookNode) -> str:
    """Key of a notebook's outputs: its code, the package files behind it, the lock and the interpreter."""
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    files_read = sorted(files_of(workspace, notebook))
    return dependencies.digest(
        *code, *files_read, workspace.lock_text, sys.version, FIXED_KEY, root=workspace.root
    )


def files_of(workspace: Workspace, notebook: NotebookNode) -> set[Path]:
    """The files that a notebook's outputs depend on."""
    plain = plain_code(notebook)
    parts = dependencies.closure(dependencies.Source(workspace.source), plain)
    return parts | {path for path in places_named_in(plain, workspace.root) if path.is_file()}


def plain_code(notebook: NotebookNode) -> list[str]:
    """The notebook's cells of code as plain Python, without IPython's own syntax."""
    from IPython.core.inputtransformer2 import TransformerManager

    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    return [TransformerManager().transform_cell(source) for source in code]


def places_named_in(code: Iterable[str], root: Path) -> set[Path]:
    """The places below `root` that strings in code name, from the folder of the notebooks."""
    literals = {literal for text in code for literal in syntax.literals(text)}
    places = ((root / "notebooks" / literal).resolve() for literal in literals)
    inside = (place for place in places if place.is_relative_to(root.resolve()))
    return {root / place.relative_to(root.resolve()) for place in inside}


def publish(workspace: Workspace, executed: Iterable[Executed]) -> int:
    """Bring ``figures/`` and ``build/notebooks/`` up to date; returns how many files changed."""
    changed = 0
    for result in executed:
        target = workspace.figures / result.name
        drawn = {path.name: path for path in result.folder.glob("*")} if result.folder.is_dir() else {}
        for stale in set(target.glob("*")) - {target / name for name in drawn}:
            stale.unlink()
            changed += 1
        changed += sum(files.write(target / name, path.read_bytes()) for name, path in drawn.items())
        files.write(workspace.build / "notebooks" / f"{result.name}.ipynb", nbformat.writes(result.notebook))
    return changed


def _run_into(
    entry: Path, workspace: Workspace, path: Path, notebook: NotebookNode, progress: Progress
) -> None:
    draft = entry.with_name(f".{entry.name}.{os.getpid()}.partial")
    shutil.rmtree(draft, ignore_errors=True)
    (draft / "figures").mkdir(parents=True)
    started = time.perf_counter()
    loaded = _run(workspace, path, notebook, draft / "figures", progress)
    _check_counted(workspace, path, notebook, loaded)
    (draft / "seconds").write_text(f"{time.perf_counter() - started:.1f}")
    nbformat.write(notebook, draft / "executed.ipynb")
    sealed.close_folder(draft)
    draft.replace(entry)
    _forget_old_entries(entry.parent)


def _check_counted(workspace: Workspace, path: Path, notebook: NotebookNode, loaded: list[str]) -> None:
    source = dependencies.Source(workspace.source)
    missing = dependencies.uncounted(source, loaded, files_of(workspace, notebook))
    if missing:
        raise UncountedImport(
            f"notebooks/{path.name} loads {', '.join(missing)}, but no import that can be followed leads "
            "there: its outputs would be kept when that changes"
        )


def _run(
    workspace: Workspace, path: Path, notebook: NotebookNode, figures: Path, progress: Progress
) -> list[str]:
    """Execute the cells; returns the modules of the package that the kernel has loaded at the end."""
    from nbclient.client import NotebookClient
    from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

    total = len(notebook.cells)
    question = nbformat.v4.new_code_cell(_LOADED)
    notebook.cells.append(question)
    reached = [0]

    def done(cell_index: int, **_: Any) -> None:
        reached[0] = cell_index
        progress(path.stem, cell_index, total)

    client = NotebookClient(
        notebook,
        timeout=CELL_TIMEOUT,
        record_timing=False,
        resources={"metadata": {"path": str(path.parent)}},
        kernel_manager_class=_kernel_manager_class(),
        on_cell_start=lambda cell, cell_index: done(cell_index),
    )
    variables = {"PONTRYAGIN_NOTEBOOK": path.stem, "PONTRYAGIN_FIGURES": str(figures.parent / "drawn")}
    try:
        client.execute(env=environment(workspace, **variables))
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
        notebook.cells.pop()
        raise CellFailure(_describe(path, notebook, reached[0], error)) from None
    notebook.cells.pop()
    drawn = figures.parent / "drawn" / path.stem
    if drawn.is_dir():
        figures.rmdir()
        drawn.replace(figures)
    progress(path.stem, total, total)
    return "".join(output.text for output in question.outputs).split()


def _kernel_manager_class() -> type:
    from jupyter_client.kernelspec import KernelSpec
    from jupyter_client.manager import AsyncKernelManager

    class ThisInterpreter(AsyncKernelManager):
        """Starts the interpreter that runs the build, whatever kernels the user has installed."""

        @property
        def kernel_spec(self) -> KernelSpec:
            argv = [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "--log-level=40"]
            argv += ["-f", "{connection_file}"]
            return KernelSpec(argv=argv, display_name="Python 3", language="python")

    return ThisInterpreter


def _describe(path: Path, notebook: NotebookNode, index: int, error: Exception) -> str:
    cell = notebook.cells[index]
    raised = [out for out in cell.get("outputs", []) if out.output_type == "error"]
    what = f"{raised[0].ename}: {raised[0].evalue}" if raised else str(error).strip()
    source = "\n".join(f"    {line}" for line in cell.source.splitlines())
    return f"notebooks/{path.name}, cell {index + 1} of {len(notebook.cells)}: {what}\n{source}"


def _with_outputs(notebook: NotebookNode, kept: NotebookNode) -> NotebookNode:
    outputs = [cell for cell in kept.cells if cell.cell_type == "code"]
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    for cell, ran in zip(code, outputs, strict=True):
        cell["outputs"], cell["execution_count"] = ran.outputs, ran.execution_count
    notebook.metadata = kept.metadata
    return notebook


def _forget_old_entries(folder: Path) -> None:
    entries = sorted(
        (e for e in folder.iterdir() if not e.name.startswith(".")), key=lambda e: e.stat().st_mtime
    )
    for entry in entries[:-KEPT_ENTRIES]:
        shutil.rmtree(entry, ignore_errors=True)
