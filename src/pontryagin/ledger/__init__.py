"""The ledger: what the papers print, what is derived, and the verdict that a check has to earn."""

from pontryagin.ledger.collection import PAPERS, counts, entries, table, to_csv, to_json
from pontryagin.ledger.entry import Entry, Page
from pontryagin.ledger.verdict import COLOURS, VERDICTS, Unsupported, Verdict

__all__ = [
    "COLOURS",
    "PAPERS",
    "VERDICTS",
    "Entry",
    "Page",
    "Unsupported",
    "Verdict",
    "counts",
    "entries",
    "table",
    "to_csv",
    "to_json",
]
