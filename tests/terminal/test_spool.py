"""A batch that is killed goes on where it was, to the same bytes; what was damaged is not taken."""

import os
import random
import signal
import subprocess
import sys
import time

import pytest

from command_line import run, write_table
from pontryagin import triple_integrator
from pontryagin.io import files, rows

pytest.importorskip("fcntl")

SOLVE = ("solve", "triple-integrator", "--norm", "2")
HEADER = ("name", "x10", "x20", "x30", "x1f", "x2f", "x3f", "tf")
SCRIPT = """
import sys
from pontryagin.cli import main
from pontryagin.io import rows
rows.BLOCK = 100
sys.argv[0] = "pontryagin"
main()
"""


class Killed(BaseException):
    """Stands for the end of a process."""


def problems(count):
    """Rows of manoeuvres, one of which is at fault."""
    made = [[f"n{i}", "0", "0", "0", repr(1 + i / 7), "0", "0", "2"] for i in range(count)]
    made[1][3] = "much"
    return made


@pytest.fixture
def table(tmp_path, monkeypatch):
    monkeypatch.setattr(rows, "BLOCK", 2)
    return write_table(tmp_path / "in.csv", HEADER, problems(9))


@pytest.fixture
def expected(table):
    return run(*SOLVE, "--batch", table).stdout


@pytest.fixture
def solved(monkeypatch):
    """The sizes of the stacks that were solved; `solved.end` is how many are before the process ends."""
    plain = triple_integrator.minimum_energy

    class Solved(list):
        end = 99

    stacks = Solved()

    def solver(maneuver):
        if len(stacks) >= stacks.end:
            raise Killed
        stacks.append(maneuver.shape[0])
        return plain(maneuver)

    monkeypatch.setattr(triple_integrator, "minimum_energy", solver)
    return stacks


def kill(table, out, solved, after, *options):
    """Begin a batch, which ends after some stacks are solved."""
    solved.clear()
    solved.end = after
    with pytest.raises(Killed):
        run(*SOLVE, *options, "--batch", table, "--out", out)
    assert not out.exists()
    solved.clear()
    solved.end = 99


def finish(table, out, *options):
    result = run(*SOLVE, *options, "--batch", table, "--out", out)
    assert result.exit_code == 1 and "1 of 9 rows, the first of them in line 3" in result.stderr
    return result.stderr


@pytest.mark.parametrize("options", [[], ["--json"]])
def test_what_was_done_is_not_done_again(tmp_path, table, solved, options):
    expected = run(*SOLVE, *options, "--batch", table).stdout
    out = tmp_path / "out.csv"
    kill(table, out, solved, 3, *options)
    said = finish(table, out, *options)
    assert said.startswith("Goes on after 6 rows that were done before\n")
    assert solved == [2, 1]
    assert out.read_text() == expected
    assert {path.name for path in tmp_path.iterdir()} == {"in.csv", "out.csv"}


def test_the_rows_that_are_left_may_change(tmp_path, table, solved):
    out = tmp_path / "out.csv"
    kill(table, out, solved, 3)
    write_table(table, HEADER, [*problems(9)[:5], *problems(12)[8:]])
    expected = run(*SOLVE, "--batch", table).stdout
    solved.clear()
    run(*SOLVE, "--batch", table, "--out", out)
    assert out.read_text() == expected
    assert solved == [2, 2, 1]


@pytest.mark.parametrize("keep", [0.0, 0.1, 0.5, 0.9, 0.999])
@pytest.mark.parametrize("flip", [True, False])
def test_a_damaged_file_is_read_up_to_the_damage(tmp_path, table, solved, expected, keep, flip):
    out, kept = tmp_path / "out.csv", tmp_path / ".out.csv.rows"
    kill(table, out, solved, 3)
    data = bytearray(kept.read_bytes())
    place = int(keep * len(data))
    data[place] ^= 1
    kept.write_bytes(data if flip else data[:place])
    finish(table, out)
    assert out.read_text() == expected
    assert len(solved) >= 2


def test_other_settings_and_other_code_take_nothing(tmp_path, table, solved, monkeypatch):
    from pontryagin.terminal import spool

    out = tmp_path / "out.csv"
    for change in ("option", "code"):
        kill(table, out, solved, 3)
        options = ["--disturbance", "1/3"] if change == "option" else []
        if change == "code":
            monkeypatch.setattr(spool, "_code", lambda: "another version")
        expected = run(*SOLVE, *options, "--batch", table).stdout
        assert "Goes on" not in finish(table, out, *options)
        assert out.read_text() == expected
        out.unlink()


def test_a_link_in_its_place_is_not_followed(tmp_path, table, expected):
    victim = tmp_path / "victim"
    victim.write_text("kept")
    (tmp_path / ".out.csv.rows").symlink_to(victim)
    finish(table, tmp_path / "out.csv")
    assert (tmp_path / "out.csv").read_text() == expected
    assert victim.read_text() == "kept" and (tmp_path / ".out.csv.rows").is_symlink()


def test_two_batches_with_one_target_do_not_meet(tmp_path, table, expected, monkeypatch):
    out, plain, inner = tmp_path / "out.csv", triple_integrator.minimum_energy, []

    def solver(maneuver):
        if not inner:
            inner.append(True)
            inner.append(finish(table, out))
            assert out.read_text() == expected
        return plain(maneuver)

    monkeypatch.setattr(triple_integrator, "minimum_energy", solver)
    finish(table, out)
    assert out.read_text() == expected and len(inner) == 2


def test_a_full_disk_at_the_end_loses_no_row(tmp_path, table, solved, expected, monkeypatch):
    """The next batch goes on, even while somebody looks at the traceback of this one."""
    out, traceback = tmp_path / "out.csv", []

    def full(path):
        traceback.append(sys._getframe())
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(files, "replacing", full)
        result = run(*SOLVE, "--batch", table, "--out", out)
        assert result.stderr == f"Error: --out cannot write {out}: no space left on device\n"
    solved.clear()
    finish(table, out)
    assert (solved, out.read_text()) == ([], expected)


def test_what_a_process_killed_at_the_end_had_written_is_removed(tmp_path, table):
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    out = tmp_path / "out.csv"
    of_dead, of_living, of_another = (
        tmp_path / f".{name}.partial.csv"
        for name in (f"out.{dead.pid}-1", f"out.{os.getpid()}-1", f"outer.{dead.pid}-1")
    )
    for draft in (of_dead, of_living, of_another):
        draft.write_text("half")
    finish(table, out)
    assert {*tmp_path.iterdir()} == {table, out, of_living, of_another}


@pytest.mark.slow
def test_batches_killed_at_random_moments_go_on_to_the_same_bytes(tmp_path):
    """Three tables, one after the other, as a loop in a shell takes them."""
    tables = [write_table(tmp_path / f"{i}.csv", HEADER, problems(3000 + 500 * i)) for i in range(3)]

    def start(table):
        out = table.with_suffix(".out")
        command = [sys.executable, "-c", SCRIPT, *SOLVE, "--batch", table, "--out", out]
        return subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)

    started = time.monotonic()
    for table in tables:
        assert start(table).wait(120) == 1
    whole = (time.monotonic() - started) / len(tables)
    expected = {table.with_suffix(".out"): table.with_suffix(".out").read_bytes() for table in tables}
    chance = random.Random(5)
    for table in tables:
        table.with_suffix(".out").unlink()
        for _ in range(10):
            child = start(table)
            try:
                child.wait(whole * chance.random())
            except subprocess.TimeoutExpired:
                os.killpg(child.pid, signal.SIGKILL)
                child.wait()
            out = table.with_suffix(".out")
            assert not out.exists() or out.read_bytes() == expected[out]
        assert start(table).wait(120) == 1
    assert {out: out.read_bytes() for out in expected} == expected
    assert {*tmp_path.iterdir()} == {*tables, *expected}
