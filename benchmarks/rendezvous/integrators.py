"""Flights with their derivatives by our native loop, by heyoka's Taylor series and by SciPy's DOP853."""

import math
import types
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.clock import one_call, take_turns
from benchmarks.rendezvous import problems
from benchmarks.table import by_heading
from benchmarks.taylor import has_heyoka
from pontryagin.arrays import Array
from pontryagin.numerics.equations import Arithmetic, Kernel
from pontryagin.rendezvous import Extremal
from pontryagin.rendezvous.reduced.arcs import arc, equations

CASES = (*problems.FIXED, "inclined-10", "inclined-60", "glonass")
TAYLOR, SCIPY = 1e-15, 1e-13
"""The tolerances of the two peers: the least that each takes for what it is."""
OURS, THEIRS, CLASSIC = "ours, ms", "heyoka, ms", "SciPy, ms"


def on_heyoka() -> Arithmetic:
    """A kernel's arithmetic on heyoka's expressions: its own code runs with heyoka's functions."""
    import heyoka as hy

    def sqrt(x: Any) -> Any:
        return math.sqrt(x) if isinstance(x, int | float) else hy.sqrt(x)  # heyoka takes no plain number

    def lift(kernel: Any) -> Callable[..., Any]:
        names = {"sqrt": sqrt, "sin": hy.sin, "cos": hy.cos}
        return types.FunctionType(kernel.__code__, names, kernel.__name__)

    return Arithmetic(lift, sqrt, hy.tanh)


def taylor(system: Kernel) -> Any:
    """heyoka's integrator of the equations with their derivatives."""
    import heyoka as hy

    x = [hy.expression(name) for name in system.names]
    p = [hy.par[i] for i in range(system.parameters)]
    rates = system.right_hand_side(on_heyoka(), hy.time, x, p)
    varied = hy.var_ode_sys(list(zip(x, rates, strict=True)), [x[i] for i in system.wrt], order=1)
    size = len(x) * (1 + len(system.wrt))
    return hy.taylor_adaptive(varied, np.zeros(size), tol=TAYLOR, compact_mode=True)


def by_taylor(compiled: Any, whole: Array, end: float, parameters: tuple[float, ...]) -> Array:
    """The end by heyoka's integrator."""
    compiled.time = 0.0
    compiled.state[:], compiled.pars[:] = whole, parameters
    compiled.propagate_until(end)
    return compiled.state.copy()


def by_scipy(system: Kernel, whole: Array, end: float, parameters: tuple[float, ...]) -> Array:
    """The end by SciPy's integrator and NumPy's right-hand side."""
    n = len(system.names)

    def rates(time: float, flat: Array) -> Array:
        table = system.variational(time, flat[:n], flat[n:].reshape(n, -1), parameters)
        return np.concatenate([table[:, 0], table[:, 1:].ravel()])

    return solve_ivp(rates, (0.0, end), whole, "DOP853", rtol=SCIPY, atol=SCIPY / 10).y[:, -1]


def first_arc(best: Extremal) -> tuple[Kernel, Array, float, tuple[float, ...], Callable[[], Array]]:
    """The equations, the start, the end and the parameters of the first arc of a flight, and its run."""
    flight = best.root.flight
    piece, end = flight.pieces[0], float(np.append(flight.switch_times, flight.duration)[0])
    parameters = (flight.scaled.eccentricity, float(flight.chart))
    follow = arc(piece.mode, False)
    ours = partial(follow.run, piece.whole, 0.0, end, parameters)
    return equations(piece.mode, False), piece.whole, end, parameters, lambda: ours().whole


def table(quick: bool) -> dict[str, list]:
    """Times and differences of the first arc of each case; heyoka's are None where it is absent."""
    rows = []
    for name in CASES[:1] if quick else CASES:
        system, whole, end, parameters, run = first_arc(problems.solved(name))
        shots = {
            OURS: run,
            CLASSIC: partial(by_scipy, system, whole, end, parameters),
        }
        if has_heyoka():
            shots[THEIRS] = partial(by_taylor, taylor(system), whole, end, parameters)
        runs = {heading: one_call(shot) for heading, shot in shots.items()}
        timings = take_turns(runs, 1 if quick else 5)
        times = {heading: 1e3 * timing.typical for heading, timing in timings.items()}
        ends = {heading: shot() for heading, shot in shots.items()}
        rows.append(
            {
                "case": name,
                **{heading: times.get(heading) for heading in (OURS, THEIRS, CLASSIC)},
                "heyoka, times ours": times[THEIRS] / times[OURS] if THEIRS in times else None,
                "SciPy, times ours": times[CLASSIC] / times[OURS],
                "ours against heyoka": difference(ends[OURS], ends.get(THEIRS)),
                "SciPy against heyoka": difference(ends[CLASSIC], ends.get(THEIRS)),
            }
        )
    return by_heading(rows)


def difference(found: Array, expected: Array | None) -> float | None:
    """Largest difference, relative to the largest entry expected; None where nothing is expected."""
    return None if expected is None else float(np.abs(found - expected).max() / np.abs(expected).max())
