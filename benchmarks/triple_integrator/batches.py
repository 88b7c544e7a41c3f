"""Batches on the command line: processor time of the whole process, from a CSV file to a CSV file."""

import tempfile
from pathlib import Path

import numpy as np

from benchmarks.triple_integrator import problems
from benchmarks.triple_integrator.start import command

GOALS = {
    "least energy": ("--norm", "2"),
    "least peak": ("--norm", "inf"),
    "least impulse": ("--norm", "1"),
    "least time": ("--peak", "2"),
}
COLUMNS = "x10,x20,x30,x1f,x2f,x3f,tf"
AIM = 10.0
"""The aim for a row, start of the process included, in microseconds: 100000 rows in a second."""


def table(quick: bool) -> dict[str, list]:
    """Microseconds per row, the least of some processes; native code was made before."""
    count, repeats = (2_000, 1) if quick else (100_000, 3)
    with tempfile.TemporaryDirectory(prefix="pontryagin-bench-") as folder:
        given, found = Path(folder) / "in.csv", Path(folder) / "out.csv"
        values = np.column_stack([*problems.ends("stack", count), np.ones(count)])
        np.savetxt(given, values, fmt="%.17g", delimiter=",", header=COLUMNS, comments="")
        files = ("--batch", str(given), "--out", str(found))
        runs = {
            name: [command("solve", "triple-integrator", *goal, *files) for _ in range(repeats + 1)][1:]
            for name, goal in GOALS.items()
        }
    least = [min(processor for processor, _ in taken) for taken in runs.values()]
    return {
        "problem": list(runs),
        "rows": [count] * len(runs),
        "aim, microseconds per row": [AIM] * len(runs),
        "microseconds per row": [1e6 * seconds / count for seconds in least],
    }
