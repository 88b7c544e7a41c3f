"""The ledger: what the papers print, what is derived, and the verdict that a check has to earn."""

from pontryagin.ledger.entry import (
    COLOURS,
    PAPERS,
    VERDICTS,
    Entry,
    Page,
    Unsupported,
    Verdict,
    counts,
    entries,
    table,
    to_csv,
    to_json,
)

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
