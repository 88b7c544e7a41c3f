"""A slow test is left out only while nothing that it depends on has changed: a small project is tested."""

import subprocess
import sys

import pytest
from tests.house.dependence import Project

from pontryagin.io import files

ROOT = files.repository()
COPIED = (
    "tests/house/kept.py",
    "tests/house/dependence.py",
    "src/pontryagin/report/dependencies.py",
    "src/pontryagin/report/study_keys.py",
    "src/pontryagin/report/syntax.py",
)
RUN = "open('ran', 'a').write('{} ')"
PROJECT = {
    "pyproject.toml": '[tool.pytest.ini_options]\nmarkers = ["slow"]\naddopts = "--import-mode=importlib"\n'
    'testpaths = ["tests"]\npythonpath = [".", "tests"]\n',
    "requirements.lock": "numpy==2\n",
    "README.md": "words",
    "figures/a/ends.csv": "1\n",
    "src/pontryagin/__init__.py": "",
    "src/pontryagin/report/__init__.py": "",
    "src/pontryagin/constants.py": "ONE = 1\n",
    "src/pontryagin/steps.py": "from pontryagin.constants import ONE\n",
    "src/pontryagin/lonely.py": "",
    "src/pontryagin/lazy/__init__.py": "import lazy_loader\nlazy_loader.attach_stub(__name__, __file__)\n",
    "src/pontryagin/lazy/__init__.pyi": "from .shown import one as one\n",
    "src/pontryagin/lazy/shown.py": "one = 1\n",
    "src/pontryagin/lazy/hidden.py": "",
    "src/pontryagin/papers.py": "from importlib import import_module\n"
    "def room(a, b): return import_module(f'pontryagin.{a}.{b}')\n",
    "src/pontryagin/toy/__init__.py": "",
    "src/pontryagin/toy/command.py": "",
    "src/pontryagin/toy/claims/__init__.py": "from pontryagin import ledger\n",
    "src/pontryagin/other/__init__.py": "",
    "src/pontryagin/other/claims/__init__.py": "",
    "src/pontryagin/ledger/__init__.py": "from pontryagin.ledger.collection import entries\n",
    "src/pontryagin/ledger/collection.py": "from pontryagin import papers\n"
    "def entries(): return [papers.room(p, 'claims') for p in ('toy', 'other')]\n",
    "benchmarks/__init__.py": "",
    "benchmarks/clock.py": "import pontryagin.steps\n",
    "tests/conftest.py": "",
    "tests/helper.py": "from pontryagin import lonely\n",
    "tests/test_steps.py": "import pytest\n\nfrom pontryagin.steps import ONE\n\n\n@pytest.mark.slow\n"
    f"def test_steps():\n    {RUN.format('steps')}\n    assert ONE == 1\n\n\n"
    f"def test_quickly():\n    {RUN.format('quick')}\n",
    "tests/test_lazy.py": "import pytest\n\nfrom pontryagin import lazy\n\n\n@pytest.mark.slow\n"
    f"def test_lazy():\n    {RUN.format('lazy')}\n",
}


@pytest.fixture
def project(tmp_path):
    for name in COPIED:
        files.write(tmp_path / name, (ROOT / name).read_bytes())
    for name, text in PROJECT.items():
        files.write(tmp_path / name, text)
    return tmp_path


def ran(project, *options):
    """The tests that a run in the project has run, in alphabetic order, and its last lines."""
    (project / "ran").write_text("")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "tests.house.kept", "-p", "xdist", *options],
        cwd=project,
        env={
            "PYTHONPATH": f"{project / 'src'}:{project}",
            "PYTHONDONTWRITEBYTECODE": "1",  # it would be taken for current after a change of the same length
            "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        },
        capture_output=True,
        text=True,
    )
    assert done.returncode in {0, 1}, done.stdout + done.stderr
    return sorted((project / "ran").read_text().split()), done.stdout


def with_kept(project):
    return ran(project, "--kept")[0]


@pytest.mark.slow
def test_what_passed_is_left_out_until_its_files_change(project):
    constants, before = project / "src/pontryagin/constants.py", PROJECT["src/pontryagin/constants.py"]
    assert with_kept(project) == ["lazy", "quick", "steps"]
    assert with_kept(project) == ["quick"]
    constants.write_text("ONE = 1.0\n")
    assert with_kept(project) == ["quick", "steps"]
    constants.write_text(before)
    (project / "src/pontryagin/lonely.py").write_text("LONELY = 1\n")
    assert with_kept(project) == ["quick"]
    (project / "requirements.lock").write_text("numpy==3\n")
    assert with_kept(project) == ["lazy", "quick", "steps"]


@pytest.mark.slow
@pytest.mark.parametrize("options", [(), ("-n", "2")])
def test_the_summary_says_how_many_were_left_out(project, options):
    assert "kept:" not in ran(project, "--kept", *options)[1]
    left, output = ran(project, "--kept", *options)
    assert left == ["quick"]
    assert "2 slow tests kept: nothing that they depend on has changed" in output


@pytest.mark.slow
def test_a_test_that_failed_runs_again_whatever_passed_before(project):
    constants, before = project / "src/pontryagin/constants.py", PROJECT["src/pontryagin/constants.py"]
    assert with_kept(project) == ["lazy", "quick", "steps"]
    constants.write_text("ONE = 2\n")
    for _ in range(2):
        left, output = ran(project, "--kept")
        assert left == ["quick", "steps"] and "1 failed" in output
    constants.write_text(before)
    assert with_kept(project) == ["quick", "steps"]
    assert with_kept(project) == ["quick"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "fixture", ["raise ValueError", "yield\n    raise ValueError", "import pytest\n    pytest.skip()"]
)
def test_a_test_with_an_error_around_it_or_that_was_skipped_runs_again(project, fixture):
    text = f"import pytest\n\n\n@pytest.fixture(autouse=True)\ndef around():\n    {fixture}\n"
    (project / "tests/conftest.py").write_text(text)
    for _ in range(2):
        assert "1 deselected" not in ran(project, "--kept", "tests/test_lazy.py")[1]
    assert not list((project / "build").glob("kept-tests/*"))


@pytest.mark.slow
def test_without_the_option_everything_runs_and_is_noted(project):
    for _ in range(2):
        assert ran(project)[0] == ["lazy", "quick", "steps"]
    assert with_kept(project) == ["quick"]


@pytest.mark.slow
def test_a_file_that_changes_while_the_tests_run_leaves_nothing_noted(project):
    test = project / "tests/test_lazy.py"
    test.write_text(test.read_text() + "    open('src/pontryagin/lazy/shown.py', 'a').write('two = 2\\n')\n")
    for _ in range(2):
        assert "lazy" in with_kept(project)


def needed(project, text):
    """The files of the project that a test depends on, itself apart; 'everything' if these are all."""
    test = project / "tests/test_new.py"
    test.write_text(text)
    found = Project(project / "src" / "pontryagin")
    depends = found.files(test)
    if depends == found.everything:
        return "everything"
    return {str(path.relative_to(project)) for path in depends} - {"tests/test_new.py", "tests/conftest.py"}


def source(*names):
    return {f"src/pontryagin/{name}" for name in names}


STEPS = source("__init__.py", "steps.py", "constants.py")
LAZY = source("__init__.py", "lazy/__init__.py", "lazy/__init__.pyi", "lazy/shown.py")
LEDGER = source("__init__.py", "papers.py", "ledger/__init__.py", "ledger/collection.py")
TOY = source("toy/__init__.py", "toy/claims/__init__.py")
OTHER = source("other/__init__.py", "other/claims/__init__.py")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("import numpy", set()),
        ("from math import *", set()),
        ("from pontryagin.steps import ONE", STEPS),
        ("from pontryagin import lazy", LAZY),
        ("import helper", source("__init__.py", "lonely.py") | {"tests/helper.py"}),
        ("from benchmarks import clock", STEPS | {"benchmarks/__init__.py", "benchmarks/clock.py"}),
        ("import subprocess\nrun('-c', 'import pontryagin.steps')", STEPS),
        ("import subprocess\nrun('-c', f'from pontryagin.steps import ONE; print({1})')", STEPS),
        ("monkeypatch.setattr('pontryagin.steps.ONE', 2)", STEPS),
        ("from pontryagin import steps\nopen(steps.__file__)", STEPS),
        ("from pontryagin.toy import claims", LEDGER | TOY),
        ("from pontryagin import ledger\nledger.entries()", LEDGER | TOY | OTHER),
        ("from pontryagin.ledger import entries", LEDGER | TOY | OTHER),
        ("from pontryagin import ledger as book\nbook.entries()", LEDGER | TOY | OTHER),
        (
            "from pontryagin import papers\npapers.room(package=one, name='claims')",
            LEDGER | TOY | OTHER,
        ),
        ("def room(): ...\nroom()", set()),
        ("from pontryagin.io.files import figures_folder", source("__init__.py") | {"figures/a/ends.csv"}),
    ],
)
def test_a_test_depends_on_what_its_imports_reach(project, text, expected):
    assert needed(project, text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "from pontryagin.io.files import repository",
        "from pathlib import Path\nHERE = Path(__file__)",
        "from pontryagin import steps\nPath(steps.__file__).parent",
        "import subprocess\nsubprocess.run(['pontryagin', 'solve'])",
        "import subprocess\nsubprocess.run(['-c', f'import {name}'])",
        "import subprocess\nsubprocess.run(['-c', 'import ' + name])",
        "import subprocess\nsubprocess.run(['-c', 'import pontryagin.' + name])",
        "import subprocess\nsubprocess.run(['-m', 'pontryagin'])",
        "from importlib import import_module\nimport_module(f'pontryagin.{name}')",
        "import os\nos.getcwd()",
    ],
)
def test_what_cannot_be_told_depends_on_everything(project, text):
    assert needed(project, text) == "everything"


def test_an_import_by_a_computed_name_may_reach_every_module(project):
    found = needed(project, "from importlib import import_module\nimport_module(name)")
    assert found == "everything" or set(found) >= {n for n in PROJECT if n.endswith(".py") and "new" not in n}


@pytest.mark.slow
@pytest.mark.parametrize(
    "test",
    [
        "rendezvous/reduced/test_solve.py",
        "averaging/test_claims.py",
        "orbit_correction/plan/test_correction.py",
        "triple_integrator/test_playback.py",
        "benchmarks/test_benchmarks_averaging.py",
        "studies/test_run.py",
    ],
)
def test_what_python_loads_for_a_test_is_among_its_files(test):
    script = (
        "import runpy, sys; runpy.run_path(sys.argv[1]); "
        "print(*(m.__file__ for m in list(sys.modules.values()) if getattr(m, '__file__', None)), sep='\\n')"
    )
    path = ROOT / "tests" / test
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)],
        env={"PYTHONPATH": f"{ROOT / 'src'}:{ROOT}:{ROOT / 'tests'}"},
        capture_output=True,
        text=True,
        check=True,
    )
    ours = {
        line for line in done.stdout.splitlines() if line.startswith((str(ROOT / "src"), str(ROOT / "tests")))
    }
    beside = (str(ROOT / "benchmarks"), str(ROOT / "studies"))
    ours |= {line for line in done.stdout.splitlines() if line.startswith(beside)}
    assert ours and ours <= {str(file) for file in Project(ROOT / "src" / "pontryagin").files(path)}
