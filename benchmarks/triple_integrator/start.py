"""Cost of the first call in a fresh process: imports, native code, command line.

Native code is made once per machine, "compiling", and opened by later processes, "compiled before".
"""

import resource
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from time import perf_counter

from benchmarks.fresh import least_seconds, seconds

FIRST_CALL = """
import numpy
mark("import numpy")
import pontryagin
mark("import pontryagin, beyond numpy")
from pontryagin.triple_integrator import Maneuver, minimum_peak, minimum_impulse, minimum_time
mark("import the solvers, beyond that")
x0, xf = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]
minimum_time(x0, xf, 1.0)
mark("first least time")
minimum_peak(Maneuver(x0, xf, 2.0))
mark("first least peak")
for _ in range(10000):
    minimum_time(x0, xf, 1.0)
mark("10000 more, least time")
for _ in range(10000):
    minimum_peak(Maneuver(x0, xf, 2.0))
mark("10000 more, least peak")
"""

FIRST_STACK = """
import numpy as np
from pontryagin.triple_integrator import Maneuver, minimum_peak, minimum_impulse, minimum_time
rng = np.random.default_rng(0)
x0, xf = rng.standard_normal((2, 1000, 3))
mark("all before the first stack")
minimum_impulse(Maneuver(x0, xf, 1.0))
mark("first stack of 1000, least impulse")
minimum_peak(Maneuver(x0, xf, 1.0))
mark("first stack of 1000, least peak")
minimum_time(x0, xf, 1.0)
mark("first stack of 1000, least time")
"""

COMMAND = "solve triple-integrator --norm inf --x0 0,0,0 --xf 1,0,0 --duration 2"


def table(quick: bool) -> dict[str, list]:
    """Processor seconds of each step; for the command line also seconds by the clock."""
    repeats = 1 if quick else 5
    with tempfile.TemporaryDirectory(prefix="pontryagin-bench-") as cache:
        seconds(FIRST_CALL, XDG_CACHE_HOME=cache)
        uncached = seconds(FIRST_STACK, XDG_CACHE_HOME=cache)
        cached = least_seconds(FIRST_STACK, repeats, XDG_CACHE_HOME=cache)
        steps = least_seconds(FIRST_CALL, repeats, XDG_CACHE_HOME=cache)
    for how, taken in (("compiling", uncached), ("compiled before", cached)):
        steps |= {f"{step}, {how}": taken[step] for step in taken if step.startswith("first stack")}
    if find_spec("pontryagin.cli"):
        runs = [command(*COMMAND.split()) for _ in range(repeats)]
        steps["pontryagin solve, command line"] = min(processor for processor, _ in runs)
        steps["pontryagin solve, command line, by the clock"] = min(clock for _, clock in runs)
    return {"step": list(steps), "seconds": list(steps.values())}


def command(*arguments: str) -> tuple[float, float]:
    """Seconds of ``pontryagin`` with these arguments: of the processor, and by the clock."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    subprocess.run(
        [sys.executable, "-c", "import pontryagin.cli as c; c.main()", *arguments],
        check=True,
        capture_output=True,
    )
    after, ended = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return processor, ended - started
