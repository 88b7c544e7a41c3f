"""``pontryagin ledger``: the entries of the ledger as a table, CSV or JSON."""

from typing import Annotated

import typer

from pontryagin import ledger as book
from pontryagin.terminal import console

Text = str | None


def ledger(
    paper: Annotated[
        Text, typer.Option(metavar="NAME", help="Entries of the paper whose name contains this.")
    ] = None,
    verdict: Annotated[
        Text, typer.Option(metavar="VERDICT", help=f"Entries of one verdict: {', '.join(book.VERDICTS)}.")
    ] = None,
    csv: Annotated[
        Text, typer.Option(metavar="FILE", help="Write CSV to a file; - is standard output.")
    ] = None,
    json: Annotated[
        Text, typer.Option(metavar="FILE", help="Write JSON to a file; - is standard output.")
    ] = None,
) -> None:
    """What the papers print, and whether it holds: every formula, number and claim with its verdict.

    \b
    Examples:
      pontryagin ledger --verdict misprint
      pontryagin ledger --paper gorelov --csv ledger.csv
    """
    with console.refusing({"paper": "--paper", "verdict": "--verdict"}):
        entries = book.entries(paper, verdict)
    if csv is not None:
        console.emit("--csv", csv, book.to_csv(entries))
    if json is not None:
        console.emit("--json", json, book.to_json(entries) + "\n")
    if csv is None and json is None:
        from rich.console import Console

        Console().print(book.table(entries))
