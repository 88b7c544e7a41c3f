"""``python -m pontryagin.rendezvous.judge.table``: what the direct method finds in the report's cases.

Its costs at two meshes are kept in ``judge.csv``, so that the report needs no CasADi; a row carries the
checksum of the problem that it was found for. The cases of least fuel come last. The judge is told nothing of
our solutions.
"""

import csv
import sys
import zlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pontryagin.display.tables import csv_table
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.problem.cases import (
    Case,
    FuelCase,
    cases,
    fuel_cases,
)
from pontryagin.rendezvous.problem.rendezvous import Rendezvous

FILE = Path(__file__).with_name("judge.csv")
MESHES = (40, 96)
"""Intervals of the coarse mesh and of the fine one."""


@dataclass(frozen=True)
class Verdict:
    """What the direct method found in a case.

    Attributes
    ----------
    checksum : int
        Of the problem.
    costs, durations : tuple of float
        At the two meshes, in the case's units.
    iterations : tuple of int
        Of Ipopt.
    violation : float
        Largest violation of its constraints, in the solver's units.
    """

    checksum: int
    costs: tuple[float, float]
    durations: tuple[float, float]
    iterations: tuple[int, int]
    violation: float


def judged_cases() -> dict[str, Case]:
    """All cases that the judge is asked about, by name: those of the report, and those of least fuel."""
    return {**cases(), **fuel_cases()}


def checksum(problem: Rendezvous, fuel: bool = False) -> int:
    """A number that changes with every number of the problem, and with what alpha2 is the weight of.

    Examples
    --------
    >>> from pontryagin.rendezvous.problem.cases import case
    >>> checksum(case("mixed").problem) == checksum(case("mixed-bounded").problem)
    False
    """
    craft, orbit = problem.chaser, problem.target
    numbers = [craft.r, craft.v1, craft.c, *np.ravel(craft.attitude)]
    numbers += [orbit.parameter, orbit.eccentricity, *np.ravel(orbit.attitude), orbit.anomaly]
    numbers += [problem.time_weight, problem.energy_weight, problem.peak, problem.gravity]
    numbers += [] if problem.duration is None else [problem.duration]
    text = " ".join(f"{number + 0.0:.10g}" for number in numbers)
    return zlib.crc32(f"{text} fuel".encode() if fuel else text.encode())


def judged(case: Case) -> Verdict:
    """Solve a case directly at both meshes, each from the cold start of the case.

    Raises
    ------
    ModuleNotFoundError
        Without CasADi.
    NotConverged
        If Ipopt does not converge.
    """
    from pontryagin.rendezvous.judge.collocation import direct

    fuel = isinstance(case, FuelCase)
    coarse, fine = (direct(case.problem, case.guess, case.revolutions, mesh, fuel) for mesh in MESHES)
    return Verdict(
        checksum(case.problem, fuel),
        (coarse.cost, fine.cost),
        (coarse.duration, fine.duration),
        (coarse.iterations, fine.iterations),
        max(coarse.violation, fine.violation),
    )


def verdicts() -> dict[str, Verdict]:
    """What ``judge.csv`` contains, by the names of the cases.

    Examples
    --------
    >>> list(verdicts()) == list(judged_cases())
    True
    """
    with FILE.open(newline="") as file:
        return {row["case"]: _verdict(row) for row in csv.DictReader(file)}


def _verdict(row: dict[str, str]) -> Verdict:
    low, high = MESHES
    return Verdict(
        int(row["checksum"]),
        (float(row[f"cost {low}"]), float(row[f"cost {high}"])),
        (float(row[f"duration {low}"]), float(row[f"duration {high}"])),
        (int(row[f"iterations {low}"]), int(row[f"iterations {high}"])),
        float(row["violation"]),
    )


def write(found: dict[str, Verdict]) -> None:
    """Keep verdicts in ``judge.csv``, costs and durations with fifteen digits."""
    columns: dict[str, list] = {"case": list(found), "checksum": [one.checksum for one in found.values()]}
    for j, mesh in enumerate(MESHES):
        columns[f"cost {mesh}"] = [f"{one.costs[j]:.15g}" for one in found.values()]
        columns[f"duration {mesh}"] = [f"{one.durations[j]:.15g}" for one in found.values()]
        columns[f"iterations {mesh}"] = [one.iterations[j] for one in found.values()]
    columns["violation"] = [f"{one.violation:.1e}" for one in found.values()]
    FILE.write_text(csv_table(columns))


def main(names: Iterable[str] = ()) -> None:
    """Judge the cases named, or all; the others' rows are kept."""
    known = judged_cases()
    chosen = list(names) or list(known)
    found = verdicts() if names else {}
    for name in chosen:
        try:
            found[name] = judged(known[name])
        except NotConverged as reason:
            sys.exit(f"{name}: {reason}")
        print(f"   {name}: {found[name].costs[1]:.10g}", flush=True)
        write({name: found[name] for name in known if name in found})


if __name__ == "__main__":
    main(sys.argv[1:])
