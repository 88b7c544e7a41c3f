"""The README lists every figure and table, what it names exists, and its example runs."""

import re

import pytest

from pontryagin.io.files import repository

README = (repository() / "README.md").read_text()
DRAWN = sorted(path for path in (repository() / "figures").rglob("*") if path.suffix in {".svg", ".csv"})


@pytest.mark.parametrize("path", DRAWN, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_every_figure_and_table_is_on_the_map(path):
    folder = re.escape(path.parent.name)
    if path.parent.parent.name == "benchmarks":
        folder = rf"benchmarks/{folder} \(`make bench`\)"
    if path.parent.parent.name == "studies":
        folder = rf"studies/{folder} \(`make study NAME={folder}`\)"
    assert re.search(rf"^\| {re.escape(path.stem)} \| {folder} \|", README, re.MULTILINE)


def test_every_maker_on_the_map_exists():
    makers = re.findall(r"`(\w+)` in `([\w/]+\.py)` \|$", README, re.MULTILINE)
    assert len(makers) > 20
    for function, module in makers:
        source = (repository() / "src" / "pontryagin" / module).read_text()
        assert re.search(rf"^ *def {function}\(", source, re.MULTILINE), (function, module)


def test_the_library_example_runs(capsys):
    block = re.search(r"```python\n(.*?)```", README, re.DOTALL)
    assert block is not None
    exec(compile(block[1].replace("1_000_000", "1_000"), "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "True" in printed


def test_linked_files_exist():
    for target in re.findall(r"\]\((?!http)([^)#]+)\)", README):
        assert (repository() / target).is_file(), target
