"""``python -m tests.house.interpreters``: mypy on every supported interpreter; one that is missing is named.

An interpreter other than the one that runs this gets an environment of its own in ``build/types-VERSION``,
with mypy and the packages that have types, at the versions of requirements.lock.
"""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LOCK = ROOT / "requirements.lock"
SUPPORTED = ("3.11", "3.12", "3.13")
TYPED = ("ipython", "mypy", "nbclient", "nbformat", "rerun-sdk", "scipy-stubs")
"""Packages whose types mypy reads, besides those that the library itself needs."""
UV = str(Path(sys.executable).with_name("uv"))


def interpreters(version: str) -> list[str]:
    """Where a version may be: on the search path, or among those that pyenv keeps beside it."""
    kept = Path(os.environ.get("PYENV_ROOT", "~/.pyenv")).expanduser() / "versions"
    return [version, *map(str, sorted(kept.glob(f"{version}.*/bin/python")))]


def packages() -> list[str]:
    """What an environment for mypy holds: what the library needs, and what only its types need."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    return [*project["dependencies"], *TYPED]


def environment(version: str) -> Path | None:
    """The Python of an environment with mypy for a version; None where it cannot be had."""
    folder = ROOT / "build" / f"types-{version}"
    python = folder / "bin" / "python"
    complete = folder / "complete"
    content = "\n".join([*packages(), LOCK.read_text()])
    if complete.exists() and complete.read_text() == content:
        return python
    make = [UV, "venv", "-q", "--clear", "--no-python-downloads", str(folder), "--python"]
    install = [UV, "pip", "install", "-q", "--python", str(python), "-c", str(LOCK), *packages()]
    if not any(succeeds([*make, place]) for place in interpreters(version)) or not succeeds(install):
        return None
    complete.write_text(content)
    return python


def succeeds(command: list[str]) -> bool:
    """Run a command without its output; whether it can be run and returns 0."""
    try:
        return subprocess.run(command, capture_output=True).returncode == 0
    except OSError:
        return False


def main() -> int:
    """Run mypy on each interpreter; 1 if one of them finds an error."""
    own = f"{sys.version_info.major}.{sys.version_info.minor}"
    failed = False
    for version in SUPPORTED:
        python = Path(sys.executable) if version == own else environment(version)
        if python is None:
            print(f"== mypy on Python {version}: skipped, no environment for it can be had here", flush=True)
            continue
        print(f"== mypy on Python {version}", flush=True)
        failed |= bool(subprocess.run([python, "-m", "mypy"], cwd=ROOT).returncode)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
