"""Which quick tests reach a line of a module that decides, and how long each takes; kept by file of tests."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from tests.house.dependence import Project

from pontryagin.io import files
from pontryagin.report.dependencies import digest
from studies.mutation.laboratory import Laboratory

APART = {
    "derivation",
    "figures",
    "judge",
    "test_claims.py",
    "test_derivation.py",
    "test_figures.py",
    "test_playback.py",
}
"""Folders and files of tests that are about something else than solvers and certificates."""
SECONDS = 600.0
"""Processor time that the tests of one file may take."""


Reached = tuple[str, float, set[int]]
"""A test, its seconds, and the lines of a module that it reaches."""


@dataclass(frozen=True)
class Reach:
    """The lines that quick tests reach in a checkout.

    Attributes
    ----------
    root : Path
        The checkout.
    folder : Path
        Where the lines are kept, a file for each file of tests, under the hash of all that it depends on.
    modules : sequence of str
        The modules whose lines are counted, as paths in the checkout.
    """

    root: Path
    folder: Path
    modules: Sequence[str]
    _files: dict[Path, frozenset[Path]] = field(default_factory=dict, repr=False)

    @cached_property
    def project(self) -> Project:
        """The sources and tests."""
        return Project(self.root / "src" / "pontryagin")

    def candidates(self, module: str) -> list[Path]:
        """The files of tests of a module's paper or room whose imports lead to the module."""
        room = Path(module).relative_to("src/pontryagin").parts[0]
        tests = self.root / "tests"
        found = sorted(tests.glob("test_*.py") if room.endswith(".py") else (tests / room).rglob("test_*.py"))
        solving = (test for test in found if not APART & {*test.relative_to(tests).parts})
        return [test for test in solving if self.root / module in self._depends(test)]

    def _depends(self, test: Path) -> frozenset[Path]:
        if test not in self._files:
            self._files[test] = self.project.files(test)
        return self._files[test]

    def key(self, test: Path) -> str:
        """Of a file of tests and all that it depends on."""
        settings = [self.root / name for name in ("pyproject.toml", "requirements.lock")]
        known = [path for path in settings if path.is_file()]
        return digest(*sorted(self._depends(test)), *known, *self.modules, root=self.root)

    def _traced(self, name: str, environment: dict[str, str], laboratory: Laboratory) -> dict[str, Any]:
        trace = [str(laboratory.root / module) for module in self.modules]
        answer = laboratory.ask([name], SECONDS, trace=trace, environment=environment)
        return {
            test: [seconds, {str(Path(file).relative_to(laboratory.root)): lines[file] for file in lines}]
            for test, (seconds, lines) in answer.get("tests", {}).items()
        }

    def of(self, test: Path, laboratory: Laboratory) -> Mapping[str, Any]:
        """Tests of a file: {test: [seconds, {module: lines}]}.

        Kernels run as plain Python, and once more by the native code that the user's cache holds: lines that
        deal with its answers are reached then.
        """
        name = str(test.relative_to(self.root))
        place = self.folder / f"{name.replace('/', '-').removesuffix('.py')}-{self.key(test)}.json"
        if not place.is_file():
            plain, native = {"XDG_CACHE_HOME": str(self.folder / "cache")}, dict[str, str]()
            found: dict[str, Any] = {}
            for environment in (plain, native):
                for one, (seconds, lines) in self._traced(name, environment, laboratory).items():
                    known = found.setdefault(one, [seconds, {}])[1]
                    known |= {module: sorted({*known.get(module, ()), *lines[module]}) for module in lines}
            files.write(place, json.dumps(found))
        return dict(json.loads(place.read_text(encoding="utf-8")))

    def reaching(self, module: str, laboratory: Laboratory) -> Iterator[Reached]:
        """The tests that reach a module, each with its seconds and lines."""
        for candidate in self.candidates(module):
            for test, (seconds, lines) in self.of(candidate, laboratory).items():
                if module in lines:
                    yield test, seconds, set(lines[module])


def chosen(tests: Iterable[Reached], lines: range, budget: float) -> list[tuple[str, float]]:
    """The tests that reach any of some lines, quickest first, as many as a budget of seconds allows."""
    found = sorted((seconds, test) for test, seconds, reached in tests if reached & {*lines})
    kept: list[tuple[str, float]] = []
    spent = 0.0
    for seconds, test in found:
        if kept and spent + seconds > budget:
            break
        kept.append((test, seconds))
        spent += seconds
    return kept
