"""What notebooks display besides figures and tables: formulas, and entries of the ledger judged anew."""

import re
from collections.abc import Iterable, Mapping
from typing import Any

from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from pontryagin import ledger
from pontryagin.ledger import Entry
from pontryagin.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, WIDTH, styled

TILES: dict[str, str] = dict(zip(ledger.VERDICTS, (GREEN, ORANGE, RED, PURPLE, BLUE, SKY), strict=True))
SECTIONS: dict[str, dict[str, str]] = {
    "Gorelov & Morozova 2012": {
        "0": "Gorelov, introduction",
        "1": "1 moments",
        "2": "2 energy",
        "3": "3 peak",
        "4": "4 impulse",
    },
    "Ibragimov 2017": {"0": "Ibragimov"},
    "Akulenko 1977": {
        "0": "Akulenko, introduction",
        "1": "1 problem",
        "2": "2 averaging",
        "3": "3 examples",
    },
}
"""Rows of the overview: the sections of a paper whose equations carry their numbers."""
_SPECIAL = re.compile(r"([\\`*_~^<>\[\]#])")


def equation(left: Any, right: Any) -> None:
    r"""Display ``left = right`` as mathematics.

    Parameters
    ----------
    left, right : SymPy expression or matrix, or LaTeX

    Examples
    --------
    >>> import sympy as sp
    >>> equation("J", sp.Symbol("x") ** 2)
    {'text/latex': '$\\displaystyle J = x^{2}$', 'text/plain': ...}
    """
    equations([left], [right])


def equations(left: Iterable[Any], right: Iterable[Any] | None = None) -> None:
    r"""Display equations one below the other, aligned at the sign of equality.

    Parameters
    ----------
    left, right : SymPy expressions or matrices, or LaTeX
        Both sides; or a mapping from left-hand to right-hand sides alone.
    """
    sides = left.items() if isinstance(left, Mapping) else zip(left, right or (), strict=True)
    rows = [f"{_latex(a)} &= {_latex(b)}" for a, b in sides]
    single = len(rows) == 1
    lines = r" \\ ".join(rows)
    body = lines.replace(" &= ", " = ") if single else rf"\begin{{aligned}} {lines} \end{{aligned}}"
    _publish({"text/latex": rf"$\displaystyle {body}$"})


def vanishing(expressions: Iterable[Any]) -> None:
    """Display expressions that are to be zero, as equations one below the other."""
    listed = list(expressions)
    equations(listed, ["0"] * len(listed))


def entry(label: str, paper: str | None = None) -> None:
    """Check an entry of the ledger; display what is printed, what is derived, the verdict and the remark.

    Parameters
    ----------
    label : str
        Equation number or place, as in the ledger.
    paper : str, optional
        A paper's name or part of it.

    Raises
    ------
    ValueError
        If there is no such entry, or several papers have one.
    pontryagin.ledger.Unsupported
        If the verdict does not stand.
    """
    found = [candidate for candidate in ledger.entries(paper) if candidate.label == label]
    if not found:
        raise ValueError(f"label: got {label!r}, takes one of the ledger's")
    if len(papers := list(dict.fromkeys(one.paper for one in found))) > 1:
        raise ValueError(f"paper: got {paper!r}, takes one of those that have {label}: {', '.join(papers)}")
    for one in found:
        one.check()
        _publish({"text/markdown": account(one)})


def verdicts(verdict: str, paper: str | None = None) -> None:
    """Check every entry of a verdict; display each as `entry` does, with the steps of its proof."""
    for one in ledger.entries(paper, verdict):
        steps = "\n".join(f"- {_text(step)}" for step in one.proof())
        _publish({"text/markdown": f"{account(one)}\n\nChecked here, step by step:\n\n{steps}"})


def account(entry: Entry) -> str:
    """An entry as Markdown: print and derivation typeset, then the remark."""
    parts = [f"**{entry.label}** {_text(entry.statement)}: *{entry.verdict}*."]
    if entry.printed_latex:
        parts.append(f"Printed:\n\n$${entry.printed_latex}$$")
    if entry.derived_latex:
        same = entry.verdict == "holds"
        parts.append("Derived: the same." if same else f"Derived:\n\n$${entry.derived_latex}$$")
    if entry.remark:
        parts.append(_text(entry.remark))
    return "\n\n".join(parts)


def counts_table(paper: str | None = None) -> dict[str, list[Any]]:
    """Entries of each verdict by section of the paper: columns for `plotting.show_table`."""
    rows = sections(ledger.entries(paper))
    names = [*rows, "all"]
    groups = [*rows.values(), [one for group in rows.values() for one in group]]
    tallies = [ledger.counts(group) for group in groups]
    seen = [verdict for verdict in ledger.VERDICTS if tallies[-1][verdict]]
    columns: dict[str, list[Any]] = {"section": names}
    columns |= {verdict: [tally[verdict] for tally in tallies] for verdict in seen}
    return columns | {"entries": [len(group) for group in groups]}


def sections(entries: Iterable[Entry]) -> dict[str, list[Entry]]:
    """Entries by section, read off the equation number in their labels; others stay with the one before.

    A section that `SECTIONS` does not name is called by its paper and number.
    """
    grouped: dict[str, list[Entry]] = {}
    paper, section = "", "0"
    for one in entries:
        numbered = re.search(r"\((\d)\.", one.label)
        section = numbered[1] if numbered else section if one.paper == paper else "0"
        paper = one.paper
        name = SECTIONS.get(paper, {}).get(section, f"{paper}, {section}")
        grouped.setdefault(name, []).append(one)
    return grouped


@styled
def verdict_tiles(paper: str | None = None) -> Figure:
    """One tile for each entry in the order of the paper, a row a section, coloured by verdict."""
    grouped = sections(ledger.entries(paper))
    across = 36
    lines = [
        (name if start == 0 else "", group[start : start + across])
        for name, group in grouped.items()
        for start in range(0, len(group), across)
    ]
    figure = Figure(figsize=(WIDTH, 0.5 + 0.165 * len(lines)), layout="constrained")
    ax = figure.subplots()
    for row, (name, group) in enumerate(lines):
        ax.text(-0.6, row + 0.5, name, ha="right", va="center", color=INK)
        for column, one in enumerate(group):
            faint = 0.35 if one.verdict == "holds" else 1.0
            tile = Rectangle(
                (column + 0.08, row + 0.08), 0.84, 0.84, color=TILES[one.verdict], alpha=faint, lw=0
            )
            ax.add_patch(tile)
    ax.set(xlim=(-6.5, across), ylim=(len(lines), 0), aspect="equal")
    ax.axis("off")
    present = [verdict for verdict, count in ledger.counts(ledger.entries(paper)).items() if count]
    handles = [Patch(color=TILES[verdict], alpha=0.35 if verdict == "holds" else 1.0) for verdict in present]
    figure.legend(handles, present, loc="outside lower center", ncols=len(present), handlelength=1.0)
    return figure


def _latex(side: Any) -> str:
    import sympy as sp

    return side if isinstance(side, str) else sp.latex(side)


def _text(words: str) -> str:
    """Words for Markdown: what stands between dollars is kept, the rest means itself."""
    parts = re.split(r"(\$[^$]*\$)", words)
    return "".join(part if part.startswith("$") else _SPECIAL.sub(r"\\\1", part) for part in parts)


def _publish(data: dict[str, str]) -> None:
    from IPython.display import display

    plain = next(iter(data.values()))
    display({**data, "text/plain": plain}, raw=True)
