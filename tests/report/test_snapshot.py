"""A build is left out only while all that the last one read and wrote is as it was."""

import os
import subprocess
import sys

import pytest

from pontryagin.report import snapshot

NAMED = "open('ends.csv').read(); open('../data/late.csv')"


@pytest.fixture
def complete(checkout):
    """A checkout after a complete build; everything in it is an hour old."""
    checkout.modules({"__init__.py": "", "numerics/__init__.py": "", "numerics/newton.py": "TOLERANCE = 1\n"})
    checkout.notebook("01-title", "# Title", NAMED)
    workspace = checkout.workspace
    for path in (
        checkout.root / "notebooks" / "ends.csv",
        workspace.figures / "benchmarks" / "benchmarks.md",
        workspace.figures / "studies" / "soak" / "table.csv",
        checkout.root / "studies" / "soak" / "study.py",
        workspace.figures / "01-title" / "line.svg",
        workspace.report / "index.html",
        workspace.recordings / "turn.rrd",
    ):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("as it was")
    make_old(checkout.root)
    note(checkout)
    assert snapshot.is_current(workspace, "report")
    return checkout


def make_old(folder):
    for path in folder.rglob("*"):
        os.utime(path, (path.stat().st_atime - 3600, path.stat().st_mtime - 3600))


def note(checkout, meanwhile=lambda: None):
    """What a build does that begins and ends now, but for what it makes."""
    named = snapshot.named_by_notebooks(checkout.workspace)
    read = snapshot.inputs(checkout.workspace, named)
    meanwhile()
    snapshot.remember(checkout.workspace, "report", read, named)


@pytest.mark.parametrize(
    "place",
    [
        "src/pontryagin/numerics/newton.py",
        "notebooks/01-title.ipynb",
        "notebooks/ends.csv",
        "requirements.lock",
        "figures/benchmarks/benchmarks.md",
        "figures/studies/soak/table.csv",
        "studies/soak/study.py",
        "figures/01-title/line.svg",
        "build/report/index.html",
        "build/recordings/turn.rrd",
    ],
)
def test_a_file_that_is_changed_or_removed_calls_for_a_build(complete, place):
    path = complete.root / place
    before = path.read_bytes()
    path.write_bytes(before + b" ")
    assert not snapshot.is_current(complete.workspace, "report")
    path.write_bytes(before)
    assert snapshot.is_current(complete.workspace, "report")
    path.unlink()
    assert not snapshot.is_current(complete.workspace, "report")


@pytest.mark.parametrize(
    "place",
    ["src/pontryagin/numerics/new.py", "notebooks/02.ipynb", "figures/01-title/new.svg", "data/late.csv"],
)
def test_a_new_file_calls_for_a_build(complete, place):
    path = complete.root / place
    path.parent.mkdir(exist_ok=True)
    path.write_text("new")
    assert not snapshot.is_current(complete.workspace, "report")


def test_other_stages_and_forgotten_builds_are_not_current(complete):
    assert not snapshot.is_current(complete.workspace, "figures")
    snapshot.forget(complete.workspace)
    assert not snapshot.is_current(complete.workspace, "report")


def test_a_change_that_leaves_size_and_time_is_seen(complete):
    path = complete.workspace.source / "numerics" / "newton.py"
    before = path.stat()
    path.write_text("TOLERANCE = 2\n")
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    after = path.stat()
    assert (after.st_size, after.st_mtime_ns) == (before.st_size, before.st_mtime_ns)
    assert not snapshot.is_current(complete.workspace, "report")


def test_a_file_read_just_after_it_changed_is_read_again(complete, monkeypatch):
    path = complete.workspace.source / "numerics" / "newton.py"
    path.write_text("TOLERANCE = 3\n")
    known = snapshot._hashed(path, None)
    wrong = ["0" * 24, *known[1:]]
    assert snapshot._hashed(path, wrong)[0] == known[0]
    monkeypatch.setattr(snapshot, "GRAIN", -snapshot.GRAIN)
    assert snapshot._hashed(path, wrong)[0] == wrong[0]


def test_a_change_during_the_build_calls_for_another(complete):
    path = complete.workspace.source / "numerics" / "newton.py"
    note(complete, lambda: path.write_text("TOLERANCE = 4\n"))
    assert not snapshot.is_current(complete.workspace, "report")


def test_another_environment_calls_for_a_build(complete, monkeypatch):
    monkeypatch.setattr(snapshot.provenance, "version", lambda package: "another")
    assert not snapshot.is_current(complete.workspace, "report")


@pytest.mark.slow
def test_the_second_build_finds_nothing_to_do_and_a_failed_one_is_done_again(checkout):
    checkout.notebook("01", "# Title", "6 * 7")
    command = [sys.executable, "-m", "pontryagin.report", "notebooks", "--root", str(checkout.root)]

    def told():
        return subprocess.run(command, capture_output=True, text=True).stdout

    assert "01: executed" in told()
    assert "nothing changed since the last build" in told()
    checkout.notebook("01", "# Title", "6 / 0")
    assert "ZeroDivisionError" in told()
    assert "ZeroDivisionError" in told()
    checkout.notebook("01", "# Title", "6 * 7")
    assert "01: nothing changed since it was executed" in told()
    assert "nothing changed since the last build" in told()
