"""The soak as a study: its parts, the cells of its table, and the cases that are kept with exact inputs."""

from collections.abc import Sequence
from typing import Any

from studies.part import Found, Part, Study
from studies.soak import averaged, corrections, meetings, triple

MEASURES = ("gap", "residual", "disagreement")
SHOWN = 40
"""Failures of a part that are listed."""
NOTE = (
    "Random problems, many of them chosen to be hard: ties, edges of regimes, narrow reversals, forty "
    "decades of scale. All are judged by their own certificates. *Compared* are a stratified hundredth of "
    "the manoeuvres and corrections, a twentieth of the averaged problems, all meetings, and whatever is "
    "suspicious: by fifty-digit arithmetic and quadratures of its own (triple integrator), HiGHS and "
    "Clarabel (corrections), SciPy's integrators on equations built anew (averaged problems, meetings), "
    "and for some meetings CasADi's direct method. A failure is an exception, a certificate that does not "
    "hold, a member that differs from its stack, or an oracle that disagrees; *not solved* are the "
    "exceptions."
)


def row(part: Part, found: Sequence[Found]) -> dict[str, Any]:
    """Counts, and the worst of each measure, to one digit."""
    worst = {name: _worst(found, name) for name in MEASURES}
    absent = sorted({peer for one in found for peer in one["absent"]})
    return {
        "problems": sum(one["problems"] for one in found),
        "failures": sum(one["failures"] for one in found),
        "not solved": sum(one["unsolved"] for one in found),
        "worst gap": _digit(worst["gap"]),
        "worst residual": _digit(worst["residual"]),
        "compared": sum(one["compared"] for one in found),
        "worst disagreement": _digit(worst["disagreement"]),
        "peers not installed": " ".join(absent),
    }


def cases(part: Part, found: Sequence[Found]) -> list[dict[str, Any]]:
    """The first failures, and the problem that is worst in each measure; the records have all of them."""
    kept = [case for one in found for case in one["kept"]][:SHOWN]
    worst = {name: _worst(found, name) for name in MEASURES}
    return [*kept, *({"what": f"worst {name}", **case} for name, case in worst.items() if case)]


def _worst(found: Sequence[Found], name: str) -> dict[str, Any] | None:
    known = [one["worst"][name] for one in found if name in one["worst"]]
    return max(known, key=lambda case: case["value"], default=None)


def _digit(case: dict[str, Any] | None) -> str:
    if case is None or case["value"] == 0:
        return "" if case is None else "0"
    return f"{case['value']:.0e}"


STUDY = Study(
    name="soak",
    title="Soak",
    note=NOTE,
    seed=1,
    parts=[*triple.parts(), *corrections.parts(), *averaged.parts(), *meetings.parts()],
    row=row,
    cases=cases,
)
