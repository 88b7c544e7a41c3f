"""The ledger: what the papers print, what is derived, and the verdict that a check has to earn.

An entry states one formula, number or claim of a paper and a verdict. Its evidence, one of the kinds in
`pontryagin.ledger.evidence`, finds a verdict by mathematics; `Entry.check` raises when the two do not agree.
"""

import csv
import io
import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal, get_args

if TYPE_CHECKING:
    from rich.table import Table

    from pontryagin.ledger.evidence import Evidence

Verdict = Literal["holds", "misprint", "false", "conditional", "unreadable", "not checked"]
VERDICTS: tuple[Verdict, ...] = get_args(Verdict)

PAPERS = (
    "pontryagin.triple_integrator.claims",
    "pontryagin.rendezvous.claims",
    "pontryagin.orbit_correction.claims",
    "pontryagin.averaging.claims",
)
"""Modules whose ``ENTRIES`` make up the ledger, a paper a line."""

COLOURS = {
    "holds": "green",
    "misprint": "yellow",
    "false": "red",
    "conditional": "magenta",
    "unreadable": "cyan",
    "not checked": "white",
}


class Unsupported(AssertionError):
    """The evidence of an entry does not support its verdict; the message says where it breaks."""


@dataclass(frozen=True)
class Entry:
    """One formula, number or claim of a paper.

    Parameters
    ----------
    paper, label, statement : str
        Where it stands (paper; equation number or place) and what it says.
    verdict : str
        One of `VERDICTS`.
    remark : str
        For whatever does not hold: what is printed, what is right, and why.
    build : callable
        Returns the evidence; called once, when it is first asked for.

    Examples
    --------
    >>> entry = entries(paper="Gorelov", verdict="misprint")[0]
    >>> entry.verdict
    'misprint'
    >>> entry.check()
    """

    paper: str
    label: str
    statement: str
    verdict: Verdict
    remark: str
    build: "Callable[[], Evidence | None]"

    @cached_property
    def evidence(self) -> "Evidence | None":
        """The printed form, the derivation and the proofs; None for what is not checked."""
        return self.build()

    def check(self) -> None:
        """Find the verdict anew and compare.

        Raises
        ------
        Unsupported
            If the evidence breaks, or supports another verdict than the one stated.
        """
        if self.verdict != "holds" and not self.remark:
            raise Unsupported(f"{self.label}: a verdict of {self.verdict!r} needs a remark that says why")
        try:
            found = self.evidence.finding() if self.evidence else "not checked"
        except Unsupported as broken:
            raise Unsupported(f"{self.label}: {broken}") from broken
        if found != self.verdict:
            raise Unsupported(f"{self.label}: the ledger says {self.verdict!r}, the evidence says {found!r}")

    @property
    def printed(self) -> Any:
        """What the paper prints, a mapping from left-hand sides to SymPy expressions; None for words."""
        return self.evidence.printed if self.evidence else None

    @property
    def derived(self) -> Any:
        """What first principles give instead, in the form of `printed`; None for words."""
        return self.evidence.derivation() if self.evidence else None

    @property
    def printed_latex(self) -> str:
        """What the paper prints as LaTeX without delimiters; empty for a claim in words."""
        return self.evidence.shown() if self.evidence else ""

    @property
    def derived_latex(self) -> str:
        """`derived` as LaTeX without delimiters; empty for a claim in words. Runs the derivation."""
        return self.evidence.latex(self.evidence.derivation()) if self.evidence else ""

    def proof(self) -> list[str]:
        """Run the check and return its steps, one sentence each."""
        self.check()
        return [words for words, _ in self.evidence.steps()] if self.evidence else []

    def as_dict(self) -> dict[str, str]:
        """The entry as flat text: paper, label, statement, verdict, remark and `printed` in LaTeX."""
        return {
            "paper": self.paper,
            "label": self.label,
            "statement": self.statement,
            "verdict": self.verdict,
            "remark": self.remark,
            "printed": self.printed_latex,
        }


class Page(list[Entry]):
    """Entries of one paper in its order; called as a decorator, it takes down one more.

    Examples
    --------
    >>> claim = Page("A paper")
    >>> @claim("(1)", "something said in passing", verdict="not checked", remark="no mathematics decides it")
    ... def passing():
    ...     return None
    >>> claim[0].check()
    """

    def __init__(self, paper: str) -> None:
        super().__init__()
        self.paper = paper

    def __call__(
        self, label: str, statement: str, *, verdict: Verdict, remark: str = ""
    ) -> "Callable[[Callable[[], Evidence | None]], Entry]":
        """Decorate a function that returns the evidence; the function becomes the entry."""

        def take_down(build: "Callable[[], Evidence | None]") -> Entry:
            entry = Entry(self.paper, label, statement, verdict, remark, build)
            self.append(entry)
            return entry

        return take_down


def entries(paper: str | None = None, verdict: str | None = None) -> tuple[Entry, ...]:
    """The ledger in the order of the papers, or the part of it that is asked for.

    Parameters
    ----------
    paper : str, optional
        A paper's name or part of it, in any case.
    verdict : str, optional
        One of `VERDICTS`.

    Raises
    ------
    ValueError
        If no paper has that name, or no verdict.

    Examples
    --------
    >>> entries(paper="gorelov")[0].label
    '(0.1)'
    """
    if verdict is not None and verdict not in VERDICTS:
        raise ValueError(f"verdict: got {verdict!r}, takes one of {', '.join(map(repr, VERDICTS))}")
    whole = tuple(_all())
    papers = list(dict.fromkeys(entry.paper for entry in whole))
    named = [name for name in papers if paper is None or paper.casefold() in name.casefold()]
    if not named:
        raise ValueError(f"paper: got {paper!r}, takes (part of) one of {', '.join(map(repr, papers))}")
    return tuple(entry for entry in whole if entry.paper in named and verdict in (None, entry.verdict))


def _all() -> Iterator[Entry]:
    for module in PAPERS:
        yield from import_module(module).ENTRIES


def counts(of: Iterable[Entry]) -> dict[str, int]:
    """How many entries there are of each verdict, in the order of `VERDICTS`."""
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
    """The entries as a table for the terminal, papers under headings, verdicts in colour."""
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
