"""Types that a type checker infers for the public names of the package in a user's script."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pontryagin

pytestmark = pytest.mark.slow

SCRIPT = """
import math
import sympy as sp  # type: ignore[import-untyped]
from pontryagin import triple_integrator as ti, orbit_correction as oc, averaging as av, rendezvous as rv

m = ti.Maneuver([0, 0, 0], [1, 0, 0], tf=2.0)
reveal_type(m)  # Maneuver
reveal_type(m.x0)  # ndarray[tuple[Any, ...], dtype[float64]]
reveal_type(m.moments)  # ndarray[tuple[Any, ...], dtype[float64]]
reveal_type(ti.Maneuver([[0, 0, 0]] * 2, [1, 0, 0], [2, 3], 0.5, lambda t: 2 * t))  # Maneuver
reveal_type(ti.minimum_energy(m))  # EnergySolution
reveal_type(ti.minimum_peak(m))  # PeakSolution
reveal_type(ti.minimum_peak(m).switch_times)  # ndarray[tuple[Any, ...], dtype[float64]]
reveal_type(ti.minimum_peak(m).control([0, 1]))  # ndarray[tuple[Any, ...], dtype[float64]]
reveal_type(ti.minimum_peak(m).certificate.gap)  # ndarray[tuple[Any, ...], dtype[float64]]
reveal_type(ti.minimum_impulse(m))  # ImpulseSolution
reveal_type(ti.minimum_norm(m, 3))  # NormSolution
reveal_type(ti.minimum_time([0, 0, 0], [1, 0, 0], peak=1.0))  # TimeSolution
reveal_type(ti.maximum_entropy(m))  # EntropySolution

reveal_type(oc.correct([-0.0037787, -0.0039109, 0.0141512]))  # Plan
discrete = oc.DiscreteSystem([[1, 0], [0, 1]], [[1, 0], [0, 1]])
reveal_type(discrete)  # DiscreteSystem
reveal_type(oc.gauge(discrete, [3, 4], 10))  # Gauge

v, u, x = sp.symbols("v u x", real=True)
reveal_type(av.smooth_example(1, [0.5, 0.25]))  # AveragedSolution
reveal_type(av.rotor(1.0, 2.0, force=-sp.Symbol("v"), peak=1.0))  # AveragedSolution
reveal_type(av.kepler(-0.5, 0.9, -0.4, 1.0))  # AveragedSolution
reveal_type(av.spin_down([1, 0, 1], [1, 1, 1], 1.5))  # AveragedSolution
system = av.PhaseSystem([u], slow=[v], control=[u], phase=x, target=[v])
reveal_type(system)  # PhaseSystem
reveal_type(av.solve_averaged(system, [1.5]))  # AveragedSolution
a = av.smooth_example(1.0, 0.5)
reveal_type(a.exact(0.1))  # Extremals
reveal_type(a.exact(0.1)[0].kind)  # str
reveal_type(a.certificate)  # AveragedCertificate

target = rv.Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
reveal_type(target)  # Orbit
reveal_type(target.attitude)  # ndarray[tuple[Any, ...], dtype[float64]]
problem = rv.Rendezvous(rv.Chaser(1, 0, 1, [1, 0, 0, 0]), target, energy_weight=1, peak=math.inf, duration=6)
reveal_type(problem)  # Rendezvous
reveal_type(rv.solve(problem))  # Extremal
reveal_type(rv.solve(problem).others)  # tuple[Extremal, ...]
reveal_type(rv.solve(problem).searched)  # Search | None
reveal_type(rv.solve(problem).cost)  # float
reveal_type(rv.solve_in_elements(problem))  # ElementsExtremal
reveal_type(rv.least_fuel(problem))  # ElementsExtremal
reveal_type(rv.Elements.from_state([1, 0, 0], [0, 1, 0]))  # Elements
"""


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """mypy's messages by line, for a user's script in strict mode and the package as it is installed."""
    folder = tmp_path_factory.mktemp("user")
    (folder / "script.py").write_text(SCRIPT)
    (folder / "mypy.ini").write_text("[mypy]\nstrict = true\n")
    found = Path(pontryagin.__file__).parents[1]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "script.py"],
        capture_output=True,
        text=True,
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(found), "MYPYPATH": ""},
    )
    assert not done.stderr, done.stderr
    lines: dict[int, list[str]] = {}
    for place, text in re.findall(r"^script\.py:(\d+): (.*)$", done.stdout, re.MULTILINE):
        lines.setdefault(int(place), []).append(text)
    return lines


@pytest.mark.slow
def test_a_users_script_has_no_type_error(answers):
    errors = [f"{SCRIPT.splitlines()[line - 1]}: {text}" for line, said in answers.items() for text in said]
    assert [text for text in errors if "Revealed type" not in text] == []


@pytest.mark.parametrize(
    ("line", "kind"),
    [(i, line.split("  # ")[1]) for i, line in enumerate(SCRIPT.splitlines(), 1) if line[:6] == "reveal"],
)
def test_a_public_name_has_the_type_of_what_it_makes(answers, line, kind):
    (said,) = (text for text in answers[line] if "Revealed type" in text)
    revealed = re.sub(r"\b[a-z_]+\.(?:[a-z_0-9]+\.)*", "", said.split('"')[1])
    assert revealed == kind
