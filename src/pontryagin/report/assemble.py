"""Executed notebooks to one Markdown text in which every piece knows the cell it comes from."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from nbformat import NotebookNode

from pontryagin.io import files
from pontryagin.report import tex
from pontryagin.report.execute import Executed
from pontryagin.report.workspace import Workspace

FENCE = ":" * 12
_ADDRESS = re.compile(r"<[^<>\n]* at 0x[0-9a-f]+>")
_ANSI = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")


class Unprintable(RuntimeError):
    """A cell that the report cannot show; the message names it."""


@dataclass(frozen=True)
class Item:
    """A figure or table of the report: where it is kept, which notebook makes it, what it shows."""

    kind: str
    notebook: str
    name: str
    caption: str

    @property
    def anchor(self) -> str:
        """Identifier of the item in the text."""
        return f"{self.kind}-{self.notebook}-{self.name}"

    @property
    def file(self) -> str:
        """Path below the root of the checkout."""
        return f"figures/{self.notebook}/{self.name}.{'svg' if self.kind == 'figure' else 'csv'}"


def chapter(workspace: Workspace, executed: Executed) -> str:
    """Markdown of one executed notebook.

    Raises
    ------
    Unprintable
        When the notebook has no title, or a cell prints what differs from run to run.
    """
    cells = executed.notebook.cells
    if not cells or cells[0].cell_type != "markdown" or not cells[0].source.startswith("# "):
        raise Unprintable(f"notebooks/{executed.name}.ipynb, cell 1: must begin with the title, '# ...'")
    blocks = []
    for number, cell in enumerate(cells, 1):
        place = f"notebooks/{executed.name}.ipynb, cell {number}"
        text = (
            _text(cell, executed.name, number)
            if cell.cell_type == "markdown"
            else _code(workspace, cell, place)
        )
        blocks.append(f'{FENCE} {{.cell place="{place}"}}\n\n{text}\n\n{FENCE}\n')
    return "\n".join(blocks)


def items(executed: Iterable[Executed]) -> list[Item]:
    """All figures and tables, in the order of the report.

    Raises
    ------
    Unprintable
        When a notebook gives two of them the same name.
    """
    found: dict[str, Item] = {}
    for result in executed:
        for number, cell in enumerate(result.notebook.cells, 1):
            for output in cell.get("outputs", []):
                item = _item(output)
                if item and item.anchor in found:
                    place = f"notebooks/{result.name}.ipynb, cell {number}"
                    raise Unprintable(
                        f"{place}: a second {item.kind} is called {item.name!r}; name it otherwise"
                    )
                if item:
                    found[item.anchor] = item
    return list(found.values())


def warnings(executed: Executed) -> list[str]:
    """What cells wrote to stderr: left out of the report, told by the build."""
    told = []
    for number, cell in enumerate(executed.notebook.cells, 1):
        for output in cell.get("outputs", []):
            if output.output_type == "stream" and output.name == "stderr":
                first = output.text.strip().splitlines()[0]
                told.append(f"notebooks/{executed.name}.ipynb, cell {number} wrote to stderr: {first}")
    return told


def _text(cell: NotebookNode, notebook: str, number: int) -> str:
    text = tex.display_blocks(cell.source)
    text = re.sub(r"(?<!!)\]\((?:\./)?([\w.-]+)\.ipynb(?:#[^)]*)?\)", r"](#nb-\1)", text)
    text = re.sub(r"(!\[[^\]]*\]\()\.\./", r"\1", text)
    text = re.sub(r"(?<!!)(\[[^\]!]*\]\()\.\./", r"\1../../", text)
    if number == 1:
        title, _, rest = text.partition("\n")
        return f"{title} {{#nb-{notebook}}}\n{rest}"
    return text


def _code(workspace: Workspace, cell: NotebookNode, place: str) -> str:
    shown = [_fenced(cell.source, ".python .cell-code")] if cell.source.strip() else []
    for count, output in enumerate(cell.outputs):
        shown.append(_output(workspace, output, place, count))
    return "\n\n".join(part for part in shown if part)


def _output(workspace: Workspace, output: NotebookNode, place: str, count: int) -> str:
    if output.output_type == "stream":
        return _fenced(_plain(output.text, place), ".output") if output.name == "stdout" else ""
    item, data = _item(output), output.data
    if item:
        return _shown(item, data)
    if "text/markdown" in data:
        return tex.display_blocks(data["text/markdown"])
    if "text/latex" in data:
        return tex.of_output(data["text/latex"])
    for kind, ending in (("image/svg+xml", "svg"), ("image/png", "png")):
        if kind in data:
            return _picture(workspace, data[kind], ending, place, count)
    if "text/html" in data:
        return f"```{{=html}}\n{data['text/html']}\n```"
    return _fenced(_plain(data.get("text/plain", ""), place), ".output")


def _item(output: NotebookNode) -> Item | None:
    kept = output.get("metadata", {}).get("pontryagin")
    if not kept:
        return None
    return Item(kept["kind"], kept["notebook"], kept["name"], " ".join(kept["caption"].split()))


def _shown(item: Item, data: NotebookNode) -> str:
    if item.kind == "figure":
        return f"![{item.caption}]({item.file}){{#{item.anchor}}}"
    table = f"{data['text/markdown']}\n\n: {item.caption}"
    return f'{FENCE} {{#{item.anchor} .kept file="{item.file}"}}\n\n{table}\n\n{FENCE}'


def _picture(workspace: Workspace, data: str, ending: str, place: str, count: int) -> str:
    from base64 import b64decode

    name = f"{re.sub(r'[^a-z0-9]+', '-', place.lower())}-{count + 1}.{ending}"
    content = data.encode() if ending == "svg" else b64decode(data)
    files.write(workspace.build / "pictures" / name, content)
    return f"![](build/pictures/{name})\\"


def _plain(text: str, place: str) -> str:
    if _ADDRESS.search(text):
        raise Unprintable(
            f"{place}: prints a memory address, which differs from run to run: {text.strip()[:80]}"
        )
    return _ANSI.sub("", text).rstrip()


def _fenced(text: str, classes: str) -> str:
    longest = max((len(ticks) for ticks in re.findall(r"`{3,}", text)), default=2)
    fence = "`" * (longest + 1)
    return f"{fence} {{{classes}}}\n{text}\n{fence}" if text else ""
