"""Small checkouts to build reports from."""

import shutil
import textwrap

import nbformat
import pytest

from pontryagin.io import files
from pontryagin.papers import PAPERS
from pontryagin.report.workspace import Workspace


class Checkout:
    """A checkout in a temporary folder, written cell by cell and module by module."""

    def __init__(self, root):
        self.root = root
        self.workspace = Workspace(root)
        (root / "notebooks").mkdir(parents=True)
        (root / "requirements.lock").write_text("numpy==2\n")

    def module(self, place, text=""):
        path = self.root / "src" / "pontryagin" / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
        return path

    def modules(self, texts):
        """Write modules, each text under its place."""
        for place, text in texts.items():
            self.module(place, text)

    def package(self):
        """Copy the package without its papers."""
        without = shutil.ignore_patterns("__pycache__", *(paper.package for paper in PAPERS))
        shutil.copytree(files.repository() / "src" / "pontryagin", self.workspace.source, ignore=without)

    def notebook(self, name, *cells):
        """Write a notebook; a cell that begins with '#' and a space is text, every other is code."""
        made = [
            nbformat.v4.new_markdown_cell(textwrap.dedent(cell))
            if cell.startswith("# ")
            else nbformat.v4.new_code_cell(textwrap.dedent(cell).strip())
            for cell in cells
        ]
        path = self.root / "notebooks" / f"{name}.ipynb"
        nbformat.write(nbformat.v4.new_notebook(cells=made), path)
        return path


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path / "checkout")


@pytest.fixture
def another_checkout(tmp_path):
    return Checkout(tmp_path / "another")


ENTRIES = [
    {
        "paper": "Gorelov & Morozova 2012",
        "label": "(2.3)",
        "statement": "the programme of least energy, a*b_c < |u| and ~x",
        "verdict": "misprint",
        "remark": "Printed: $|c_1|$. Right: $\\|c\\|_2$.",
    },
    {
        "paper": "Gorelov & Morozova 2012",
        "label": "(2.4)",
        "statement": "its norm",
        "verdict": "holds",
        "remark": "",
    },
]


@pytest.fixture(scope="session")
def entries():
    return [dict(entry) for entry in ENTRIES]


@pytest.fixture(scope="session")
def new_checkout():
    return Checkout
