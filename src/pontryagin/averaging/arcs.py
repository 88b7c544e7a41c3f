"""Flows whose right-hand side switches, followed arc by arc with every switch located.

The right-hand side holds modes, the signs of switching functions. On an arc they are constant; where a
switching function vanishes its mode changes and the derivatives in the initial state jump by
(f+ - f-) grad(s)'/s', f- and f+ being the rates before and after.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.modes import Modes
from pontryagin.errors import NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import (
    STEPS,
    TOLERANCE,
    Ends,
    Flow,
    has_heyoka,
    heyoka_system,
    with_floats,
)


def switched_ends(
    modes: Modes,
    states: Sequence,
    rates: Sequence,
    parameters: Sequence = (),
    clock: object = None,
    wrt: Sequence = (),
    taylor: bool | None = None,
) -> Ends:
    """As `pontryagin.numerics.flow.ends`, for rates that hold modes.

    Parameters
    ----------
    modes : tuple of (sympy.Symbol, sympy.Expr)
        Modes and the functions whose signs they are, in states, parameters, clock and earlier modes.
    states, rates, parameters, clock, wrt, taylor
        As there.

    Examples
    --------
    A ball under a force towards the origin, 1 in modulus, from rest at 1/2: it is back after four arcs of
    unit duration.

    >>> x, v, m = sp.symbols("x v m")
    >>> fall = switched_ends(((m, x),), [x, v], [v, -m], wrt=[v])
    >>> states, slopes = fall([[0.5, 0.0]], 0.0, 4.0)
    >>> (states.round(12) + 0.0).tolist(), (slopes.round(12) + 0.0).tolist()
    ([[0.5, 0.0]], [[[0.0], [1.0]]])
    """
    run = _arcs(modes, tuple(states), tuple(rates), tuple(parameters), clock, tuple(wrt), _use(taylor))

    def carry(starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike = ()):
        start = np.asarray(starts, dtype=float)
        count = len(start)
        first, last = (np.broadcast_to(np.asarray(t, dtype=float), (count,)) for t in (begin, end))
        constants = np.broadcast_to(np.asarray(values, dtype=float), (count, len(parameters)))
        reached = np.array(
            [
                run(s, np.array([b, e]), c)[-1]
                for s, b, e, c in zip(start, first, last, constants, strict=True)
            ]
        )
        n = len(states)
        return reached[:, :n], reached[:, n:].reshape(count, n, len(wrt))

    return carry


def switched_flow(
    modes: Modes,
    states: Sequence,
    rates: Sequence,
    parameters: Sequence = (),
    clock: object = None,
    taylor: bool | None = None,
) -> Flow:
    """As `pontryagin.numerics.flow.flow`, for rates that hold modes."""
    run = _arcs(modes, tuple(states), tuple(rates), tuple(parameters), clock, (), _use(taylor))

    def follow(start: ArrayLike, times: ArrayLike, values: ArrayLike = ()) -> Array:
        return run(*(np.asarray(value, dtype=float) for value in (start, times, values)))

    return follow


def _use(taylor: bool | None) -> bool:
    return has_heyoka() if taylor is None else taylor


@lru_cache(maxsize=32)
def _arcs(
    modes: Modes, states: tuple, rates: tuple, parameters: tuple, clock: object, wrt: tuple, taylor: bool
) -> Callable[[Array, Array, Array], Array]:
    """function (start (n,), grid (k,), values (p,)) -> (k, n + n m): states and derivatives on the grid."""
    switches = _Switches(modes, states, rates, parameters, clock, len(wrt))
    make = _taylor if taylor else _runge_kutta
    return make(switches, modes, states, rates, parameters, clock, wrt)


class _Switches:
    """Which mode holds, and what happens to the derivatives where one changes."""

    def __init__(
        self, modes: Modes, states: tuple, rates: tuple, parameters: tuple, clock: object, columns: int
    ) -> None:
        time = clock if clock is not None else sp.Dummy("t")
        symbols = [mode for mode, _ in modes]
        arguments = [time, *states, *parameters, *symbols]
        functions = sp.Matrix([switching for _, switching in modes])
        self.columns, self.dimension, self.count = columns, len(states), len(modes)
        self.values = compiler.function("switching", arguments, {"s": functions})
        self.gradients = compiler.function(
            "gradients", arguments, {"by_state": functions.jacobian(states), "by_time": functions.diff(time)}
        )
        self.rates = compiler.function("rates", arguments, {"f": sp.Matrix(rates)})

    def at_start(self, time: float, state: Array, constants: Array) -> Array:
        """The modes that hold from a point on; one whose function vanishes there has its slope's sign."""
        signs = np.ones(self.count)
        for i in range(self.count):
            point = (time, *state, *constants, *signs)
            value = float(self.values(*point)[0][i, 0])
            signs[i] = np.sign(value) or np.sign(self.slope(i, time, state, constants, signs)) or 1.0
        return signs

    def slope(self, i: int, time: float, state: Array, constants: Array, signs: Array) -> float:
        """Rate of switching function i."""
        point = (time, *state, *constants, *signs)
        by_state, by_time = self.gradients(*point)
        return float(by_state[i] @ self.rates(*point)[0][:, 0] + by_time[i, 0])

    def jump(self, i: int, time: float, whole: Array, constants: Array, signs: Array) -> Array:
        """The derivatives (n, m) after mode i changes; `signs` are those before."""
        n, m = self.dimension, self.columns
        state, through = whole[:n], whole[n:].reshape(n, m)
        flipped = np.where(np.arange(self.count) == i, -signs, signs)
        before, after = (self.rates(time, *state, *constants, *s)[0][:, 0] for s in (signs, flipped))
        by_state, _ = self.gradients(time, *state, *constants, *signs)
        slope = self.slope(i, time, state, constants, signs)
        if slope == 0:
            raise NotConverged("a switching function touches zero without crossing it", 0.0)
        return through + np.outer(after - before, by_state[i] @ through / slope)


def _taylor(
    switches: _Switches,
    modes: Modes,
    states: tuple,
    rates: tuple,
    parameters: tuple,
    clock: object,
    wrt: tuple,
) -> Callable[[Array, Array, Array], Array]:
    import heyoka as hy

    symbols = [mode for mode, _ in modes]
    functions = [switching for _, switching in modes]
    system, table = heyoka_system(states, rates, (*parameters, *symbols), clock)
    n, p = len(states), len(parameters)
    if wrt:
        system = hy.var_ode_sys(system, [table[symbol] for symbol in wrt], order=1)

    def flip(i: int):
        def change(integrator, _sign: int) -> bool:
            if wrt:
                constants, signs = integrator.pars[:p], integrator.pars[p:].copy()
                after = switches.jump(i, integrator.time, integrator.state, constants, signs)
                integrator.state[n:] = after.ravel()
            integrator.pars[p + i] *= -1
            return True

        return change

    integrator = hy.taylor_adaptive(
        system,
        np.zeros(n),
        tol=TOLERANCE,
        pars=np.ones(p + len(modes)),
        compact_mode=True,
        t_events=[
            hy.t_event(hy.from_sympy(with_floats(s), table), callback=flip(i))
            for i, s in enumerate(functions)
        ],
    )
    identity = np.array(integrator.state[n:])

    def run(start: Array, grid: Array, values: Array) -> Array:
        integrator.reset_cooldowns()
        integrator.time = grid[0]
        integrator.state[:n], integrator.state[n:] = start, identity
        integrator.pars[:p] = values
        integrator.pars[p:] = switches.at_start(grid[0], start, values)
        outcome, *_, reached = integrator.propagate_grid(grid, max_steps=STEPS)
        if outcome != hy.taylor_outcome.time_limit:
            raise NotConverged(f"the Taylor integrator stopped: {outcome}", float(grid[-1] - integrator.time))
        return reached

    return run


def _runge_kutta(
    switches: _Switches,
    modes: Modes,
    states: tuple,
    rates: tuple,
    parameters: tuple,
    clock: object,
    wrt: tuple,
) -> Callable[[Array, Array, Array], Array]:
    from scipy.integrate import solve_ivp

    n, m = len(states), len(wrt)
    time = clock if clock is not None else sp.Dummy("t")
    arguments = [time, *states, *parameters, *(mode for mode, _ in modes)]
    outputs = {"f": sp.Matrix(rates)} | ({"J": sp.Matrix(rates).jacobian(states)} if wrt else {})
    evaluate = compiler.function("rates", arguments, outputs)
    identity = np.array([[float(x == w) for w in wrt] for x in states]).reshape(n * m)

    def run(start: Array, grid: Array, values: Array) -> Array:
        signs = switches.at_start(grid[0], start, values)
        now, whole = grid[0], np.concatenate([start, identity])
        rows: list[Array] = []
        for _ in range(STEPS):

            def rate(t: float, z: Array, signs: Array = signs) -> Array:
                columns = evaluate(t, *z[:n], *values, *signs)
                through = (columns[1] @ z[n:].reshape(n, m)).ravel() if wrt else []
                return np.concatenate([columns[0][:, 0], through])

            events = [_leaving(switches, i, n, values, signs) for i in range(len(modes))]
            left = grid[len(rows) :]
            result = solve_ivp(
                rate, (now, grid[-1]), whole, "DOP853", left, events=events, rtol=1e-13, atol=1e-14
            )
            if result.status < 0:
                raise NotConverged(f"the Runge-Kutta integrator stopped: {result.message}", grid[-1] - now)
            rows.extend(np.reshape(result.y, (len(whole), -1)).T)
            if result.status == 0:
                return np.array(rows)
            instants, there = result.t_events or [], result.y_events or []
            i = next(i for i, found in enumerate(instants) if len(found))
            now, whole = float(instants[i][0]), there[i][0].copy()
            if wrt:
                whole[n:] = switches.jump(i, now, whole, values, signs).ravel()
            signs = np.where(np.arange(len(modes)) == i, -signs, signs)
        raise NotConverged("the right-hand side switches without end", float(grid[-1] - now))

    return run


def _leaving(switches: _Switches, i: int, n: int, values: Array, signs: Array):
    """An event where mode i stops being the sign of its function; its own switch does not count again."""

    def event(t: float, z: Array) -> float:
        return float(signs[i] * switches.values(t, *z[:n], *values, *signs)[0][i, 0])

    event.terminal = True  # type: ignore[attr-defined]
    event.direction = -1  # type: ignore[attr-defined]
    return event
