"""The keys of long studies: what the modules that a study depends on are made of, in the whole checkout."""

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from pontryagin.report.dependencies import Source, digest, reached

BESIDE = ("studies", "benchmarks", "tests")
"""Packages of the checkout beside the one that is installed."""
FOUND = "table.csv"
"""The file of a study's table."""
TAKEN = "seconds.csv"
"""The file of the seconds that its parts took, and of what they ran on."""
DEPENDS, KEY = "depends on", "key"
"""Columns of the table: dotted names of the modules that a row depends on, and what they were made of."""


@dataclass(frozen=True)
class Checkout(Source):
    """The modules of the package in `folder`, and of the packages beside it in the checkout."""

    @property
    def root(self) -> Path:
        """The checkout."""
        return self.folder.parents[1]

    @cached_property
    def modules(self) -> dict[str, Path]:
        """Dotted name -> file; what lies in ``tests`` itself is imported without that name too."""
        found: dict[str, Path] = {}
        for name in BESIDE:
            found |= Source(self.root / name).modules
        short = {path.stem: path for path in found.values() if path.parent == self.root / "tests"}
        return short | found | super().modules


def key(checkout: Checkout, modules: Iterable[str]) -> str:
    """The key of results that depend on some modules: on all that these import, and on the pinned packages.

    Parameters
    ----------
    checkout : Checkout
        Where the modules are.
    modules : iterable of str
        Their dotted names.

    Raises
    ------
    KeyError
        If there is no module of that name.
    """
    lock = checkout.root / "requirements.lock"
    parts = sorted(reached(checkout, modules))
    return digest(*parts, lock.read_bytes() if lock.is_file() else b"", root=checkout.root)


@dataclass(frozen=True)
class StudyTable:
    """A table as it was written: what was said before it, its headings and its rows."""

    facts: dict[str, str]
    headings: Sequence[str]
    rows: Sequence[dict[str, str]]


def read(path: Path) -> StudyTable:
    """A table of a study from its file."""
    lines = path.read_text(encoding="utf-8").splitlines()
    said = [line.removeprefix("# ").partition(": ") for line in lines if line.startswith("# ")]
    reader = csv.DictReader(line for line in lines if not line.startswith("# "))
    return StudyTable({name: value for name, _, value in said}, reader.fieldnames or [], [*reader])


def stale(checkout: Checkout, row: dict[str, str]) -> bool:
    """Whether what a row depends on has changed since, or is no longer there."""
    names = row[DEPENDS].split()
    return not set(names) <= checkout.modules.keys() or key(checkout, names) != row[KEY]
