"""The records of finished chunks: a file each, written in one step, below the key of their sources."""

import json
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from pontryagin.io import files
from pontryagin.report.study_keys import Checkout, key
from studies.part import Found, Part, Study


class AtWork(RuntimeError):
    """Another process runs the study."""


@dataclass(frozen=True)
class Records:
    """The records of a study in a checkout."""

    study: Study
    root: Path

    @property
    def folder(self) -> Path:
        """Where they are."""
        return self.root / "build" / "studies" / self.study.name

    @cached_property
    def keys(self) -> dict[str, str]:
        """The key of each part: of all sources that it depends on, and the lock."""
        checkout = Checkout(self.root / "src" / "pontryagin")
        return {part.name: key(checkout, part.modules) for part in self.study.parts}

    def place(self, part: Part) -> Path:
        """The folder of a part's records, under its key and the seed."""
        return self.folder / part.name.replace(" ", "-") / f"{self.keys[part.name]}-{self.study.seed}"

    def done(self, part: Part) -> set[int]:
        """Numbers of the chunks that are finished."""
        return {int(path.stem) for path in self.place(part).glob("*.json") if path.stem.isdecimal()}

    def read(self, part: Part) -> list[dict[str, Any]]:
        """The records of a part in the order of its chunks; one that cannot be read is removed."""
        found = []
        for number in sorted(self.done(part)):
            path = self.place(part) / f"{number:06d}.json"
            try:
                record = json.loads(path.read_text(encoding="utf-8"))
            except ValueError:
                path.unlink()
                continue
            if part.holds(record["found"]):
                found.append(record)
        return found

    def write(self, part: Part, number: int, seconds: float, found: Found) -> None:
        """Keep what a chunk found, and the seconds that it took."""
        record = {"chunk": number, "seconds": seconds, "found": found}
        files.write(self.place(part) / f"{number:06d}.json", json.dumps(record, allow_nan=False))

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Hold the records for this process.

        Raises
        ------
        AtWork
            If another process does.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / ".lock").open("w") as held:
            with suppress(ImportError):
                import fcntl

                try:
                    fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    raise AtWork(f"another process runs the study {self.study.name!r} here") from None
            files.remove_drafts(self.folder)
            yield
