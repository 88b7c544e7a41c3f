"""Generated files appear in one step, whatever happens to their writer."""

import os
import stat
import subprocess
import sys
from pathlib import Path

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


@pytest.mark.checkout
def test_figures_go_where_the_environment_says_else_into_the_checkout(tmp_path, monkeypatch):
    monkeypatch.delenv("PONTRYAGIN_FIGURES", raising=False)
    monkeypatch.chdir(tmp_path)
    assert files.figures_folder() == files.repository() / "figures"
    monkeypatch.setenv("PONTRYAGIN_FIGURES", str(tmp_path / "drawn"))
    assert files.figures_folder() == tmp_path / "drawn"


def test_an_environment_inside_a_user_s_project_is_no_checkout(tmp_path, monkeypatch):
    (tmp_path / "pyproject.toml").touch()
    installed = tmp_path / ".venv" / "lib" / "python3.12" / "site-packages" / "pontryagin" / "io" / "files.py"
    monkeypatch.setattr(files, "__file__", str(installed))
    with pytest.raises(ValueError, match="installed without"):
        files.repository()


@pytest.fixture
def pipe(tmp_path):
    """A named pipe, and a function that returns what was written to it."""
    path = tmp_path / "pipe.csv"
    os.mkfifo(path)
    reader = subprocess.Popen(["cat", path], stdout=subprocess.PIPE)
    yield path, lambda: reader.communicate(timeout=20)[0]
    reader.kill()


class TestWhatIsReplaced:
    @pytest.mark.parametrize("mode", [0o600, 0o640, 0o755])
    def test_a_file_keeps_its_permissions(self, tmp_path, mode):
        target = tmp_path / "table.csv"
        target.write_text("old")
        target.chmod(mode)
        files.write(target, "new")
        assert (target.read_text(), stat.S_IMODE(target.stat().st_mode)) == ("new", mode)

    @pytest.mark.parametrize("there", [True, False])
    @pytest.mark.parametrize("links", [1, 2])
    def test_a_link_is_followed(self, tmp_path, there, links):
        target = tmp_path / "elsewhere" / "table.csv"
        target.parent.mkdir()
        if there:
            target.write_text("old")
        link = tmp_path / "link.csv"
        for place in [*(tmp_path / f"{i}.csv" for i in range(1, links)), link]:
            place.symlink_to(os.path.relpath(target, tmp_path))
            target = place
        files.write(link, "new")
        assert link.is_symlink() and link.read_text() == "new"
        assert (tmp_path / "elsewhere" / "table.csv").read_text() == "new"
        assert [path.name for path in (tmp_path / "elsewhere").iterdir()] == ["table.csv"]

    def test_a_pipe_is_written_through(self, tmp_path, pipe):
        path, received = pipe
        link = tmp_path / "link.csv"
        link.symlink_to(path)
        files.write(link, "new")
        assert received() == b"new"
        assert link.is_symlink() and stat.S_ISFIFO(path.stat().st_mode)
        assert {entry.name for entry in tmp_path.iterdir()} == {"pipe.csv", "link.csv"}

    def test_a_pipe_gets_nothing_from_a_writer_that_raises(self, tmp_path, pipe):
        path, received = pipe
        with pytest.raises(ZeroDivisionError), files.replacing(path) as draft:
            draft.write_text("half")
            _ = 1 / 0
        path.write_text("")
        assert received() == b""

    @pytest.mark.skipif(not Path("/dev/fd").exists(), reason="needs names for descriptors")
    def test_an_open_descriptor_is_written_where_it_stands(self, tmp_path):
        kept = tmp_path / "kept.txt"
        with kept.open("w") as file:
            print("first", file=file, flush=True)
            files.write(Path(f"/dev/fd/{file.fileno()}"), "second\n")
            print("third", file=file)
        assert kept.read_text() == "first\nsecond\nthird\n"

    @pytest.mark.parametrize("name", ["", ".", "..", "/"])
    def test_a_folder_is_refused(self, tmp_path, monkeypatch, name):
        monkeypatch.chdir(tmp_path)
        with pytest.raises(IsADirectoryError):
            files.write(Path(name), "new")

    def test_links_in_a_circle_are_refused(self, tmp_path):
        (tmp_path / "a").symlink_to("b")
        (tmp_path / "b").symlink_to("a")
        with pytest.raises(OSError, match="symbolic links"):
            files.write(tmp_path / "a", "new")

    @pytest.mark.skipif(not hasattr(os, "mknod") or os.geteuid() != 0, reason="makes a device")
    def test_a_full_device_is_an_error_and_stays(self, tmp_path):
        device = tmp_path / "full.csv"
        try:
            os.mknod(device, 0o666 | stat.S_IFCHR, os.makedev(1, 7))
            device.write_bytes(b"")
        except OSError:
            pytest.skip("devices cannot be made here")
        with pytest.raises(OSError, match="No space left"):
            files.write(device, "new")
        assert stat.S_ISCHR(device.stat().st_mode)
