"""Times of compiled averaged solves, one by one and in a stack, compared with the aim."""

from functools import partial

from benchmarks.averaging.examples import EXAMPLES, worst_residual
from benchmarks.clock import one_call, repeated, take_turns
from benchmarks.table import by_heading

AIM = 0.010
"""The aim for one averaged solve after compilation, in seconds."""


def table(quick: bool) -> dict[str, list]:
    """Milliseconds of each example's averaged solve, the aim, and the worst residual in the stack."""
    size, rounds = (20, 2) if quick else (1000, 3)
    rows = []
    for name, example in EXAMPLES.items():
        together = partial(example.solve, **example.stack(name, size))
        one = repeated(one_call(example.one), 1 if quick else 10)
        timings = take_turns({"one": one, "stack": one_call(together, size)}, rounds)
        rows.append(
            {
                "example": name,
                "aim, ms": 1e3 * AIM,
                "one problem, ms": 1e3 * timings["one"].typical,
                "fastest round, ms": 1e3 * timings["one"].least,
                f"a problem in a stack of {size}, ms": 1e3 * timings["stack"].typical,
                "residual": worst_residual(example.one()),
                "worst residual in the stack": worst_residual(together()),
            }
        )
    return by_heading(rows)
