"""The command line prints the answers of the solvers, and each error in one line."""

import csv
import json
import os
import re
import resource
import subprocess
import sys
import sysconfig
import warnings
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import command_line
from command_line import (
    assert_examples_run,
    assert_numbers,
    assert_plots,
    assert_refused,
    read_table,
    run,
    write_table,
)
from pontryagin import __version__, ledger, papers
from pontryagin.display.recording import read_back
from pontryagin.triple_integrator import (
    Maneuver,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)

ENDS = ["--x0", "-1,0.5,0", "--xf", "pi/4,0,-0.2"]
X0, XF = [-1.0, 0.5, 0.0], [np.pi / 4, 0.0, -0.2]
SOLVERS = {
    "1": minimum_impulse,
    "2": minimum_energy,
    "inf": minimum_peak,
    "3.5": lambda maneuver: minimum_norm(maneuver, 3.5),
}


SOLVE = ("solve", "triple-integrator")


def solve(*arguments):
    return run(*SOLVE, *arguments)


def answer(*arguments):
    return command_line.answer(*SOLVE, *arguments)


class TestSolutions:
    def test_a_rest_to_rest_turn_has_the_peak_that_the_paper_gives(self):
        printed = answer("--norm", "inf", "--x0", "0,0,0", "--xf", "1,0,0", "--duration", "2")
        assert printed["solution"]["norm"] == pytest.approx(32 / 2**3, rel=1e-14)
        assert printed["solution"]["switch_times"] == pytest.approx([0.5, 1.5], rel=1e-14)

    @pytest.mark.parametrize("norm", SOLVERS)
    def test_json_holds_the_numbers_of_the_solver_to_the_last_digit(self, norm):
        printed = answer("--norm", norm, *ENDS, "--t0", "1", "--duration", "2.5", "--disturbance", "0.3")
        solution = SOLVERS[norm](Maneuver(X0, XF, 3.5, t0=1.0, disturbance=0.3))
        assert_numbers(printed["solution"], solution)
        assert_numbers(printed["certificate"], solution.certificate)
        assert printed["problem"]["moments"] == solution.maneuver.moments.tolist()

    def test_json_of_a_least_time_holds_the_numbers_of_the_solver(self):
        printed = answer("--peak", "32", *ENDS, "--disturbance", "1/3")
        assert_numbers(printed["solution"], minimum_time(X0, XF, 32.0, 1 / 3))

    @pytest.mark.parametrize("goal", [["--norm", q, "--duration", "2"] for q in SOLVERS] + [["--peak", "9"]])
    def test_the_states_printed_are_the_given_ends(self, goal):
        printed = answer(*goal, *ENDS)
        assert printed["states"]["start"] == pytest.approx(X0, abs=1e-12)
        assert printed["states"]["end"] == pytest.approx(XF, abs=1e-10)
        assert abs(printed["certificate"]["gap"]) < 1e-10

    def test_json_has_these_keys(self):
        common = {"solver", "x0", "xf", "disturbance"}
        found = {
            "1": {"norm", "regime", "unique", "impulse_times", "impulse_offsets", "impulses", "multipliers"},
            "2": {"norm", "coefficients", "multipliers"},
            "inf": {
                "norm",
                "switch_times",
                "switch_offsets",
                "first_sign",
                "switch_condition",
                "multipliers",
            },
            "3.5": {"q", "norm", "peak", "breakpoints", "breakpoint_offsets", "multipliers"},
        }
        for norm, keys in found.items():
            printed = answer("--norm", norm, *ENDS, "--duration", "2")
            assert set(printed) == {"problem", "solution", "states", "certificate"}
            assert set(printed["problem"]) == common | {"t0", "tf", "duration", "moments"}
            assert set(printed["solution"]) == keys
        printed = answer("--peak", "1", *ENDS)
        assert set(printed["problem"]) == common | {"peak"}
        assert set(printed["solution"]) == found["inf"] | {"duration"}

    def test_a_formula_as_disturbance_acts_as_the_function(self):
        printed = answer("--norm", "2", *ENDS, "--duration", "2", "--disturbance", "0.1*sin(3*t) + t^2")
        maneuver = Maneuver(X0, XF, 2.0, disturbance=lambda t: 0.1 * np.sin(3 * t) + t * t)
        assert printed["problem"]["moments"] == pytest.approx(maneuver.moments.tolist(), abs=1e-13)
        assert printed["problem"]["disturbance"] == "0.1*sin(3*t) + t^2"

    def test_a_narrow_feature_of_a_formula_is_found(self):
        bump = "exp(-((t - 1.0628)/1e-6)^2)*1e6"
        printed = answer("--norm", "2", *ENDS, "--duration", "2", "--disturbance", bump)
        moved = Maneuver(X0, XF, 2.0).moments - np.sqrt(np.pi) * np.array([2 - 1.0628, 1, 0])
        assert printed["problem"]["moments"] == pytest.approx(moved.tolist(), rel=1e-11)
        assert printed["problem"]["disturbance"] == bump

    def test_samples_are_the_solution_at_even_times(self):
        printed = answer("--norm", "2", *ENDS, "--duration", "2", "--samples", "5")["samples"]
        solution = minimum_energy(Maneuver(X0, XF, 2.0))
        assert printed["t"] == [0.0, 0.5, 1.0, 1.5, 2.0]
        for name in ("control", "state", "costate"):
            assert printed[name] == getattr(solution, name)(printed["t"]).tolist()

    def test_a_switch_that_does_not_happen_is_null(self):
        printed = answer("--norm", "inf", "--x0", "0,0,0", "--xf", "0,0,0", "--duration", "1")
        assert printed["solution"]["switch_times"] == [None, None]
        assert printed["solution"]["norm"] == 0

    def test_equal_ends_need_no_time(self):
        printed = answer("--peak", "1", "--x0", "1,2,3", "--xf", "1,2,3")
        assert printed["solution"]["duration"] == 0
        assert printed["states"]["end"] == [1, 2, 3]

    @pytest.mark.parametrize("norm", SOLVERS)
    def test_the_table_shows_norm_and_certificate(self, norm):
        shown = solve("--norm", norm, *ENDS, "--duration", "2").stdout
        solution = SOLVERS[norm](Maneuver(X0, XF, 2.0))
        assert re.search(rf"^ +norm +{float(solution.norm):.12g} *$", shown, re.MULTILINE)
        bound, cost = (float(getattr(solution.certificate, side)) for side in ("dual_value", "primal_value"))
        assert f"No control does better than {bound:.12g}, and this one costs {cost:.12g}." in shown
        for quantity in ("primal residual", "dual value", "gap", "start", "end", "multipliers"):
            assert re.search(rf"^ +{quantity} ", shown, re.MULTILINE), quantity


class TestFiles:
    GOAL = ("--norm", "1", *ENDS, "--duration", "2")

    @pytest.mark.slow
    def test_a_plot_is_drawn_in_the_format_of_its_name(self, tmp_path):
        assert_plots(tmp_path, *SOLVE, *self.GOAL)
        size = ElementTree.parse(tmp_path / "a.svg").getroot().attrib["viewBox"].split()
        assert float(size[2]) > 300
        assert float(size[3]) > 200

    @pytest.mark.extra(name="recording")
    def test_a_recording_holds_the_motion(self, tmp_path):
        path = tmp_path / "motion.rrd"
        assert solve("--norm", "2", *ENDS, "--duration", "2", "--record", path).exit_code == 0
        solution = minimum_energy(Maneuver(X0, XF, 2.0))
        curves = [parts for parts in read_back(path).values() if "scalars" in parts]
        angle = solution.state(curves[0]["time"])[:, 0]
        assert any(
            curve["scalars"].shape == angle.shape and np.allclose(curve["scalars"], angle, atol=1e-12)
            for curve in curves
        )

    def test_a_plot_of_no_motion_is_refused(self, tmp_path):
        result = solve("--peak", "1", "--x0", "1,2,3", "--xf", "1,2,3", "--plot", tmp_path / "a.svg")
        assert_refused(result, "--plot")
        assert not list(tmp_path.iterdir())

    @pytest.mark.parametrize(
        ("option", "name"),
        [
            ("--plot", "a.svg"),
            pytest.param("--record", "a.rrd", marks=pytest.mark.extra(name="recording")),
        ],
    )
    def test_a_path_that_cannot_be_written_is_named(self, tmp_path, option, name):
        (tmp_path / "file").touch()
        result = solve("--norm", "2", *ENDS, "--duration", "2", option, tmp_path / "file" / name)
        assert_refused(result, f"{option} cannot write {tmp_path / 'file' / name}")


GOAL = ["--norm", "2", "--x0", "0,0,0", "--xf", "1,0,0", "--duration", "2"]


def options(**changes):
    """The options of a valid command, some of them replaced, removed (None) or added."""
    options = dict(zip(GOAL[::2], GOAL[1::2], strict=True))
    options |= {f"--{name}": value for name, value in changes.items()}
    return [part for option, value in options.items() if value is not None for part in (option, value)]


class TestRefusals:
    @pytest.mark.parametrize(
        ("arguments", "begins"),
        [
            (options(x0="0,0"), "--x0 takes 3 numbers separated by commas, got '0,0'"),
            (options(x0="0,nan,0"), "--x0 takes"),
            (options(xf="1,two,3"), "--xf takes"),
            (options(x0=None), "--x0 is missing"),
            (options(duration="0"), "--duration takes a positive number, got '0'"),
            (options(duration="-1"), "--duration takes"),
            (options(duration="1e999"), "--duration takes"),
            (options(duration=None), "--duration is missing"),
            (options(t0="1e30"), "--duration is lost to rounding"),
            (options(t0="1e9", duration="1e-3"), "--duration would become 0.00100004673 on a clock"),
            (options(t0="now"), "--t0 takes"),
            (options(norm="0.5"), "--norm takes 1, 2, inf"),
            (options(norm="L2"), "--norm takes"),
            (options(norm="nan"), "--norm takes"),
            (options(norm=None), "--norm is missing"),
            (options(peak="1"), "--norm cannot be combined with --peak"),
            (options(peak="1", norm=None), "--duration cannot be combined with --peak"),
            (options(peak="0", norm=None, duration=None), "--peak takes a positive number"),
            (
                options(peak="1", norm=None, duration=None, disturbance="t"),
                "--disturbance takes a number",
            ),
            (options(disturbance="open('x')"), "--disturbance: \"open('x')\" is not a formula"),
            (options(disturbance="1/(t-1)"), "--disturbance must be finite"),
            (options(disturbance="sqrt(t-1)"), "--disturbance must be finite"),
            (
                options(plot="a.gif"),
                "--plot takes a file name ending in .svg or .pdf or .png, got a.gif",
            ),
            (options(record="a.mp4"), "--record takes a file name ending in .rrd"),
            (options(samples="3"), "--samples needs --json"),
            (options(samples="-3"), "Invalid value for '--samples'"),
            (options(out="a.csv"), "--out needs --batch"),
            (options(batch="a.csv"), "--duration cannot be combined with --batch"),
            (options(colour="red"), "No such option: --colour"),
            ([*options(), "again"], "Got unexpected extra argument"),
            (["--x0"], "Option '--x0' requires an argument"),
            (
                options(xf="1e308,0,0", duration="1e-200"),
                "--xf must give with x0 and tf - t0 a control",
            ),
            (
                options(xf="1e308,0,0", duration="1e-200", norm="3"),
                "--xf must give with x0 and tf - t0 a control",
            ),
            (
                options(xf="1e308,0,0", peak="1e-300", norm=None, duration=None),
                "--xf must give with x0 and peak a motion",
            ),
        ],
    )
    def test_a_wrong_option_is_named_in_one_line(self, arguments, begins):
        assert_refused(solve(*arguments), begins)

    @pytest.mark.parametrize(
        "arguments",
        [
            options(disturbance="1/t"),
            options(norm="1.0000001"),
        ],
    )
    def test_a_problem_without_an_answer_exits_with_1_and_a_line(self, arguments):
        assert_refused(solve(*arguments), "", status=1)

    @pytest.mark.parametrize(
        ("arguments", "begins"),
        [
            (["solve", "double-integrator"], "No such command 'double-integrator'"),
            (["ledgers"], "No such command 'ledgers'"),
            (["ledger", "--verdict", "wrong"], "--verdict: got 'wrong', takes one of 'holds'"),
            (["ledger", "--paper", "Newton"], "--paper: got 'Newton'"),
            pytest.param(
                ["report", "everything"],
                "STAGE takes notebooks, figures, recordings, report, got 'everything'",
                marks=pytest.mark.extra(name="report"),
            ),
        ],
    )
    def test_the_other_commands_name_wrong_options(self, arguments, begins):
        assert_refused(run(*arguments), begins)


class TestBatch:
    HEADER = ("name", "x10", "x20", "x30", "x1f", "x2f", "x3f", "t0", "tf")
    ROWS = (
        ["first", "0", "0", "0", "1", "0", "0", "0", "2"],
        ["second", "-1", "0.5", "0", "pi/4", "0", "-0.2", "1", "3.5"],
        ["rest", "0", "0", "0", "0", "0", "0", "0", "1"],
    )

    def write(self, folder, rows=ROWS, header=HEADER):
        return write_table(folder / "problems.csv", header, rows)

    @pytest.mark.parametrize("norm", SOLVERS)
    def test_each_row_comes_back_with_its_own_solution(self, tmp_path, norm):
        problems, results = self.write(tmp_path), tmp_path / "out.csv"
        result = solve("--norm", norm, "--batch", problems, "--out", results)
        assert (result.exit_code, result.stdout) == (0, "")
        rows = read_table(results.read_text())
        assert [row["name"] for row in rows] == ["first", "second", "rest"]
        assert rows[1]["x1f"] == "pi/4"
        single = SOLVERS[norm](Maneuver(X0, XF, 3.5, t0=1.0))
        assert float(rows[1]["norm"]) == pytest.approx(float(single.norm), rel=1e-12)
        assert float(rows[0]["norm"]) > float(rows[2]["norm"]) == 0
        assert all(abs(float(row["gap"])) < 1e-10 for row in rows)

    def test_vectors_become_columns_and_absent_impulses_are_empty(self, tmp_path):
        rows = read_table(solve("--norm", "1", "--batch", self.write(tmp_path)).stdout)
        assert [float(rows[0][f"impulses_{i}"]) for i in (1, 2, 3)] == pytest.approx([1, -2, 1])
        assert [rows[2][f"impulse_times_{i}"] for i in (1, 2, 3)] == ["", "", ""]
        assert [row["regime"] for row in rows] == ["chebyshev", rows[1]["regime"], "zero"]

    def test_least_times_need_no_times(self, tmp_path):
        rows = [row[1:7] for row in self.ROWS]
        problems = self.write(tmp_path, rows, self.HEADER[1:7])
        found = read_table(solve("--peak", "32", "--batch", problems).stdout)
        durations = [float(row["duration"]) for row in found]
        assert durations[0] == pytest.approx(1.0, rel=1e-12)
        assert durations[1] == pytest.approx(float(minimum_time(X0, XF, 32.0).duration), rel=1e-12)
        assert durations[2] == 0

    @pytest.mark.parametrize(
        ("rows", "header", "line"),
        [
            ([[*ROWS[1][:3], "much", *ROWS[1][4:]]], HEADER, "line 2: x30 takes a number, got 'much'"),
            ([ROWS[2][:5]], HEADER, "line 2: has 5 entries, but the header has 9"),
            ([[*ROWS[1][:8], "1"]], HEADER, "line 2: tf must be later than t0, got t0 = 1.0 and tf = 1.0"),
            ([[*ROWS[1][:8], "nan"]], HEADER, "line 2: tf takes a number"),
            (ROWS, ["name", "y10", *HEADER[2:]], "line 1: column x10 is missing"),
            ([], HEADER, "line 2: the file holds no problem"),
        ],
    )
    def test_a_bad_row_is_named_by_its_line(self, tmp_path, rows, header, line):
        problems = self.write(tmp_path, rows, header)
        assert_refused(solve("--norm", "2", "--batch", problems), f"--batch: {problems}, {line}")

    def test_a_file_that_is_not_there_is_named(self, tmp_path):
        result = solve("--norm", "2", "--batch", tmp_path / "in.csv")
        assert_refused(result, f"--batch cannot read {tmp_path / 'in.csv'}")

    def test_a_row_beyond_floating_point_is_named_and_loses_no_other(self, tmp_path):
        hopeless = ["far", "0", "0", "0", "1e308", "0", "0", "0", "1e-200"]
        problems = self.write(tmp_path, [*self.ROWS, hopeless])
        result = solve("--norm", "inf", "--batch", problems)
        assert result.exit_code == 1
        reason = "xf must give with x0 and tf - t0 a control"
        assert result.stderr.startswith(
            f"Error: --batch: {problems}, 1 of 4 rows, the first of them in line 5: {reason}"
        )
        rows = read_table(result.stdout)
        assert [bool(row["norm"]) for row in rows] == [True, True, True, False]
        assert [row["error"][:20] for row in rows] == ["", "", "", reason[:20]]
        assert "index" not in result.stderr


class TestLedger:
    def test_csv_and_json_are_the_ledger(self, tmp_path):
        path = tmp_path / "ledger.csv"
        assert run("ledger", "--verdict", "misprint", "--csv", path).exit_code == 0
        entries = ledger.entries(verdict="misprint")
        with path.open(newline="", encoding="utf-8") as file:
            assert [row["label"] for row in csv.DictReader(file)] == [entry.label for entry in entries]
        printed = json.loads(run("ledger", "--paper", "gorelov", "--json", "-").stdout)
        assert printed == [entry.as_dict() for entry in ledger.entries(paper="gorelov")]

    def test_the_table_shows_the_chosen_entries(self):
        shown = run("ledger", "--verdict", "misprint").stdout
        entries = ledger.entries(verdict="misprint")
        assert f"{len(entries)} entries" in shown
        assert all(entry.label.split()[0] in shown for entry in entries)


def test_the_report_without_its_extra_names_it(monkeypatch):
    from pontryagin import report

    monkeypatch.delattr(report, "build", raising=False)
    monkeypatch.setitem(sys.modules, "pontryagin.report.build", None)
    result = run("report", "figures")
    assert result.exit_code == 1
    assert result.stderr.endswith("which is not installed: pip install 'pontryagin[report]'\n")


@pytest.mark.extra(name="report")
class TestReport:
    @pytest.fixture
    def build(self):
        """The module that builds the report; it needs the extra."""
        from pontryagin.report import build

        return build

    def test_it_builds_up_to_the_stage_and_hands_on_the_status(self, monkeypatch, build):
        calls = []
        monkeypatch.setattr(build, "main", lambda arguments: calls.append(arguments) or 1)
        assert run("report", "figures", "--workers", "1").exit_code == 1
        assert calls == [["figures", "--workers", "1"]]

    def test_every_stage_is_in_the_help(self, build):
        printed = run("report", "--help").stdout
        assert all(stage in printed for stage in build.STAGES)


class TestWarnings:
    def test_a_warning_is_one_line_and_no_failure(self, monkeypatch):
        def noisy(paper, verdict):
            warnings.warn("numba is not installed;\nlarge stacks run slowly", UserWarning, stacklevel=1)
            return ()

        monkeypatch.setattr(ledger, "entries", noisy)
        result = run("ledger", "--json", "-")
        assert (result.exit_code, result.stdout) == (0, "[]\n")
        assert result.stderr == "Warning: numba is not installed; large stacks run slowly\n"


class TestHelp:
    @pytest.mark.parametrize("arguments", [[], ["solve"], ["--help"], ["solve", "--help"]])
    def test_without_a_command_it_prints_the_help(self, arguments):
        result = run(*arguments)
        assert (result.exit_code, result.stderr) == (0, "")
        assert "Example" in result.stdout

    @pytest.mark.parametrize("name", papers.commands())
    def test_every_paper_is_a_command_with_examples(self, name):
        assert name in run("solve", "--help").stdout
        assert "Examples:" in run("solve", name, "--help").stdout

    def test_every_verdict_is_in_the_help(self):
        shown = " ".join(run("ledger", "--help").stdout.split())
        assert ", ".join(ledger.VERDICTS) in shown

    def test_every_example_in_the_help_runs(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)
        TestBatch().write(tmp_path)
        assert_examples_run(6, SOLVE, ["ledger"])


class TestProcess:
    """What only a separate process shows."""

    PROGRAM = str(Path(sysconfig.get_path("scripts")) / "pontryagin")
    TURN = (
        "solve",
        "triple-integrator",
        "--norm",
        "inf",
        "--x0",
        "0,0,0",
        "--xf",
        "1,0,0",
        "--duration",
        "2",
    )

    def process(self, *arguments, **options):
        return subprocess.run(
            [self.PROGRAM, *arguments], capture_output=True, text=True, timeout=120, check=False, **options
        )

    def test_the_version(self):
        assert self.process("--version").stdout == f"pontryagin {__version__}\n"

    def test_a_cold_start_takes_at_most_seconds_of_processor_time(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        result = self.process(*self.TURN)
        spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        assert (result.returncode, result.stderr) == (0, "")
        assert re.search(r"norm +4 ", result.stdout)
        assert spent < 2.5

    def test_an_answer_imports_nothing_heavy(self):
        script = "import sys; from pontryagin.cli import main; sys.argv[0] = 'pontryagin'\ntry: main()\n"
        script += "except SystemExit: print(*sorted({name.split('.')[0] for name in sys.modules}))"
        arguments = [*self.TURN, "--disturbance", "0.1*sin(t)"]
        shown = subprocess.run(
            [sys.executable, "-c", script, *arguments],
            capture_output=True,
            text=True,
            timeout=120,
            check=True,
        )
        loaded = set(shown.stdout.splitlines()[-1].split())
        assert {"numpy", "typer"} <= loaded
        assert not loaded & {"sympy", "scipy", "numba", "matplotlib", "rerun", "IPython"}

    def test_a_mistake_is_one_line_and_exit_code_2(self):
        result = self.process(*self.TURN[:-1], "-2")
        assert (result.returncode, result.stdout) == (2, "")
        assert result.stderr == "Error: --duration takes a positive number, got '-2'\n"

    def test_a_terminal_without_unicode_gets_its_answer(self):
        result = self.process(*self.TURN, env=os.environ | {"PYTHONIOENCODING": "ascii"})
        assert (result.returncode, result.stderr) == (0, "")

    @pytest.mark.slow
    def test_a_closed_pipe_is_no_error(self):
        with subprocess.Popen(
            [self.PROGRAM, "ledger"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as running:
            running.stdout.readline()
            running.stdout.close()
            assert running.stderr.read() == ""
