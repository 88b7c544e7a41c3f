"""The solutions of the cases of the report, each computed once."""

from pontryagin.io.kept_results import kept
from pontryagin.rendezvous.problem.cases import (
    case,
    cases,
)
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.reduced.solve import solve


@kept
def solved(name: str) -> Extremal:
    """The best extremal of a case, with the others found.

    Raises
    ------
    ValueError
        If there is no case of this name.
    """
    return solve(case(name).problem)


def all_solved() -> dict[str, Extremal]:
    """The best extremals of all cases, by name."""
    return {name: solved(name) for name in cases()}


def ahead() -> None:
    """Solve the cases from the last to the first, while a notebook needs them from the first to the last."""
    for name in reversed(cases()):
        solved.ahead(name)
