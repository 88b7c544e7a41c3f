"""Generated files appear in one step, whatever happens to their writer."""

import subprocess
import sys

import pytest

from pontryagin.io import files


def test_a_reader_never_sees_a_part_of_a_file(tmp_path):
    target = tmp_path / "table.csv"
    target.write_text("old")
    with files.replacing(target) as draft:
        draft.write_text("half of the ne")
        assert target.read_text() == "old"
        draft.write_text("new")
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


def test_a_writer_that_raises_leaves_the_old_file_and_no_draft(tmp_path):
    target = tmp_path / "table.csv"
    target.write_text("old")
    with pytest.raises(ZeroDivisionError), files.replacing(target) as draft:
        draft.write_text("half")
        _ = 1 / 0
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_killed_writer_leaves_the_old_file_and_a_draft_that_is_tidied_away(tmp_path):
    target = tmp_path / "deep" / "table.csv"
    files.write(target, "old")
    script = f"""
import os, signal
from pathlib import Path
from pontryagin.io import files
with files.replacing(Path({str(target)!r})) as draft:
    draft.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""
    assert subprocess.run([sys.executable, "-c", script]).returncode == -9
    assert target.read_text() == "old"
    assert len(list(target.parent.iterdir())) == 2
    files.remove_drafts(tmp_path)
    assert list(target.parent.iterdir()) == [target]


def test_writing_what_is_there_already_touches_nothing(tmp_path):
    target = tmp_path / "figure.svg"
    assert files.write(target, "<svg/>")
    before = target.stat()
    assert not files.write(target, b"<svg/>")
    after = target.stat()
    assert (after.st_mtime_ns, after.st_ino) == (before.st_mtime_ns, before.st_ino)


def test_figures_go_where_the_environment_says_else_into_the_checkout(tmp_path, monkeypatch):
    monkeypatch.delenv("PONTRYAGIN_FIGURES", raising=False)
    monkeypatch.chdir(tmp_path)
    assert files.figures_folder() == files.repository() / "figures"
    monkeypatch.setenv("PONTRYAGIN_FIGURES", str(tmp_path / "drawn"))
    assert files.figures_folder() == tmp_path / "drawn"
