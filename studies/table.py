"""The table of a study: what its finished chunks found, with the keys of their sources, as CSV."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.table import as_csv, by_heading, machine, printed

from pontryagin import __version__
from pontryagin.io import files
from pontryagin.report.study_keys import DEPENDS, FOUND, KEY, TAKEN
from studies.part import Part, Study
from studies.records import Records

CASES = "cases.json"
"""The file of the cases that are kept with their exact inputs."""


def write(records: Records, folders: Sequence[Path]) -> None:
    """Write what is known to folders: the table, the seconds that it took, and the cases.

    The table and the cases depend on the finished chunks alone, to the byte; the seconds do not.
    """
    study = records.study
    known = {part.name: records.read(part) for part in study.parts}
    begun = [part for part in study.parts if known[part.name]]
    facts = {"title": study.title, "note": study.note, "seed": str(study.seed), "version": __version__}
    rows = [_row(study, part, known[part.name], records.keys[part.name]) for part in begun]
    seconds = [_seconds(part, known[part.name]) for part in begun]
    cases = {part.name: study.cases(part, _found(known[part.name])) for part in begun}
    for folder in folders if begun else ():
        files.write(folder / FOUND, as_csv(facts, by_heading(rows)))
        files.write(folder / TAKEN, as_csv(machine(), by_heading(seconds)))
        files.write(folder / CASES, json.dumps(cases, indent=1, sort_keys=True) + "\n")


def show(records: Records) -> None:
    """Print the table."""
    study = records.study
    known = [(part, records.read(part)) for part in study.parts]
    rows = [{"part": part.name, **study.row(part, _found(done))} for part, done in known if done]
    if rows:
        printed(study.title, by_heading(rows))


def _row(study: Study, part: Part, done: Sequence[Mapping[str, Any]], key: str) -> dict[str, Any]:
    cells = dict(study.row(part, _found(done)))
    return {"part": part.name, **cells, DEPENDS: " ".join(part.modules), KEY: key}


def _seconds(part: Part, done: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    return {"part": part.name, "seconds": round(sum(record["seconds"] for record in done), 1)}


def _found(done: Sequence[Mapping[str, Any]]) -> list[Any]:
    return [record["found"] for record in done]
