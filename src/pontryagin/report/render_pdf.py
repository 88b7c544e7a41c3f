"""The same text as a PDF, by pandoc's typst writer and typst; code is left out."""

import json
from pathlib import Path

from pontryagin.io import files
from pontryagin.report import tex, tree
from pontryagin.report.environment import EPOCH
from pontryagin.report.render_html import ASSETS


def render_pdf(document: tree.Node, root: Path, target: Path, title: dict[str, str]) -> None:
    """Write the PDF to `target`.

    Raises
    ------
    PandocWarning
        When a formula cannot be converted or typst cannot render a piece.
    """
    import typst

    text = typst_text(document, title)
    draft = root / "build" / ".report.partial.typ"
    draft.parent.mkdir(parents=True, exist_ok=True)
    try:
        draft.write_text(_placed(text), encoding="utf-8")
        pdf = typst.compile(
            str(draft), root=str(root), ignore_system_fonts=True, timestamp=int(EPOCH), pdf_tags=False
        )
    except typst.TypstError as error:
        raise tree.PandocWarning(f"typst: {error}") from error
    finally:
        draft.unlink(missing_ok=True)
    files.write(target, pdf)


def _placed(text: str) -> str:
    return text.replace('image("', 'image("/').replace("align(center)[#table(", "align(left)[#table(")


def typst_text(document: tree.Node, title: dict[str, str]) -> str:
    """The document in typst's language."""
    prepared = tree.walk(document, _for_typst)
    options = ["-f", "json", "-t", "typst", "--standalone", "--wrap=none"]
    options += [f"--template={ASSETS / 'report.typ'}"]
    options += [f"--variable={name}={value}" for name, value in title.items()]
    return tree.run(options, json.dumps(prepared))


def _for_typst(node: tree.Node) -> list[tree.Node] | None:
    kind: str = node["t"]
    if kind == "Math":
        return _formula(node)
    if kind == "CodeBlock" and "cell-code" in tree.attributes(node)[1]:
        return []
    if kind == "RawBlock" and node["c"][0] == "html":
        return tree.walk(tree.read(node["c"][1], "html")["blocks"], _for_typst)
    if kind == "Span" and "verdict" in tree.attributes(node)[1]:
        name = tree.attributes(node)[1][-1]
        opening, closing = (tree.raw("typst", part, inline=True) for part in (f'#verdict("{name}")[', "]"))
        return [opening, *node["c"][1], closing]
    if kind == "Table":
        node["c"][2] = [[alignment, {"t": "ColWidthDefault"}] for alignment, _ in node["c"][2]]
    if kind == "Link" and not node["c"][2][0].startswith(("#", "http")):
        return node["c"][1]
    return None


def _formula(node: tree.Node) -> list[tree.Node]:
    formula, tag = tex.for_typst(node["c"][1])
    node["c"][1] = formula
    if tag is None:
        return [node]
    opening, closing = (tree.raw("typst", part, inline=True) for part in (f"#tagged[{tag}][", "]"))
    return [opening, node, closing]
