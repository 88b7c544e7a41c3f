"""Times of compiled averaged solves, one by one and in a stack, compared with the aim."""

from collections.abc import Callable

from benchmarks.averaging.examples import EXAMPLES, Example, worst_residual
from benchmarks.clock import repeated, take_turns

AIM = 0.010
"""The aim for one averaged solve after compilation, in seconds."""


def table(quick: bool) -> dict[str, list]:
    """Milliseconds of each example's averaged solve, the aim, and the worst residual in the stack."""
    size, rounds = (20, 2) if quick else (1000, 3)
    rows: list[tuple] = []
    for name, example in EXAMPLES.items():
        stack = example.stack(name, size)
        runs = {"one": repeated(_one(example), 1 if quick else 10), "stack": _stack(example, stack, size)}
        timings = take_turns(runs, rounds)
        one, each = timings["one"], timings["stack"]
        rows.append(
            (
                name,
                1e3 * AIM,
                1e3 * one.typical,
                1e3 * one.least,
                1e3 * each.typical,
                worst_residual(example.one()),
                worst_residual(example.solve(**stack)),
            )
        )
    headings = (
        "example",
        "aim, ms",
        "one problem, ms",
        "fastest round, ms",
        f"a problem in a stack of {size}, ms",
        "residual",
        "worst residual in the stack",
    )
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}


def _one(example: Example) -> Callable[[], int]:
    def run() -> int:
        example.one()
        return 1

    return run


def _stack(example: Example, stack: dict, size: int) -> Callable[[], int]:
    def run() -> int:
        example.solve(**stack)
        return size

    return run
