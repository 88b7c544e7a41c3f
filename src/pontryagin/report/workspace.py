"""The folders that a build reads and writes, and the lock that keeps two builds apart."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from pontryagin.report import progress


@dataclass(frozen=True)
class Workspace:
    """A checkout: ``notebooks/`` and ``src/`` are read, ``figures/`` and ``build/`` are written."""

    root: Path

    @property
    def notebooks(self) -> list[Path]:
        """The notebooks, in the order of their file names, which is the order of the report."""
        return sorted((self.root / "notebooks").glob("*.ipynb"))

    @property
    def source(self) -> Path:
        """The package's folder."""
        return self.root / "src" / "pontryagin"

    @property
    def figures(self) -> Path:
        """Figures and tables, a folder per notebook."""
        return self.root / "figures"

    @property
    def build(self) -> Path:
        """Everything generated and not committed."""
        return self.root / "build"

    @property
    def cache(self) -> Path:
        """Results keyed on what they were made of."""
        return self.build / "cache"

    @property
    def results(self) -> Path:
        """Dear results, kept by what the build runs, with their keys."""
        return self.cache / "results"

    @property
    def report(self) -> Path:
        """The rendered report."""
        return self.build / "report"

    @property
    def recordings(self) -> Path:
        """The recordings."""
        return self.build / "recordings"

    @property
    def lock_text(self) -> bytes:
        """The pinned packages, on which every result depends."""
        lock = self.root / "requirements.lock"
        return lock.read_bytes() if lock.is_file() else b""


@contextmanager
def alone(workspace: Workspace) -> Iterator[None]:
    """Hold the workspace for this process; a second build says so and waits.

    The system frees it when the process is killed.
    """
    workspace.build.mkdir(parents=True, exist_ok=True)
    with (workspace.build / ".lock").open("w") as held:
        with suppress(ImportError):
            import fcntl

            try:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                progress.note("another build is at work here: this one waits until it is done")
                fcntl.flock(held, fcntl.LOCK_EX)
        yield
