"""Flows of differential equations given in SymPy: heyoka's Taylor integrator, or SciPy's DOP853.

Both stand behind one function, so that a machine without heyoka's wheel integrates the same right-hand
side, tens of times slower.
"""

import functools
import importlib.util
import sys
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin import compile as compiler
from pontryagin.errors import NotConverged

Flow = Callable[..., NDArray[np.float64]]

TOLERANCE = 1e-15


@functools.cache
def has_heyoka() -> bool:
    """Whether heyoka can be imported; said once if it cannot."""
    if importlib.util.find_spec("heyoka") is None:
        print("pontryagin: heyoka is not installed; flows use SciPy's DOP853, slower", file=sys.stderr)
        return False
    return True


def flow(states: Sequence, rates: Sequence, parameters: Sequence = (), taylor: bool | None = None) -> Flow:
    """Compile x' = rates(x, p) into a function that follows it.

    Parameters
    ----------
    states : sequence of sympy.Symbol
        The state x.
    rates : sequence of sympy.Expr
        Its derivative, one expression for each state; autonomous.
    parameters : sequence of sympy.Symbol
        The constants p.
    taylor : bool, optional
        Whether to use heyoka; by default wherever it is installed.

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
    if len(states) != len(rates):
        raise ValueError(f"rates must hold one expression for each of {len(states)} states, got {len(rates)}")
    known = set(states) | set(parameters)
    unknown = {str(symbol) for rate in rates for symbol in rate.free_symbols - known}
    if unknown:
        raise ValueError(
            f"rates must be in states and parameters alone, got symbols {', '.join(sorted(unknown))}"
        )
    use_taylor = has_heyoka() if taylor is None else taylor
    make = _taylor if use_taylor else _runge_kutta
    return make(tuple(states), tuple(rates), tuple(parameters))


def _taylor(states: tuple, rates: tuple, parameters: tuple) -> Flow:
    import heyoka as hy

    names = {symbol: hy.expression(f"x_{i}") for i, symbol in enumerate(states)}
    constants = {symbol: hy.par[i] for i, symbol in enumerate(parameters)}
    table = {**names, **constants}
    system = [(names[x], hy.from_sympy(rate, table)) for x, rate in zip(states, rates, strict=True)]
    integrator = hy.taylor_adaptive(system, [0.0] * len(states), tol=TOLERANCE, pars=[0.0] * len(parameters))

    def follow(start: ArrayLike, times: ArrayLike, values: ArrayLike = ()) -> NDArray[np.float64]:
        grid = np.asarray(times, dtype=float)
        integrator.time = grid[0]
        integrator.state[:] = start
        integrator.pars[:] = values
        outcome, *_, states_at = integrator.propagate_grid(grid)
        if outcome != hy.taylor_outcome.time_limit:
            raise NotConverged(f"the Taylor integrator stopped: {outcome}", float(grid[-1] - integrator.time))
        return states_at

    return follow


def _runge_kutta(states: tuple, rates: tuple, parameters: tuple) -> Flow:
    from scipy.integrate import solve_ivp

    evaluate = compiler.function(
        "rates", [*states, *parameters], {f"d{x}": r for x, r in zip(states, rates, strict=True)}
    )

    def follow(start: ArrayLike, times: ArrayLike, values: ArrayLike = ()) -> NDArray[np.float64]:
        grid = np.asarray(times, dtype=float)
        constants = list(np.asarray(values, dtype=float))
        result = solve_ivp(
            lambda _, x: np.array(evaluate(*x, *constants)),
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
