"""The table of verdicts is the only place that lists them: a row added to it is seen everywhere."""

import re
import shutil
import subprocess
import sys

import pytest

from pontryagin import ledger
from pontryagin.display import notebook, plotting
from pontryagin.io import files
from pontryagin.ledger import decimals, evidence, verdict
from pontryagin.report import front

ROOT = files.repository()
ROW = '    Kind("supported", "instances speak for it", "blue", "INK", 0.5, ("Instances",)),\n'
SHOW = """
import io
from rich.console import Console
from typer.testing import CliRunner
from pontryagin import ledger
from pontryagin.cli import app
from pontryagin.display.notebook import TILES
from pontryagin.report.front import VERDICTS

claim = ledger.Page("A paper")
claim("(1)", "something", verdict="supported", remark="why")(lambda: None)
help = " ".join(CliRunner().invoke(app, ["ledger", "--help"]).stdout.split())
refusal = CliRunner().invoke(app, ["ledger", "--verdict", "wrong"]).stderr
shown = io.StringIO()
Console(file=shown, width=200).print(ledger.table(claim))
print("supported" in help, "'supported'" in refusal, TILES["supported"], ledger.COLOURS["supported"])
print(ledger.counts(claim)["supported"], VERDICTS["supported"], "1 supported" in shown.getvalue())
"""


@pytest.mark.slow
def test_a_seventh_verdict_is_one_row(tmp_path):
    shutil.copytree(ROOT / "src", tmp_path / "src", ignore=shutil.ignore_patterns("__pycache__"))
    table = tmp_path / "src" / "pontryagin" / "ledger" / "verdict.py"
    text = table.read_text()
    table.write_text(text.replace("TABLE = (\n", f"TABLE = (\n{ROW}"))
    done = subprocess.run(
        [sys.executable, "-c", SHOW],
        capture_output=True,
        text=True,
        env={"PYTHONPATH": str(tmp_path / "src")},
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == (
        f"True True {{'color': '{plotting.INK}', 'alpha': 0.5}} blue\n1 instances speak for it True\n"
    )


def test_every_kind_of_evidence_earns_one_verdict():
    kinds = [
        name
        for module in (evidence, decimals)
        for name, item in vars(module).items()
        if isinstance(item, type) and issubclass(item, evidence.Evidence) and item is not evidence.Evidence
    ]
    admitted = [name for row in verdict.TABLE for name in row.evidence]
    assert sorted(admitted) == sorted(set(kinds))


def test_tiles_are_told_apart():
    looks = [tuple(tile.items()) for tile in notebook.TILES.values()]
    assert len(set(looks)) == len(verdict.TABLE)


def test_the_readme_lists_the_table():
    section = re.search(r"## How to read the ledger\n(.*?)\n## ", (ROOT / "README.md").read_text(), re.DOTALL)
    assert section is not None
    block = re.search(r"^- .*?\n(?=\n)", section[1], re.DOTALL | re.MULTILINE)
    assert block is not None
    items = (" ".join(item.split()) for item in re.split(r"^- ", block[0], flags=re.MULTILINE)[1:])
    expected = [f"**{row.name}**: {row.meaning}." for row in verdict.TABLE]
    assert list(items) == expected


def test_the_report_means_the_same_and_colours_no_other_verdict():
    assert {row.name: row.meaning for row in verdict.TABLE} == front.VERDICTS
    assets = ROOT / "src" / "pontryagin" / "report" / "assets"
    style = (assets / "report.css").read_text()
    named = set(re.findall(r"^\.verdict\.([\w-]+)", style, re.MULTILINE))
    printed = re.search(r"#let verdicts = \((.*)\)", (assets / "report.typ").read_text())
    assert printed is not None
    typeset = dict(re.findall(r'"?([\w-]+)"?: rgb\("(#\w+)"\)', printed[1]))
    assert named == set(typeset) <= {name.replace(" ", "-") for name in ledger.VERDICTS}
    variables = dict(re.findall(r"--(\w+): (#\w+);", style))
    for name, colour in re.findall(r"^\.verdict\.([\w-]+) \{ color: (.+?); \}", style, re.MULTILINE):
        value = re.sub(r"var\(--(\w+)\)", lambda found: variables[found[1]], colour)
        assert value == typeset[name], name


def test_an_unknown_verdict_is_refused_where_it_is_written():
    with pytest.raises(ValueError, match="verdict: got 'true', takes one of 'holds'") as refused:
        ledger.Page("A paper")("(1)", "something", verdict="true")(lambda: None)
    assert refused.value.argument == "verdict"
