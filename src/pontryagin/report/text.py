"""The assembled Markdown as a syntax tree, and the cell that every formula stands in."""

import re
from dataclasses import dataclass

from pontryagin.report import tex, tree

OWN_PAGES = "a page that the report makes itself"


class UnreadableFormula(RuntimeError):
    """A formula that a renderer cannot read; the message names its place."""


@dataclass(frozen=True)
class Text:
    """The report's text: its tree, and for each formula the places where it stands."""

    document: tree.Node
    places: dict[str, list[str]]

    def unreadable(self, complaint: str, formulas: list[str] | None = None) -> UnreadableFormula | None:
        """An error that places the formulas a renderer named, or those its complaint quotes; None if none."""
        named = formulas if formulas is not None else [f for f in self.places if _quoted(f, complaint)]
        if not named:
            return None
        lines = [f"{place}: cannot read the formula {f.strip()}" for f in named for place in self._of(f)]
        return UnreadableFormula("\n".join([*lines, complaint] if complaint else lines))

    def _of(self, formula: str) -> list[str]:
        return self.places.get(formula, [OWN_PAGES])


def read(markdown: str) -> Text:
    """Read the assembled Markdown.

    Raises
    ------
    PandocWarning
        When pandoc warns about a piece or a link leads nowhere; the message names the cell.
    """
    try:
        document = tree.read(markdown)
    except tree.PandocWarning as warning:
        raise tree.PandocWarning(_with_place(str(warning), markdown)) from None
    places: dict[str, list[str]] = {}
    blocks: list[tree.Node] = []
    for block in document["blocks"]:
        place = _place(block)
        for math in tree.elements(block, "Math"):
            places.setdefault(math["c"][1], []).append(place or OWN_PAGES)
        blocks.extend(block["c"][1] if place else [block])
    _check_links(document["blocks"])
    return Text({**document, "blocks": blocks}, places)


def _check_links(blocks: list[tree.Node]) -> None:
    known = set(tree.identifiers(blocks))
    for block in blocks:
        for link in tree.elements(block, "Link"):
            target: str = link["c"][2][0]
            if target.startswith("#") and target[1:] not in known:
                place = _place(block) or OWN_PAGES
                raise tree.PandocWarning(f"{place}: a link leads to {target}, which is not in the report")


def _place(block: tree.Node) -> str | None:
    if block["t"] != "Div" or "cell" not in tree.attributes(block)[1]:
        return None
    return tree.attributes(block)[2]["place"]


def _quoted(formula: str, complaint: str) -> bool:
    written = tex.for_typst(formula)[0].strip()
    return f"TeX math {written}, rendering" in complaint


def _with_place(warning: str, markdown: str) -> str:
    line = re.search(r"line (\d+)", warning)
    above = markdown.splitlines()[: int(line[1])] if line else []
    places = re.findall(r'place="([^"]*)"', "\n".join(above))
    return f"{places[-1]}: {warning}" if places else warning
