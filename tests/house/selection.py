"""``python -m tests.house.selection [PAPER]``: folders with the tests of one paper, or of the core."""

import sys
from pathlib import Path

from pontryagin.papers import packages

ROOT = Path(__file__).resolve().parents[2]
APART = {"benchmarks", "properties", "report", "studies", "__pycache__"}
"""Folders that belong neither to a paper nor to the core: `make test` runs their tests."""


def folders(paper: str = "") -> list[Path]:
    """Where the tests of a paper are, those in its docstrings included; of the core, if none is named.

    Raises
    ------
    ValueError
        If there is no such paper.
    """
    if paper:
        name = paper.replace("-", "_")
        if name not in packages():
            raise ValueError(f"PAPER: got {paper!r}, takes one of {', '.join(packages())}")
        return [ROOT / "tests" / name, ROOT / "src" / "pontryagin" / name]
    others = APART | set(packages())
    inside = [*(ROOT / "tests").iterdir(), *(ROOT / "src" / "pontryagin").iterdir()]
    return sorted(
        path for path in inside if path.name not in others and (path.is_dir() or path.suffix == ".py")
    )


if __name__ == "__main__":
    try:
        print(*(path.relative_to(ROOT) for path in folders(*sys.argv[1:2])))
    except ValueError as error:
        sys.exit(str(error))
