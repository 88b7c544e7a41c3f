"""Texts that are code, in every place of the command line and of the files it reads: refused, never run."""

import json
import sys

import pytest

from command_line import run, write_table

RAN: list[str] = []
"""Text that is run as code leaves a note here."""
CALL = f"__import__('sys').modules[{__name__!r}].RAN.append(1)"
TEXTS = [
    CALL,
    f"({CALL})",
    f"0*{CALL}",
    f"[{CALL}][0]",
    f"({CALL} for t in [1])",
    f"(lambda: {CALL})()",
    f"sin({CALL})",
    f"{CALL} or 1",
    f"1 if {CALL} else 2",
    f"(y := {CALL})",
    f"1\n{CALL}",
    f"1;{CALL}",
    f"exec({CALL!r})",
    f"eval({CALL!r})",
    f"sympify({CALL!r})",
    f"Function({CALL!r})(t)",
    f"f'{{{CALL}}}'",
    f"'%s' % {CALL}",
    f"{{{CALL}}}",
    f"sin(**{CALL})",
    f"sin(*[{CALL}])",
    f"t.__class__.__init__({CALL})",
    "().__class__.__bases__[0].__subclasses__()",
    "sin.__globals__",
    "__builtins__",
    "import os",
    "9**9**9**9**9",
    "1e999",
    "1\0",
    "\ud800",
    "$(touch here)",
    "`touch here`",
    "'; touch here; '",
    "@here",
    "nan",
    "inf - inf",
    "0x",
]
INTEGRATOR = ("solve", "triple-integrator")
ROTOR = ("solve", "averaging", "--example", "rotor", "--a0", "2", "--a1", "4", "--k", "1")
PLACES = {
    "--disturbance": (*INTEGRATOR, "--norm", "2", "--x0", "0,0,0", "--xf", "1,0,0", "--duration", "2"),
    "--duration": (*INTEGRATOR, "--norm", "2", "--x0", "0,0,0", "--xf", "1,0,0"),
    "--norm": (*INTEGRATOR, "--x0", "0,0,0", "--xf", "1,0,0", "--duration", "2"),
    "--xf": (*INTEGRATOR, "--norm", "2", "--x0", "0,0,0", "--duration", "2"),
    "--mass": ROTOR,
    "--force": ROTOR,
    "--epsilon": ROTOR,
    "--z0": ("solve", "orbit-correction"),
    "--interval": ("solve", "orbit-correction", "--z0", "0,0.01,0"),
    "--thrust": ("solve", "orbit-correction", "--z0", "0,0.01,0"),
    "--case": ("solve", "rendezvous"),
    "--paper": ("ledger",),
}


@pytest.fixture(autouse=True)
def nothing_is_run(tmp_path, monkeypatch):
    assert sys.modules[__name__].RAN is RAN
    monkeypatch.chdir(tmp_path)
    yield
    assert RAN == []
    assert not (tmp_path / "here").exists()


def assert_refused(result):
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert result.stderr.startswith("Error: ")
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize("option", PLACES)
def test_no_option_runs_text(option):
    for text in TEXTS:
        assert_refused(run(*PLACES[option], f"{option}={text}"))


def test_no_cell_of_a_table_runs_text(tmp_path):
    header = ("x10", "x20", "x30", "x1f", "x2f", "x3f", "tf")
    for text in TEXTS:
        if text.isascii() and text.isprintable():
            row = ["0", "0", "0", '"' + text.replace('"', '""') + '"', "0", "0", "2"]
            table = write_table(tmp_path / "in.csv", header, [row])
            result = run("solve", "triple-integrator", "--norm", "2", "--batch", table)
            assert result.exit_code != 0
            assert "x1f" in result.stderr


@pytest.mark.parametrize("key", ["peak", "gravity", "duration"])
def test_no_number_of_a_json_file_runs_text(tmp_path, key):
    orbit = {"parameter": 1.5, "eccentricity": 0.1, "anomaly": 0.6, "attitude": [1, 0, 0, 0]}
    file = tmp_path / "problem.json"
    for text in TEXTS:
        problem = {"chaser": orbit, "target": dict(orbit, anomaly=text), "peak": 1, "energy_weight": 1}
        for one in (problem, dict(problem, target=orbit) | {key: text}, {text: problem}, [text]):
            file.write_text(json.dumps(one))
            result = run("solve", "rendezvous", "--file", file)
            assert_refused(result)
