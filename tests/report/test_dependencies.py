import ast
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import nbformat
import pytest

from pontryagin.io import files
from pontryagin.papers import PAPERS as ALL_PAPERS
from pontryagin.report.dependencies import Source, closure, digest
from pontryagin.report.syntax import literals

REAL = Source(files.repository() / "src" / "pontryagin")


MODULES = {
    "__init__.py": "",
    "certificate.py": "import numpy",
    "compile.py": "def f():\n    from pontryagin import certificate",
    "lonely.py": "",
    "plain/__init__.py": "from .energy import solve",
    "plain/energy.py": "from .. import certificate\ndef solve(): ...",
    "plain/figures.py": "",
    "paper/__init__.py": "import lazy_loader\nlazy_loader.attach_stub(__name__, __file__)",
    "paper/__init__.pyi": "from . import notes as notes\nfrom .peak import solve as solve",
    "paper/notes.py": "",
    "paper/peak.py": "from pontryagin.compile import f",
    "paper/unnamed.py": "",
    "computed/__init__.py": "",
    "computed/all.py": "from importlib import import_module\nimport_module('.' + input())",
    "computed/hidden.py": "",
    "exact/__init__.py": "",
    "exact/one.py": "import importlib\nimportlib.import_module('pontryagin.lonely')",
    "exact/two.py": "",
    "table/__init__.py": "NAMES = {'peak': 'pontryagin.lonely'}",
    "reader/__init__.py": "from pathlib import Path\nTEXT = (Path(__file__).parent / 'a.txt')",
    "reader/a.txt": "words",
    "report/__init__.py": "",
    "cli.py": "import pontryagin.report",
}
LAZY = {"pontryagin", "paper", "__init__.pyi"}
PAPERS = {
    "__init__.py": "",
    "papers.py": "from importlib import import_module\ndef room(a, b): return import_module(a + b)",
    "ledger/__init__.py": "from pontryagin.ledger.collection import entries",
    "ledger/collection.py": (
        "from pontryagin import papers\ndef entries(): return [papers.room(p, 'claims') for p in 'ab']"
    ),
    **{f"{name}/__init__.py": "" for name in "ab"},
    **{f"{name}/command.py": "def solve(): ..." for name in "ab"},
    **{f"{name}/claims/__init__.py": f"from pontryagin.{name}.claims import first" for name in "ab"},
    **{f"{name}/claims/first.py": "" for name in "ab"},
}
"""Two papers whose claims and commands are imported by name, as `pontryagin.papers` does it."""


@pytest.fixture
def source(checkout):
    checkout.modules(MODULES)
    return Source(checkout.root / "src" / "pontryagin")


def names(source, *code):
    found = closure(source, code)
    modules = {path: name for name, path in source.modules.items()}
    return {modules.get(path, path.name).removeprefix("pontryagin.") for path in found}


@pytest.mark.parametrize(
    ("code", "needed"),
    [
        ("import numpy", set()),
        ("import pontryagin.certificate", {"pontryagin", "certificate"}),
        ("from pontryagin import certificate as c", {"pontryagin", "certificate"}),
        ("from pontryagin.certificate import Certificate", {"pontryagin", "certificate"}),
        ("import pontryagin.compile", {"pontryagin", "compile", "certificate"}),
        ("from pontryagin.plain import solve", {"pontryagin", "plain", "plain.energy", "certificate"}),
        ("from pontryagin.paper import notes", LAZY | {"paper.notes"}),
        ("from pontryagin.paper import solve", LAZY | {"paper.peak", "compile", "certificate"}),
        ("from pontryagin.paper import solve as s", LAZY | {"paper.peak", "compile", "certificate"}),
        ("from pontryagin.paper.peak import solve", LAZY | {"paper.peak", "compile", "certificate"}),
        ("from pontryagin.paper.unnamed import x", LAZY | {"paper.unnamed"}),
        ("import pontryagin.computed.all", {"pontryagin", "computed", "computed.all", "computed.hidden"}),
        ("import pontryagin.exact.one", {"pontryagin", "exact", "exact.one", "lonely"}),
        ("import pontryagin.table", {"pontryagin", "table", "lonely"}),
        ("import pontryagin.reader", {"pontryagin", "reader", "a.txt"}),
        ("def later():\n    import pontryagin.lonely", {"pontryagin", "lonely"}),
    ],
)
def test_code_depends_on_what_its_imports_reach_and_on_nothing_else(source, code, needed):
    assert names(source, code) == needed


@pytest.mark.parametrize(
    "code",
    [
        "import pontryagin.paper",
        "import pontryagin.paper as p",
        "from pontryagin import paper",
        "from pontryagin.paper import mystery",
        "sys.modules['pontryagin.paper'].solve",
        "from pontryagin.paper.unnamed import x\nimport pontryagin\npontryagin.paper.solve",
        "import pontryagin.paper.unnamed\npontryagin.paper.solve",
    ],
)
def test_a_lazy_package_at_hand_may_import_all_that_it_names(source, code):
    needed = LAZY | {"paper.notes", "paper.peak", "compile", "certificate"}
    assert names(source, code) - {"paper.unnamed"} == needed


@pytest.mark.parametrize(
    "code",
    [
        "from pontryagin import *",
        "import importlib\nimportlib.import_module('pontryagin.' + name)",
        "get_ipython().system('pontryagin ledger')",
        "this is no Python",
    ],
)
def test_what_cannot_be_decided_depends_on_all_papers(source, code):
    everything = {name.removeprefix("pontryagin.") for name in source.modules} | {"a.txt", "__init__.pyi"}
    assert names(source, code) == everything - {"report", "cli"}


def test_what_lies_beside_the_report_is_no_paper_s_business(source):
    (source.folder / "files.py").write_text("from pathlib import Path\nHERE = Path(__file__).parent")
    (source.folder / "report" / "report.css").write_text("p { margin: 0 }")
    (source.folder / "table" / "ends.csv").write_text("1")
    found = names(Source(source.folder), "import pontryagin.files")
    assert found == {"pontryagin", "files", "a.txt", "ends.csv", "__init__.pyi"}


def test_a_key_changes_with_every_part_and_with_their_borders(tmp_path):
    (tmp_path / "a").write_text("1")
    keys = {digest("ab", "c"), digest("a", "bc"), digest("abc"), digest(tmp_path / "a", root=tmp_path)}
    (tmp_path / "a").write_text("2")
    keys.add(digest(tmp_path / "a", root=tmp_path))
    (tmp_path / "a").rename(tmp_path / "b")
    keys.add(digest(tmp_path / "b", root=tmp_path))
    assert len(keys) == 6


def test_files_that_code_may_read_are_seen_in_its_strings():
    assert literals("open('data/ends.csv').read()  # 'comment'") == {"data/ends.csv"}


def test_nothing_below_the_report_imports_the_report_or_the_command_line():
    for name, path in REAL.modules.items():
        if not name.startswith(("pontryagin.report", "pontryagin.cli", "pontryagin.__main__")):
            imports = re.findall(
                r"^ *(?:from|import) +(\S+)(?: +import +(\w+))?", path.read_text(), re.MULTILINE
            )
            reached = {".".join(parts).rstrip(".") for parts in imports}
            assert not [m for m in reached if m.startswith(("pontryagin.report", "pontryagin.cli"))], name


@pytest.mark.slow
@pytest.mark.parametrize(
    "module", ["pontryagin.ledger", "pontryagin.triple_integrator", "pontryagin.display.recording"]
)
def test_what_python_loads_for_a_module_is_in_its_closure(module):
    script = f"import sys, {module}; print(*(m for m in sys.modules if m.split('.')[0] == 'pontryagin'))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    loaded = {REAL.modules[name] for name in done.stdout.split()}
    assert module in done.stdout.split()
    assert loaded <= closure(REAL, [f"import {module}"])


def test_threads_parse_one_after_the_other(monkeypatch):
    inside, crowds, parse = [], [], ast.parse

    def watched(text):
        inside.append(text)
        crowds.append(len(inside))
        time.sleep(0.002)
        inside.pop()
        return parse(text)

    monkeypatch.setattr("pontryagin.report.syntax.ast.parse", watched)
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(literals, [f"open('{i}.csv')" for i in range(40)]))
    assert found == [{f"{i}.csv"} for i in range(40)]
    assert crowds == [1] * 40


@pytest.fixture
def papers(checkout):
    checkout.modules(PAPERS)
    return Source(checkout.root / "src" / "pontryagin")


CLAIMS = {f"{paper}{part}" for paper in "ab" for part in ("", ".claims", ".claims.first")}
LEDGER = {"pontryagin", "papers", "ledger", "ledger.collection"}


@pytest.mark.parametrize(
    "code",
    [
        "from pontryagin.ledger import entries",
        "from pontryagin.ledger import entries as all_of_them",
        "from pontryagin.ledger.collection import entries",
        "from pontryagin import ledger\nledger.entries('a')",
        "from pontryagin import ledger as book\nbook.entries('a')",
        "import pontryagin.ledger\npontryagin.ledger.entries('a')",
        "from pontryagin import ledger\nbook = ledger",
        "from pontryagin import ledger\ngetattr(ledger, 'ent' + 'ries')()",
        "import sys\nsys.modules['pontryagin.ledger'].entries()",
    ],
)
def test_who_asks_the_ledger_depends_on_all_papers_claims_and_not_on_their_commands(papers, code):
    assert names(papers, code) == LEDGER | CLAIMS


def test_who_uses_the_ledger_of_one_paper_depends_on_its_claims_alone(papers):
    assert names(papers, "from pontryagin import ledger\nledger.Entry") == LEDGER
    assert names(papers, "import pontryagin.papers") == {"pontryagin", "papers"}
    papers.modules["pontryagin.a.claims.first"].write_text("from pontryagin.ledger import Page")
    found = names(papers, "from pontryagin.a.claims import ENTRIES")
    assert found == LEDGER | {name for name in CLAIMS if name[0] == "a"}


CODE = {
    path.stem: [cell.source for cell in nbformat.read(path, 4).cells if cell.cell_type == "code"]
    for path in sorted((files.repository() / "notebooks").glob("*.ipynb"))
}


@pytest.mark.parametrize("module", [name for name in REAL.modules if name.endswith(".claims")])
def test_a_changed_claims_file_changes_the_key_of_what_uses_the_ledger(module):
    assert len(module.split(".")) == 3
    for code in ("from pontryagin.ledger import entries", *CODE["00-overview"]):
        if "entries" in code:
            assert set(REAL.modules[module].parent.glob("*.py")) <= closure(REAL, [code])
    assert REAL.modules[module] not in closure(REAL, ["from pontryagin.display import plotting"])


@pytest.mark.parametrize("notebook", [name for name in CODE if name != "00-overview"])
def test_a_chapter_depends_on_the_modules_of_its_own_paper_alone(notebook):
    folders = {path.relative_to(REAL.folder).parts[0] for path in closure(REAL, CODE[notebook])}
    own = {paper.package for paper in ALL_PAPERS if paper.chapter == notebook[0]}
    assert folders & {paper.package for paper in ALL_PAPERS} == own
