"""Throughput of our solvers against the aims and against the size of the stack."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import one_by_one, repeated, take_turns
from benchmarks.triple_integrator import problems
from benchmarks.triple_integrator.fixed_time import OURS
from pontryagin.triple_integrator import Maneuver, minimum_time
from pontryagin.triple_integrator.least_time import time as least_time
from pontryagin.triple_integrator.norms import impulse, norm, peak
from pontryagin.triple_integrator.norms.power_rules import table

AIMS = {"least peak": 2.0, "least impulse": 20.0, "least time": 1.0, "least L4 norm": 0.1}
"""The aims for the throughput, in million problems a second on one core."""

STACK_SIZE = 100_000
"""Size of the stack for the throughput: so large that a call costs little, small enough for the cache."""

AIM_CALL = 2.5
"""The aim for one call from Python, in microseconds."""


def throughput(quick: bool) -> dict[str, list]:
    """Million problems a second of the compiled loop and of the whole call; microseconds of one call."""
    count, rounds = (20_000, 3) if quick else (STACK_SIZE, 7)
    loop, whole = (
        take_turns({name: repeated(run, 10) for name, run in runs.items()}, rounds)
        for runs in (_loops(count), whole_calls(count))
    )
    lists, arrays = (
        take_turns(single_calls(200 if quick else 2000, form), rounds) for form in (np.ndarray.tolist, list)
    )
    return {
        "problem": list(whole),
        "aim, million/s": [AIMS.get(name) for name in whole],
        "compiled loop, million/s": [1e-6 / loop[name].typical if name in loop else None for name in whole],
        "whole call, million/s": [1e-6 / timing.typical for timing in whole.values()],
        "aim, one call, microseconds": [AIM_CALL] * len(whole),
        "one call from lists, microseconds": [1e6 * lists[name].typical for name in whole],
        "one call from arrays, microseconds": [1e6 * arrays[name].typical for name in whole],
    }


def by_size(quick: bool) -> dict[str, list]:
    """Microseconds per problem of the whole public call against the number of problems in the stack."""
    sizes = (1, 10, 100, 1000) if quick else tuple(round(10 ** (k / 2)) for k in range(13))
    result: dict[str, list] = {"stack": list(sizes)}
    for size in sizes:
        times = max(1, 2000 // size)
        runs = {name: repeated(run, times) for name, run in whole_calls(size).items()}
        for name, timing in take_turns(runs, 3 if quick else 5).items():
            result.setdefault(f"{name}, microseconds", []).append(1e6 * timing.typical)
    return result


def whole_calls(count: int) -> dict[str, Callable[[], int]]:
    """Each public solver on a stack, from the ends to the solution."""
    x0, xf, T, bound = _stack(count)

    def fixed_time(solve: Callable) -> Callable[[], int]:
        return lambda: len(solve(Maneuver(x0, xf, T)).norm)

    calls = {name: fixed_time(solve) for name, solve in OURS.items()}
    return calls | {"least time": lambda: len(minimum_time(x0, xf, bound).duration)}


def _stack(count: int) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """Both ends (count, 3), durations and bounds (count,) of random problems."""
    scales = np.exp(problems.generator("durations").uniform(-1, 1, (2, count)))
    return *problems.ends("stack", count), *scales


def _loops(count: int) -> dict[str, Callable[[], int]]:
    """The compiled loops alone, from columns of numbers to arrays of results."""
    x0, xf, T, bound = _stack(count)
    c = Maneuver(x0, xf, T).moments
    moments = [*(np.ascontiguousarray(c[:, i]) for i in range(3)), T]
    ends = [np.ascontiguousarray(x[:, i]) for x in (x0, xf) for i in range(3)]
    transfer = [*ends, np.zeros(count), bound]
    return {
        "least peak": lambda: len(peak.solve_stack(*moments)),
        "least impulse": lambda: len(impulse.solve_stack(*moments)),
        "least time": lambda: len(least_time.solve_stack(*transfer)),
        "least L4 norm": lambda: len(norm.solve_stack(*moments, tables=(table(4.0),))),
    }


def single_calls(count: int, form: Callable[[NDArray], list]) -> dict[str, Callable[[], int]]:
    """Each public solver, called for one problem at a time; `form` makes the states from rows of numbers."""
    ends = [form(x) for x in problems.ends("single", count)]

    def fixed_time(solve: Callable) -> Callable[[], int]:
        return one_by_one(lambda start, end: solve(Maneuver(start, end, 1.5)), *ends)

    calls = {name: fixed_time(solve) for name, solve in OURS.items()}
    return calls | {"least time": one_by_one(lambda start, end: minimum_time(start, end, 1.5), *ends)}
