"""The last pages: every figure and table with its maker, and what the report was made with."""

import os
import platform
import re
import subprocess
from collections.abc import Sequence
from importlib import metadata
from typing import Any

from pontryagin import __version__
from pontryagin.display.tables import markdown_table
from pontryagin.report.assemble import Item
from pontryagin.report.environment import EPOCH
from pontryagin.report.execute import Executed
from pontryagin.report.workspace import Workspace

PACKAGES = (
    "numpy",
    "scipy",
    "sympy",
    "numba",
    "matplotlib",
    "rerun-sdk",
    "pypandoc-binary",
    "typst",
)
_SEED = re.compile(r"(?:default_rng|RandomState|PCG64|Philox|seed)\s*[(=]\s*(?:seed\s*=\s*)?(\d[\d_]*)")


def index_of(items: Sequence[Item]) -> str:
    """Markdown of the list of figures and tables, each with the notebook that makes it."""
    if not items:
        return ""
    table = {
        "": [item.kind for item in items],
        "what it shows": [f"[{_plain(item.caption)}](#{item.anchor})" for item in items],
        "made by": [f"[{item.notebook}.ipynb](../../notebooks/{item.notebook}.ipynb)" for item in items],
        "file": [f"[{item.name}](../../{item.file})" for item in items],
    }
    return f"# Figures and tables {{#index}}\n\n{markdown_table(table)}"


def provenance(workspace: Workspace, executed: Sequence[Executed]) -> str:
    """Markdown of the provenance page."""
    made: dict[str, list[Any]] = {
        "what": ["pontryagin", "commit", "Python", "platform", "cores", "hash seed", "BLAS threads", "epoch"],
        "value": [
            __version__,
            commit(workspace),
            platform.python_version(),
            f"{platform.system()} {platform.machine()}",
            str(os.cpu_count()),
            "0",
            "1",
            EPOCH,
        ],
    }
    versions: dict[str, list[Any]] = {
        "package": list(PACKAGES),
        "version": [version(package) for package in PACKAGES],
    }
    notebooks: dict[str, list[Any]] = {
        "notebook": [f"{result.name}.ipynb" for result in executed],
        "code ran for, s": [round(result.seconds, 1) for result in executed],
        "seeds": [", ".join(seeds(result)) or "none" for result in executed],
    }
    tables: list[tuple[dict[str, list[Any]], str]] = [
        (made, "The build."),
        (versions, "Packages."),
        (notebooks, "Notebooks: run time and random seeds."),
    ]
    shown = "\n\n".join(f"{markdown_table(table)}\n\n: {caption}" for table, caption in tables)
    return f"# Provenance {{#provenance}}\n\n{shown}"


def commit(workspace: Workspace) -> str:
    """The commit that the checkout is at, told when files differ from it or nothing is known of it."""

    def git(*arguments: str) -> str:
        command = ["git", "-C", str(workspace.root), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    try:
        if os.path.realpath(git("rev-parse", "--show-toplevel")) != os.path.realpath(workspace.root):
            return "unknown (not a git checkout)"
        changed = git("status", "--porcelain", "--", "src", "notebooks", "requirements.lock")
        return git("rev-parse", "--short=12", "HEAD") + (", with local changes" if changed else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown (not a git checkout)"


def seeds(executed: Executed) -> list[str]:
    """Seeds written in a notebook's code."""
    code = (cell.source for cell in executed.notebook.cells if cell.cell_type == "code")
    return list(dict.fromkeys(seed for source in code for seed in _SEED.findall(source)))


def version(package: str) -> str:
    """The version of an installed package, or that it is absent."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "absent"


def _plain(caption: str) -> str:
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", caption)
