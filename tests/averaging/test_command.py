"""The command line prints the solvers' results, and one line for every mistake of the user."""

import csv
import io
import json
import re

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from typer.testing import CliRunner

from pontryagin.averaging import kepler, rotor, smooth_example, spin_down
from pontryagin.cli import app
from pontryagin.display.recording import read_back
from pontryagin.progress import listening

KEPLER = ["--E0", "-1/2", "--K0", "0.95", "--E1", "-0.35", "--l", "0.1"]
SMOOTH = ["--v0", "1", "--v1", "2", "--ripple", "0.5"]
ROTOR = ["--a0", "2", "--a1", "4", "--mass", "1 + 0.2*cos(x)", "--potential", "cos(x)", "--force", "-v/5"]
SPIN = ["--omega0", "3,4,2", "--semiaxes", "1,1,0.5", "--ratio", "1/2"]
X, V = sp.symbols("x v", real=True)
FORMULAS = {"mass": 1 + sp.cos(X) / 5, "potential": sp.cos(X), "force": -V / 5}


def solve(example, *arguments):
    arguments = ["solve", "averaging", "--example", example, *(str(argument) for argument in arguments)]
    return CliRunner().invoke(app, arguments, catch_exceptions=False)


def answer(*arguments):
    result = solve(*arguments, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def assert_refused(result, begins, status=2):
    assert (result.exit_code, result.stdout) == (status, "")
    assert result.stderr.startswith(f"Error: {begins}"), result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("example", "arguments", "solution"),
    [
        ("kepler", KEPLER, lambda: kepler(-0.5, 0.95, -0.35, 0.1)),
        ("smooth", SMOOTH, lambda: smooth_example(1.0, 2.0, ripple=0.5)),
        ("smooth", [*SMOOTH, "--k", "4"], lambda: smooth_example(1.0, 2.0, 4.0, 0.5)),
        ("rotor", [*ROTOR, "--k", "1"], lambda: rotor(2.0, 4.0, **FORMULAS, k=1.0)),
        ("rotor", [*ROTOR, "--peak", "2"], lambda: rotor(2.0, 4.0, **FORMULAS, peak=2.0)),
        ("spin-down", SPIN, lambda: spin_down([3.0, 4.0, 2.0], [1.0, 1.0, 0.5], 0.5)),
    ],
)
def test_json_holds_the_numbers_of_the_solver_to_the_last_digit(example, arguments, solution):
    told, known = answer(example, *arguments), solution()
    for name in ("duration", "cost", "multipliers"):
        assert told["averaged"][name] == getattr(known, name).tolist(), name
    assert told["averaged"]["initial_costate"] == known.costate([0.0])[0].tolist()
    for name, value in told["certificate"].items():
        assert value == float(getattr(known.certificate, name)), name
    assert told["problem"]["example"] == example and "exact" not in told


def test_epsilon_adds_every_extremal_and_the_corrected_cost():
    told = answer("smooth", *SMOOTH, "--epsilon", "0.1", "--phase", "pi/3")
    solution = smooth_example(1.0, 2.0, ripple=0.5)
    exact = solution.exact(0.1, np.pi / 3)
    columns = told["exact"]
    assert columns["count"] == len(exact) > 2
    assert columns["minima"] == columns["kind"].count("minimum")
    assert columns["cost"] == [extremal.cost for extremal in exact] == sorted(columns["cost"])
    assert columns["kind"] == [extremal.kind for extremal in exact]
    assert columns["duration"] == [extremal.duration for extremal in exact]
    assert max(columns["residual"]) < 1e-9
    correction = float(solution.correction(np.pi / 3))
    assert told["corrected"]["correction"] == pytest.approx(correction, rel=1e-12)
    assert told["corrected"]["cost"] == pytest.approx(2 + 0.1 * correction, rel=1e-12)
    assert abs(told["corrected"]["cost"] - columns["cost"][0]) < 0.2 * abs(2 - columns["cost"][0])


def test_the_table_shows_the_best_extremals_and_says_how_many_there_are():
    shown = solve("smooth", *SMOOTH, "--epsilon", "0.05").stdout
    exact = smooth_example(1.0, 2.0, ripple=0.5).exact(0.05)
    assert re.search(rf"^ +extremals +{len(exact)} *$", shown, re.MULTILINE)
    assert f"minimum: cost {exact[0].cost:.8g}" in shown
    assert re.search(
        rf"^ +further +{len(exact) - 6}, with costs up to {exact[-1].cost:.10g}", shown, re.MULTILINE
    )
    assert "no bound from below is claimed" in " ".join(shown.split())


def test_without_epsilon_it_is_the_first_approximation():
    shown = solve("kepler", *KEPLER).stdout
    assert re.search(r"^ +duration +0\.516526349104 *$", shown, re.MULTILINE)
    assert "The least cost is 0.103305269821 + O(epsilon)." in shown


@pytest.mark.slow
@pytest.mark.extra(name="recording")
def test_files_are_drawn_and_recorded(tmp_path):
    for name, start in {"a.svg": b"<?xml", "a.png": b"\x89PNG"}.items():
        result = solve("smooth", *SMOOTH, "--plot", tmp_path / name)
        assert (result.exit_code, result.stderr) == (0, f"wrote {tmp_path / name}\n")
        assert (tmp_path / name).read_bytes().startswith(start)
    files = ["--plot", tmp_path / "b.pdf", "--record", tmp_path / "b.rrd"]
    assert solve("smooth", *SMOOTH, "--epsilon", "0.1", *files).exit_code == 0
    assert (tmp_path / "b.pdf").read_bytes().startswith(b"%PDF")
    best = smooth_example(1.0, 2.0, ripple=0.5).exact(0.1)[0]
    held = read_back(tmp_path / "b.rrd")
    assert held["/cost/exact"]["scalars"][-1] == pytest.approx(best.cost, rel=1e-9)


@pytest.mark.parametrize(
    ("example", "arguments", "begins"),
    [
        ("kepler", KEPLER[2:], "--E0 is missing"),
        ("pendulum", [], "--example takes kepler, smooth, rotor, spin-down, got 'pendulum'"),
        ("kepler", [*KEPLER, "--v0", "1"], "--v0 cannot be combined with --example kepler"),
        ("kepler", [*KEPLER, "--k", "1"], "--k cannot be combined with --example kepler"),
        ("smooth", [*SMOOTH, "--peak", "1"], "--peak cannot be combined with --example smooth"),
        (
            "spin-down",
            [*SPIN, "--phase", "1", "--epsilon", "1"],
            "--phase cannot be combined with --example spin",
        ),
        ("kepler", [*KEPLER[:1], "0.5", *KEPLER[2:]], "--E0 must be negative"),
        ("kepler", [*KEPLER[:1], "nan", *KEPLER[2:]], "--E0 takes a number, got 'nan'"),
        ("kepler", [*KEPLER[:3], "1.5", *KEPLER[4:]], "--K0 must be below"),
        ("kepler", [*KEPLER[:-1], "0"], "--l must be"),
        ("smooth", ["--v0", "-1", "--v1", "2"], "--v0 must be"),
        ("rotor", ROTOR, "--peak or --k must be given"),
        ("rotor", [*ROTOR, "--peak", "1", "--k", "1"], "--peak cannot be combined with --k"),
        ("rotor", [*ROTOR[:1], "0.5", *ROTOR[2:], "--k", "1"], "--a0 must exceed"),
        ("rotor", [*ROTOR[:4], "--mass", "cos(x)", "--k", "1"], "--mass must be positive"),
        ("rotor", [*ROTOR[:4], "--mass", "x + 2", "--k", "1"], "--mass must be 2 pi-periodic"),
        ("rotor", [*ROTOR[:4], "--mass", "__import__('os')", "--k", "1"], "--mass: \"__import__('os')\""),
        ("rotor", [*ROTOR[:4], "--potential", "cos(v)", "--k", "1"], "--potential: 'v' is not"),
        ("spin-down", [*SPIN[:1], "3,4", *SPIN[2:]], "--omega0 takes 3 numbers"),
        ("spin-down", [*SPIN[:1], "3,4,0", *SPIN[2:]], "--omega0 must have w_z other than 0"),
        ("spin-down", [*SPIN[:-1], "1"], "--ratio must differ from 1"),
        ("smooth", [*SMOOTH, "--epsilon", "0"], "--epsilon takes a positive number"),
        ("smooth", [*SMOOTH, "--phase", "1"], "--phase needs --epsilon"),
        ("smooth", [*SMOOTH, "--record", "a.rrd"], "--record needs --epsilon"),
        ("smooth", [*SMOOTH, "--plot", "a.gif"], "--plot takes a file name ending"),
        ("smooth", [*SMOOTH, "--out", "a.csv"], "--out needs --batch"),
        (
            "smooth",
            [*SMOOTH, "--batch", "a.csv", "--plot", "a.svg"],
            "--plot cannot be combined with --batch",
        ),
        ("smooth", ["--batch", "none.csv"], "--batch cannot read none.csv"),
        ("smooth", ["--v0", "1", "--v1", "1", "--plot", "a.svg"], "--plot needs a motion"),
    ],
)
def test_what_was_typed_wrong_is_named_in_one_line(example, arguments, begins):
    assert_refused(solve(example, *arguments), begins)


def test_what_cannot_be_reached_exits_with_1_and_the_reason():
    result = solve("rotor", "--a0", "2", "--a1", "4", "--force", "-3", "--peak", "1")
    assert_refused(result, "the target cannot be reached", status=1)


class TestBatch:
    def rows(self, path):
        return list(csv.DictReader(io.StringIO(path.read_text())))

    def test_columns_are_problems_and_options_are_common_to_all(self, tmp_path):
        given, results = tmp_path / "in.csv", tmp_path / "out.csv"
        given.write_text("name,E0,K0,E1\na,-1/2,0.95,-0.35\nb,-0.4,0.5,-0.8\n")
        result = solve("kepler", "--l", "0.1", "--batch", given, "--out", results)
        assert (result.exit_code, result.stdout) == (0, "")
        known = kepler([-0.5, -0.4], [0.95, 0.5], [-0.35, -0.8], 0.1)
        for i, row in enumerate(self.rows(results)):
            assert row["name"] == "ab"[i]
            assert float(row["cost"]) == pytest.approx(float(known.cost[i]), rel=1e-12)
            assert float(row["duration"]) == pytest.approx(float(known.duration[i]), rel=1e-12)
            assert float(row["residual"]) < 1e-9

    def test_three_columns_make_a_vector(self, tmp_path):
        given, results = tmp_path / "in.csv", tmp_path / "out.csv"
        given.write_text("omega_x,omega_y,omega_z,ratio\n3,4,2,0.5\n1,0,-1,3\n")
        solve("spin-down", "--semiaxes", "1,1,0.5", "--batch", given, "--out", results)
        assert_allclose([float(row["cost"]) for row in self.rows(results)], [5.0, 1.0], rtol=1e-9)

    def test_epsilon_corrects_each_row(self, tmp_path):
        given, results = tmp_path / "in.csv", tmp_path / "out.csv"
        given.write_text("v0,v1,ripple\n1,2,0.5\n1,3,0.2\n")
        solve("smooth", "--epsilon", "0.1", "--batch", given, "--out", results)
        known = smooth_example([1.0, 1.0], [2.0, 3.0], ripple=[0.5, 0.2])
        corrected = [float(row["corrected_cost"]) for row in self.rows(results)]
        assert_allclose(corrected, known.cost + 0.1 * known.correction(), rtol=1e-12)

    @pytest.mark.parametrize(
        ("arguments", "text", "begins"),
        [
            ([], "v0\n1\n", "--batch: {path}, line 1: column v1 is missing"),
            (["--v1", "2"], "v0\nfast\n", "--batch: {path}, line 2: v0 takes a number"),
            (["--v1", "2", "--k", "3"], "v0,k\n1,2\n", "--k cannot be combined with the column of {path}"),
            (["--v1", "2"], "v0\n-1\n", "--batch: {path}, line 2: v0 must be"),
            (["--v1", "-2"], "v0\n1\n", "--v1 must be"),
        ],
    )
    def test_what_is_wrong_is_named(self, tmp_path, arguments, text, begins):
        given = tmp_path / "in.csv"
        given.write_text(text)
        assert_refused(solve("smooth", *arguments, "--batch", given), begins.format(path=given))


@pytest.mark.slow
def test_every_example_in_the_help_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "orbits.csv").write_text("E0,K0,E1\n-0.5,0.95,-0.35\n")
    shown = CliRunner().invoke(app, ["solve", "averaging", "--help"]).stdout
    examples = re.findall(r"^ +pontryagin (.*)$", shown, re.MULTILINE)
    assert len(examples) == 5
    for example in examples:
        assert CliRunner().invoke(app, example).exit_code == 0, example


def test_an_interrupted_search_leaves_the_averaged_solution():
    def interrupt(doing, done, total):
        raise KeyboardInterrupt

    with listening(interrupt):
        result = solve("smooth", *SMOOTH, "--epsilon", "0.1")
        with pytest.raises(KeyboardInterrupt):
            smooth_example(1.0, 2.0, ripple=0.5).exact(0.1)
    assert (result.exit_code, result.stderr) == (130, "Interrupted: the averaged solution alone is printed\n")
    assert "The least cost is 2 + O(epsilon)." in result.stdout


def test_the_search_reports_its_turns_and_the_extremals_found():
    said = []
    with listening(lambda *what: said.append(what)):
        exact = smooth_example(1.0, 2.0, ripple=0.5).exact(0.1)
    assert any(doing.startswith("following the exact solutions later, turn 1") for doing, *_ in said)
    assert said[-1] == ("exact extremals found", len(exact), len(exact))
