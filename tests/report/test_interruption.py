"""Builds that are killed, or find damaged caches, a full disk or another build: seen, and the same bytes."""

import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from importlib.metadata import version
from importlib.util import find_spec

import pytest

from pontryagin.io import sealed
from pontryagin.papers import PAPERS
from pontryagin.report import build, recordings
from pontryagin.report.workspace import alone

MODULE = f"pontryagin.{PAPERS[0].package}.playback"
PLAYBACK = """
import time
from pathlib import Path

def writer(name):
    def write(path):
        for part in range(4):
            with Path(path).open("a") as file:
                file.write(f"{name} {part} " * 500)
            time.sleep(0.01)
    return write

def recordings():
    return {name: writer(name) for name in ("one", "two", "three")}
"""
DRAW = "from pontryagin.display.plotting import show_table; show_table({'x': [%d, 2]}, 'sample')"
KILLS = 10


@pytest.fixture
def small(checkout):
    """A checkout with recordings that are quickly written."""
    package = PAPERS[0].package
    checkout.package()
    checkout.modules({f"{package}/__init__.py": "", f"{package}/playback.py": PLAYBACK})
    keep_viewer(checkout)
    return checkout


def keep_viewer(checkout):
    """Put something small in the place of rerun's viewer, which takes seconds to pack."""
    if find_spec("rerun"):
        sealed.write(checkout.workspace.cache / "viewer" / f"{version('rerun-sdk')}.js", "viewer")


def command(checkout, stage="recordings"):
    return [sys.executable, "-m", "pontryagin.report", stage, "--root", str(checkout.root)]


def made(checkout):
    """All that a build is to make, by its place."""
    folders = (checkout.workspace.recordings, checkout.workspace.figures)
    paths = [path for folder in folders for path in folder.rglob("*") if path.is_file()]
    return {str(path.relative_to(checkout.root)): path.read_bytes() for path in paths}


def killed_after(seconds, arguments):
    """Start a build in a session of its own, and kill all of it if it is not done by then."""
    child = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, start_new_session=True)
    try:
        child.wait(seconds)
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()


@pytest.mark.slow
@pytest.mark.parametrize("stage", ["recordings", "figures"])
def test_a_build_killed_at_random_moments_goes_on_to_the_same_bytes(small, stage):
    for number in (1, 2):
        small.notebook(f"0{number}", "# Title", DRAW % number)
    started = time.monotonic()
    assert subprocess.run(command(small, stage), stdout=subprocess.DEVNULL).returncode == 0
    whole, expected = time.monotonic() - started, made(small)
    assert expected
    for path in [small.workspace.build, small.workspace.figures]:
        shutil.rmtree(path, ignore_errors=True)
    keep_viewer(small)
    chance = random.Random(11)
    for _ in range(KILLS if stage == "recordings" else 4):
        killed_after(whole * chance.random(), command(small, stage))
        found = made(small)
        assert {name: expected.get(name) for name in found if ".partial" not in name} == {
            name: content for name, content in found.items() if ".partial" not in name
        }
    assert subprocess.run(command(small, stage), stdout=subprocess.DEVNULL).returncode == 0
    assert made(small) == expected


def record(checkout):
    return {clip.name: fresh for clip, fresh in recordings.record(checkout.workspace, MODULE)}


@pytest.mark.parametrize(
    "damage", [lambda data: data[: len(data) // 2], lambda data: b"", lambda data: data[:-1] + b"!"]
)
def test_a_damaged_recording_and_a_damaged_list_of_them_are_made_anew(small, damage):
    assert record(small) == dict.fromkeys(("one", "two", "three"), True)
    expected = made(small)
    recording = small.workspace.recordings / "two.rrd"
    recording.write_bytes(damage(recording.read_bytes()))
    assert record(small) == {"one": False, "two": True, "three": False}
    assert made(small) == expected
    (listed,) = (small.workspace.cache / "recordings").glob("*.json")
    listed.write_bytes(damage(listed.read_bytes()))
    assert record(small) == dict.fromkeys(("one", "two", "three"), True)
    assert record(small) == dict.fromkeys(("one", "two", "three"), False)
    assert made(small) == expected


@pytest.mark.slow
def test_damaged_outputs_of_a_notebook_are_named_and_made_anew(small):
    small.notebook("01", "# Title", DRAW % 1)
    assert subprocess.run(command(small, "figures"), stdout=subprocess.DEVNULL).returncode == 0
    expected = made(small)
    (executed,) = small.workspace.cache.glob("notebooks/01/*/executed.ipynb")
    executed.write_bytes(executed.read_bytes()[:100])
    (drawn,) = small.workspace.figures.glob("01/*.csv")
    drawn.write_text("other")
    done = subprocess.run(command(small, "figures"), capture_output=True, text=True)
    assert (done.returncode, made(small)) == (0, expected)
    assert "01: its kept outputs are damaged, and are made anew" in done.stdout


def test_a_full_disk_is_named_and_the_next_build_goes_on(small):
    def no_room():
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

    done = subprocess.run(command(small), capture_output=True, text=True, preexec_fn=no_room)
    assert (done.returncode, done.stderr) == (1, "")
    assert "File too large" in done.stdout and "Traceback" not in done.stdout
    assert not [name for name in made(small) if name.endswith(".rrd")]
    assert subprocess.run(command(small), capture_output=True).returncode == 0
    assert sorted(made(small)) == [f"build/recordings/{name}.rrd" for name in ("one", "three", "two")]


def test_a_full_disk_during_the_build_s_own_writing_is_one_line_with_the_file(small, monkeypatch, capsys):
    def full(self, data):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    assert build.main(["recordings", "--root", str(small.root)]) == 1
    said = capsys.readouterr().out
    assert "No space left on device; the same command goes on from here" in said
    assert str(small.workspace.build) in said


def test_a_second_build_says_that_it_waits(small, capsys):
    with alone(small.workspace):
        waiting = subprocess.Popen(command(small), stdout=subprocess.PIPE, text=True)
        assert "another build is at work here" in waiting.stdout.readline()
        assert waiting.poll() is None
    assert waiting.wait(60) == 0
    assert len(made(small)) == 3
    waiting.stdout.close()


def test_where_the_build_may_not_write_it_says_so(checkout, capsys):
    checkout.workspace.build.write_text("no folder")
    assert build.main(["recordings", "--root", str(checkout.root)]) == 1
    assert f"{checkout.workspace.build}: File exists" in capsys.readouterr().out
