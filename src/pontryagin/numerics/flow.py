"""Flows of differential equations given in SymPy: heyoka's Taylor integrator, or SciPy's DOP853.

Both stand behind the same small functions, so that a machine without heyoka's wheel integrates the same
right-hand side, tens of times slower: `flow` follows one trajectory and samples it, `ends` carries many
trajectories to their ends at once, with their derivatives in the initial state if asked.
"""

import functools
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.packages import installed

Flow = Callable[..., Array]
Ends = Callable[..., tuple[Array, Array]]

TOLERANCE = 1e-15
ROUGH = 1e-10
"""Of a flight that only guesses: what comes of it is polished by one to rounding."""
STEPS = 100_000
SMALL = 200
"""Right-hand sides of fewer operations than this are unrolled by heyoka: faster, but slow to compile."""


@functools.cache
def has_heyoka() -> bool:
    """Whether heyoka can be imported; one warning in a process where it cannot."""
    if not installed("heyoka", "flows use SciPy's DOP853, slower"):
        return False
    import heyoka

    heyoka.set_logger_level_error()  # a trial step into a singularity is refused, and warrants no line
    return True


def flow(
    states: Sequence,
    rates: Sequence,
    parameters: Sequence = (),
    taylor: bool | None = None,
    clock: object = None,
) -> Flow:
    """Compile x' = rates(x, p) into a function that follows it.

    Parameters
    ----------
    states : sequence of sympy.Symbol
        The state x.
    rates : sequence of sympy.Expr
        Its derivative, one expression for each state.
    parameters : sequence of sympy.Symbol
        The constants p.
    taylor : bool, optional
        Whether to use heyoka; by default wherever it is installed.
    clock : sympy.Symbol, optional
        The independent variable, if the rates hold it.

    Returns
    -------
    function (start, times, parameters=()) -> (k, n) array
        The states at the times (k,), ascending, from ``start`` (n,) at the first of them. It raises
        `pontryagin.NotConverged` where the integrator stops short.

    Raises
    ------
    ValueError
        If the numbers of states and rates differ, or a rate holds an unknown symbol.

    Examples
    --------
    >>> import sympy as sp
    >>> x, v, k = sp.symbols("x v k")
    >>> oscillate = flow([x, v], [v, -k * x], [k])
    >>> oscillate([1.0, 0.0], [0.0, np.pi], [1.0])[-1].round(12) + 0.0
    array([-1.,  0.])
    """
    require_known(states, rates, parameters, clock)
    use_taylor = has_heyoka() if taylor is None else taylor
    make = _taylor if use_taylor else _runge_kutta
    return make(tuple(states), tuple(rates), tuple(parameters), clock)


def ends(
    states: Sequence,
    rates: Sequence,
    parameters: Sequence = (),
    clock: object = None,
    wrt: Sequence = (),
    taylor: bool | None = None,
    tolerance: float = TOLERANCE,
) -> Ends:
    """Compile x' = rates(x, p) into a function that carries many trajectories to their ends.

    Parameters
    ----------
    states, rates, parameters, taylor, clock
        As for `flow`.
    wrt : sequence of sympy.Symbol
        States in whose initial values the ends are differentiated, by the variational equations.
    tolerance : float
        Error allowed per step, relative; a rougher one is faster where only derivatives are wanted.

    Returns
    -------
    function (starts, begin, end, parameters=()) -> (k, n) array, (k, n, m) array
        From ``starts`` (k, n) at ``begin`` (k,) the states at ``end`` (k,), and their derivatives in the m
        initial values ``wrt``. ``parameters`` is (p,) or (k, p). It raises `pontryagin.NotConverged` where
        an integrator stops short. The same equations are compiled once.

    Examples
    --------
    >>> import sympy as sp
    >>> x, v = sp.symbols("x v")
    >>> oscillate = ends([x, v], [v, -x], wrt=[v])
    >>> states, slopes = oscillate([[1.0, 0.0], [2.0, 0.0]], [0.0, 0.0], [np.pi, np.pi / 2])
    >>> states.round(12) + 0.0, slopes[..., 0].round(12) + 0.0
    (array([[-1.,  0.],
           [ 0., -2.]]), array([[ 0., -1.],
           [ 1.,  0.]]))
    """
    require_known(states, rates, parameters, clock)
    use_taylor = has_heyoka() if taylor is None else taylor
    make = _taylor_ends if use_taylor else _runge_kutta_ends
    run = make(tuple(states), tuple(rates), tuple(parameters), clock, tuple(wrt), tolerance)

    def carry(starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike = ()):
        start = np.asarray(starts, dtype=float)
        count = len(start)
        first, last = (np.broadcast_to(np.asarray(t, dtype=float), (count,)) for t in (begin, end))
        constants = np.broadcast_to(np.asarray(values, dtype=float), (count, len(parameters)))
        return run(start, first, last, constants)

    return carry


def require_known(states: Sequence, rates: Sequence, parameters: Sequence, clock: object) -> None:
    """Raise ValueError unless the rates are as many as the states and hold no other symbols."""
    if len(states) != len(rates):
        raise ValueError(f"rates must hold one expression for each of {len(states)} states, got {len(rates)}")
    known = set(states) | set(parameters) | {clock}
    unknown = {str(symbol) for rate in rates for symbol in rate.free_symbols - known}
    if unknown:
        raise ValueError(
            f"rates must be in states and parameters alone, got symbols {', '.join(sorted(unknown))}"
        )


# --- heyoka ------------------------------------------------------------------------------------------


def heyoka_system(
    states: Sequence, rates: Sequence, parameters: Sequence, clock: object
) -> tuple[list[tuple], dict]:
    """The equations in heyoka's expressions, what they share built once, and the table of symbols."""
    import heyoka as hy
    import sympy as sp

    table = {symbol: hy.expression(f"x_{i}") for i, symbol in enumerate(states)}
    table |= {symbol: hy.par[i] for i, symbol in enumerate(parameters)}
    if clock is not None:
        table[clock] = hy.time
    shared, reduced = sp.cse([with_floats(rate) for rate in rates], symbols=sp.numbered_symbols(cls=sp.Dummy))
    for symbol, expression in shared:
        table[symbol] = hy.from_sympy(expression, table)
    return [(table[x], hy.from_sympy(r, table)) for x, r in zip(states, reduced, strict=True)], table


def with_floats(expression):
    """Fractions as floats where heyoka takes none: those whose denominator is no power of two."""
    import sympy as sp

    taken = sp.sympify(expression)
    fractions = [r for r in taken.atoms(sp.Rational) if r.q & (r.q - 1)]
    return taken.xreplace({r: sp.Float(float(r)) for r in fractions})


def compact(rates: Sequence) -> bool:
    """Whether heyoka should compile loops: large systems unrolled take many seconds to compile."""
    import sympy as sp

    return sp.count_ops(list(rates)) > SMALL


def _counted(rates: Sequence, parameters: Sequence) -> int:
    """How many parameters heyoka counts: up to the last that the rates hold."""
    used = {symbol for rate in rates for symbol in rate.free_symbols}
    return max((i for i, symbol in enumerate(parameters, 1) if symbol in used), default=0)


def _taylor(states: tuple, rates: tuple, parameters: tuple, clock: object) -> Flow:
    import heyoka as hy

    system, _ = heyoka_system(states, rates, parameters, clock)
    held = _counted(rates, parameters)
    integrator = hy.taylor_adaptive(
        system,
        [0.0] * len(states),
        tol=TOLERANCE,
        pars=[0.0] * held,
        compact_mode=compact(rates),
    )

    def follow(start: ArrayLike, times: ArrayLike, values: ArrayLike = ()) -> Array:
        grid = np.asarray(times, dtype=float)
        integrator.time = grid[0]
        integrator.state[:] = start
        integrator.pars[:] = np.asarray(values, dtype=float)[:held]
        outcome, *_, states_at = integrator.propagate_grid(grid, max_steps=STEPS)
        if outcome != hy.taylor_outcome.time_limit:
            raise NotConverged(f"the Taylor integrator stopped: {outcome}", float(grid[-1] - integrator.time))
        return states_at

    return follow


@functools.lru_cache(maxsize=64)
def _taylor_ends(states: tuple, rates: tuple, parameters: tuple, clock: object, wrt: tuple, tolerance: float):
    import heyoka as hy

    system, table = heyoka_system(states, rates, parameters, clock)
    lanes, n, m = hy.recommended_simd_size(), len(states), len(wrt)
    held = _counted(rates, parameters)
    if wrt:
        system = hy.var_ode_sys(system, [table[symbol] for symbol in wrt], order=1)
    integrator = hy.taylor_adaptive_batch(
        system,
        np.zeros((n, lanes)),
        tol=tolerance,
        pars=np.zeros((held, lanes)),
        compact_mode=bool(wrt) or compact(rates),
    )
    identity = np.array(integrator.state[n:])

    def run(start: NDArray, begin: NDArray, end: NDArray, values: NDArray):
        count = len(start)
        states_at, slopes = np.empty((count, n)), np.empty((count, n, m))
        for i in range(0, count, lanes):
            chosen = np.minimum(np.arange(i, i + lanes), count - 1)
            integrator.set_time(begin[chosen])
            integrator.state[:n] = start[chosen].T
            integrator.state[n:] = identity
            integrator.pars[:] = values[chosen, :held].T
            integrator.propagate_until(end[chosen], max_steps=STEPS)
            worst = [outcome for outcome, *_ in integrator.propagate_res]
            if any(outcome != hy.taylor_outcome.time_limit for outcome in worst):
                left = float(np.abs(end[chosen] - integrator.time).max())
                raise NotConverged("the Taylor integrator stopped short of the end", left)
            part = slice(i, min(i + lanes, count))
            filled = part.stop - part.start
            states_at[part] = integrator.state[:n, :filled].T
            slopes[part] = integrator.state[n:, :filled].reshape(n, m, filled).transpose(2, 0, 1)
        return states_at, slopes

    return run


# --- SciPy -------------------------------------------------------------------------------------------


def _runge_kutta(states: tuple, rates: tuple, parameters: tuple, clock: object) -> Flow:
    from scipy.integrate import solve_ivp

    time = clock if clock is not None else _unused()
    evaluate = compiler.function("rates", [time, *states, *parameters], _named(rates))

    def follow(start: ArrayLike, times: ArrayLike, values: ArrayLike = ()) -> Array:
        grid = np.asarray(times, dtype=float)
        constants = list(np.asarray(values, dtype=float))
        result = solve_ivp(
            lambda t, x: np.array(evaluate(t, *x, *constants)),
            (grid[0], grid[-1]),
            np.asarray(start, dtype=float),
            method="DOP853",
            t_eval=grid,
            rtol=1e-13,
            atol=1e-14,
        )
        if not result.success:
            raise NotConverged(
                f"the Runge-Kutta integrator stopped: {result.message}", float(grid[-1] - result.t[-1])
            )
        return result.y.T

    return follow


@functools.lru_cache(maxsize=64)
def _runge_kutta_ends(
    states: tuple, rates: tuple, parameters: tuple, clock: object, wrt: tuple, tolerance: float
):
    import sympy as sp
    from scipy.integrate import solve_ivp

    time, n, m = (clock if clock is not None else _unused()), len(states), len(wrt)
    outputs = _named(rates) | ({"jacobian": sp.Matrix(rates).jacobian(list(states))} if wrt else {})
    evaluate = compiler.function("rates", [time, *states, *parameters], outputs)
    identity = np.array([[float(x == y) for y in wrt] for x in states])
    rtol = max(tolerance, 1e-13)

    def run(start: NDArray, begin: NDArray, end: NDArray, values: NDArray):
        count, span = len(start), end - begin

        def rate(s: float, flat: NDArray) -> NDArray:
            lanes = flat.reshape(count, n, 1 + m)
            columns = evaluate(begin + s * span, *lanes[..., 0].T, *values.T)
            slope = np.stack(columns[:n], axis=-1)[..., None]
            if wrt:
                slope = np.concatenate([slope, columns[n] @ lanes[..., 1:]], axis=-1)
            return (slope * span[:, None, None]).ravel()

        first = np.concatenate([start[..., None], np.broadcast_to(identity, (count, n, m))], axis=-1)
        result = solve_ivp(rate, (0.0, 1.0), first.ravel(), method="DOP853", rtol=rtol, atol=rtol / 10)
        if not result.success or not np.isfinite(result.y[:, -1]).all():
            raise NotConverged(
                f"the Runge-Kutta integrator stopped: {result.message}", float(1.0 - result.t[-1])
            )
        last = result.y[:, -1].reshape(count, n, 1 + m)
        return last[..., 0], last[..., 1:]

    return run


def _named(rates: Sequence) -> dict[str, object]:
    return {f"d{i}": rate for i, rate in enumerate(rates)}


def _unused():
    import sympy as sp

    return sp.Dummy("t")
