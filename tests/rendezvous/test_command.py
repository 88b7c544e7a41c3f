"""The command line prints the numbers of the solver, and every error in one line."""

import json
import math
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from typer.testing import CliRunner

from command_line import read_table, write_table
from pontryagin.cli import app
from pontryagin.display.recording import read_back
from pontryagin.io.files import repository
from pontryagin.progress import listening
from pontryagin.rendezvous import (
    Orbit,
    schema,
    solve,
    transcript,
)
from pontryagin.rendezvous.problem.cases import (
    cases,
    chaser_on,
)
from pontryagin.rendezvous.reduced.conditions import Setting, equations
from pontryagin.rendezvous.reduced.search_log import Search
from pontryagin.rendezvous.root import Root

CRAFT = {"r": 1, "v1": 0, "c": 1, "attitude": [1, 0, 0, 0]}
TARGET = {"parameter": 1.5, "eccentricity": 0.1, "anomaly": 0.6, "attitude": [1, 0, 0, 0]}
TILTED = {
    "parameter": "3/2",
    "eccentricity": 0.1,
    "anomaly": 0.6,
    "node": 0,
    "inclination": "pi/9",
    "pericentre": -0.3,
}
LEAP = {"chaser": CRAFT, "target": TARGET, "time_weight": 0, "energy_weight": 1, "peak": "inf", "duration": 6}


def run(*arguments, **given):
    arguments = ["solve", "rendezvous", *(str(argument) for argument in arguments)]
    return CliRunner().invoke(app, arguments, catch_exceptions=False, **given)


def assert_refused(result, begins, status=2):
    assert (result.exit_code, result.stdout) == (status, "")
    assert result.stderr.startswith(f"Error: {begins}"), result.stderr
    assert result.stderr.count("\n") == 1


def flat(problem, prefix=""):
    """A problem as the cells of a row."""
    cells = {}
    for key, value in problem.items():
        if isinstance(value, dict):
            cells |= flat(value, f"{key}.")
        elif isinstance(value, list):
            cells |= {f"{prefix}{key}_{i}": str(part) for i, part in enumerate(value, 1)}
        else:
            cells[prefix + key] = str(value)
    return cells


def write_rows(path, problems):
    """Write a table with a row for each problem, and return its path."""
    cells = [flat(problem) | {"name": f"n{i}"} for i, problem in enumerate(problems)]
    header = list(dict.fromkeys(name for row in cells for name in row))
    return write_table(path, header, [[row.get(name, "") for name in header] for row in cells])


@pytest.fixture
def write(tmp_path):
    def written(problem, name="problem.json"):
        path = tmp_path / name
        path.write_text(problem if isinstance(problem, str) else json.dumps(problem))
        return path

    return written


class TestAnswers:
    @pytest.mark.slow
    def test_json_holds_every_digit_of_the_solver_s_numbers(self, write, leap):
        result = run("--file", write(LEAP), "--json", "--samples", "5")
        assert (result.exit_code, result.stderr) == (0, "")
        output = json.loads(result.stdout)
        assert output["solution"]["duration"] == leap.duration == 6.0
        assert output["solution"]["cost"] == leap.cost
        assert output["solution"]["arrival_anomaly"] == leap.arrival_anomaly
        assert output["solution"]["revolutions"] == leap.revolutions
        assert output["solution"]["initial_costate"] == leap.initial_costate.tolist()
        assert output["solution"]["arcs"] == ["unsaturated"] and output["solution"]["switch_times"] == []
        for name, value in output["certificate"].items():
            assert value == float(getattr(leap.certificate, name)), name
        assert output["certificate"]["residual"] < 1e-10
        assert output["others"]["cost"] == [other.cost for other in leap.others]
        assert output["searched"]["durations"] == pytest.approx([6.0], rel=1e-15)
        assert output["searched"]["revolutions"] == sorted(set(leap.searched.revolutions))
        assert output["searched"]["ends"] == list(leap.searched.ends) and len(leap.searched.ends) == 2
        t = np.linspace(0, 6, 5)
        assert output["samples"]["t"] == t.tolist()
        for name in ("state", "costate", "control"):
            assert output["samples"][name] == getattr(leap, name)(t).tolist(), name
        end, start = output["samples"]["state"][-1], output["samples"]["state"][0]
        assert start[:4] == pytest.approx([1, 0, 1, 0.6], abs=1e-14)
        assert end[0] == pytest.approx(1.5 / (1 + 0.1 * math.cos(end[3])), abs=1e-12)

    def test_the_problem_in_the_json_output_is_an_input_file(self, leap):
        output = schema.to_dict(leap.problem)
        again = schema.read(json.dumps(output))
        assert schema.to_dict(again) == output
        assert again.peak == math.inf and again.duration == 6.0

    @pytest.mark.slow
    def test_the_table_holds_times_cost_arcs_and_the_extent_of_the_search(self, write, leap):
        path = write(LEAP | {"peak": 0.5})
        result = run("--file", path)
        assert result.exit_code == 0, result.stderr
        shown = result.stdout
        assert "Rendezvous with the least energy in the time 6" in shown
        for heading in ("problem", "solution", "certificate", "others found", "searched"):
            assert re.search(rf"^ {heading} *$", shown, re.MULTILINE), heading
        assert re.search(r"^ +duration +6 *$", shown, re.MULTILINE)
        assert re.search(rf"^ +cost +{leap.cost:.10g}"[:-1], shown, re.MULTILINE)
        assert re.search(r"^ +arcs +unsaturated *$", shown, re.MULTILINE)
        assert re.search(r"^ +first durations +6 *$", shown, re.MULTILINE)
        assert "it is not claimed that no other control costs less" in " ".join(shown.split())

    def test_the_table_says_what_was_given_up_and_why(self):
        reasons = [
            f"lap {lap}: the walk broke off (residual {lap}.5e-01)" for lap in (1, 1, 2, 3, 4, 5, 6, 7)
        ]
        lines = transcript._most_frequent(reasons)
        assert lines[0] == "lap 1: the walk broke off (2 times)" and lines[1] == "lap 2: the walk broke off"
        assert len(lines) == 7 and lines[-1] == "and 1 others"
        assert len(transcript._most_frequent(reasons[:3])) == 2

    def test_up_to_six_other_extremals_are_listed_and_the_rest_is_counted(self):
        output = {
            "problem": {"duration": None},
            "others": {
                "count": 8,
                "cost": list(range(1, 9)),
                "duration": [2.5] * 8,
                "revolutions": [0.5] * 8,
            },
        }
        lines = transcript.table(output)["others found"]
        assert list(lines) == ["2", "3", "4", "5", "6", "7", "further"]
        assert lines["2"] == "cost 1, time 2.5, 0.50 revolutions"
        assert lines["further"] == "2, with costs up to 8"
        assert transcript.table(output)["problem"]["duration"] == "free"

    @pytest.mark.slow
    @pytest.mark.extra(name="recording")
    def test_a_figure_and_a_recording_are_written(self, write, tmp_path, leap, monkeypatch):
        monkeypatch.setattr("pontryagin.rendezvous.reduced.solve.solve", lambda problem: leap)
        files = ["--plot", tmp_path / "a.png", "--record", tmp_path / "a.rrd"]
        result = run("--file", write(LEAP), *files)
        assert result.exit_code == 0, result.stderr
        assert result.stderr == f"wrote {tmp_path / 'a.png'}\nwrote {tmp_path / 'a.rrd'}\n"
        assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
        held = read_back(tmp_path / "a.rrd")
        t = held["/thrust/p1"]["time"]
        assert held["/thrust/p1"]["scalars"] == pytest.approx(leap.control(np.clip(t, 0, 6))[:, 0], abs=1e-8)

    def test_every_case_is_listed(self):
        shown = run("--list").stdout
        for name, case in cases().items():
            assert re.search(rf"^ +{name} +{re.escape(case.title[:30])}", shown, re.MULTILINE), name
        output = json.loads(run("--list", "--json").stdout)
        assert output == {"cases": {name: case.title for name, case in cases().items()}}

    def test_a_case_is_the_problem_of_that_name(self, monkeypatch):
        """The solver is replaced by a function that keeps the problem it is given."""

        class Reached(Exception):
            pass

        def reached(problem):
            raise Reached(problem)

        monkeypatch.setattr("pontryagin.rendezvous.reduced.solve.solve", reached)
        for name in ("mars", "mixed-bounded"):
            with pytest.raises(Reached) as reached_with:
                run("--case", name)
            assert schema.to_dict(reached_with.value.args[0]) == schema.to_dict(cases()[name].problem)


class TestFiles:
    def read(self, **changes):
        return schema.read(json.dumps(LEAP | changes))

    def test_missing_keys_have_their_default_values(self):
        problem = schema.read(json.dumps({"chaser": CRAFT, "target": TARGET, "peak": 0.1}))
        assert (problem.time_weight, problem.energy_weight, problem.gravity) == (1.0, 0.0, 1.0)
        assert problem.duration is None and self.read(duration=None, time_weight=1).duration is None

    def test_angles_may_replace_the_attitude_and_texts_numbers(self):
        target = self.read(target=TILTED).target
        known = Orbit.from_angles(1.5, 0.1, 0.0, math.pi / 9, -0.3, 0.6)
        assert target.parameter == 1.5 and np.array_equal(target.attitude, known.attitude)

    @pytest.mark.parametrize("orbit", [TARGET, TILTED])
    def test_a_chaser_given_as_an_orbit_has_its_energy_and_areal_constant(self, orbit):
        craft = self.read(chaser=orbit, gravity=4).chaser
        place = self.read(target=orbit).target
        assert craft.c == pytest.approx(math.sqrt(4 * 1.5), rel=1e-15)
        assert craft.r == pytest.approx(1.5 / (1 + 0.1 * math.cos(0.6)), rel=1e-15)
        energy = (craft.v1**2 + (craft.c / craft.r) ** 2) / 2 - 4 / craft.r
        assert energy == pytest.approx(-4 * (1 - 0.1**2) / (2 * 1.5), rel=1e-14) and craft.v1 > 0
        assert np.allclose(craft.attitude, chaser_on(place, 4.0).attitude)

    @pytest.mark.parametrize("name", list(cases()))
    def test_every_case_is_read_as_it_was_written(self, name):
        problem = cases()[name].problem
        again = schema.read(json.dumps(schema.to_dict(problem)))
        output, known = schema.to_dict(again), schema.to_dict(problem)
        for part in ("chaser", "target"):
            assert output[part].keys() == known[part].keys()
            for key, value in known[part].items():
                assert output[part][key] == pytest.approx(value, rel=1e-15, abs=1e-16), (part, key)
        assert {key: output[key] for key in schema.OPTIONAL} == {key: known[key] for key in schema.OPTIONAL}


BAD = {
    "non-unit attitude": (
        {"chaser": CRAFT | {"attitude": [1, 0, 0, 0.1]}},
        "chaser.attitude must be a unit quaternion, got one of length 1.00498756211",
    ),
    "non-unit orbit": (
        {"target": TARGET | {"attitude": [0.5, 0, 0, 0]}},
        "target.attitude must be a unit quaternion, got one of length 0.5",
    ),
    "three numbers": (
        {"chaser": CRAFT | {"attitude": [1, 0, 0]}},
        "chaser.attitude takes four numbers, scalar part first, got [1, 0, 0]",
    ),
    "a word in a quaternion": (
        {"target": TARGET | {"attitude": [1, "up", 0, 0]}},
        'target.attitude[1] takes a number, got "up"',
    ),
    "target on a parabola": (
        {"target": TARGET | {"eccentricity": 1}},
        "target.eccentricity must be less than 1: the target moves on an ellipse, got 1",
    ),
    "e* below 0": ({"target": TILTED | {"eccentricity": -0.1}}, "target.eccentricity must be at least 0"),
    "p* = 0": ({"target": TARGET | {"parameter": 0}}, "target.parameter must be greater than 0, got 0.0"),
    "craft on a hyperbola": (
        {"chaser": TILTED | {"eccentricity": 1.2}},
        "chaser.eccentricity must be less than 1: the craft starts on an ellipse, got 1.2",
    ),
    "hyperbolic start": (
        {"chaser": CRAFT | {"v1": 1.5}},
        "chaser must start on an ellipse, with the energy v1^2/2 + c^2/(2 r^2) - gravity/r negative, got 0.6",
    ),
    "r = 0": ({"chaser": CRAFT | {"r": 0}}, "chaser.r must be greater than 0, got 0.0"),
    "c < 0": ({"chaser": CRAFT | {"c": -1}}, "chaser.c must be greater than 0, got -1.0"),
    "peak 0": ({"peak": 0}, "peak must be greater than 0, got 0.0"),
    "peak below 0": ({"peak": -0.1}, "peak must be greater than 0, got -0.1"),
    "peak null": ({"peak": None}, 'peak takes a number, or "inf" for no bound, got null'),
    "no bound in the least time": (
        {"time_weight": 1, "energy_weight": 0, "duration": None},
        "peak must be finite where energy_weight is 0, got inf",
    ),
    "no weights": (
        {"energy_weight": 0},
        "time_weight and energy_weight must not both be 0: nothing would be minimised",
    ),
    "weight below 0": ({"time_weight": -1}, "time_weight must be at least 0, got -1.0"),
    "weight null": ({"energy_weight": None}, "energy_weight takes a number, got null"),
    "nothing asked of a fixed time": (
        {"time_weight": 1, "energy_weight": 0, "peak": 0.1},
        "duration must be left free where energy_weight is 0, got 6",
    ),
    "energy alone in free time": (
        {"duration": None},
        " time_weight must be positive where the duration is free, got 0: a longer flight",
    ),
    "duration 0": ({"duration": 0}, "duration must be greater than 0, got 0.0"),
    "gravity below 0": ({"gravity": -1}, "gravity must be greater than 0, got -1.0"),
    "nan": ({"chaser": CRAFT | {"r": math.nan}}, "chaser.r must be a number and finite, got nan"),
    "nan peak": ({"peak": math.nan}, "peak must be a number and finite, got nan"),
    "infinite": ({"target": TARGET | {"anomaly": math.inf}}, "target.anomaly must be a number and finite"),
    "nan as a text": ({"gravity": "nan"}, 'gravity takes a number, got "nan"'),
    "code": ({"peak": "__import__('os')"}, 'peak takes a number, or "inf" for no bound, got "__import__'),
    "true": ({"peak": True}, 'peak takes a number, or "inf" for no bound, got true'),
    "too large": ({"peak": 10**400}, 'peak takes a number, or "inf" for no bound, got 1000'),
    "unknown key": ({"mass": 1}, "mass is an unknown key; known are chaser, target, peak, time_weight"),
    "unknown key inside": (
        {"target": TARGET | {"e": 0}},
        "target.e is an unknown key; known are parameter, eccentricity, anomaly, attitude",
    ),
    "attitude and angles": (
        {"target": TARGET | TILTED},
        "target.attitude is an unknown key; known are parameter, eccentricity, anomaly, node, inclination, p",
    ),
    "an angle missing": (
        {"target": {key: TILTED[key] for key in TILTED if key != "node"}},
        "target.node is missing",
    ),
    "a state missing": ({"chaser": {"r": 1}}, "chaser.v1 is missing"),
    "no object": (
        {"target": [1.5, 0.1]},
        "target takes an object with the keys parameter, eccentricity, anomaly, ",
    ),
}
TEXTS = {
    "empty": ("", "line 1, column 1: Expecting value"),
    "broken": ('{"chaser": {\n "r": 1,,', "line 2, column 9: Expecting property name"),
    "a number": ("1", "the text takes an object with the keys chaser, target, peak, time_weight"),
    "no target": (json.dumps({"chaser": CRAFT, "peak": 1}), "target is missing"),
    "no peak": (json.dumps({"chaser": CRAFT, "target": TARGET}), "peak is missing"),
    "twice": ('{"peak": 1, "peak": 2}', "peak occurs twice in one object"),
    "deep": ("[" * 100_000, "the objects are nested too deeply"),
}


class TestBatch:
    def test_each_row_comes_back_with_its_best_extremal(self, tmp_path, leap):
        table = write_rows(tmp_path / "in.csv", [LEAP, LEAP | {"duration": 5, "target": TILTED}])
        result = run("--batch", table)
        assert (result.exit_code, result.stderr) == (0, "")
        first, second = read_table(result.stdout)
        assert (first["name"], float(first["solution.cost"])) == ("n0", leap.cost)
        single = json.loads(
            run("--file", "-", "--json", input=json.dumps(LEAP | {"duration": 5, "target": TILTED})).stdout
        )
        for name in ("duration", "cost", "arrival_anomaly", "revolutions"):
            assert float(second[f"solution.{name}"]) == single["solution"][name]
        costate = [float(second[f"solution.initial_costate_{i}"]) for i in range(1, 7)]
        assert costate == single["solution"]["initial_costate"]
        assert float(second["certificate.residual"]) == single["certificate"]["residual"]

    def test_a_row_without_an_answer_loses_no_other(self, tmp_path, leap):
        bad = {
            "peak takes a number": {"peak": "none"},
            "chaser.r must be": {"chaser": CRAFT | {"r": -1}},
            "target.inclination is missing": {"target": {**TILTED, "inclination": ""}},
            "target.height is an unknown key": {"target": TARGET | {"height": 1}},
            "time_weight must be positive where the duration is free": {"duration": ""},
        }
        table = write_rows(tmp_path / "in.csv", [LEAP, *(LEAP | change for change in bad.values())])
        result = run("--batch", table, "--json")
        assert result.exit_code == 1
        assert result.stderr.startswith(f"Error: --batch: {table}, 5 of 6 rows, the first of them in line 3")
        first, *others = map(json.loads, result.stdout.splitlines())
        assert first["solution.cost"] == leap.cost and "error" not in first
        for row, begins in zip(others, bad, strict=True):
            assert row["error"].startswith(begins), row["error"]


class TestErrors:
    @pytest.mark.parametrize("name", BAD)
    def test_the_error_of_a_wrong_value_names_its_key(self, write, name):
        changes, begins = BAD[name]
        path = write(LEAP | changes)
        output = f"--file:{begins}" if begins.startswith(" ") else f"--file: {path}, {begins}"
        assert_refused(run("--file", path), output)

    @pytest.mark.parametrize(
        ("changes", "argument"),
        [
            ({"target": TARGET | {"eccentricity": -1}}, "target.eccentricity"),
            ({"chaser": {"r": 1}}, "chaser.v1"),
            ({"mass": 1}, "mass"),
            ({"target": TARGET | {"attitude": [1, "up", 0, 0]}}, "target.attitude[1]"),
            ({"peak": -1}, "peak"),
            ({"energy_weight": 0}, "time_weight"),
        ],
    )
    def test_the_error_carries_the_key_as_its_argument(self, changes, argument):
        with pytest.raises(ValueError, match=re.escape(argument)) as error:
            schema.read(json.dumps(LEAP | changes))
        assert error.value.argument == argument

    @pytest.mark.parametrize("name", TEXTS)
    def test_the_error_of_a_wrong_text_names_the_fault(self, write, name):
        text, begins = TEXTS[name]
        path = write(text)
        assert_refused(run("--file", path), f"--file: {path}, {begins}")

    def test_the_error_of_an_unreadable_file_names_it(self, tmp_path):
        assert_refused(run("--file", tmp_path / "none.json"), f"--file cannot read {tmp_path / 'none.json'}")
        assert_refused(run("--file", tmp_path), f"--file cannot read {tmp_path}")
        (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\x00")
        assert_refused(run("--file", tmp_path / "bytes.json"), f"--file: {tmp_path / 'bytes.json'}, ")

    @pytest.mark.parametrize(
        ("arguments", "begins"),
        [
            ([], "--case or --file must be given"),
            (["--case", "moon"], "--case takes circle, circle-energy, ellipse, "),
            (["--case", "mars", "--file", "a.json"], "--case cannot be combined with --file"),
            (["--case", ""], "--case takes circle, "),
            (["--case", "mars", "--samples", "3"], "--samples needs --json"),
            (["--case", "mars", "--plot", "a.gif"], "--plot takes a file name ending"),
            (["--case", "mars", "--record", "a.mp4"], "--record takes a file name ending"),
            (["--list", "--case", "mars"], "--case cannot be combined with --list"),
            (["--list", "--plot", "a.svg"], "--plot cannot be combined with --list"),
            (["--case", "mars", "--json", "--samples", "-1"], "Invalid value for '--samples'"),
            (["--peak", "1"], "No such option: --peak"),
        ],
    )
    def test_the_error_of_a_wrong_option_names_it_in_one_line(self, arguments, begins):
        assert_refused(run(*arguments), begins)

    def test_the_error_of_an_overflow_names_the_argument(self, write):
        path = write(LEAP | {"chaser": CRAFT | {"c": 1e200}})
        assert_refused(run("--file", path), f"--file: {path}, chaser must start on an ellipse")

    @pytest.mark.slow
    def test_an_infeasible_problem_exits_with_1_and_the_reason(self, write):
        path = write(LEAP | {"peak": 0.02})
        assert_refused(
            run("--file", path), "no transfer of this duration keeps the thrust within the peak", status=1
        )

    def test_a_solution_whose_certificate_does_not_close_is_refused(self, write, leap, monkeypatch):
        """With costates that are wrong by 1e-4 the craft ends at another place."""
        scaled = leap.problem.scaled
        setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
        moved = leap.root.unknowns + 1e-4
        wrong = replace(leap, root=Root(moved, equations(setting, moved)), searched=Search())
        monkeypatch.setattr("pontryagin.rendezvous.reduced.solve.solve", lambda problem: wrong)
        assert_refused(
            run("--file", write(LEAP)), "the certificate does not hold: its residual is too large", status=1
        )


@pytest.mark.slow
def test_every_example_in_the_help_runs(write, tmp_path, monkeypatch, leap):
    monkeypatch.chdir(tmp_path)
    shown = run("--help").stdout
    block = re.search(r"^ +(\{\"chaser\".*?\})\n\n", shown, re.DOTALL | re.MULTILINE)
    assert block is not None
    problem = schema.read(block[1])
    assert problem.duration == 9.0 and problem.peak == math.inf
    tilted = Orbit.from_angles(1.5, 0.1, 0.0, 20 * math.pi / 180, 0.0, 0.6)
    assert np.array_equal(problem.target.attitude, tilted.attitude)
    write(block[1])
    solved = []

    def known(given):
        solved.append(given)
        return leap

    monkeypatch.setattr("pontryagin.rendezvous.reduced.solve.solve", known)
    examples = re.findall(r"^ +pontryagin (.*)$", shown, re.MULTILINE)
    assert len(examples) == 5
    write_rows(tmp_path / "problems.csv", [LEAP])
    for example in examples:
        assert CliRunner().invoke(app, example).exit_code == 0, example
    assert [schema.to_dict(given)["duration"] for given in solved] == [8.0, 8.0, 9.0, 6.0]


@pytest.mark.checkout
def test_the_file_in_the_readme_is_a_problem():
    block = re.search(r"```json\n(.*?)```", (repository() / "README.md").read_text(), re.DOTALL)
    assert block is not None
    problem = schema.read(block[1])
    known = cases()["mixed-bounded"].problem
    assert schema.to_dict(problem)["chaser"] == schema.to_dict(known)["chaser"]
    assert problem.target.attitude == pytest.approx(known.target.attitude, abs=1e-15)
    assert (problem.peak, problem.duration, problem.time_weight) == (0.08, None, 0.0036)


class TestInterruption:
    @staticmethod
    def interrupt(doing, done, total, lap="-1"):
        if doing == f"seeking extremals on lap {lap}":
            raise KeyboardInterrupt

    def test_the_best_extremal_so_far_is_printed_as_of_an_unfinished_search(self, tmp_path):
        path = tmp_path / "leap.json"
        path.write_text(json.dumps(LEAP))
        with listening(self.interrupt):
            result = run("--file", path, "--json")
            shown = run("--file", path)
        assert result.exit_code == shown.exit_code == 130
        assert result.stderr == "Interrupted: the best extremal found so far is printed\n"
        told = json.loads(result.stdout)
        assert told["searched"]["ends"][-1] == "the search was interrupted"
        assert told["certificate"]["residual"] < 1e-9
        assert "The search is unfinished, as it was interrupted. The" in " ".join(shown.stdout.split())

    def test_before_any_is_found_there_is_no_answer(self, tmp_path):
        path = tmp_path / "leap.json"
        path.write_text(json.dumps(LEAP))
        with listening(partial(self.interrupt, lap="+0")):
            result = run("--file", path)
        assert (result.exit_code, result.stdout) == (130, "")
        assert result.stderr == "Interrupted: no extremal was found so far\n"

    def test_a_call_of_the_library_lets_it_through(self):
        with listening(self.interrupt), pytest.raises(KeyboardInterrupt):
            solve(schema.read(json.dumps(LEAP)))
