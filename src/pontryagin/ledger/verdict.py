"""The table of verdicts: what each is called, means, looks like, and which evidence earns it."""

from dataclasses import dataclass
from typing import TypeAlias

from pontryagin.errors import ArgumentValueError

Verdict: TypeAlias = str
"""The name of a verdict, one of `VERDICTS`."""


class Unsupported(AssertionError):
    """The evidence of an entry does not support its verdict; the message says where it breaks."""


@dataclass(frozen=True)
class Kind:
    """A row of the table.

    Attributes
    ----------
    name : str
        What the ledger calls the verdict.
    meaning : str
        What it says about an entry; Markdown that completes the sentence "NAME: ...".
    terminal : str
        Its colour in tables of the terminal, in rich's names.
    tile : str
        Its colour in figures: the name of a constant of `pontryagin.display.plotting`.
    opacity : float
        Opacity of its tiles, from 0 to 1.
    evidence : tuple of str
        The classes of evidence that may earn it, those of `pontryagin.ledger.evidence` and `decimals`. An
        entry whose verdict admits none has no evidence.
    """

    name: Verdict
    meaning: str
    terminal: str
    tile: str
    opacity: float
    evidence: tuple[str, ...]


TABLE = (
    Kind(
        "holds",
        "what is printed equals what is derived, or the claim is proved",
        "green",
        "GREEN",
        0.35,
        ("Equality", "LinearSystem", "Decimals", "Proof"),
    ),
    Kind(
        "misprint",
        "the printed form is wrong: the paper's own later lines use the derived one, or it plainly cannot "
        "be meant; numbers show where the print leads",
        "yellow",
        "ORANGE",
        1.0,
        ("Misprint", "Slip"),
    ),
    Kind(
        "false",
        "a claim that fails, with a counterexample whose certificate is checked each time",
        "red",
        "RED",
        1.0,
        ("Refutation",),
    ),
    Kind(
        "conditional",
        "true on a stated region, with a counterexample outside it",
        "magenta",
        "PURPLE",
        1.0,
        ("Conditional",),
    ),
    Kind(
        "unreadable",
        "the scan does not say what is printed; the derived form is given",
        "cyan",
        "BLUE",
        1.0,
        ("Unreadable",),
    ),
    Kind(
        "not checked",
        "the text at hand does not hold what would decide it, or it is a matter of judgement",
        "white",
        "SKY",
        1.0,
        (),
    ),
)
"""All verdicts, in the order in which they are counted and shown."""

VERDICTS: tuple[Verdict, ...] = tuple(row.name for row in TABLE)

COLOURS: dict[Verdict, str] = {row.name: row.terminal for row in TABLE}
"""Colour of each verdict in the terminal, in rich's names."""


def kind(verdict: Verdict) -> Kind:
    """The row of a verdict.

    Raises
    ------
    ValueError
        If there is no such verdict.

    Examples
    --------
    >>> kind("false").evidence
    ('Refutation',)
    """
    for row in TABLE:
        if row.name == verdict:
            return row
    raise ArgumentValueError(
        f"verdict: got {verdict!r}, takes one of {', '.join(map(repr, VERDICTS))}", "verdict"
    )
