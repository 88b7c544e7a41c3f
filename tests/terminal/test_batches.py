"""Batches: any number of rows in the same memory, rows at fault beside others, what is done after Ctrl-C."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from command_line import assert_refused, read_table, run, write_table
from pontryagin import triple_integrator
from pontryagin.errors import NotConverged
from pontryagin.io import rows
from pontryagin.terminal import batches
from pontryagin.validation import members_of

SOLVE = ("solve", "triple-integrator", "--norm", "2")
HEADER = ("name", "x10", "x20", "x30", "x1f", "x2f", "x3f", "tf")
SCRIPT = "import sys; from pontryagin.cli import main; sys.argv[0] = 'pontryagin'; main()"
STATUS = Path("/proc/self/status")
"""Where Linux tells the most memory that a process held, without that of the process it was started by."""


def problems(count):
    """Rows of manoeuvres, each from rest to an angle of its own."""
    return [[f"n{i}", "0", "0", "0", repr(1 + i / 7), "0", "0", "2"] for i in range(count)]


PATIENCE = 300
"""Seconds after which a process counts as one that will never end."""


@pytest.fixture
def process():
    """A function that starts the command line in a process; what still runs after the test is killed."""
    with contextlib.ExitStack() as started:

        def start(*arguments, script=SCRIPT, **streams):
            command = [sys.executable, "-X", "faulthandler", "-c", script, *map(str, arguments)]
            pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
            running = started.enter_context(subprocess.Popen(command, text=True, **pipes | streams))
            started.callback(running.kill)
            return running

        yield start


@pytest.fixture
def small_blocks(monkeypatch):
    """Blocks of two rows."""
    monkeypatch.setattr(rows, "BLOCK", 2)


@pytest.fixture
def solved(monkeypatch):
    """The manoeuvres solved so far; the third stack is not solved, as Ctrl-C comes before."""
    plain, stacks = triple_integrator.minimum_energy, []

    def solver(maneuver):
        if len(stacks) == 2:
            raise KeyboardInterrupt
        stacks.append(maneuver)
        return plain(maneuver)

    monkeypatch.setattr(triple_integrator, "minimum_energy", solver)
    return stacks


class TestBlocks:
    @pytest.mark.parametrize("goal", [["--norm", "1"], ["--norm", "inf"], ["--norm", "3"], ["--peak", "2"]])
    def test_manoeuvres_in_blocks_are_those_of_the_whole(self, tmp_path, monkeypatch, goal):
        table = write_table(tmp_path / "in.csv", HEADER, problems(5))
        command = ("solve", "triple-integrator", *goal, "--batch", table)
        whole = run(*command).stdout
        monkeypatch.setattr(rows, "BLOCK", 2)
        assert run(*command).stdout == whole
        assert run(*command, "--out", tmp_path / "out.csv").exit_code == 0
        assert (tmp_path / "out.csv").read_text() == whole

    @pytest.mark.parametrize("thrust", ["ball", "disc"])
    def test_plans_in_blocks_are_those_of_the_whole(self, tmp_path, monkeypatch, thrust):
        states = [
            ["0.001", "0", "0", '"a, ""b"""'],
            ["0", "0", "0", '"two\nlines"'],
            ["0.03", "0.01", "0", "c"],
        ]
        table = write_table(tmp_path / "in.csv", ("dr", "dv_R", "dv_T", "kept"), states)
        command = ("solve", "orbit-correction", "--thrust", thrust, "--batch", table)
        whole = run(*command).stdout
        monkeypatch.setattr(rows, "BLOCK", 1)
        assert run(*command).stdout == whole
        assert [row["kept"] for row in read_table(whole)] == ['a, "b"', "two\nlines", "c"]

    def test_a_formula_is_integrated_over_the_times_of_all_rows(self, tmp_path, small_blocks, monkeypatch):
        table, sizes = write_table(tmp_path / "in.csv", HEADER, problems(3)), []
        plain = triple_integrator.minimum_energy
        monkeypatch.setattr(
            triple_integrator, "minimum_energy", lambda stack: sizes.append(*stack.shape) or plain(stack)
        )
        for force in ("sin(t)", "1/3"):
            assert run(*SOLVE, "--disturbance", force, "--batch", table).exit_code == 0
        assert sizes == [3, 2, 1]

    @pytest.mark.slow
    @pytest.mark.skipif(not STATUS.exists(), reason="needs the most memory of a process by itself")
    def test_twice_the_rows_take_the_same_memory(self, tmp_path, process):
        most = []
        for count in (200_000, 400_000):
            table = write_table(tmp_path / "in.csv", HEADER, problems(count))
            script = f"{SCRIPT[:-6]}\ntry: main()\nfinally: print(open({str(STATUS)!r}).read())"
            running = process(*SOLVE, "--batch", table, "--out", tmp_path / "out.csv", script=script)
            most.append(int(re.search(r"VmHWM:\s+(\d+)", running.communicate(timeout=PATIENCE)[0])[1]))
            assert (running.returncode, (tmp_path / "out.csv").read_bytes().count(b"\n")) == (0, count + 1)
        assert most[1] < 1.05 * most[0]


class TestFaults:
    FAR = ("far", "0", "0", "0", "1e308", "0", "0", "1e-200")
    FAULTS = (
        (["a", "0", "0", "much", "1", "0", "0", "2"], "x30 takes a number, got 'much'"),
        (["a", "0", "0", "0", "1", "0", "0", "-2"], "tf must be later than t0, got t0 = 0.0 and tf = -2.0"),
        (["a", "0", "0"], "has 3 entries, but the header has 8"),
        (FAR, "xf must give with x0 and tf - t0 a control"),
    )

    @pytest.mark.parametrize(("row", "reason"), FAULTS)
    @pytest.mark.parametrize("place", [0, 3, 5])
    def test_a_row_at_fault_loses_no_other(self, tmp_path, row, reason, place):
        good = problems(6)
        whole = read_table(run(*SOLVE, "--batch", write_table(tmp_path / "in.csv", HEADER, good)).stdout)
        faulty = [*good[:place], row, *good[place:]]
        for out in ("-", tmp_path / "out.csv"):
            table = write_table(tmp_path / "in.csv", HEADER, faulty)
            result = run(*SOLVE, "--batch", table, "--out", out)
            said = f"Error: --batch: {table}, 1 of 7 rows, the first of them in line {place + 2}: {reason}"
            assert result.exit_code == 1
            assert result.stderr.splitlines()[-1].startswith(said)
            found = read_table(result.stdout if out == "-" else out.read_text())
            failed = found.pop(place)
            assert failed["error"].startswith(reason) and not failed["norm"]
            assert [row | {"error": ""} for row in whole] == found

    def test_any_number_of_rows_may_be_at_fault(self, tmp_path, small_blocks):
        table = write_table(tmp_path / "in.csv", HEADER, [self.FAR, *problems(5), self.FAR, self.FAR])
        result = run(*SOLVE, "--batch", table, "--json")
        assert "3 of 8 rows, the first of them in line 2" in result.stderr
        found = [json.loads(line) for line in result.stdout.splitlines()]
        assert ["error" in row for row in found] == [True, *[False] * 5, True, True]
        assert ["norm" in row for row in found] == [False, *[True] * 5, False, False]

    def test_each_row_gets_the_reason_that_it_has_alone(self, tmp_path, monkeypatch):
        """And the others are solved as one stack, however many are at fault."""
        plain, stacks = triple_integrator.Maneuver, []
        monkeypatch.setattr(
            triple_integrator, "Maneuver", lambda *given: stacks.append(len(given[0])) or plain(*given)
        )
        bad = [row for row, _ in self.FAULTS]
        mixed = [row for good in problems(8) for row in (good, *bad)]
        for norm in ("1", "2", "inf"):
            command, reasons = ("solve", "triple-integrator", "--norm", norm), []
            for row in bad:
                table = write_table(tmp_path / "in.csv", HEADER, [*problems(1), row])
                reasons.append(read_table(run(*command, "--batch", table).stdout)[1]["error"])
            stacks.clear()
            table = write_table(tmp_path / "in.csv", HEADER, mixed)
            found = read_table(run(*command, "--batch", table).stdout)
            assert [row["error"] for row in found] == [*["", *reasons] * 8]
            assert all(bool(row["norm"]) == (not row["error"]) for row in found)
            assert stacks == [16, *[1] * 8, 8]

    @pytest.mark.parametrize(("goal", "solver"), [("--peak", "minimum_time"), ("--norm", "minimum_norm")])
    def test_what_is_not_solved_is_tried_alone_and_the_others_together(
        self, tmp_path, monkeypatch, goal, solver
    ):
        plain, stacks = getattr(triple_integrator, solver), []

        def unsure(first, *others):
            lost = np.abs((first.xf if hasattr(first, "xf") else others[0])[:, 0] - 1 - 2 / 7) < 1e-9
            stacks.append(len(lost))
            if lost.any():
                raise NotConverged("nothing was found", 0.5, members_of(lost))
            return plain(first, *others)

        monkeypatch.setattr(triple_integrator, solver, unsure)
        table = write_table(tmp_path / "in.csv", HEADER, problems(9))
        found = read_table(run("solve", "triple-integrator", goal, "3", "--batch", table).stdout)
        assert [row["error"] for row in found if row["error"]] == ["nothing was found (residual 5.000e-01)"]
        assert found[2]["error"] and stacks == [9, 1, 8]

    @pytest.mark.parametrize(("row", "reason"), FAULTS)
    def test_without_any_answer_nothing_is_written(self, tmp_path, small_blocks, row, reason):
        table = write_table(tmp_path / "in.csv", HEADER, [row] * 3)
        (tmp_path / "out.csv").write_text("old")
        for out in ("-", tmp_path / "out.csv"):
            result = run(*SOLVE, "--batch", table, "--out", out)
            assert_refused(result, f"--batch: {table}, line 2: {reason}")
        assert (tmp_path / "out.csv").read_text() == "old"
        assert {path.name for path in tmp_path.iterdir()} == {"in.csv", "out.csv"}

    @pytest.mark.parametrize(
        ("options", "begins"),
        [
            (["--disturbance", "1/(t-1)", "--norm", "2"], "--disturbance must be finite"),
            (["--disturbance", "tan(9*t)", "--norm", "2"], "disturbance is not integrable"),
        ],
    )
    def test_an_option_at_fault_is_named_once(self, tmp_path, monkeypatch, options, begins):
        calls, plain = [], triple_integrator.Maneuver
        monkeypatch.setattr(
            triple_integrator, "Maneuver", lambda *given: calls.append(given) or plain(*given)
        )
        table = write_table(tmp_path / "in.csv", HEADER, problems(9))
        result = run("solve", "triple-integrator", *options, "--batch", table)
        assert_refused(result, begins, status=2 if begins.startswith("--") else 1)
        assert len(calls) == 1

    def test_rows_without_proof_come_back_with_their_answers(self, tmp_path, small_blocks, monkeypatch):
        from pontryagin.terminal import console

        monkeypatch.setattr(console, "ACCEPTED", -1.0)
        table = write_table(tmp_path / "in.csv", HEADER, problems(5))
        result = run(*SOLVE, "--batch", table, "--out", tmp_path / "out.csv")
        assert result.exit_code == 1
        assert "5 of 5 rows, the first of them in line 2: the certificate does not hold" in result.stderr
        found = read_table((tmp_path / "out.csv").read_text())
        assert all(row["norm"] and "does not hold" in row["error"] for row in found)

    def test_a_result_is_no_batch_as_its_columns_are_answers(self, tmp_path):
        table = write_table(tmp_path / "in.csv", HEADER, problems(2))
        assert run(*SOLVE, "--batch", table, "--out", tmp_path / "out.csv").exit_code == 0
        for more in ([], ["--json"]):
            result = run(*SOLVE, "--batch", tmp_path / "out.csv", *more)
            assert_refused(result, f"--batch: {tmp_path / 'out.csv'}, line 1: column 'norm' has the name of")


def test_the_name_of_standard_input_is_a_hyphen(tmp_path, process):
    table = write_table(tmp_path / "in.csv", HEADER, problems(3))
    expected = run(*SOLVE, "--batch", table).stdout
    running = process(*SOLVE, "--batch", "-", stdin=subprocess.PIPE)
    assert running.communicate(table.read_text(), timeout=PATIENCE) == (expected, "")


def test_json_has_an_object_with_the_answers_for_each_row(tmp_path, small_blocks):
    table = write_table(tmp_path / "in.csv", HEADER, problems(3))
    text = run(*SOLVE, "--batch", table, "--json", "--out", tmp_path / "out.jsonl")
    assert (text.exit_code, text.stdout) == (0, "")
    found = [json.loads(line) for line in (tmp_path / "out.jsonl").read_text().splitlines()]
    shown = read_table(run(*SOLVE, "--batch", table).stdout)
    for one, other in zip(found, shown, strict=True):
        assert one["name"] == other["name"] and one["tf"] == 2.0
        assert one["coefficients"] == [float(other[f"coefficients_{i}"]) for i in (1, 2, 3)]
        assert {name: one[name] for name in ("norm", "gap")} == {
            name: float(other[name]) for name in ("norm", "gap")
        }


def interrupted(running):
    """What a process printed after Ctrl-C, which is pressed again where the process is slow to answer."""
    for _ in range(5):
        running.send_signal(signal.SIGINT)
        try:
            return running.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            continue
    raise AssertionError("the process does not answer to Ctrl-C")


def writer_of(pipe, running):
    """A descriptor to write to a named pipe that a process reads; the process must open it in time."""
    for _ in range(100 * PATIENCE):
        try:
            descriptor = os.open(pipe, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:  # There is no reader yet.
            assert running.poll() is None, running.communicate()
            time.sleep(0.01)
        else:
            os.set_blocking(descriptor, True)
            return descriptor
    raise AssertionError("the process does not read")


def test_a_swallowed_interruption_is_still_known():
    with batches._pressed() as pressed:
        assert not pressed()
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        assert pressed()


class TestInterruption:
    def test_the_rows_done_are_written(self, tmp_path, small_blocks, solved):
        table = write_table(tmp_path / "in.csv", HEADER, problems(9))
        out = tmp_path / "out.csv"
        result = run(*SOLVE, "--batch", table, "--out", out)
        assert (result.exit_code, result.stdout) == (130, "")
        done = "the first 4 rows are done and written; the same command goes on from there"
        assert result.stderr == f"wrote {out}\nInterrupted: {done}\n"
        assert [row["name"] for row in read_table(out.read_text())] == ["n0", "n1", "n2", "n3"]

    def test_before_any_row_is_done_nothing_is_written(self, tmp_path, solved):
        solved += [None, None]
        table = write_table(tmp_path / "in.csv", HEADER, problems(9))
        result = run(*SOLVE, "--batch", table, "--out", tmp_path / "out.csv")
        assert (result.exit_code, result.stderr) == (130, "Interrupted: no row is done\n")
        assert not (tmp_path / "out.csv").exists()

    @pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
    def test_a_signal_while_the_next_rows_are_awaited(self, tmp_path, process):
        pipe = tmp_path / "pipe"
        os.mkfifo(pipe)
        running = process(*SOLVE, "--batch", pipe)
        text = "\n".join(",".join(row) for row in [HEADER, *problems(4 * rows.BLOCK)])
        with os.fdopen(writer_of(pipe, running), "w") as file:
            # What a pipe and its reader do not hold was read, so that blocks before it are solved.
            file.write(text)
            file.flush()
            printed, said = interrupted(running)
        assert running.returncode == 130
        done = int(re.fullmatch(r"Interrupted: the first (\d+) rows are done and written\n", said)[1])
        assert done % rows.BLOCK == 0 < done
        assert len(read_table(printed)) == done


class TestBar:
    def test_there_is_none_where_standard_error_is_no_terminal(self, tmp_path, process):
        table = write_table(tmp_path / "in.csv", HEADER, problems(3))
        running = process(*SOLVE, "--batch", table, "--out", tmp_path / "out.csv")
        assert running.communicate(timeout=PATIENCE) == ("", f"wrote {tmp_path / 'out.csv'}\n")

    def test_a_terminal_shows_the_rows_done(self, tmp_path, process):
        pty = pytest.importorskip("pty")
        table = write_table(tmp_path / "in.csv", HEADER, problems(3 * rows.BLOCK))
        ours, theirs = pty.openpty()
        with (tmp_path / "printed").open("w") as printed:
            streams = {"stdout": printed, "stderr": theirs}
            running = process(*SOLVE, "--batch", table, env=os.environ | {"TERM": "xterm"}, **streams)
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 1 << 16):
                shown += part
        except OSError:  # The other end is closed.
            pass
        os.close(ours)
        assert running.wait(60) == 0
        assert len(read_table((tmp_path / "printed").read_text())) == 3 * rows.BLOCK
        assert f"/{3 * rows.BLOCK + 1}" in shown.decode()
        assert "rows" in shown.decode()
