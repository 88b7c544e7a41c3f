"""First calls in a fresh process: imports, averaged solve, engine build, first exact extremals."""

import json
import subprocess
import sys

from benchmarks.averaging.examples import EXAMPLES, KEPLER

BUILD_AIM = 1.0
"""The aim for building a `PhaseSystem` and its compiled model from expressions, in seconds."""

SCRIPT = """
import json, sys
from time import process_time
spent = {}
def mark(step, since=[process_time()]):
    now = process_time()
    spent[step] = now - since[0]
    since[0] = now
%s
print(json.dumps(spent))
"""

SOLVE = """
import numpy
mark("import numpy")
from pontryagin.averaging import %(import)s
%(given)s
mark("import")
solution = %(call)s
mark("first")
"""

BUILD = """
import sympy
import benchmarks.averaging.examples as examples
name = %r
if name == examples.OWN:
    examples.own_expressions()
    mark("import")
    examples.own_system().model
    mark("build")
else:
    solution = examples.EXAMPLES[name].one()
    import pontryagin.averaging.system.average as average
    average._MODELS.clear()
    mark("import")
    solution.make_system().model
    mark("build")
"""

ONCE = """
import benchmarks.averaging.examples as examples
mark("import")
example = examples.EXAMPLES[%r]
solution = example.one()
mark("first")
solution.exact(0.05)
mark("exact")
"""


def table(quick: bool) -> dict[str, list]:
    """Processor seconds of the first calls of each example, the least over a few processes."""
    repeats = 1 if quick else 2
    names = [KEPLER] if quick else list(EXAMPLES)
    rows = []
    for name in names:
        built = _fastest(BUILD % name, repeats)
        once = _fastest(ONCE % name, repeats)
        rows.append((name, BUILD_AIM, built["build"], once["import"], once["first"], once["exact"]))
    headings = (
        "example",
        "aim, s",
        "engine build, s",
        "imports, s",
        "first averaged solve, s",
        "first exact extremals, s",
    )
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


def _fastest(body: str, repeats: int) -> dict[str, float]:
    runs = [_phases(body) for _ in range(repeats)]
    return {step: min(run[step] for run in runs) for step in runs[0]}


def _phases(body: str) -> dict[str, float]:
    run = subprocess.run([sys.executable, "-c", SCRIPT % body], check=True, capture_output=True, text=True)
    return json.loads(run.stdout)
