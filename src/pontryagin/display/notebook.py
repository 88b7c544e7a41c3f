"""Formulas and entries of the ledger as notebooks display them; each entry shown is checked first."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from pontryagin import ledger
from pontryagin.display import plotting
from pontryagin.display.plotting import INK, styled, subplots
from pontryagin.errors import ArgumentValueError
from pontryagin.ledger import Entry
from pontryagin.ledger.verdict import TABLE

TILES = {row.name: {"color": getattr(plotting, row.tile), "alpha": row.opacity} for row in TABLE}
"""Colour and opacity of each verdict's tiles, as Matplotlib's arguments."""

_SPECIAL = re.compile(r"([\\`*_~^<>\[\]#])")


def equation(left: Any, right: Any) -> None:
    r"""Display the equation ``left = right``.

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
    r"""Display equations one below the other, aligned at their equals signs.

    Parameters
    ----------
    left, right : SymPy expressions or matrices, or LaTeX
        Both sides; or, as the only argument, a mapping from left-hand to right-hand sides.
    """
    sides = left.items() if isinstance(left, Mapping) else zip(left, right or (), strict=True)
    rows = [f"{_latex(a)} &= {_latex(b)}" for a, b in sides]
    single = len(rows) == 1
    lines = r" \\ ".join(rows)
    body = lines.replace(" &= ", " = ") if single else rf"\begin{{aligned}} {lines} \end{{aligned}}"
    _publish({"text/latex": rf"$\displaystyle {body}$"})


def vanishing(expressions: Iterable[Any]) -> None:
    """Display the equations ``expression = 0`` one below the other."""
    listed = list(expressions)
    equations(listed, ["0"] * len(listed))


def entry(label: str, entries: Iterable[Entry]) -> None:
    """Check an entry of the ledger; display its printed and derived forms, its verdict and its remark.

    Parameters
    ----------
    label : str
        Equation number or place, as in the ledger.
    entries : iterable of Entry
        Where it is looked for: a paper's entries, so that no other paper's claims are loaded.

    Raises
    ------
    ValueError
        If there is no such entry, or several papers have one.
    pontryagin.ledger.Unsupported
        If the evidence does not support the verdict.
    """
    found = [candidate for candidate in entries if candidate.label == label]
    if not found:
        raise ArgumentValueError(f"label: got {label!r}, takes that of one of the entries", "label")
    if len(papers := list(by_paper(found))) > 1:
        raise ArgumentValueError(
            f"entries: got those of {', '.join(papers)}, which have an entry {label} each; takes one paper's",
            "entries",
        )
    for one in found:
        _publish({"text/markdown": account(one)})


def verdicts(entries: Iterable[Entry]) -> None:
    """Check entries of the ledger; display each as `entry` does, followed by the steps of its proof."""
    for one in entries:
        steps = "\n".join(f"- {_text(step)}" for step in one.checked_steps())
        _publish({"text/markdown": f"{account(one)}\n\nChecked here, step by step:\n\n{steps}"})


def account(entry: Entry) -> str:
    """A checked entry as Markdown: its printed and derived forms as formulas, then the remark."""
    printed, derived = entry.checked_forms()
    parts = [f"**{entry.label}** {_text(entry.statement)}: *{entry.verdict}*."]
    if printed:
        parts.append(f"Printed:\n\n$${printed}$$")
    if derived:
        same = entry.verdict == "holds"
        parts.append("Derived: the same." if same else f"Derived:\n\n$${derived}$$")
    if entry.remark:
        parts.append(_text(entry.remark))
    return "\n\n".join(parts)


def counts_table(entries: Iterable[Entry]) -> dict[str, list[Any]]:
    """The number of entries of each verdict and paper, as columns for `plotting.show_table`."""
    rows = by_paper(entries)
    groups = [*rows.values(), [one for group in rows.values() for one in group]]
    tallies = [ledger.counts(group) for group in groups]
    seen = [verdict for verdict in ledger.VERDICTS if tallies[-1][verdict]]
    columns: dict[str, list[Any]] = {"paper": [*rows, "all"]}
    columns |= {verdict: [tally[verdict] for tally in tallies] for verdict in seen}
    return columns | {"entries": [len(group) for group in groups]}


def by_paper(entries: Iterable[Entry]) -> dict[str, list[Entry]]:
    """The entries of each paper by its name, in the order of the ledger."""
    grouped: dict[str, list[Entry]] = {}
    for one in entries:
        grouped.setdefault(one.paper, []).append(one)
    return grouped


@styled
def verdict_tiles(entries: Sequence[Entry]) -> Figure:
    """A tile for each entry, coloured by verdict; papers one below the other, entries in their order."""
    grouped = by_paper(entries)
    across = 36
    gap = 0.5
    lines = [
        (number * gap, name if start == 0 else "", group[start : start + across])
        for number, (name, group) in enumerate(grouped.items())
        for start in range(0, len(group), across)
    ]
    height = len(lines) + gap * (len(grouped) - 1)
    figure, ax = subplots(height=0.5 + 0.165 * height)
    for line, (offset, name, group) in enumerate(lines):
        row = line + offset
        ax.text(-0.6, row + 0.5, name, ha="right", va="center", color=INK)
        for column, one in enumerate(group):
            corner = (column + 0.08, row + 0.08)
            ax.add_patch(Rectangle(corner, 0.84, 0.84, lw=0, **TILES[one.verdict]))
    ax.set(xlim=(-10.5, across), ylim=(height, 0), aspect="equal")
    ax.axis("off")
    present = [verdict for verdict, count in ledger.counts(entries).items() if count]
    handles = [Patch(**TILES[verdict]) for verdict in present]
    figure.legend(handles, present, loc="outside lower center", ncols=len(present), handlelength=1.0)
    return figure


def _latex(side: Any) -> str:
    import sympy as sp

    return side if isinstance(side, str) else sp.latex(side)


def _text(words: str) -> str:
    """Text for Markdown: formulas between dollar signs are kept, special characters elsewhere are escaped."""
    parts = re.split(r"(\$[^$]*\$)", words)
    return "".join(part if part.startswith("$") else _SPECIAL.sub(r"\\\1", part) for part in parts)


def _publish(data: dict[str, str]) -> None:
    from IPython.display import display

    plain = next(iter(data.values()))
    display({**data, "text/plain": plain}, raw=True)  # type: ignore[no-untyped-call]
