"""The chapter of benchmarks: what ``make bench`` last measured, as committed in ``figures/benchmarks``."""

import re
from pathlib import Path

from pontryagin.report.workspace import Workspace

LEFT_OUT = ("Least time, share of inputs failed at each scale", "Growth with the number of steps")
"""Tables too long for the report; they lie beside the others as CSV."""

PICTURES = {
    "triple-integrator": {
        "accuracy-and-time": "Turns: error and time of each method, one problem a call.",
        "failures-by-scale": "Least time: share of inputs on which ruckig finds no answer, by scale. "
        "Ours: none.",
        "stack-size": "Turns: time per problem against the size of the stack.",
    },
    "orbit-correction": {
        "accuracy-and-time": "Orbit correction: error and time of each method, one state a call.",
        "growth": "Time of one gauge against the number of steps, by set of impulses. What depends on "
        "the steps alone is not timed for the peers; for ours beyond 1024 steps it is.",
        "root-finders": "Where SciPy's root finders end on the system (11), from random starts.",
    },
}
"""Captions by folder and name."""


def benchmarks(workspace: Workspace) -> str:
    """Markdown of the chapter; empty where nothing was measured yet."""
    folder = workspace.figures / "benchmarks"
    measured = folder / "benchmarks.md"
    if not measured.is_file():
        return ""
    head, *tables = re.split(r"^(?=##)", measured.read_text(encoding="utf-8"), flags=re.MULTILINE)
    kept = [part.strip() for part in tables if part.split("\n", 1)[0].lstrip("# ") not in LEFT_OUT]
    shown = [line for paper in PICTURES for line in _pictures(folder, paper)]
    return "\n\n".join(["# Benchmarks {#benchmarks}", head.split("\n", 1)[1].strip(), *shown, *kept])


def _pictures(folder: Path, paper: str) -> list[str]:
    return [
        f"![{caption}](figures/benchmarks/{paper}/{name}.svg)\n"
        for name, caption in PICTURES[paper].items()
        if (folder / paper / f"{name}.svg").is_file()
    ]
