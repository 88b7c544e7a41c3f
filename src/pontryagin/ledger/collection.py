"""The ledger of all papers: its entries, their counts, and their export as CSV, JSON and a table."""

import csv
import io
import json
from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING

from pontryagin import papers
from pontryagin.errors import ArgumentValueError
from pontryagin.ledger.entry import Entry
from pontryagin.ledger.verdict import COLOURS, VERDICTS, kind

if TYPE_CHECKING:
    from rich.table import Table

PAPERS = tuple(f"pontryagin.{package}.claims" for package in papers.packages())
"""Modules whose ``ENTRIES`` make up the ledger."""


def entries(paper: str | None = None, verdict: str | None = None) -> tuple[Entry, ...]:
    """The entries of all papers in their order, or those of one paper or verdict.

    Parameters
    ----------
    paper : str, optional
        A paper's name or part of it, in any case.
    verdict : str, optional
        One of `VERDICTS`.

    Raises
    ------
    ValueError
        If there is no such paper or verdict.

    Examples
    --------
    >>> entries(paper="gorelov")[0].label
    '(0.1)'
    """
    if verdict is not None:
        kind(verdict)
    known = dict.fromkeys(one.name for one in papers.PAPERS)
    chosen = [name for name in known if paper is None or paper.casefold() in name.casefold()]
    if not chosen:
        raise ArgumentValueError(
            f"paper: got {paper!r}, takes (part of) one of {', '.join(map(repr, known))}", "paper"
        )
    packages = dict.fromkeys(one.package for one in papers.PAPERS if one.name in chosen)
    collected: list[Entry] = [
        entry for package in packages for entry in papers.room(package, "claims").ENTRIES
    ]
    return tuple(entry for entry in collected if entry.paper in chosen and verdict in (None, entry.verdict))


def counts(of: Iterable[Entry]) -> dict[str, int]:
    """The number of entries of each verdict, in the order of `VERDICTS`."""
    tally = Counter(entry.verdict for entry in of)
    return {verdict: tally[verdict] for verdict in VERDICTS}


def to_json(of: Iterable[Entry]) -> str:
    """A JSON list with one object per entry (see `Entry.as_dict`)."""
    return json.dumps([entry.as_dict() for entry in of], ensure_ascii=False, indent=1)


def to_csv(of: Iterable[Entry]) -> str:
    """CSV with a header line and one row per entry (see `Entry.as_dict`)."""
    text = io.StringIO()
    writer = csv.DictWriter(
        text, ["paper", "label", "statement", "verdict", "remark", "printed"], lineterminator="\n"
    )
    writer.writeheader()
    writer.writerows(entry.as_dict() for entry in of)
    return text.getvalue()


def table(of: Iterable[Entry]) -> "Table":
    """The entries as a table for the terminal, under the names of their papers, verdicts in colour."""
    from rich.table import Table
    from rich.text import Text

    rows = list(of)
    tally = ", ".join(f"{n} {verdict}" for verdict, n in counts(rows).items() if n)
    view = Table(title=f"{len(rows)} entries: {tally}", show_lines=False, pad_edge=False)
    for heading in ("label", "statement", "verdict", "remark"):
        view.add_column(heading, overflow="fold", vertical="top")
    for number, entry in enumerate(rows):
        if number == 0 or entry.paper != rows[number - 1].paper:
            view.add_row("", Text(entry.paper, style="bold"), "", "")
        view.add_row(
            Text(entry.label),
            Text(entry.statement),
            Text(entry.verdict, style=COLOURS[entry.verdict]),
            Text(entry.remark),
        )
    return view
