"""The text as one HTML page that opens with no network: formulas by MathJax, pictures and scripts inside."""

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

from pontryagin.report import tree

ASSETS = Path(__file__).parent / "assets"
MATHJAX = Path(__file__).parent / "vendor" / "mathjax" / "tex-svg-full.js"
SHORT = 24
"""Characters of a table cell that stay on one line."""


def render_html(document: tree.Node, root: Path, title: dict[str, str]) -> str:
    """The page.

    Parameters
    ----------
    document : Node
        The assembled text; its pictures are named by paths below `root`.
    root : Path
        Where the pictures are looked for.
    title : dict
        ``pagetitle``, ``subtitle`` and ``imprint``.

    Raises
    ------
    PandocWarning
        When a picture is missing or a piece cannot be rendered.
    """
    _check_vendored()
    prepared = tree.walk(document, _for_html)
    options = ["-f", "json", "-t", "html5", "--standalone", "--embed-resources", "--wrap=none"]
    options += ["--toc", "--toc-depth=3", "--number-sections", f"--resource-path={root}"]
    options += [f"--template={ASSETS / 'report.html'}", f"--css={ASSETS / 'report.css'}"]
    options += [f"--include-in-header={ASSETS / 'mathjax.html'}", f"--mathjax={MATHJAX}"]
    options += [f"--variable={name}={value}" for name, value in title.items()]
    return tree.run(options, json.dumps(prepared))


def _for_html(node: tree.Node) -> list[tree.Node] | None:
    kind: str = node["t"]
    if kind == "CodeBlock" and "cell-code" in tree.attributes(node)[1]:
        fold = tree.raw("html", '<details class="code"><summary>code</summary>')
        node["c"][0][1] = ["python"]
        return [fold, node, tree.raw("html", "</details>")]
    if kind == "Table":
        _natural_widths(node)
        _unbroken(node)
        return [{"t": "Div", "c": [["", ["wide"], []], [node]]}]
    if kind == "Figure":
        return [_with_maker(node)]
    if kind == "Div" and "kept" in tree.attributes(node)[1]:
        identifier, classes, pairs = tree.attributes(node)
        made = {"t": "Plain", "c": [_maker(pairs["file"])]}
        line = {"t": "Div", "c": [["", ["made-by"], []], [made]]}
        return [{"t": "Div", "c": [[identifier, classes, []], [*node["c"][1], line]]}]
    return None


def _with_maker(figure: tree.Node) -> tree.Node:
    images = list(tree.elements(figure, "Image"))
    if images and images[0]["c"][2][0].count("/") == 2 and images[0]["c"][2][0].startswith("figures/"):
        span = {"t": "Span", "c": [["", ["made-by"], []], [_maker(images[0]["c"][2][0])]]}
        caption: list[Any] = figure["c"][1][1]
        caption[-1]["c"] = [*caption[-1]["c"], {"t": "Space"}, span]
    return figure


def _maker(file: str) -> tree.Node:
    _, notebook, name = file.split("/")
    links = (
        f'<a href="../../notebooks/{notebook}.ipynb">{notebook}.ipynb</a> · <a href="../../{file}">{name}</a>'
    )
    return tree.raw("html", links, inline=True)


def _natural_widths(table: tree.Node) -> None:
    table["c"][2] = [[alignment, {"t": "ColWidthDefault"}] for alignment, _ in table["c"][2]]


def _unbroken(table: tree.Node) -> None:
    """Mark the cells that are too short to be broken: names and numbers, hyphens in them or not."""
    for _, _, headed, rows in table["c"][4]:
        for _, cells in [*headed, *rows]:
            for cell in cells:
                if tree.length(cell[4]) <= SHORT:
                    cell[0][1] = [*cell[0][1], "short"]


def _check_vendored() -> None:
    recorded = (MATHJAX.parent / "ORIGIN").read_text(encoding="utf-8").split("sha256 ")[1].split()[0]
    if sha256(MATHJAX.read_bytes()).hexdigest() != recorded:
        raise ValueError(f"{MATHJAX.name}: its checksum is not the recorded one; restore the vendored file")
