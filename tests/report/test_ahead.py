"""Dear results are computed beside the notebooks, once under each key."""

import pytest

from pontryagin.papers import PAPERS
from pontryagin.report import ahead, result_keys
from pontryagin.report.ahead import AheadFailure

SOLVER = """
    from pontryagin.io.kept_results import kept

    @kept
    def twice(number):
        open("runs", "a").write("x")
        return 2 * number

    def ahead():
        twice.ahead(2)
        twice.ahead(3)
"""
PACKAGE = PAPERS[0].package
MODULE = f"pontryagin.{PACKAGE}.solver"


@pytest.fixture
def solver(checkout, monkeypatch):
    checkout.package()
    checkout.modules({f"{PACKAGE}/__init__.py": "", f"{PACKAGE}/solver.py": SOLVER})
    checkout.module(f"{PACKAGE}/other.py", "from pontryagin.io.kept_results import kept")
    monkeypatch.chdir(checkout.root)
    return checkout


def due(checkout):
    keys = result_keys.hand_down(checkout.workspace)
    return {module: keys[module] for module in ahead.modules(checkout.workspace, keys)}


def test_results_are_computed_once_under_each_key(solver):
    assert list(due(solver)) == [MODULE]
    for text, runs in ((SOLVER, "xx"), (SOLVER.replace("2 *", "3 *"), "xxxx")):
        solver.module(f"{PACKAGE}/solver.py", text)
        for module, key in due(solver).items():
            ahead.compute(solver.workspace, module, key)
        assert due(solver) == {}
        assert (solver.root / "runs").read_text() == runs
    assert len(list((solver.workspace.results / MODULE).rglob("*.pickle"))) == 4


def test_users_of_results_are_the_notebooks_that_import_their_module(solver):
    solver.notebook("01-user", "# Title", f"from {MODULE} import twice")
    solver.notebook("02-other", "# Title", f"from pontryagin.{PACKAGE} import other")
    solver.module(f"{PACKAGE}/playback.py", f"from {MODULE} import twice")
    assert ahead.users(solver.workspace, [MODULE]) == {"01-user", f"pontryagin.{PACKAGE}.playback"}
    assert ahead.users(solver.workspace, []) == set()


def test_a_result_that_fails_is_named_and_due_again(solver):
    solver.module(f"{PACKAGE}/solver.py", SOLVER.replace("2 * number", "1 / 0"))
    with pytest.raises(AheadFailure, match=f"the results of {MODULE}: ZeroDivisionError"):
        ahead.compute(solver.workspace, *due(solver).popitem())
    assert list(due(solver)) == [MODULE]


def test_results_that_depend_on_what_the_key_does_not_count_are_refused(solver):
    hidden = "exec('import pontryagin.' + 'numerics')\n        return 2"
    solver.module(f"{PACKAGE}/solver.py", SOLVER.replace("return 2", hidden))
    with pytest.raises(AheadFailure, match=f"{MODULE} loads pontryagin.numerics, but"):
        ahead.compute(solver.workspace, *due(solver).popitem())
    assert list(due(solver)) == [MODULE]
