"""The chapter of the long studies: their committed tables, and which rows are of sources since changed."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from pontryagin.display.tables import markdown_table
from pontryagin.report.study_keys import DEPENDS, FOUND, KEY, TAKEN, Checkout, StudyTable, read, stale
from pontryagin.report.workspace import Workspace

NOT_SHOWN = (DEPENDS, KEY)
"""Columns that are for the check alone."""
HEAD = """# Long studies {#studies}

Each study runs for hours and is seeded. Its rows are kept with keys: hashes of all sources that a row depends
on and of the pinned packages. *Sources* says whether these are still today's; `make study NAME=...` earns the
rows anew that are not.
"""


def chapter(workspace: Workspace) -> str:
    """Markdown of the chapter; empty where no study was run yet."""
    tables = sorted((workspace.figures / "studies").glob(f"*/{FOUND}"))
    checkout = Checkout(workspace.source)
    return "\n\n".join([HEAD.strip(), *(_section(checkout, path) for path in tables)]) if tables else ""


def _section(checkout: Checkout, path: Path) -> str:
    kept, taken = read(path), read(path.with_name(TAKEN))
    seconds = {row["part"]: row["seconds"] for row in taken.rows}
    shown: dict[str, Sequence[str | float]] = {
        heading: [_entry(row[heading]) for row in kept.rows]
        for heading in kept.headings
        if heading not in NOT_SHOWN and any(row[heading] for row in kept.rows)
    }
    shown["seconds"] = [round(float(seconds[row["part"]])) for row in kept.rows]
    shown["sources"] = ["changed" if stale(checkout, row) else "today's" for row in kept.rows]
    name = path.parent.name
    return f"""## {kept.facts["title"]} {{#study-{name}}}

{kept.facts["note"]}

{markdown_table(shown)}

{_run(kept, taken, sum(map(float, seconds.values())))} The cases that are kept with their exact inputs are in
`figures/studies/{name}`."""


def _entry(text: str) -> str | float:
    """A cell: a number where it is one."""
    for read_as in (int, float):
        with suppress(ValueError):
            return read_as(text)
    return text


def _run(kept: StudyTable, taken: StudyTable, seconds: float) -> str:
    made = "; ".join(f"{name} {value}" for name, value in taken.facts.items())
    begun = f"Seed {kept.facts['seed']}, version {kept.facts['version']}"
    return f"{begun}, {seconds:.0f} seconds in all, on {made}."
