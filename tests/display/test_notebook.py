"""Displays of formulas and entries, and the notebooks as they are committed."""

import ast
import json
import re

import nbformat
import pytest
import sympy as sp
from matplotlib.patches import Rectangle

from pontryagin import ledger
from pontryagin.display import notebook
from pontryagin.io import files

NOTEBOOKS = sorted((files.repository() / "notebooks").glob("*.ipynb"))
LOGIC = (
    ast.For | ast.While | ast.If | ast.FunctionDef | ast.ClassDef | ast.Lambda | ast.comprehension | ast.Try
)


@pytest.fixture
def published(monkeypatch):
    kept = []
    monkeypatch.setattr(notebook, "_publish", kept.append)
    return kept


def test_equations_are_aligned_at_the_sign_of_equality(published):
    x = sp.Symbol("x")
    notebook.equations({"a": x**2, sp.Symbol("beta"): r"\tfrac12"})
    expected = r"$\displaystyle \begin{aligned} a &= x^{2} \\ \beta &= \tfrac12 \end{aligned}$"
    assert published == [{"text/latex": expected}]


def test_one_equation_needs_no_alignment(published):
    notebook.vanishing([sp.Symbol("x") - 1])
    assert published == [{"text/latex": r"$\displaystyle x - 1 = 0$"}]


def test_sides_must_pair():
    with pytest.raises(ValueError, match="zip"):
        notebook.equations(["a", "b"], [1])


def test_an_entry_is_checked_and_shown(published):
    notebook.entry("(2.3)", ledger.entries("Gorelov"))
    (shown,) = published
    (entry,) = [e for e in ledger.entries("Gorelov") if e.label == "(2.3)"]
    text = shown["text/markdown"]
    assert "*misprint*" in text
    assert f"$${entry.printed_latex}$$" in text and f"$${entry.derived_latex}$$" in text


def test_an_entry_whose_verdict_breaks_is_not_shown(published):
    from dataclasses import replace

    wrong = replace(ledger.entries("Gorelov", "misprint")[0], verdict="holds")
    with pytest.raises(ledger.Unsupported):
        notebook.entry(wrong.label, [wrong])
    assert published == []


def test_an_unknown_label_is_refused():
    with pytest.raises(ValueError, match=r"label: got '\(9.9\)'"):
        notebook.entry("(9.9)", ledger.entries("Gorelov"))


def test_a_label_of_two_papers_needs_the_paper(published):
    with pytest.raises(ValueError, match="Gorelov & Morozova 2012, Akulenko 1977"):
        notebook.entry("(2.3)", ledger.entries())
    assert published == []


@pytest.mark.slow
def test_verdicts_show_every_step(published):
    entries = ledger.entries(verdict="false")
    notebook.verdicts(entries)
    assert len(published) == len(entries)
    for shown, entry in zip(published, entries, strict=True):
        assert shown["text/markdown"].count("\n- ") == len(entry.proof())


def test_words_mean_themselves():
    assert notebook._text("λ~ and a_m*, but $a_m^*$") == r"λ\~ and a\_m\*, but $a_m^*$"


def test_every_entry_is_a_tile_and_counted():
    total = len(ledger.entries())
    tiles = [
        patch
        for patch in notebook.verdict_tiles(ledger.entries()).axes[0].patches
        if isinstance(patch, Rectangle)
    ]
    assert len(tiles) == total
    table = notebook.counts_table(ledger.entries())
    assert table["entries"][-1] == total == sum(table["entries"][:-1])
    assert sum(table[verdict][-1] for verdict in ledger.VERDICTS if verdict in table) == total


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
class TestCommitted:
    def test_it_is_valid_and_holds_no_output(self, path):
        content = nbformat.read(path, as_version=4)
        nbformat.validate(content)
        code = [cell for cell in content.cells if cell.cell_type == "code"]
        assert code and all(cell.outputs == [] and cell.execution_count is None for cell in code)
        assert [cell.id for cell in content.cells] == [f"cell-{n}" for n in range(1, len(content.cells) + 1)]

    def test_it_begins_with_a_title(self, path):
        first = nbformat.read(path, as_version=4).cells[0]
        assert first.cell_type == "markdown" and re.match(r"# \S", first.source)

    def test_its_cells_hold_no_logic(self, path):
        for cell in nbformat.read(path, as_version=4).cells:
            if cell.cell_type == "code":
                found = [
                    type(node).__name__
                    for node in ast.walk(ast.parse(cell.source))
                    if isinstance(node, LOGIC)
                ]
                assert found == [], cell.source

    def test_its_links_lead_to_notebooks(self, path):
        targets = re.findall(
            r"\]\(([\w.-]+\.ipynb)", json.dumps([c.source for c in nbformat.read(path, 4).cells])
        )
        assert all((path.parent / target).is_file() for target in targets)
