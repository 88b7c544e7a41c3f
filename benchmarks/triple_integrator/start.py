"""Cost of the first call in a fresh process: imports, compilation, command line."""

import json
import os
import resource
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from time import perf_counter

FIRST_CALL = """
import json
from time import process_time
spent = {}
def mark(step, since=[process_time()]):
    now = process_time()
    spent[step] = now - since[0]
    since[0] = now
import numpy
mark("import numpy")
import pontryagin
mark("import pontryagin, beyond numpy")
from pontryagin.triple_integrator import Maneuver, minimum_peak, minimum_impulse, minimum_time
mark("import the solvers, beyond that")
minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0))
mark("first least peak")
print(json.dumps(spent))
"""

FIRST_STACK = """
import json
from time import process_time
import numpy as np
from pontryagin.triple_integrator import Maneuver, minimum_peak, minimum_impulse, minimum_time
rng = np.random.default_rng(0)
x0, xf = rng.standard_normal((2, 1000, 3))
spent = {}
def mark(step, since=[process_time()]):
    now = process_time()
    spent[step] = now - since[0]
    since[0] = now
import numba
mark("import numba")
minimum_impulse(Maneuver(x0, xf, 1.0))
mark("first stack of 1000, least impulse")
minimum_peak(Maneuver(x0, xf, 1.0))
mark("first stack of 1000, least peak")
minimum_time(x0, xf, 1.0)
mark("first stack of 1000, least time")
print(json.dumps(spent))
"""

COMMAND = "solve triple-integrator --norm inf --x0 0,0,0 --xf 1,0,0 --duration 2"


def table(quick: bool) -> dict[str, list]:
    """Processor seconds of each step; for the command line also seconds by the clock."""
    repeats = 1 if quick else 5
    steps = _fastest(_phases(FIRST_CALL) for _ in range(repeats))
    with tempfile.TemporaryDirectory(prefix="pontryagin-bench-") as cache:
        uncached = _phases(FIRST_STACK, cache)
        cached = _fastest(_phases(FIRST_STACK, cache) for _ in range(repeats))
    steps |= {f"{step}, compiling": seconds for step, seconds in uncached.items() if step != "import numba"}
    steps |= {
        f"{step}, compiled before": seconds for step, seconds in cached.items() if step != "import numba"
    }
    steps["import numba"] = cached["import numba"]
    if find_spec("pontryagin.cli"):
        runs = [_command() for _ in range(repeats)]
        steps["pontryagin solve, command line"] = min(processor for processor, _ in runs)
        steps["pontryagin solve, command line, by the clock"] = min(clock for _, clock in runs)
    return {"step": list(steps), "seconds": list(steps.values())}


def _phases(script: str, cache: str | None = None) -> dict[str, float]:
    environment = os.environ | ({"XDG_CACHE_HOME": cache} if cache else {})
    run = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True, env=environment
    )
    return json.loads(run.stdout)


def _fastest(runs) -> dict[str, float]:
    runs = list(runs)
    return {step: min(run[step] for run in runs) for step in runs[0]}


def _command() -> tuple[float, float]:
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    subprocess.run(
        [sys.executable, "-c", "import pontryagin.cli as c; c.main()", *COMMAND.split()],
        check=True,
        capture_output=True,
    )
    after, ended = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return processor, ended - started
