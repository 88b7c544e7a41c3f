"""Operations and times of the right-hand sides with 16, 14, 11 and 10 equations."""

from collections.abc import Callable
from functools import partial

import numpy as np
import sympy as sp

from benchmarks.clock import one_call, repeated, take_turns
from benchmarks.rendezvous import problems, systems
from benchmarks.rendezvous.systems import SYSTEMS
from benchmarks.table import by_heading
from pontryagin.arrays import Array
from pontryagin.numerics.runge_kutta import STAGES
from pontryagin.rendezvous.derivation.principle import Mode

REFERENCE = "inclined-energy"
"""The case whose flight is timed."""
SCALES: dict[Mode, float] = {"unsaturated": 1.0, "saturated": 0.05}
"""The parameter of each kind of arcs: alpha2 on unsaturated ones, p_max on saturated ones."""
MODES: tuple[Mode, ...] = ("unsaturated", "saturated")


def operations(size: str, mode: Mode, derivatives: bool) -> int:
    """Number of operations of one right-hand side, with common subexpressions counted once."""
    form, columns = systems.expressions(size, mode)
    rates = [*form.rates, *(columns if derivatives else ())]
    shared, reduced = sp.cse(rates)
    return int(sp.count_ops([value for _, value in shared]) + sp.count_ops(reduced))


def table(quick: bool) -> dict[str, list]:
    """Operations and times of every form on both kinds of arcs, with and without derivatives."""
    rounds = 1 if quick else 7
    rows = []
    for mode in MODES[:1] if quick else MODES:
        for derivatives in (False, True):
            flights = {size: _fly(size, mode, derivatives) for size in SYSTEMS}
            flight_times = take_turns(
                {size: repeated(run, 5) for size, (run, _, _) in flights.items()}, rounds
            )
            reference = flights["11"][2]
            for size in SYSTEMS:
                _, steps, end = flights[size]
                rows.append(
                    {
                        "arc": mode,
                        "derivatives": "with" if derivatives else "without",
                        "equations": len(SYSTEMS[size](mode).states) * (7 if derivatives else 1),
                        "form": size,
                        "operations": operations(size, mode, derivatives),
                        "steps of a flight": steps,
                        "nanoseconds a stage": 1e9 * flight_times[size].typical / (STAGES * steps),
                        "microseconds a flight": 1e6 * flight_times[size].typical,
                        "fastest round": 1e6 * flight_times[size].least,
                        "difference from 11": float(np.abs(end[:4] - reference[:4]).max()),
                    }
                )
    return by_heading(rows)


def _fly(size: str, mode: Mode, derivatives: bool) -> tuple[Callable[[], int], int, Array]:
    """A function that runs the reference case's flight, the number of its steps, and its end."""
    best = problems.solved(REFERENCE)
    scaled, duration = best.problem.scaled, best.flight.duration
    start = systems.initial_state(size, scaled, best.flight.costates)
    integrator = systems.compiled(size, mode, derivatives)
    rest = systems.identity(size).ravel() if derivatives else np.empty(0)
    state, parameters = np.concatenate([start, rest]), systems.parameters(size, scaled, SCALES[mode], start)
    fly = partial(systems.carried, integrator, state, parameters, duration)
    reached = fly()
    return one_call(fly), reached.steps, reached.whole[: len(start)]
