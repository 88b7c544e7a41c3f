"""``python -m pontryagin.rendezvous.small_weight``: the case ``mixed`` at decreasing weights of time.

At a smaller weight the best flight makes more revolutions and the shooting equations are worse conditioned.
The last rows take half a minute to compute, so the results are kept in ``small_weight.csv``.
"""

import csv
import sys
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from pontryagin.display.tables import csv_table
from pontryagin.rendezvous.problem.cases import case
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.reduced.solve import solve

FILE = Path(__file__).with_name("small_weight.csv")
WEIGHTS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
"""The weights alpha1 that are solved for, with alpha2 = 1."""


@dataclass(frozen=True)
class Row:
    """The best extremal found at a weight of time.

    Attributes
    ----------
    time_weight, duration, cost, revolutions : float
        alpha1, t_k, J, and the revolutions of the craft.
    condition, residual : float
        Condition number and largest residual of its certificate.
    """

    time_weight: float
    duration: float
    cost: float
    revolutions: float
    condition: float
    residual: float


def problem(time_weight: float) -> Rendezvous:
    """The case ``mixed`` with another weight of time.

    Examples
    --------
    >>> problem(1e-3).time_weight
    0.001
    """
    return replace(case("mixed").problem, time_weight=time_weight)


def row(best: Extremal) -> Row:
    """The row of an extremal."""
    certificate = best.certificate
    weight = best.problem.time_weight
    return Row(
        weight,
        best.duration,
        best.cost,
        best.revolutions,
        float(certificate.condition),
        float(certificate.residual),
    )


def rows() -> list[Row]:
    """The contents of ``small_weight.csv``, by decreasing alpha1.

    Examples
    --------
    >>> [one.time_weight for one in rows()] == list(WEIGHTS)
    True
    """
    with FILE.open(newline="") as file:
        return [Row(**{name: float(text) for name, text in line.items()}) for line in csv.DictReader(file)]


def write(found: Iterable[Row]) -> None:
    """Write rows to ``small_weight.csv``."""
    several = list(found)
    forms = {"condition": ".3g", "residual": ".1e", "time_weight": "g", "revolutions": ".4f"}
    FILE.write_text(
        csv_table(
            {
                name: [f"{getattr(one, name):{forms.get(name, '.12g')}}" for one in several]
                for name in Row.__dataclass_fields__
            }
        )
    )


def main(weights: Iterable[float] = ()) -> None:
    """Solve for the given weights and keep the rows of the others; with no weights given, solve for all."""
    chosen = list(weights) or list(WEIGHTS)
    found = {one.time_weight: one for one in rows()} if weights else {}
    for weight in chosen:
        found[weight] = row(solve(problem(weight)))
        print(f"   {weight:g}: {found[weight].cost:.10g}", flush=True)
        write(found[one] for one in sorted(found, reverse=True))


if __name__ == "__main__":
    main([float(text) for text in sys.argv[1:]])
