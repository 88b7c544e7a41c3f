"""A copy of the tree in which modules are changed, and the process that runs tests there."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

COPIED = ("src", "tests", "pyproject.toml")
"""What the tests that need no checkout read."""
SERVER = Path(__file__).with_name("server.py")


@dataclass(frozen=True)
class Laboratory:
    """A copy of a checkout with a server of tests; see `opened`.

    Attributes
    ----------
    root : Path
        The copy.
    server : Popen
        The process that `studies.mutation.server` describes.
    """

    root: Path
    server: "subprocess.Popen[str]"

    def ask(self, tests: Sequence[str], seconds: float, **request: Any) -> dict[str, Any]:
        """What the server answers about tests that may take some seconds of processor time.

        Raises
        ------
        RuntimeError
            If the server has ended.
        """
        assert self.server.stdin and self.server.stdout
        self.server.stdin.write(json.dumps({"tests": [*tests], "seconds": seconds, **request}) + "\n")
        self.server.stdin.flush()
        said = self.server.stdout.readline()
        if not said:
            raise RuntimeError("the process that runs the tests of mutants has ended")
        return dict(json.loads(said))

    @contextmanager
    def changed(self, place: str, text: str) -> Iterator[None]:
        """Have another text in a file of the copy, for a while."""
        path = self.root / place
        before = path.with_suffix(".before")
        path.rename(before)
        try:
            path.write_text(text, encoding="utf-8")
            yield
        finally:
            before.replace(path)


@contextmanager
def opened(checkout: Path, folder: Path) -> Iterator[Laboratory]:
    """Copy the tree of a checkout into a folder, and start a server of tests there."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in COPIED:
        source, copy = checkout / name, folder / name
        if source.is_dir():
            shutil.copytree(source, copy)
        elif source.is_file():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, copy)
    places = os.pathsep.join(str(folder / name) for name in ("src", "tests", "."))
    own = {"PYTHONPATH": places, "PYTHONDONTWRITEBYTECODE": "1", "OMP_NUM_THREADS": "1"}
    with subprocess.Popen(
        [sys.executable, "-P", str(SERVER)],
        cwd=folder,
        env={**os.environ, **own, "OPENBLAS_NUM_THREADS": "1", "PYTHONHASHSEED": "0"},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as server:
        try:
            yield Laboratory(folder, server)
        finally:
            server.kill()
