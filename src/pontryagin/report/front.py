"""The front page: what this is, what the papers' formulas came to, and the ledger entry by entry."""

import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Mapping, Sequence

from pontryagin.display.tables import markdown_table
from pontryagin.io import sealed
from pontryagin.ledger.verdict import TABLE
from pontryagin.papers import PAPERS, Paper
from pontryagin.report import dependencies
from pontryagin.report.environment import environment
from pontryagin.report.workspace import Workspace

Entry = Mapping[str, str]

VERDICTS = {row.name: row.meaning for row in TABLE}

_ASK = (
    "import json; from pontryagin import ledger; print(json.dumps([e.as_dict() for e in ledger.entries()]))"
)


def ledger_entries(workspace: Workspace) -> list[dict[str, str]]:
    """The ledger in its JSON form, from the cache when nothing behind it changed.

    Raises
    ------
    RuntimeError
        When the ledger cannot be read; the message is the last line of its error.
    """
    source = dependencies.Source(workspace.source)
    parts = sorted(dependencies.closure(source, [_ASK]))
    key = dependencies.digest(*parts, workspace.lock_text, sys.version, root=workspace.root)
    place = workspace.cache / "ledger" / f"{key}.json"
    kept = sealed.read(place)
    if kept is None:
        done = subprocess.run(
            [sys.executable, "-c", _ASK], capture_output=True, text=True, env=environment(workspace)
        )
        if done.returncode:
            raise RuntimeError(f"the ledger: {done.stderr.strip().splitlines()[-1]}")
        kept = done.stdout.encode()
        sealed.write(place, kept)
    entries: list[dict[str, str]] = json.loads(kept)
    return entries


def front_page(entries: Sequence[Entry], papers: Sequence[Paper] = PAPERS) -> str:
    """Markdown of the front page.

    Parameters
    ----------
    entries : sequence of mappings
        The ledger's entries with ``paper``, ``label``, ``statement``, ``verdict`` and ``remark``.
    papers : sequence of Paper
        The papers that the report replicates.
    """
    return "\n\n".join([_ABOUT, _sources(papers), _summary(entries), _ledger(entries)])


_ABOUT = """# About this report {#about .unnumbered}

Papers on the optimal control of spacecraft, worked through again with a computer algebra system. Every
formula is derived from first principles and set beside what the paper prints; what was derived is compiled
into solvers; and each numerical answer carries a certificate: a bound on the optimum that comes from the
other side and does not use the answer. The text below is made by executing the notebooks of the project. The
code behind each figure and table is folded under *code*."""


def _sources(papers: Sequence[Paper]) -> str:
    return "\n".join(
        f"- {paper.source}: *{paper.title}*. In the code: `pontryagin.{paper.package}`." for paper in papers
    )


def _summary(entries: Sequence[Entry]) -> str:
    counts = Counter((entry["paper"], entry["verdict"]) for entry in entries)
    names = list(dict.fromkeys(entry["paper"] for entry in entries))
    verdicts = [verdict for verdict in VERDICTS if any(counts[name, verdict] for name in names)]
    verdicts += sorted({entry["verdict"] for entry in entries} - set(VERDICTS))
    columns: dict[str, list[object]] = {"paper": [*names]}
    columns |= {verdict: [counts[name, verdict] for name in names] for verdict in verdicts}
    columns["entries"] = [sum(counts[name, verdict] for verdict in verdicts) for name in names]
    if len(names) > 1:
        for heading, values in columns.items():
            values.append("all" if heading == "paper" else sum(int(str(value)) for value in values))
    meanings = "\n".join(
        f"[{verdict}]{_class(verdict)}\n:   {VERDICTS.get(verdict, '')}\n" for verdict in verdicts
    )
    heading = "## What the papers' formulas came to {.unnumbered #verdicts}"
    return f"{heading}\n\n{markdown_table(columns)}\n\n: Entries of the ledger by verdict.\n\n{meanings}"


def _ledger(entries: Sequence[Entry]) -> str:
    parts = ["## The ledger {.unnumbered #ledger}"]
    for name in dict.fromkeys(entry["paper"] for entry in entries):
        chosen = [entry for entry in entries if entry["paper"] == name]
        table = {
            "place": [_literal(entry["label"]) for entry in chosen],
            "what it says": [_literal(entry["statement"]) for entry in chosen],
            "verdict": [f"[{entry['verdict']}]{_class(entry['verdict'])}" for entry in chosen],
            "remark": [_literal(entry.get("remark") or "") for entry in chosen],
        }
        parts.append(f"::: {{.ledger}}\n\n{markdown_table(table)}\n\n: The ledger of {name}.\n\n:::")
    return "\n\n".join(parts)


def _class(verdict: str) -> str:
    return f"{{.verdict .{verdict.replace(' ', '-')}}}"


def _literal(text: str) -> str:
    """Text that is no Markdown, but for its formulas between dollar signs."""
    parts = re.split(r"(\$[^$]+\$)", text)
    return "".join(p if p.startswith("$") else re.sub(r"([\\`*_{}\[\]<>#~^|])", r"\\\1", p) for p in parts)
