"""The wheel holds the whole package, and runs where there is no checkout."""

import subprocess
import sys
import zipfile

import pytest
from tests.house import wheel as built
from tests.house.interpreters import ROOT

USE = """
import sys
sys.path.insert(0, sys.argv[1])
import pontryagin
from pontryagin.io import files
from pontryagin.rendezvous.judge.table import direct_results
from pontryagin.triple_integrator import Maneuver, minimum_peak
norm = minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], 2)).norm
print(pontryagin.__file__, len(direct_results()) > 10, abs(norm - 4) < 1e-9)
try:
    files.repository()
except ValueError:
    print("no checkout")
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    return built.built_wheel(tmp_path_factory.mktemp("wheel"))


def test_the_wheel_holds_every_file_of_the_package(wheel, tmp_path):
    assert built.absent_files(wheel) == []
    poorer = tmp_path / "poorer.whl"
    with zipfile.ZipFile(wheel) as whole, zipfile.ZipFile(poorer, "w") as without:
        for name in whole.namelist():
            if not name.endswith(("py.typed", "judge.csv")):
                without.writestr(name, whole.read(name))
    assert built.absent_files(poorer) == ["pontryagin/py.typed", "pontryagin/rendezvous/judge/judge.csv"]


def test_the_package_runs_from_the_wheel(wheel, tmp_path):
    zipfile.ZipFile(wheel).extractall(tmp_path)
    command = [sys.executable, "-I", "-c", USE, str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert done.stdout == f"{tmp_path}/pontryagin/__init__.py True True\nno checkout\n", done.stderr


@pytest.mark.parametrize(
    ("text", "needs"),
    [
        ("from tests.house import contracts", True),
        ("import benchmarks.table as table", True),
        ("from pontryagin.io import files\nROOT = files.repository()", True),
        ("from pathlib import Path\nROOT = Path(__file__).parent", True),
        ("import pontryagin\nPLACE = pontryagin.__file__", False),
        ("from strategies import moments\n\ndef test_it():\n    assert moments", False),
    ],
)
def test_what_reads_the_checkout_on_import_is_left_out(tmp_path, text, needs):
    path = tmp_path / "test_it.py"
    path.write_text(text)
    assert built.needs_checkout(path) is needs


def test_most_tests_need_no_checkout_and_those_of_the_house_do():
    chosen = {str(path.relative_to(ROOT / "tests")) for path in built.without_checkout()}
    assert "triple_integrator/norms/test_peak.py" in chosen and len(chosen) > 150
    assert not [name for name in chosen if name.startswith(("house/", "report/", "benchmarks/"))]


def test_the_extras_that_tests_need_are_those_of_the_project():
    assert built.extras() == ["recording", "report", "bench"]
