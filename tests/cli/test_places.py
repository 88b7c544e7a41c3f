"""Where the command line writes: through pipes and links, and one line where a place is full or no file."""

import os
import resource
import stat
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from command_line import assert_refused, run, write_table
from pontryagin.numerics import object_code

SOLVE = ("solve", "triple-integrator", "--norm", "2")
ONE = (*SOLVE, "--x0", "0,0,0", "--xf", "1,0,0", "--duration", "2")
MANY = "x10,x20,x30,x1f,x2f,x3f,tf\n" + "".join(f"0,0,0,{i},0,0,2\n" for i in range(1, 601))
"""A table with so many problems that native code is made."""
SCRIPT = "import sys; from pontryagin.cli import main; sys.argv[0] = 'pontryagin'; main()"


@pytest.fixture
def table(tmp_path):
    """A table with one problem."""
    header = ("x10", "x20", "x30", "x1f", "x2f", "x3f", "tf")
    return write_table(tmp_path / "in.csv", header, [["0", "0", "0", "1", "0", "0", "2"]])


def command(option, table):
    """The command that writes a file with this option."""
    if option in ("--csv", "--json"):
        return ("ledger", "--paper", "Gorelov", "--verdict", "misprint")
    return (*SOLVE, "--batch", table) if option == "--out" else ONE


RECORDS = pytest.mark.extra(name="recording")
WRITTEN = {
    "--out": ("a.csv", b"x10,"),
    "--plot": ("a.png", b"\x89PNG"),
    "--record": ("a.rrd", b"RRF"),
    "--csv": ("a.csv", b"paper,"),
}


@pytest.mark.parametrize(
    "option", [pytest.param(name, marks=RECORDS if name == "--record" else ()) for name in WRITTEN]
)
def test_a_pipe_is_written_through_and_a_link_is_followed(tmp_path, table, option):
    name, begins = WRITTEN[option]
    pipe, target, link = tmp_path / "nodes" / name, tmp_path / f"target-{name}", tmp_path / name
    pipe.parent.mkdir()
    os.mkfifo(pipe)
    target.write_bytes(b"old")
    target.chmod(0o640)
    link.symlink_to(target)
    reader = subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE)
    for place in (pipe, link):
        result = run(*command(option, table), option, place)
        assert (result.exit_code, result.stderr) == (0, f"wrote {place}\n")
    assert reader.communicate(timeout=20)[0].startswith(begins)
    assert stat.S_ISFIFO(pipe.stat().st_mode) and [*pipe.parent.iterdir()] == [pipe]
    assert link.is_symlink() and target.read_bytes().startswith(begins)
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


@pytest.mark.parametrize("option", ["--out", "--csv", "--json"])
@pytest.mark.parametrize("name", ["", ".", "/"])
def test_what_is_no_name_of_a_file_is_refused(table, option, name):
    result = run(*command(option, table), f"{option}={name}")
    assert_refused(result, f"{option} cannot write {name or '.'}: is a directory")


@pytest.mark.parametrize("option", ["--batch", "--file"])
def test_no_file_is_read_from_an_empty_name(option):
    solve = SOLVE if option == "--batch" else ("solve", "rendezvous")
    assert_refused(run(*solve, f"{option}="), f"{option} cannot read .: is a directory")


def no_room():
    """Stand in for a full disk: the process may not make a file longer."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


@pytest.mark.parametrize("arguments", [["--version"], ["--help"], ONE])
def test_a_full_standard_output_is_one_line(tmp_path, arguments):
    with (tmp_path / "out").open("w") as out:
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT, *arguments],
            stdout=out,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=no_room,
            timeout=60,
        )
    assert (done.returncode, done.stderr) == (1, "Error: cannot write the output: file too large\n")


@contextmanager
def room_for(size):
    """Stand in for a disk that is all but full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("size", [0, 30_000])
@pytest.mark.parametrize(
    "option",
    [
        "--plot=a.svg",
        "--plot=a.pdf",
        "--plot=a.png",
        pytest.param("--record=a.rrd", marks=RECORDS),
        "--csv=a.csv",
    ],
)
def test_no_half_of_a_file_is_left_where_the_disk_is_full(tmp_path, monkeypatch, option, size):
    monkeypatch.chdir(tmp_path)
    name, path = option.split("=")
    (tmp_path / path).write_text("old")
    many = ("ledger", "--paper", "Gorelov")
    with room_for(size if path != "a.pdf" else 0):
        result = run(*(many if name == "--csv" else ONE), option)
    assert_refused(result, f"{name} cannot write {path}: ")
    assert "file too large" in result.stderr
    assert (tmp_path / path).read_text() == "old" and len([*tmp_path.iterdir()]) == 1


def test_a_batch_that_finds_no_room_leaves_nothing(tmp_path, table):
    with room_for(0):
        result = run(*SOLVE, "--batch", table, "--out", tmp_path / "out.csv")
    assert_refused(result, f"--out cannot write {tmp_path / 'out.csv'}: file too large")
    assert [*tmp_path.iterdir()] == [table]


@pytest.mark.parametrize("base", [None, "~nobody-of-this-name/cache", "/dev/null/cache"])
def test_where_no_code_can_be_kept_a_process_makes_its_own_and_says_so(monkeypatch, base):
    def nowhere(self):
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    if base is None:
        monkeypatch.setattr(Path, "expanduser", nowhere)
    else:
        monkeypatch.setenv("XDG_CACHE_HOME", base)
    with pytest.warns(RuntimeWarning, match="native code cannot be kept in .*; XDG_CACHE_HOME names another"):
        folder = object_code.cache_folder.__wrapped__()
    assert folder.is_dir() and folder.name.startswith("pontryagin-")


def test_without_a_writable_home_the_answer_is_the_same_and_nothing_is_left(tmp_path):
    known = run(*SOLVE, "--batch", "-", input=MANY)
    surroundings = {name: value for name, value in os.environ.items() if name != "XDG_CACHE_HOME"}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, *SOLVE, "--batch", "-"],
        input=MANY,
        capture_output=True,
        text=True,
        env=surroundings | {"HOME": "/dev/null/home", "TMPDIR": str(tmp_path)},
        timeout=120,
    )
    assert (done.returncode, done.stdout) == (0, known.stdout)
    assert done.stderr.startswith("Warning: native code cannot be kept in ~/.cache/pontryagin")
    assert not list(tmp_path.iterdir())
