"""``python -m tests.house.wheel``: the wheel passes the tests that need no checkout, on every interpreter.

The wheel is built, and installed by itself into a fresh environment for each supported interpreter and each
extra. The tests and the examples in the docstrings run from a temporary folder, on the package in the
environment's site-packages. Without extras all quick tests run; an extra adds the quick tests that need it.
With `--lowest`, the dependencies have the lowest versions that pyproject.toml allows.
"""

import argparse
import ast
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.house.interpreters import LOCK, ROOT, SUPPORTED, UV, interpreters, succeeds
from tests.house.selection import folders

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
TOOLS = ("pytest", "pytest-timeout", "hypothesis", "cloudpickle")
"""Packages of the extra `dev` that the tests themselves import."""
BASE = "base"
"""Stands for the package without extras."""
BUILT = {"__pycache__", ".mypy_cache"}
EXEMPT = (
    "pontryagin.io.files.repository",
    "pontryagin.display.notebook.equation",
    "pontryagin.display.recording.record",
)
"""Examples that need the checkout, or the extra `report` or `recording`."""
REPORT = "report"
"""The room whose examples need an extra."""
NO_TESTS = 5
"""What pytest returns where no test is chosen: an extra that slow tests alone need."""
PLACE = """
import sys, pontryagin, pathlib
place = pathlib.Path(pontryagin.__file__).parent
inside = place.is_relative_to(sys.prefix) and place.parent.name == "site-packages"
print(place) if inside else sys.exit(f"pontryagin is imported from {place}, not from the wheel")
"""
SMOKE = """
import importlib, pickle, pkgutil, numpy as np, pontryagin
from pontryagin import triple_integrator as ti, orbit_correction as oc, averaging as av, rendezvous as rv
for found in pkgutil.walk_packages(pontryagin.__path__, "pontryagin."):
    if not found.name.startswith("pontryagin.report.") and not found.name.endswith("__main__"):
        importlib.import_module(found.name)
assert abs(ti.minimum_peak(ti.Maneuver([0, 0, 0], [1, 0, 0], 2.0)).norm - 4) < 1e-12
plan = oc.correct([-0.0037787, -0.0039109, 0.0141512])
spin = av.smooth_example(1.0, 0.5)
chaser = rv.Chaser(1, 0, 1, [1, 0, 0, 0])
best = rv.solve(rv.Rendezvous(chaser, rv.Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6), energy_weight=1, duration=6))
for solution in (plan, spin, best):
    assert np.all(solution.certificate.holds()) and pickle.loads(pickle.dumps(solution)) == solution
"""
"""Every module outside the report is imported without extras, and each paper's solver solves a problem."""


def built_wheel(folder: Path) -> Path:
    """Build the wheel of the checkout into a folder."""
    make = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(make, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    return wheel


def absent_files(wheel: Path) -> list[str]:
    """The files of the package that are not in the wheel."""
    source = ROOT / "src"
    files = (path.relative_to(source) for path in (source / "pontryagin").rglob("*") if path.is_file())
    inside = set(zipfile.ZipFile(wheel).namelist())
    return sorted(str(path) for path in files if not BUILT & set(path.parts) and str(path) not in inside)


def extras() -> list[str]:
    """The extras that tests of the package need, by the markers of these tests."""
    texts = [path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("*.py")]
    named = {name for text in texts for name in re.findall(r'mark\.extra\(name="(\w+)"\)', text)}
    return [name for name in PROJECT["project"]["optional-dependencies"] if name in named]


def without_checkout() -> Iterator[Path]:
    """The files of tests that need no checkout, by their imports and their use of files."""
    for test in sorted((ROOT / "tests").rglob("test_*.py")):
        above = [folder / "conftest.py" for folder in test.parents if folder.is_relative_to(ROOT / "tests")]
        read = [test, *filter(Path.is_file, above)]
        if not any(map(needs_checkout, read)):
            yield test


def needs_checkout(path: Path) -> bool:
    """Whether a module imports what lies beside the package, or reads the checkout when it is imported.

    A conftest does so if any of its functions does.
    """
    tree = ast.parse(path.read_text(encoding="utf-8"))
    nodes = list(ast.walk(tree))
    froms = [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)]
    names = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    if {name.split(".")[0] for name in froms + names} & {"tests", "benchmarks", "studies"}:
        return True
    inside = ast.FunctionDef if path.name != "conftest.py" else ast.Pass
    at_import = [statement for statement in tree.body if not isinstance(statement, inside | ast.ImportFrom)]
    used = " ".join(map(ast.unparse, at_import))
    return bool(re.search(r"\brepository\(|(?<![\w.])__file__", used))


def test_folder(folder: Path) -> Path:
    """Copy the tests that need no checkout, with their helpers and settings, into a folder."""
    chosen = set(without_checkout())
    above = {parent for test in chosen for parent in test.parents}
    for path in (ROOT / "tests").rglob("*.py"):
        if path in chosen or (path.parent in above and not path.name.startswith("test_")):
            copy = folder / path.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)
    settings = PROJECT["tool"]["pytest"]["ini_options"] | {"pythonpath": ["tests"]}
    lines = [f"{name} = {value!r}\n" for name, value in settings.items()]
    (folder / "pyproject.toml").write_text("[tool.pytest.ini_options]\n" + "".join(lines))
    return folder


def environment(folder: Path, version: str, wheel: Path, extra: str, lowest: bool) -> Path | None:
    """The Python of a fresh environment that holds the wheel; None where there is no such interpreter."""
    make = [UV, "venv", "-q", "--clear", "--no-python-downloads", str(folder), "--python"]
    if not any(succeeds([*make, place]) for place in interpreters(version)):
        return None
    python = folder / "bin" / "python"
    # Lowest are what is named here; what the wheel needs is named beside it.
    needs = PROJECT["project"]["dependencies"]
    versions = ["--resolution", "lowest-direct", *needs] if lowest else ["-c", str(LOCK)]
    packages = [f"pontryagin[{extra}] @ {wheel.as_uri()}" if extra != BASE else str(wheel), *_tools()]
    subprocess.run([UV, "pip", "install", "-q", "--python", str(python), *versions, *packages], check=True)
    return python


def _tools() -> list[str]:
    dev = PROJECT["project"]["optional-dependencies"]["dev"]
    return [need for need in dev if re.split(r"[<>=\[]", need)[0] in TOOLS]


def passes(python: Path, tests: Path, extra: str, paper: str) -> bool:
    """Whether the quick tests, of one paper or of all, and the examples pass on the installed package."""
    apart: dict[str, Any] = {"cwd": tests, "env": _own(), "text": True}
    place = subprocess.run([python, "-c", PLACE], capture_output=True, **apart)
    print((place.stdout or place.stderr).rstrip(), flush=True)
    if place.returncode or subprocess.run([python, "-c", SMOKE], **apart).returncode:
        return False
    installed = Path(place.stdout.strip())
    paths = [str(path) for path in _chosen(paper, ROOT / "tests", tests / "tests")]
    marks = "not slow and not checkout"
    if extra == BASE:
        examples = _chosen(paper, ROOT / "src" / "pontryagin", installed)
        paths += [str(path) for path in examples if path.name != REPORT]
    else:
        marks += f" and extra(name={extra!r})"
    others = "not (" + " or ".join(EXEMPT) + ")"
    command = [python, "-m", "pytest", "-rs", "-p", "no:cacheprovider", "-m", marks, "-k", others, *paths]
    return subprocess.run(command, **apart).returncode in {0, NO_TESTS}


def _chosen(paper: str, here: Path, there: Path) -> list[Path]:
    """What belongs to a paper, or everything, of a folder of the checkout and as it is in its copy."""
    inside = folders(paper) if paper else here.iterdir()
    places = (there / path.relative_to(here) for path in sorted(inside) if path.is_relative_to(here))
    return [place for place in places if place.suffix in {"", ".py"} and place.exists() and _is_source(place)]


def _is_source(place: Path) -> bool:
    return place.name not in BUILT and place.name != "conftest.py"


def _own() -> dict[str, str]:
    """The environment of a process without what would lead it to the checkout."""
    kept = {name: value for name, value in os.environ.items() if not re.match("PYTHON|PONTRYAGIN", name)}
    return kept | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def main(arguments: list[str]) -> int:
    """Test the wheel on the chosen interpreters; 1 if it fails on one of them."""
    parser = argparse.ArgumentParser(prog="python -m tests.house.wheel", description=__doc__)
    parser.add_argument("--version", choices=SUPPORTED, help="one interpreter instead of all")
    parser.add_argument("--extra", choices=[BASE, *extras()], help="base or one extra instead of all")
    parser.add_argument("--paper", default="", help="the tests of one paper instead of all")
    parser.add_argument("--lowest", action="store_true", help="the lowest versions of the dependencies")
    chosen = parser.parse_args(arguments)
    failed: list[str] = []
    with tempfile.TemporaryDirectory(prefix="pontryagin-wheel-") as place:
        wheel = built_wheel(Path(place) / "wheel")
        print(f"== {wheel.name}", flush=True)
        failed += [f"{name} is not in the wheel" for name in absent_files(wheel)]
        tests = test_folder(Path(place) / "apart")
        for version in [chosen.version] if chosen.version else SUPPORTED:
            for extra in [chosen.extra] if chosen.extra else [BASE, *extras()]:
                name = f"Python {version}, {extra}"
                python = environment(Path(place) / "environment", version, wheel, extra, chosen.lowest)
                if python is None:
                    print(f"== {name}: skipped, this interpreter cannot be had here", flush=True)
                    continue
                print(f"== {name}", flush=True)
                if not passes(python, tests, extra, chosen.paper):
                    failed.append(name)
    for line in failed:
        print(f"failed: {line}")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
