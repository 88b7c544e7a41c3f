"""The command line prints what the solver found, and reports every mistake in one line."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from command_line import (
    answer,
    assert_examples_run,
    assert_numbers,
    assert_plots,
    assert_refused,
    read_table,
    run,
    write_table,
)
from pontryagin.display.recording import read_back
from pontryagin.orbit_correction import correct, printed
from pontryagin.orbit_correction.system.satellite import LINEAR

STATE = list(printed.Z0)
Z0 = ",".join(map(str, STATE))


SOLVE = ("solve", "orbit-correction")


def solve(*arguments):
    return run(*SOLVE, *arguments)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_json_holds_the_numbers_of_the_solver_to_the_last_digit(thrust):
    report = answer(*SOLVE, "--z0", Z0, "--interval", "pi/8", "--peak", "4e-3", "--thrust", thrust)
    plan = correct(STATE, np.pi / 8, 4e-3, thrust)
    assert report["problem"] == {"z0": STATE, "interval": np.pi / 8, "peak": 4e-3, "thrust": thrust}
    assert_numbers(report["solution"], plan)
    assert_numbers(report["certificate"], plan.certificate)
    assert_allclose(report["states"]["end"], 0, atol=1e-15)


@pytest.mark.parametrize("thrust", ["ball", "box"])
def test_samples_are_the_linear_motion_and_its_costate(thrust):
    report = answer(*SOLVE, "--z0", Z0, "--thrust", thrust, "--samples", 31)["samples"]
    plan = correct(STATE, thrust=thrust)
    assert report["t"] == np.linspace(0, 0.25 * float(plan.impulse_count), 31).tolist()
    state, fired = np.array(STATE), 0
    for before, after, expected in zip(report["t"], report["t"][1:], report["state"][1:], strict=False):
        while fired < plan.impulse_count and 0.25 * fired <= before + 1e-12:
            state = expm(-LINEAR * (0.25 * fired - before)) @ np.append(0, plan.impulses[fired]) + state
            fired += 1
        state = expm(LINEAR * (after - before)) @ state
        if fired == plan.impulse_count or 0.25 * fired > after + 1e-12:
            assert_allclose(expected, state, atol=1e-15)
    costate = [expm(-LINEAR.T * t) @ plan.initial_costate for t in report["t"]]
    assert_allclose(report["costate"], costate, atol=1e-14)
    assert_refused(solve("--z0", Z0, "--samples", 3), "--samples needs --json")


def test_without_options_it_is_the_paper_s_example():
    shown = solve("--z0", Z0).stdout
    assert re.search(r"^ +gauge +0\.92857380200", shown, re.MULTILINE)
    assert re.search(r"^ +impulse count +6 *$", shown, re.MULTILINE)
    assert "With 4 steps the plan needs 0.92857" in shown and "with one step fewer it" in shown


def test_what_two_impulses_do_needs_no_fewer():
    shown = " ".join(solve("--z0", "1e-4,0,0", "--thrust", "disc").stdout.split())
    assert "no peak suffices with fewer impulses." in shown


def test_nothing_to_correct():
    assert "Nothing is to be corrected." in solve("--z0", "0,0,0").stdout
    assert_refused(solve("--z0", "0,0,0", "--plot", "a.svg"), "--plot needs a plan with impulses")


@pytest.mark.slow
@pytest.mark.extra(name="recording")
def test_files_are_drawn_and_recorded(tmp_path):
    assert_plots(tmp_path, *SOLVE, "--z0", Z0)
    assert solve("--z0", Z0, "--thrust", "disc", "--record", tmp_path / "a.rrd").exit_code == 0
    held = read_back(tmp_path / "a.rrd")
    gauge = float(correct(STATE, thrust="disc").gauge)
    assert_allclose(held["/gauge/alpha"]["scalars"][:20], gauge, rtol=1e-9)


@pytest.mark.parametrize(
    ("arguments", "begins"),
    [
        ([], "--z0 is missing"),
        (["--z0", "1,2"], "--z0 takes 3 numbers"),
        (["--z0", "1,nan,2"], "--z0 takes"),
        (["--z0", Z0, "--interval", "0"], "--interval takes a positive number, got '0'"),
        (["--z0", Z0, "--peak", "-1"], "--peak takes a positive number"),
        (["--z0", Z0, "--thrust", "cone"], "--thrust takes ball, disc, box, got 'cone'"),
        (["--z0", Z0, "--plot", "a.gif"], "--plot takes a file name ending"),
        (["--z0", Z0, "--record", "a.mp4"], "--record takes a file name ending"),
        (["--z0", Z0, "--out", "a.csv"], "--out needs --batch"),
        (["--z0", Z0, "--batch", "a.csv"], "--z0 cannot be combined with --batch"),
        (["--batch", "none.csv"], "--batch cannot read none.csv"),
    ],
)
def test_what_was_typed_wrong_is_named_in_one_line(arguments, begins):
    assert_refused(solve(*arguments), begins)


def test_what_cannot_be_reached_exits_with_1_and_the_reason():
    result = solve("--z0", Z0, "--interval", "2*pi")
    assert_refused(result, "", status=1)
    assert "revolutions" in result.stderr


class TestBatch:
    HEADER = ("name", "dr", "dv_R", "dv_T")
    ROWS = (["a", *Z0.split(",")], ["b", "0.01", "0", "1/300"], ["none", "0", "0", "0"])

    def test_each_row_comes_back_with_its_own_plan(self, tmp_path):
        states, results = write_table(tmp_path / "in.csv", self.HEADER, self.ROWS), tmp_path / "out.csv"
        result = solve("--batch", states, "--out", results, "--thrust", "box")
        assert (result.exit_code, result.stdout) == (0, "")
        rows = read_table(results.read_text())
        assert [row["name"] for row in rows] == ["a", "b", "none"] and rows[1]["dv_T"] == "1/300"
        for row, state in zip(rows, [STATE, [0.01, 0, 1 / 300], [0, 0, 0]], strict=True):
            plan = correct(state, thrust="box")
            assert int(row["impulse_count"]) == plan.impulse_count
            assert float(row["gauge"]) == pytest.approx(float(plan.gauge), rel=1e-12)
            fired = [row[name] for name in row if name.startswith("w") and row[name]]
            assert_allclose([float(text) for text in fired], plan.impulses.ravel(), atol=1e-15)

    @pytest.mark.parametrize(
        ("rows", "header", "line"),
        [
            ([["a", "0", "much", "0"]], HEADER, "line 2: dv_R takes a number"),
            ([["a", "0", "0"]], HEADER, "line 2: has 3 entries, but the header has 4"),
            ([["0", "0"]], ("dr", "dv_R"), "line 1: column dv_T is missing"),
            ([], ("dr", "dv_R", "dv_T"), "line 2: the file holds no problem"),
        ],
    )
    def test_a_bad_row_is_named_by_its_line(self, tmp_path, rows, header, line):
        path = write_table(tmp_path / "in.csv", header, rows)
        assert_refused(solve("--batch", path), f"--batch: {path}, {line}")


def test_every_example_in_the_help_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_table(tmp_path / "states.csv", TestBatch.HEADER, TestBatch.ROWS)
    assert_examples_run(4, SOLVE)
