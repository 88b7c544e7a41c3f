"""A fifth paper is a line in ``papers.py`` and a folder: a toy is added to a copy of the package."""

import json
import shutil
import subprocess
import sys

import nbformat
import pytest

from pontryagin.io import files

pytestmark = pytest.mark.slow

ROOT = files.repository()
LINE = '    Paper("Toy 2026", "toy", "On squares", "A. Toy, 2026", "5", "Squares (Toy 2026)"),\n'
PAPER = {
    "__init__.py": '"""Squares."""\n\nfrom pontryagin.toy.side import side\n\n__all__ = ["side"]\n',
    "derivation.py": '''"""The area of a square, (1)."""

import sympy as sp

a = sp.Symbol("a", positive=True)


def area() -> sp.Expr:
    """The integral of a over the side, (1)."""
    return sp.integrate(a, (sp.Symbol("x"), 0, a))
''',
    "side.py": '''"""The side of a square of given area, from (1)."""


def side(area: float) -> float:
    """The positive solution of (1)."""
    return area**0.5
''',
    "claims/__init__.py": '''"""The ledger of Toy 2026."""

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality
from pontryagin.toy import derivation

claim = Page("Toy 2026")


@claim("(1)", "area of a square", verdict="holds")
def area():
    return Equality({"A": derivation.a**2}, lambda: {"A": derivation.area()})


ENTRIES = tuple(claim)
''',
    "command.py": '''"""``pontryagin solve toy``."""

from typing import Annotated

import typer


def solve(area: Annotated[float, typer.Option(help="Area of the square.")]) -> None:
    """The side of a square.

    \\b
    Examples:
      pontryagin solve toy --area 9
    """
    from pontryagin.toy import side

    typer.echo(f"side {side(area):g}")
''',
}
SHOW = """
import json, sys
from pathlib import Path
from typer.testing import CliRunner
from benchmarks.papers import PAPERS
from pontryagin import ledger
from pontryagin.cli import app
from pontryagin.report import assemble, execute, front
from pontryagin.report.workspace import Workspace

def run(*arguments):
    result = CliRunner().invoke(app, arguments, catch_exceptions=False)
    assert result.exit_code == 0, result.stderr
    return result.stdout

ledger.entries("toy")[0].check()
workspace = Workspace(Path(sys.argv[1]))
chapters = [execute.execute(workspace, path) for path in workspace.notebooks]
print(json.dumps({
    "ledger": run("ledger", "--paper", "toy"),
    "help": run("solve", "--help"),
    "command": run("solve", "toy", "--area", "9"),
    "chapters": [assemble.chapter(workspace, chapter) for chapter in chapters],
    "front": front.front_page([entry.as_dict() for entry in ledger.entries("toy")]),
    "benchmarks": PAPERS,
}))
"""


@pytest.fixture(scope="module")
def seen(tmp_path_factory):
    """What the ledger, the command line, the report and the benchmarks of the copy say about the toy."""
    root = tmp_path_factory.mktemp("copy")
    package = root / "src" / "pontryagin"
    shutil.copytree(ROOT / "src" / "pontryagin", package, ignore=shutil.ignore_patterns("__pycache__"))
    papers = (package / "papers.py").read_text()
    head, tail = papers.split('\n)\n"""All papers')
    (package / "papers.py").write_text(f'{head}\n{LINE})\n"""All papers{tail}')
    for name, text in PAPER.items():
        files.write(package / "toy" / name, text)
    cells = [
        nbformat.v4.new_markdown_cell("# Squares"),
        nbformat.v4.new_code_cell("from pontryagin.toy import side\nside(9.0)"),
    ]
    (root / "notebooks").mkdir()
    nbformat.write(nbformat.v4.new_notebook(cells=cells), root / "notebooks" / "50-toy.ipynb")
    done = subprocess.run(
        [sys.executable, "-c", SHOW, str(root)],
        capture_output=True,
        text=True,
        env={"PYTHONPATH": f"{root / 'src'}:{ROOT}", "PYTHONHASHSEED": "0", "HOME": str(root)},
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_it_is_in_the_ledger(seen):
    assert "1 entries: 1 holds" in seen["ledger"]
    assert "Toy 2026" in seen["ledger"] and "area of a square" in seen["ledger"]


def test_it_is_a_command_behind_those_of_the_earlier_chapters(seen):
    assert seen["command"] == "side 3\n"
    assert seen["help"].index("rendezvous") < seen["help"].index("toy ")


def test_it_is_a_chapter_of_the_report_and_on_its_front_page(seen):
    (chapter,) = seen["chapters"]
    assert "# Squares {#nb-50-toy}" in chapter and "3.0" in chapter
    assert "A. Toy, 2026: *On squares*. In the code: `pontryagin.toy`." in seen["front"]


def test_it_is_measured_last(seen):
    assert list(seen["benchmarks"].items())[-1] == ("toy", "Squares (Toy 2026)")
