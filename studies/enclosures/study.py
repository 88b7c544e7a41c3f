"""The enclosures as a study: proven digits of random problems and of the worked examples."""

import math
from collections.abc import Sequence
from functools import partial
from statistics import median
from typing import Any

import numpy as np

from studies.enclosures import examples, sample
from studies.enclosures.ball import Enclosure, precise
from studies.part import Found, Part, Study

CHUNK, DEAR_CHUNK = 50, 10
"""Problems of a chunk; those of any exponent take longer, for their integrals."""
WANTED = 20
"""Chunks of a part."""
SHOWN = 10
"""Problems left open that are listed."""
NOTE = (
    "How many digits of the returned optimum are proved in ball arithmetic (FLINT). All returned numbers are "
    "taken as the rationals that they are. A control that is completed so as to meet the constraints exactly "
    "and a dual bound prove both ends of an interval; for the least time it is the isolated root of a "
    "quartic, for averaged problems the closed form. A double has at most 16 digits. *Left open* are "
    "problems whose balls decide nothing. The errors of an entropy are absolute. Meetings have no row: "
    "rendezvous are not convex, and no bound on their optima is known."
)


def chunk(solver: str, rng: np.random.Generator, number: int) -> Found:
    """The proven digits of random problems."""
    count = DEAR_CHUNK if solver == "least norm" else CHUNK
    with precise():
        problems, enclosures = zip(*(sample.SOLVERS[solver](rng) for _ in range(count)), strict=True)
        found = _found(enclosures)
    kept = {problems[i]: entry for i, entry in enumerate(found["digits"]) if entry is None}
    least = min(range(count), key=lambda i: found["digits"][i] or math.inf)
    return {**found, "kept": kept | {problems[least]: found["digits"][least]}}


def example(name: str, rng: np.random.Generator, number: int) -> Found:
    """The proven digits of a worked example, and its optimum to these."""
    with precise():
        enclosure = examples.EXAMPLES[name]()
        shown = "" if enclosure is None else shortened(enclosure.value, enclosure.digits)
        return {**_found([enclosure]), "optimum": shown, "kept": {}}


def shortened(value: float, digits: float) -> str:
    """A value to its proven digits."""
    return f"{value:#.{int(digits)}g}"


def _found(enclosures: Sequence[Enclosure | None]) -> dict[str, Any]:
    digits = [None if one is None else round(one.digits, 2) for one in enclosures]
    return {"digits": digits, "optimum": ""}


def row(part: Part, found: Sequence[Found]) -> dict[str, Any]:
    """Counts, and the digits that are proved for all problems and for half of them."""
    digits = [entry for one in found for entry in one["digits"]]
    proved = [entry for entry in digits if entry is not None]
    return {
        "problems": len(digits),
        "left open": len(digits) - len(proved),
        "least digits": f"{min(proved):.1f}" if proved else "",
        "median digits": f"{median(proved):.1f}" if proved else "",
        "optimum": found[0]["optimum"],
    }


def cases(part: Part, found: Sequence[Found]) -> list[dict[str, Any]]:
    """The problem of the fewest digits, and those that were left open."""
    kept = [(problem, digits) for one in found for problem, digits in one["kept"].items()]
    closed = [case for case in kept if case[1] is not None]
    shown = [case for case in kept if case[1] is None][:SHOWN] + sorted(closed, key=lambda case: case[1])[:1]
    return [{"problem": problem, "digits": digits} for problem, digits in shown]


STUDY = Study(
    name="enclosures",
    title="Proven digits",
    note=NOTE,
    seed=1,
    parts=[
        *(Part(name, [sample.__name__], WANTED, partial(chunk, name)) for name in sample.SOLVERS),
        *(Part(name, [examples.__name__], 1, partial(example, name)) for name in examples.EXAMPLES),
    ],
    row=row,
    cases=cases,
)
