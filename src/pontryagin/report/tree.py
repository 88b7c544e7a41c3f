"""Pandoc's syntax tree: read Markdown into it, change it, write it out; every warning is an error."""

import json
import subprocess
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

READER = (
    "markdown+lists_without_preceding_blankline-citations-example_lists-fancy_lists-subscript-superscript"
)

Node = dict[str, Any]
Visit = Callable[[Node], list[Node] | None]


class PandocWarning(RuntimeError):
    """Pandoc could not do all it was asked for; the message is its own."""


def read(markdown: str, reader: str = READER) -> Node:
    """The syntax tree of a text.

    Raises
    ------
    PandocWarning
        When pandoc warns.
    """
    return json.loads(run(["-f", reader, "-t", "json"], markdown))


def run(arguments: list[str], text: str) -> str:
    """Run pandoc on `text`; raises `PandocWarning` on any warning."""
    done = subprocess.run(
        [_pandoc(), "--fail-if-warnings", *arguments],
        input=text,
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    if done.returncode:
        raise PandocWarning(done.stderr.strip())
    return done.stdout


def walk(node: Any, visit: Visit) -> Any:
    """The tree with every element replaced by what `visit` returns for it, from the leaves up.

    `visit` returns None to keep an element, or the elements to put in its place.
    """
    if isinstance(node, dict):
        return {key: walk(value, visit) for key, value in node.items()}
    if not isinstance(node, list):
        return node
    walked: list[Any] = []
    for item in node:
        item = walk(item, visit)
        instead = visit(item) if isinstance(item, dict) and "t" in item else None
        walked.extend([item] if instead is None else instead)
    return walked


def elements(node: Any, kind: str) -> Iterator[Node]:
    """Every element of a kind below `node`, in the order of the text."""
    if isinstance(node, dict):
        if node.get("t") == kind:
            yield node
        for value in node.values():
            yield from elements(value, kind)
    elif isinstance(node, list):
        for item in node:
            yield from elements(item, kind)


def length(node: Any) -> int:
    """Characters of the text below `node`; a formula counts as it is written in TeX."""
    words = sum(len(found["c"]) for found in elements(node, "Str"))
    formulas = sum(len(found["c"][1]) for kind in ("Math", "Code") for found in elements(node, kind))
    return words + formulas + sum(1 for _ in elements(node, "Space"))


def identifiers(node: Any) -> Iterator[str]:
    """Every identifier below `node` that a link can lead to."""
    if isinstance(node, list) and len(node) == 3 and isinstance(node[0], str) and isinstance(node[1], list):
        yield node[0]
    children = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
    for child in children:
        yield from identifiers(child)


def raw(format_: str, text: str, inline: bool = False) -> Node:
    """Text in the language of one output format."""
    return {"t": "RawInline" if inline else "RawBlock", "c": [format_, text]}


def attributes(node: Node) -> tuple[str, list[str], dict[str, str]]:
    """Identifier, classes and other attributes of a Div, CodeBlock, Figure or Span."""
    identifier, classes, pairs = node["c"][0]
    return identifier, classes, dict(pairs)


@cache
def _pandoc() -> str:
    import pypandoc

    return pypandoc.get_pandoc_path()
