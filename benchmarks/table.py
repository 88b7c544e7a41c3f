"""Rows of results as CSV, Markdown and tables of the terminal."""

import csv
import io
import platform
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.contest import CALL, STACK, Row
from benchmarks.peers import PEERS, installed

NOTES = (
    "Times are processor time of one thread, medians of rounds in which all contestants take turns;",
    "input set-up from Python is included unless the row says otherwise. Ratios are to our own rows on the",
    "same problem: above 1, the factor by which a method is slower than ours; below 1, it is faster.",
    "The error of a peer is its cost against the exact optimum; ours is 1 - dual bound / cost.",
)
"""Explanations that hold for all tables."""


def by_heading(rows: Sequence[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """The columns of a table, from rows that hold a value under each heading."""
    return {heading: [row[heading] for row in rows] for heading in rows[0]}


def columns(rows: Sequence[Row]) -> dict[str, list[Any]]:
    """The rows as columns; each time also as a multiple of our own times for the same problem."""
    ours = {(row.problem, row.method): row.timing.typical for row in rows}
    return by_heading(
        [
            {
                "problem": row.problem,
                "method": row.method,
                "problems": row.count,
                "microseconds": 1e6 * row.timing.typical,
                "fastest round": 1e6 * row.timing.least,
                "times our call": row.timing.typical / ours[row.problem, CALL],
                "times our stack": row.timing.typical / ours[row.problem, STACK],
                "worst relative error": row.error,
                "solved": row.solved,
            }
            for row in rows
        ]
    )


def machine() -> dict[str, str]:
    """The processor, interpreter and package versions that the numbers depend on."""
    packages = ("numpy", "numba", *PEERS)
    return {
        "processor": f"{_processor()}, {platform.system()} {platform.machine()}",
        "threads": "1",
        "Python": platform.python_version(),
        **{package: installed(package) or "absent" for package in packages},
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or "unknown processor"


def text(value: Any) -> str:
    """The text of a cell; numbers have three digits."""
    if value is None:
        return ""
    if isinstance(value, float):
        if value != value:
            return "–"
        if value == 0 or 1e-2 <= abs(value) < 1e4:
            return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
        return f"{value:.1e}"
    return str(value)


def section(
    title: str,
    facts: Mapping[str, str],
    notes: Sequence[str],
    tables: Mapping[str, tuple[str, Mapping[str, Sequence[Any]]]],
) -> str:
    """The tables of one paper as a section of the Markdown page, after the facts about the machine."""
    head = "; ".join(f"{name} {value}" for name, value in facts.items())
    lines = [f"## {title}", "", head + ".", "", *notes, ""]
    for heading, columns in tables.values():
        numeric = [_numeric(column) for column in columns.values()]
        lines += [f"### {heading}", "", "| " + " | ".join(columns) + " |"]
        lines.append("|" + "|".join(" --: " if right else " :-- " for right in numeric) + "|")
        lines += ["| " + " | ".join(map(text, row)) + " |" for row in zip(*columns.values(), strict=True)]
        lines.append("")
    return "\n".join(lines)


def page(written: str, new: str, order: Sequence[str]) -> str:
    """The Markdown page with a new section; the other sections already written stay."""
    found = [*re.split(r"^(?=## )", written, flags=re.MULTILINE)[1:], new]
    titled = {part.split("\n", 1)[0].removeprefix("## "): part.strip() for part in found}
    kept = [titled[title] for title in order if title in titled]
    return "\n\n".join(["# Benchmarks", "\n".join(NOTES), *kept]) + "\n"


def printed(title: str, table: Mapping[str, Sequence[Any]]) -> None:
    """Print a table in the terminal."""
    from rich.console import Console
    from rich.table import Table

    shown = Table(title=title, title_justify="left", header_style="bold")
    for heading, column in table.items():
        shown.add_column(heading, justify="right" if _numeric(column) else "left")
    for row in zip(*table.values(), strict=True):
        shown.add_row(*map(text, row))
    console = Console()
    (console if console.is_terminal else Console(width=150)).print(shown)


def as_csv(facts: Mapping[str, str], table: Mapping[str, Sequence[Any]]) -> str:
    """A table as CSV, after comment lines with the facts about the machine."""
    stream = io.StringIO()
    stream.writelines(f"# {name}: {value}\n" for name, value in facts.items())
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(table)
    writer.writerows(
        [f"{value:.6g}" if isinstance(value, float) else value for value in row]
        for row in zip(*table.values(), strict=True)
    )
    return stream.getvalue()


def _numeric(column: Sequence[Any]) -> bool:
    return all(isinstance(value, float | int) or value is None for value in column)
