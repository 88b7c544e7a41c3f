"""What `pyproject.toml`, the citation and the certificates say in one place alone."""

import inspect
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pontryagin
from pontryagin.certificate import ACCEPTED, Certificate, MaximumPrinciple
from pontryagin.papers import packages

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def test_the_version_stands_in_the_package_alone_and_the_citation_repeats_it():
    assert "version" not in PROJECT["project"] and "version" in PROJECT["project"]["dynamic"]
    cited = re.search(r"^version: (\S+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    assert cited and cited[1] == pontryagin.__version__


def test_only_generated_kernels_and_the_report_are_outside_strict_types():
    mypy = PROJECT["tool"]["mypy"]
    assert mypy["strict"] and "python_version" not in mypy
    lenient = {
        name
        for override in mypy["overrides"]
        if override.keys() - {"module", "ignore_missing_imports"}
        for name in override["module"]
    }
    generated = {f"pontryagin.{name}.kernels" for name in packages() if name != "orbit_correction"}
    assert lenient == generated | {"pontryagin.report.*"}


def test_what_is_accepted_is_one_constant():
    for certificate in (Certificate, MaximumPrinciple):
        assert inspect.signature(certificate.holds).parameters["tol"].default is ACCEPTED


def test_a_paper_that_is_not_in_the_list_has_no_quick_tests():
    command = [sys.executable, "-m", "tests.house.selection"]
    wrong = subprocess.run([*command, "tides"], cwd=ROOT, capture_output=True, text=True)
    assert wrong.returncode == 1 and "PAPER: got 'tides', takes one of" in wrong.stderr
    right = subprocess.run([*command, "orbit-correction"], cwd=ROOT, capture_output=True, text=True)
    assert right.stdout.split() == ["tests/orbit_correction", "src/pontryagin/orbit_correction"]
