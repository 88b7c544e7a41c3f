"""A mutant lives where the tests are weak, and is killed by a strong one."""

import ast
import textwrap
from dataclasses import replace

import pytest
from studies.mutation.mutants import mutants
from studies.mutation.reach import Reach
from studies.mutation.sample import KILLED, SURVIVED, TIMED_OUT, UNREACHED, Sample
from studies.mutation.study import SAMPLE, equivalent

from pontryagin.io import files

MODULE, TESTS = "src/pontryagin/toy.py", "tests/test_toy.py"
TOY = """
    LIMIT = 3

    def larger(x, y):
        if x > y:
            return x
        return y

    def halvings(x):
        count = 0
        while x > 1:
            x = x / 2
            count += 1
        return count

    def alone(x):
        return -x
"""
WEAK = """
    from pontryagin.toy import LIMIT, halvings, larger

    def test_the_larger_is_one_of_them():
        assert larger(2, 5) in (2, 5) and LIMIT > 0

    def test_halvings():
        assert halvings(1) == 0 and halvings(8) == 3
"""
STRONG = "\n    def test_the_larger_is_not_less():\n        assert larger(2, 5) == 5 == larger(5, 2)\n"


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A checkout with a module, and weak tests of it."""
    root = tmp_path_factory.mktemp("checkout")
    texts = {
        "pyproject.toml": "[tool.pytest.ini_options]\nmarkers = ['slow', 'checkout']\n",
        "src/pontryagin/__init__.py": "",
        "src/pontryagin/papers.py": "",
        "src/pontryagin/numerics/__init__.py": "",
        "src/pontryagin/numerics/jit.py": "def has_numba():\n    return True\n",
        MODULE: TOY,
        TESTS: WEAK,
    }
    for place, text in texts.items():
        files.write(root / place, textwrap.dedent(text))
    return root


@pytest.fixture
def sample(checkout, monkeypatch):
    """The mutants of the module; a fork has two seconds."""
    monkeypatch.setattr("studies.mutation.sample.SPARE", 1.0)
    return Sample(checkout, checkout / "build", [MODULE], seed=1)


def outcome(sample, function, before, after):
    """What became of the mutant of this change."""
    changes = [(one.function, one.before, one.after) for one in sample.order(MODULE)]
    return sample.attempt(MODULE, changes.index((function, before, after)))


@pytest.mark.slow
def test_a_mutant_outlives_weak_tests_and_is_killed_by_a_strong_one(sample, checkout):
    flipped = outcome(sample, "larger", "x > y", "(x <= y)")
    assert flipped["outcome"] == outcome(sample, "", "3", "4")["outcome"] == SURVIVED
    counted = outcome(sample, "halvings", "count += 1", "count -= 1")
    assert (counted["outcome"], counted["by"]) == (KILLED, f"{TESTS}::test_halvings")
    assert outcome(sample, "halvings", "x / 2", "(x * 2)")["outcome"] == TIMED_OUT
    assert outcome(sample, "alone", "-x", "x")["outcome"] == UNREACHED
    assert (sample.laboratory.root / MODULE).read_text() == sample.text(MODULE) == textwrap.dedent(TOY)

    known = Reach(checkout, sample.folder / "reach", [MODULE])
    assert len(list(known.reaching(MODULE, laboratory=None))) == 2, "the lines are kept, and not traced again"

    path = checkout / TESTS
    path.write_text(path.read_text() + textwrap.dedent(STRONG))
    stronger = replace(sample, folder=checkout / "again", _hashes={}, _tests={})
    assert sample.holds(MODULE, flipped) and not stronger.holds(MODULE, flipped)
    again = outcome(stronger, "larger", "x > y", "(x <= y)")
    assert (again["outcome"], again["by"]) == (KILLED, f"{TESTS}::test_the_larger_is_not_less")
    assert stronger.holds(MODULE, again)


def test_the_key_of_a_mutant_stays_where_lines_are_added_above_it():
    before = {mutant.key: mutant.line for mutant in mutants(textwrap.dedent(TOY), MODULE)}
    after = {mutant.key: mutant.line for mutant in mutants("A = B = None\n\n" + textwrap.dedent(TOY), MODULE)}
    assert before.keys() == after.keys() and all(after[key] == before[key] + 2 for key in before)


@pytest.mark.parametrize(
    ("line", "changes"),
    [
        ("x < y", {"(x <= y)", "(x >= y)"}),
        ("a < b <= c", {"(a <= b <= c)", "(a >= b <= c)", "(a < b < c)", "(a < b > c)"}),
        ("a and not b", {"(a or not b)", "b"}),
        ("-x + 2.0", {"(-x - 2.0)", "x", "4.0"}),
        ("x[1] / 3", {"(x[1] * 3)", "2", "4"}),
        ("m = min(a, b)", {"max(a, b)"}),
        ("m = np.abs(x).max(axis=0)", {"np.abs(x).min(axis=0)", "1"}),
        ("raise ValueError('1 < 2')", {"pass"}),
        ("f(x)", {"pass"}),
        ("x: int = True", {"False"}),
        ("def f(x: 'a < b') -> 'a < b':\n    'it is 1 < 2'", set()),
        ("f'{x + 1}' + 'b'", set()),
        ("if TYPE_CHECKING:\n    x = 1", set()),
        ("for x in y:\n    break", {"continue"}),
    ],
)
def test_each_place_has_its_mutants_and_all_of_them_are_code(line, changes):
    found = mutants(line, "toy")
    assert {mutant.after for mutant in found} == changes
    for mutant in found:
        assert ast.dump(ast.parse(mutant.source(line))) != ast.dump(ast.parse(line)) or "break" in line


def test_no_mutant_of_the_modules_that_decide_is_no_code():
    """Of every hundredth mutant."""
    for module in SAMPLE.modules:
        for mutant in SAMPLE.order(module)[::100]:
            compile(mutant.source(SAMPLE.text(module)), module, "exec")


def test_every_reason_says_of_which_mutant_it_is():
    """A reason for a line that has changed since counts no more, and may be removed."""
    known = {mutant.key: mutant for module in SAMPLE.modules for mutant in SAMPLE.order(module)}
    assert equivalent()
    for key, entry in equivalent().items():
        assert entry.keys() == {"module", "function", "before", "after", "reason"}
        assert len(entry["reason"]) > 20
        if key in known:
            assert (known[key].before, known[key].after) == (entry["before"], entry["after"]), key
