"""One run of everything: measure, print, write."""

from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Any

from matplotlib.figure import Figure

from benchmarks import (
    accuracy,
    collocation,
    figures,
    fixed_time,
    grids,
    peers,
    stacks,
    start,
    table,
    transfers,
)
from benchmarks.contest import Row
from benchmarks.problems import SEED
from pontryagin import files, plotting
from pontryagin.compile import COMPILE_FROM

FOLDER = "benchmarks"
"""Folder of the committed tables and plots below figures/."""

Table = dict[str, list[Any]]


def run(quick: bool) -> None:
    """Measure everything, print the tables, and write tables and plots."""
    begun = perf_counter()
    for peer in peers.PEERS:
        if line := peers.absent(peer):
            print(line)
    sections: dict[str, tuple[str, Callable[[], Table]]] = {
        "throughput": ("Our solvers against the aims", lambda: stacks.throughput(quick)),
        "stack-size": ("Time per problem by size of the stack", lambda: stacks.by_size(quick)),
        "accuracy": ("Worst miss and gap by class of problems", lambda: accuracy.table(quick)),
        "start": ("First calls in a fresh process", lambda: start.table(quick)),
    }
    rows = side_by_side(quick)
    tables = {"side-by-side": table.columns(rows)}
    titles = {"side-by-side": "Side by side, one thread"}
    table.printed(titles["side-by-side"], tables["side-by-side"])
    for name, (title, measure) in sections.items():
        tables[name], titles[name] = measure(), title
        table.printed(title, tables[name])
    drawn = [figures.accuracy_and_time(rows), figures.stack_size(tables["stack-size"], COMPILE_FROM)]
    if not peers.absent("ruckig"):
        cells = transfers.cells(quick)
        tables["failures"], titles["failures"] = (
            transfers.summary(cells),
            "Least time, share of inputs failed",
        )
        tables["failures-by-scale"] = transfers.by_cell(cells)
        titles["failures-by-scale"] = "Least time, share of inputs failed at each scale"
        table.printed(titles["failures"], tables["failures"])
        drawn.append(figures.failures_by_scale(cells))
    facts = table.machine() | {"seed": str(SEED), "run": f"{perf_counter() - begun:.0f} s"}
    for folder in write(quick, facts, titles, tables, drawn):
        print(f"written to {folder.relative_to(files.repository())}")


def side_by_side(quick: bool) -> list[Row]:
    """All problems and methods."""
    count, large, rounds = (50, 20_000, 2) if quick else (500, stacks.STACK_SIZE, 5)
    result = transfers.rows(quick)
    for problem in fixed_time.OURS:
        opponents: dict[str, fixed_time.Peer] = {}
        if problem != "least energy":
            opponents |= grids.peers(problem, quick)
        if problem != "least impulse":
            opponents |= collocation.peers(problem, quick)
        result += fixed_time.rows(problem, opponents, count, large, rounds)
    return result


def write(
    quick: bool, facts: dict[str, str], titles: dict[str, str], tables: dict[str, Table], drawn: list[Figure]
) -> list[Path]:
    """Write the tables as CSV and together as Markdown, and the plots; from a full run to figures/ too."""
    folders = [files.repository() / "build" / "bench"]
    if not quick:
        folders.append(files.figures_folder() / FOLDER)
    sheet = table.as_markdown(facts, titles, tables)
    for folder in folders:
        files.write(folder / "benchmarks.md", sheet)
        for name, columns in tables.items():
            files.write(folder / f"{name}.csv", table.as_csv(facts, columns))
        for figure in drawn:
            files.write(folder / f"{figure.get_label()}.svg", plotting.svg_of(figure))
    return folders
