"""First solve of a rendezvous in a fresh process, and the making of native code on a new machine."""

import tempfile

from benchmarks.fresh import least_seconds
from benchmarks.table import by_heading

AIM = 2.0
"""The aim for a whole small solve from the start of the process, in seconds of the processor."""

ONCE = """
from pontryagin.rendezvous import solve
from pontryagin.rendezvous.problem.cases import cases
problem = cases()[%r].problem
spent["start and imports"] = process_time()
mark("")
from pontryagin.numerics.trajectory import compiled
from pontryagin.rendezvous.reduced.arcs import equations
for ends in (False, True):
    for mode in ("unsaturated", "saturated"):
        compiled(equations(mode, ends))

from pontryagin.rendezvous.reduced.flight import fly
import numpy as np
fly(problem.scaled, np.full(6, 0.01), 1.0)
mark("integrators")
solve(problem)
mark("solve")
del spent[""]
"""


def table(quick: bool) -> dict[str, list]:
    """Processor seconds of the first solves, with an empty cache and with what it left."""
    rows = []
    for name in ("circle-energy",) if quick else ("circle-energy", "circle", "inclined-60"):
        with tempfile.TemporaryDirectory(prefix="pontryagin-bench-") as cache:
            for when in ("nothing kept", "code kept"):
                runs = 1 if quick or when == "nothing kept" else 5
                taken = least_seconds(ONCE % name, runs, XDG_CACHE_HOME=cache)
                rows.append(
                    {
                        "case": name,
                        "machine": when,
                        **{f"{step}, s": time for step, time in taken.items()},
                        "in all, s": sum(taken.values()),
                        "aim, s": AIM,
                    }
                )
    return by_heading(rows)
