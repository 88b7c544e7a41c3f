"""The mutants of a checkout's modules in the order of a sample, and what the tests say of each."""

import ast
import atexit
import hashlib
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from studies.mutation.laboratory import Laboratory, opened
from studies.mutation.mutants import Mutant, mutants
from studies.mutation.reach import Reach, Reached, chosen
from studies.part import Found

BUDGET = 5.0
"""Seconds of the unchanged tests that a mutant meets at most."""
SLOWER, SPARE = 4.0, 20.0
"""A mutant may take so many times as long as the unchanged tests, and so many seconds to load them."""
KILLED, TIMED_OUT, SURVIVED, UNREACHED = "killed", "timed out", "survived", "not reached"


@dataclass(frozen=True)
class Sample:
    """The mutants of some modules of a checkout.

    Attributes
    ----------
    root : Path
        The checkout.
    folder : Path
        Where its copy lies, and what is known of the reach of its tests.
    modules : sequence of str
        Paths in the checkout.
    seed : int
        From which the order of the sample is drawn.
    """

    root: Path
    folder: Path
    modules: Sequence[str]
    seed: int
    _orders: dict[str, tuple[Mutant, ...]] = field(default_factory=dict, repr=False)
    _tests: dict[str, list[Reached]] = field(default_factory=dict, repr=False)
    _hashes: dict[str, str] = field(default_factory=dict, repr=False)

    def order(self, module: str) -> tuple[Mutant, ...]:
        """The mutants of a module in the order of the sample."""
        if module not in self._orders:
            found = mutants(self.text(module), module)
            order = np.random.default_rng([self.seed, *module.encode()]).permutation(len(found))
            self._orders[module] = tuple(found[i] for i in order)
        return self._orders[module]

    def text(self, module: str) -> str:
        """The unchanged module."""
        return (self.root / module).read_text(encoding="utf-8")

    @cached_property
    def laboratory(self) -> Laboratory:
        """The copy of the checkout, until the process ends."""
        held = ExitStack()
        atexit.register(held.close)
        return held.enter_context(opened(self.root, self.folder / "tree"))

    @cached_property
    def reach(self) -> Reach:
        """Which tests reach which lines."""
        return Reach(self.root, self.folder / "reach", self.modules)

    def attempt(self, module: str, number: int) -> Found:
        """Run the tests that reach a mutant, until one fails.

        Parameters
        ----------
        module : str
            The module's path.
        number : int
            The mutant's place in the order of the sample.

        Returns
        -------
        mapping
            The mutant, the ``outcome``, the test ``by`` which it was killed, and a hash of the ``tests`` that
            the outcome depends on: of that test, or of all files of tests that may reach the module.
        """
        mutant = self.order(module)[number]
        if module not in self._tests:
            self._tests[module] = list(self.reach.reaching(module, self.laboratory))
        tests = chosen(self._tests[module], range(mutant.line, mutant.last + 1), BUDGET)
        outcome, by = self._tried(module, mutant, tests) if tests else (UNREACHED, "")
        found = {"key": mutant.key, "kind": mutant.kind, "function": mutant.function, "line": mutant.line}
        found |= {"before": mutant.before, "after": mutant.after, "outcome": outcome, "by": by}
        return found | {"tests": self._hash_of_tests(module, outcome, by)}

    def _tried(self, module: str, mutant: Mutant, tests: Sequence[tuple[str, float]]) -> tuple[str, str]:
        limit = SLOWER * sum(seconds for _, seconds in tests) + SPARE
        with self.laboratory.changed(module, mutant.source(self.text(module))):
            answer = self.laboratory.ask([test for test, _ in tests], limit)
        outcome = {"passed": SURVIVED, "timed out": TIMED_OUT}.get(answer["outcome"], KILLED)
        return outcome, str(answer.get("by", ""))

    def holds(self, module: str, found: Found) -> bool:
        """Whether the tests are still those that an outcome depends on."""
        return bool(found["tests"] == self._hash_of_tests(module, found["outcome"], found["by"]))

    def _hash_of_tests(self, module: str, outcome: str, by: str) -> str:
        if outcome in {SURVIVED, UNREACHED}:
            if module not in self._hashes:
                self._hashes[module] = _digest(*(path.read_bytes() for path in self.reach.candidates(module)))
            return self._hashes[module]
        place, _, test = by.partition("::")
        path = self.root / place
        return _digest(_source(path, test)) if path.is_file() else ""


def _source(path: Path, test: str) -> bytes:
    """The text of a test, by its name without parameters; of the whole file, where there is no such test."""
    text = path.read_text(encoding="utf-8")
    name = test.partition("[")[0].rpartition("::")[2]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef) and node.name == name:
            return ast.unparse(node).encode()
    return text.encode()


def _digest(*texts: bytes) -> str:
    return hashlib.sha256(b"\0".join(texts)).hexdigest()[:12]
