"""The studies' chapter shows the committed tables, and which rows are of sources that have changed."""

import pytest

from pontryagin.io import files
from pontryagin.report.studies import chapter
from pontryagin.report.study_keys import Checkout, key

TABLE = """# title: Soak
# note: Problems and failures.
# seed: 1
# version: 0.9
part,problems,worst gap,peers not installed,depends on,key
energy,1000,4e-16,,studies.soak.energy,{energy}
peak,2000,5e-16,,studies.soak.peak,{peak}
"""


@pytest.fixture
def studied(checkout):
    checkout.modules({"__init__.py": "", "energy.py": "", "peak.py": ""})
    for name in ("energy", "peak"):
        files.write(checkout.root / "studies" / "soak" / f"{name}.py", f"from pontryagin import {name}\n")
    source = Checkout(checkout.workspace.source)
    keys = {name: key(source, [f"studies.soak.{name}"]) for name in ("energy", "peak")}
    folder = checkout.workspace.figures / "studies" / "soak"
    files.write(folder / "table.csv", TABLE.format(**keys))
    files.write(folder / "seconds.csv", "# Python: 3.12\npart,seconds\nenergy,10.4\npeak,20\n")
    return checkout


def rows(checkout):
    lines = chapter(checkout.workspace).splitlines()
    return [line.strip("| ").split(" | ") for line in lines if line.startswith(("| energy", "| peak"))]


def test_there_is_no_chapter_before_the_first_study(checkout):
    assert chapter(checkout.workspace) == ""


def test_the_table_is_shown_with_its_seconds_and_without_its_keys(studied):
    text = chapter(studied.workspace)
    assert "## Soak {#study-soak}" in text and "Problems and failures." in text
    assert "Seed 1, version 0.9, 30 seconds in all, on Python 3.12." in text
    assert "studies.soak.energy" not in text and "not installed" not in text
    assert rows(studied) == [
        ["energy", "1000", r"$4\times 10^{-16}$", "10", "today's"],
        ["peak", "2000", r"$5\times 10^{-16}$", "20", "today's"],
    ]


@pytest.mark.parametrize("place", ["src/pontryagin/peak.py", "studies/soak/peak.py"])
def test_a_row_is_stale_when_a_source_of_it_changes_and_no_other_row(studied, place):
    path = studied.root / place
    before = path.read_text()
    path.write_text(before + "# changed\n")
    assert [row[-1] for row in rows(studied)] == ["today's", "changed"]
    path.write_text(before)
    assert [row[-1] for row in rows(studied)] == ["today's", "today's"]
    path.unlink()
    assert rows(studied)[1][-1] == "changed"


def test_all_rows_are_stale_when_a_pinned_package_changes(studied):
    (studied.root / "requirements.lock").write_text("numpy==3\n")
    assert [row[-1] for row in rows(studied)] == ["changed", "changed"]
