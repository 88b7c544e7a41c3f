"""The rules of the house that a linter cannot see, each read off the source."""

import ast
import re
import shutil
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from pontryagin.papers import PAPERS

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "pontryagin"
LONGEST = 310
"""Lines that a module may have, if it is not generated: about 300."""
PARTICIPLES = frozenset(
    ("asked", "searched", "turned", "misled", "told", "held", "loud", "apart", "whole", "first")
)
"""Names of modules that do not say what is in them."""
OF_A_WHOLE_PAPER = frozenset(("values",))
"""What is tested for all problems and solutions of a paper together."""
OF_TEXTS = ("pontryagin.report", "pontryagin.io", "pontryagin.numerics.compile")
"""Modules whose errors are about a text or a formula; the caller knows which argument it came from."""
EVALUATING = ("pontryagin.numerics.compile", "pontryagin.numerics.native", "pontryagin.value")
"""Modules that compile source which they wrote themselves."""


@cache
def written() -> dict[str, Path]:
    """The file of every module of the package that is not generated, by dotted name."""
    return {dotted(path): path for path in sorted(SOURCE.rglob("*.py")) if path.name != "kernels.py"}


@cache
def trees() -> dict[str, ast.Module]:
    """The syntax tree of every module of the package that is not generated, by dotted name."""
    return {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in written().items()}


def dotted(path: Path) -> str:
    """The name under which a file of the package is imported."""
    parts = ("pontryagin", *path.relative_to(SOURCE).with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports(name: str, tree: ast.Module, modules: set[str]) -> set[str]:
    """The package's own modules that a module imports, wherever the statement stands."""
    package = (
        name if (SOURCE.parent / Path(*name.split(".")) / "__init__.py").exists() else name.rpartition(".")[0]
    )
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                base = ".".join(
                    [*package.split(".")[: len(package.split(".")) - node.level + 1], *filter(None, [base])]
                )
            for alias in node.names:
                full = f"{base}.{alias.name}"
                found.add(full if full in modules else base)
    return (found & modules) - {name}


def test_no_two_files_import_each_other_even_in_a_circle():
    modules = [*trees()]
    place = {name: i for i, name in enumerate(modules)}
    edges = [
        (place[name], place[other])
        for name, tree in trees().items()
        for other in imports(name, tree, set(modules))
    ]
    rows, columns = np.array(edges).T
    graph = csr_array((np.ones(len(edges)), (rows, columns)), shape=(len(modules),) * 2)
    _, circle = connected_components(graph, connection="strong")
    sizes = Counter(circle.tolist())
    tied = [name for name, number in zip(modules, circle.tolist(), strict=True) if sizes[number] > 1]
    assert not tied


@pytest.mark.parametrize("name", written())
def test_a_module_is_one_step_and_says_in_one_line_what_it_holds(name):
    assert len(text_of(name).splitlines()) <= LONGEST
    words = ast.get_docstring(trees()[name])
    assert words and len(words.splitlines()[0]) <= 110


def test_classes_of_a_paper_and_of_what_it_imports_have_names_of_their_own():
    packages = {paper.package for paper in PAPERS}
    homes: dict[str, list[str]] = {}
    for name, tree in trees().items():
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                homes.setdefault(node.name, []).append(name)
    papers = {name: [place.split(".")[1] for place in places] for name, places in homes.items()}
    clashes = {
        name: homes[name]
        for name, places in papers.items()
        if len(places) > 1 and not (set(places) <= packages and len(set(places)) == len(places))
    }
    assert not clashes


def test_no_module_is_named_by_a_participle():
    assert not [name for name in trees() if name.rpartition(".")[2] in PARTICIPLES]


def test_no_text_is_evaluated():
    calls = [
        f"{name}:{node.lineno}"
        for name, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in {"eval", "exec"}
    ]
    assert not [call for call in calls if not call.startswith(EVALUATING)]


def opening(error: ast.AST | None) -> str:
    """The first word of the message of a plain ValueError or TypeError, or the variable that stands there."""
    if not isinstance(error, ast.Call) or ast.unparse(error.func) not in ("ValueError", "TypeError"):
        return ""
    text = error.args[0] if error.args else None
    first = text.values[0] if isinstance(text, ast.JoinedStr) else text
    if isinstance(first, ast.FormattedValue):
        return ast.unparse(first.value)
    return str(first.value).partition(" ")[0] if isinstance(first, ast.Constant) else ""


def test_an_error_about_an_argument_carries_its_name():
    nameless = []
    for module, tree in trees().items():
        if module.startswith(OF_TEXTS):
            continue
        for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
            given = {parameter.arg for parameter in (*function.args.args, *function.args.kwonlyargs)}
            raised = (node for node in ast.walk(function) if isinstance(node, ast.Raise))
            nameless += [f"{module}:{node.lineno}" for node in raised if opening(node.exc) in given]
    assert not nameless


def test_greys_of_figures_and_recordings_are_one():
    """Fills of a background may be lighter; a line or a marker in grey has the one grey of `plotting`."""
    pattern = re.compile(r"#([0-9a-f]{2})\1\1\b", re.IGNORECASE)
    dark = {
        f"{name}: {value.group(0)}"
        for name in trees()
        for value in pattern.finditer(text_of(name))
        if int(value.group(1), 16) < 0xD0 and name != "pontryagin.display.plotting"
    }
    assert not dark


def text_of(name: str) -> str:
    """The source of a module."""
    path = SOURCE.parent / Path(*name.split("."))
    return (path / "__init__.py" if path.is_dir() else path.with_suffix(".py")).read_text(encoding="utf-8")


def test_every_name_of_a_module_is_used_somewhere():
    everything = "\n".join(
        path.read_text(encoding="utf-8")
        for folder in ("src", "tests", "benchmarks", "studies", "notebooks", "docs")
        for path in (ROOT / folder).rglob("*")
        if path.suffix in {".py", ".pyi", ".ipynb", ".md"}
    )
    words = Counter(re.findall(r"\w+", everything))
    unused = []
    for name, tree in trees().items():
        for node in tree.body:
            targets = [node.target] if isinstance(node, ast.AnnAssign) else getattr(node, "targets", [])
            names = [target.id for target in targets if isinstance(target, ast.Name)]
            names += [node.name] if isinstance(node, (ast.FunctionDef, ast.ClassDef)) else []
            decorated = bool(getattr(node, "decorator_list", []))
            unused += [f"{name}.{one}" for one in names if words[one] == 1 and not decorated]
    assert not unused


@pytest.mark.parametrize("package", dict.fromkeys(paper.package for paper in PAPERS))
def test_a_paper_has_its_rooms(package):
    folder = SOURCE / package
    rooms = [
        folder / "derivation" / "__init__.py",
        folder / "claims" / "__init__.py",
        folder / "figures" / "__init__.py",
    ]
    rooms += [folder / "playback" / "__init__.py", folder / "command.py"]
    assert not [str(room.relative_to(ROOT)) for room in rooms if not room.is_file()]


def test_tests_mirror_the_source():
    folders = {
        path.name for path in (ROOT / "tests").iterdir() if path.is_dir() and list(path.glob("test_*.py"))
    }
    rooms = {path.name for path in SOURCE.iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert folders - rooms <= {"properties", "house", "benchmarks", "studies"}
    assert rooms - folders <= {"terminal"}


@pytest.mark.parametrize("package", dict.fromkeys(paper.package for paper in PAPERS))
def test_tests_of_a_paper_mirror_its_rooms(package):
    """A file tests the module or the room that it is named after, `test_init.py` the package itself."""
    folder = ROOT / "tests" / package
    strays = []
    for file in sorted(folder.rglob("test_*.py")):
        name, room = file.stem.removeprefix("test_"), SOURCE / file.parent.relative_to(ROOT / "tests")
        mirrored = [room / f"{name}.py", room / name / "__init__.py", room / f"__{name}__.py"]
        whole = file.parent == folder and name in OF_A_WHOLE_PAPER
        if not whole and not any(path.is_file() for path in mirrored):
            strays.append(str(file.relative_to(ROOT)))
    assert not strays


def test_contracts_on_imports_are_kept():
    done = subprocess.run(
        [sys.executable, "-m", "tests.house.contracts"], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("file", "line"),
    [
        ("numerics/newton.py", "import pontryagin.averaging"),
        ("averaging/command.py", "from pontryagin.rendezvous import solve"),
        ("averaging/derivation/smooth.py", "import numpy as np"),
        ("ledger/entry.py", "import pontryagin.cli"),
    ],
)
def test_a_wall_that_is_broken_is_seen(tmp_path, file, line):

    shutil.copytree(
        SOURCE, tmp_path / "src" / "pontryagin", ignore=shutil.ignore_patterns("vendor", "__pycache__")
    )
    shutil.copytree(ROOT / "tests" / "house", tmp_path / "tests" / "house")
    broken = tmp_path / "src" / "pontryagin" / file
    broken.write_text(broken.read_text(encoding="utf-8") + f"\n{line}\n", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "tests.house.contracts"],
        cwd=tmp_path,
        env={"PYTHONPATH": f"{tmp_path}:{tmp_path / 'src'}", "PATH": ""},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1 and "BROKEN" in done.stdout
