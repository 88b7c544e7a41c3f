"""First calls in a fresh process: imports, averaged solve, engine build, first exact extremals."""

from benchmarks.averaging.examples import EXAMPLES, KEPLER
from benchmarks.fresh import least_seconds
from benchmarks.table import by_heading

BUILD_AIM = 1.0
"""The aim for building a `PhaseSystem` and its compiled model from expressions, in seconds."""

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
    rows = []
    for name in [KEPLER] if quick else EXAMPLES:
        once = least_seconds(ONCE % name, repeats)
        rows.append(
            {
                "example": name,
                "aim, s": BUILD_AIM,
                "engine build, s": least_seconds(BUILD % name, repeats)["build"],
                "imports, s": once["import"],
                "first averaged solve, s": once["first"],
                "first exact extremals, s": once["exact"],
            }
        )
    return by_heading(rows)
