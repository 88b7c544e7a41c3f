"""The results of the direct method for the cases of the report, and the command that computes them.

The command is ``python -m pontryagin.rendezvous.judge``. The costs at two meshes are kept in ``judge.csv``,
so that the report needs no CasADi; each row holds a checksum of its problem. The cases of least fuel come
last. The direct method uses nothing from the indirect solutions.
"""

import csv
import sys
import zlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

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
"""Numbers of intervals of the coarse mesh and of the fine one."""


@dataclass(frozen=True)
class DirectResult:
    """The solutions of a case by the direct method.

    Attributes
    ----------
    checksum : int
        The problem's checksum.
    costs, durations : tuple of float
        J and t_k at the two meshes, in the case's units.
    iterations : tuple of int
        Ipopt's iterations at the two meshes.
    violation : float
        Largest violation of the constraints, in the solver's units.
    """

    checksum: int
    costs: tuple[float, float]
    durations: tuple[float, float]
    iterations: tuple[int, int]
    violation: float


def all_cases() -> dict[str, Case]:
    """The cases of the report and those of least fuel, by name."""
    return {**cases(), **fuel_cases()}


def checksum(problem: Rendezvous, fuel: bool = False) -> int:
    """A checksum that changes with every number of the problem, and with the functional.

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


def solve_directly(case: Case) -> DirectResult:
    """Solve a case by the direct method at both meshes, each from the cold start of the case.

    Raises
    ------
    ModuleNotFoundError
        If CasADi is not installed.
    NotConverged
        If Ipopt does not converge.
    """
    from pontryagin.rendezvous.judge.collocation import direct

    fuel = isinstance(case, FuelCase)
    coarse, fine = (direct(case.problem, case.guess, case.revolutions, mesh, fuel) for mesh in MESHES)
    return DirectResult(
        checksum(case.problem, fuel),
        (coarse.cost, fine.cost),
        (coarse.duration, fine.duration),
        (coarse.iterations, fine.iterations),
        max(coarse.violation, fine.violation),
    )


def direct_results() -> dict[str, DirectResult]:
    """The contents of ``judge.csv``, by the names of the cases.

    Examples
    --------
    >>> list(direct_results()) == list(all_cases())
    True
    """
    with FILE.open(newline="") as file:
        return {row["case"]: _result(row) for row in csv.DictReader(file)}


def _result(row: dict[str, str]) -> DirectResult:
    low, high = MESHES
    return DirectResult(
        int(row["checksum"]),
        (float(row[f"cost {low}"]), float(row[f"cost {high}"])),
        (float(row[f"duration {low}"]), float(row[f"duration {high}"])),
        (int(row[f"iterations {low}"]), int(row[f"iterations {high}"])),
        float(row["violation"]),
    )


def write(found: dict[str, DirectResult]) -> None:
    """Write results to ``judge.csv``, costs and durations with fifteen digits."""
    columns: dict[str, list[Any]] = {
        "case": list(found),
        "checksum": [one.checksum for one in found.values()],
    }
    for j, mesh in enumerate(MESHES):
        columns[f"cost {mesh}"] = [f"{one.costs[j]:.15g}" for one in found.values()]
        columns[f"duration {mesh}"] = [f"{one.durations[j]:.15g}" for one in found.values()]
        columns[f"iterations {mesh}"] = [one.iterations[j] for one in found.values()]
    columns["violation"] = [f"{one.violation:.1e}" for one in found.values()]
    FILE.write_text(csv_table(columns))


def main(names: Iterable[str] = ()) -> None:
    """Solve the named cases, or all of them, and write ``judge.csv``; the rows of other cases are kept."""
    known = all_cases()
    chosen = list(names) or list(known)
    found = direct_results() if names else {}
    for name in chosen:
        try:
            found[name] = solve_directly(known[name])
        except NotConverged as reason:
            sys.exit(f"{name}: {reason}")
        print(f"   {name}: {found[name].costs[1]:.10g}", flush=True)
        write({name: found[name] for name in known if name in found})
