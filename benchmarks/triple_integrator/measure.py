"""All measurements of the solvers of the first paper."""

from benchmarks import peers, table
from benchmarks.contest import Row
from benchmarks.figures import accuracy_and_time
from benchmarks.papers import Measured
from benchmarks.triple_integrator import (
    accuracy,
    batches,
    collocation,
    figures,
    fixed_time,
    grids,
    stacks,
    start,
    transfers,
)
from benchmarks.triple_integrator.problems import SEED

NOTES = (
    "Stacks hold 100000 problems, fewer in a quick run.",
    "A problem counts as solved where an answer came and, for least time, where independent propagation of",
    "it reaches the target to 1e-9 of the motion.",
)


def measure(quick: bool) -> Measured:
    """All tables and plots."""
    rows = side_by_side(quick)
    by_size = stacks.by_size(quick)
    tables = {
        "side-by-side": ("Side by side, one thread", table.columns(rows)),
        "throughput": ("Our solvers against the aims", stacks.throughput(quick)),
        "stack-size": ("Time per problem by size of the stack", by_size),
        "accuracy": ("Worst miss and gap by class of problems", accuracy.table(quick)),
        "batches": ("Batches on the command line, from file to file", batches.table(quick)),
        "start": ("First calls in a fresh process", start.table(quick)),
    }
    drawn = [accuracy_and_time(rows), figures.stack_size(by_size)]
    if not peers.absent("ruckig"):
        cells = transfers.cells(quick)
        tables["failures"] = ("Least time, share of inputs failed", transfers.summary(cells))
        tables["failures-by-scale"] = (
            "Least time, share of inputs failed at each scale",
            transfers.by_cell(cells),
        )
        drawn.append(figures.failures_by_scale(cells))
    return Measured(NOTES, SEED, tables, drawn)


def side_by_side(quick: bool) -> list[Row]:
    """All problems and all methods, side by side."""
    count, large, rounds = (50, 20_000, 2) if quick else (500, stacks.STACK_SIZE, 5)
    result = transfers.rows(quick)
    for problem in fixed_time.OURS:
        opponents = grids.peers(problem, quick) | collocation.peers(problem, quick)
        result += fixed_time.rows(problem, opponents, count, large, rounds)
    return result
