"""Measuring papers, printing and writing the results; sections of other papers stay as they are."""

from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

from benchmarks import papers, peers, table
from benchmarks.papers import PAPERS, Measured
from pontryagin.display import plotting
from pontryagin.io import files

FOLDER = "benchmarks"
"""Folder of the committed tables and plots in figures/."""

PAGE = "benchmarks.md"


def run(names: Sequence[str], quick: bool) -> None:
    """Measure the named papers, print their tables, and write tables and plots."""
    for peer in peers.PEERS:
        if line := peers.absent(peer):
            print(line)
    for name in names:
        begun = perf_counter()
        measured = papers.measure(name, quick)
        for title, columns in measured.tables.values():
            table.printed(title, columns)
        facts = table.machine() | {"seed": str(measured.seed), "run": f"{perf_counter() - begun:.0f} s"}
        for folder in folders(quick):
            write(folder, name, facts, measured)
            print(f"written to {folder.relative_to(files.repository())}")


def folders(quick: bool) -> list[Path]:
    """The folders that results are written to; those of a full run go to figures/ too."""
    built = files.repository() / "build" / "bench"
    return [built] if quick else [built, files.figures_folder() / FOLDER]


def write(folder: Path, name: str, facts: dict[str, str], measured: Measured) -> None:
    """Write a paper's tables as CSV and its plots to its folder, and its section of the page."""
    page = folder / PAGE
    section = table.section(PAPERS[name], facts, measured.notes, measured.tables)
    written = page.read_text(encoding="utf-8") if page.is_file() else ""
    files.write(page, table.page(written, section, list(PAPERS.values())))
    for label, (_, columns) in measured.tables.items():
        files.write(folder / name / f"{label}.csv", table.as_csv(facts, columns))
    for figure in measured.figures:
        files.write(folder / name / f"{figure.get_label()}.svg", plotting.svg_of(figure))
