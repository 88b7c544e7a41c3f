"""The chapter of benchmarks: what ``make bench`` last measured, as committed in ``figures/benchmarks``."""

import re

from pontryagin.report.workspace import Workspace

LEFT_OUT = ("Least time, share of inputs failed at each scale",)
"""Sections too long for the report; their tables lie beside the others as CSV."""

PICTURES = {
    "accuracy-and-time": "Error and time of each method, one problem a call.",
    "failures-by-scale": "Least time: share of inputs on which ruckig finds no answer, by scale. Ours: none.",
    "stack-size": "Time per problem against the size of the stack.",
}


def benchmarks(workspace: Workspace) -> str:
    """Markdown of the chapter; empty where nothing was measured yet."""
    folder = workspace.figures / "benchmarks"
    measured = folder / "benchmarks.md"
    if not measured.is_file():
        return ""
    head, *sections = re.split(r"^## ", measured.read_text(encoding="utf-8"), flags=re.MULTILINE)
    lead = head.split("\n", 1)[1].strip()
    kept = [f"## {section.strip()}" for section in sections if not section.startswith(LEFT_OUT)]
    shown = [
        f"![{caption}](figures/benchmarks/{name}.svg)\n"
        for name, caption in PICTURES.items()
        if (folder / f"{name}.svg").is_file()
    ]
    return "\n\n".join(["# Benchmarks {#benchmarks}", lead, *shown, *kept])
