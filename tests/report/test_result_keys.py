"""A change of source makes exactly those kept results stale that depend on it."""

import pytest

from pontryagin.papers import PAPERS
from pontryagin.report import result_keys
from pontryagin.report.execute import execute

MODULES = {
    "__init__.py": "",
    "errors.py": "",
    "io/__init__.py": "",
    "io/files.py": "",
    "io/kept_results.py": "from pontryagin.io import files\ndef kept(function): return function",
    "numerics/__init__.py": "",
    "numerics/newton.py": "",
    "numerics/kepler.py": "",
    "a/__init__.py": "import lazy_loader\nlazy_loader.attach_stub(__name__, __file__)",
    "a/__init__.pyi": "from . import figures as figures\nfrom .cases import solved as solved",
    "a/cases.py": "from pontryagin.io.kept_results import kept\nfrom pontryagin.a.solver import solve",
    "a/solver.py": "from pontryagin.numerics import newton",
    "a/figures.py": "from pontryagin.a import solved",
    "a/derivation/__init__.py": "",
    "a/derivation/motion.py": "",
    "a/derivation/energy.py": "",
    "a/claims/__init__.py": "from pontryagin.a.claims import motion",
    "a/claims/motion.py": "from pontryagin.a.derivation import motion",
    "b/__init__.py": "",
    "b/derivation.py": "from pontryagin.numerics import kepler",
    "b/claims/__init__.py": "from pontryagin.b.claims import law",
    "b/claims/law.py": "from pontryagin.b import derivation",
}
CASES = {"a.cases"}
CLAIMS_OF_A, CLAIMS_OF_B = {"a.claims", "a.claims.motion"}, {"b.claims", "b.claims.law"}


@pytest.mark.parametrize(
    ("changed", "stale"),
    [
        ("a/derivation/motion.py", CLAIMS_OF_A),
        ("a/derivation/energy.py", set()),
        ("a/claims/motion.py", CLAIMS_OF_A),
        ("a/solver.py", CASES),
        ("a/figures.py", set()),
        ("a/__init__.py", CLAIMS_OF_A | CASES),
        ("numerics/newton.py", CASES),
        ("numerics/kepler.py", CLAIMS_OF_B),
        ("b/derivation.py", CLAIMS_OF_B),
        ("io/kept_results.py", CASES),
        ("__init__.py", CLAIMS_OF_A | CLAIMS_OF_B | CASES),
        ("../../requirements.lock", CLAIMS_OF_A | CLAIMS_OF_B | CASES),
    ],
)
def test_a_change_makes_exactly_its_results_stale(checkout, changed, stale):
    checkout.modules(MODULES)
    before = result_keys.hand_down(checkout.workspace)
    path = checkout.workspace.source / changed
    path.write_text(path.read_text() + "\n# changed\n")
    after = result_keys.hand_down(checkout.workspace)
    assert set(before) == set(after) == {f"pontryagin.{name}" for name in CASES | CLAIMS_OF_A | CLAIMS_OF_B}
    assert {name for name in after if after[name] != before[name]} == {f"pontryagin.{name}" for name in stale}


SOLVER = """
    from pontryagin.io.kept_results import kept

    FACTOR = 2

    @kept
    def twice(number):
        open("../../runs", "a").write("x")
        return FACTOR * number
"""


@pytest.mark.slow
def test_two_notebooks_compute_a_result_once_until_its_source_changes(checkout):
    checkout.package()
    package = PAPERS[0].package
    checkout.modules({f"{package}/__init__.py": "", f"{package}/solver.py": SOLVER})
    use = f"from pontryagin.{package}.solver import twice"
    paths = [checkout.notebook(name, "# Title", use, "twice(21)") for name in ("01-first", "02-second")]

    def answers():
        result_keys.hand_down(checkout.workspace)
        executed = [execute(checkout.workspace, path) for path in paths]
        told = [one.notebook.cells[2].outputs[0].data["text/plain"] for one in executed]
        return told, (checkout.root.parent / "runs").read_text()

    assert answers() == (["42", "42"], "x")
    checkout.module(f"{package}/solver.py", SOLVER.replace("FACTOR = 2", "FACTOR = 3"))
    assert answers() == (["63", "63"], "xx")
