"""heyoka's Taylor integrators, a peer: SymPy equations in its expressions, one trajectory, vector mode."""

import functools
import importlib.util
from collections.abc import Hashable, Sequence
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.flow import STEPS
from pontryagin.numerics.symbolic import Symbolic

SMALL = 200
"""A right-hand side with more operations than this is large.

heyoka compiles it as loops, since unrolled code, faster to run, would be slow to compile.
"""


@functools.cache
def has_heyoka() -> bool:
    """Whether heyoka can be imported."""
    if importlib.util.find_spec("heyoka") is None:
        return False
    import heyoka

    heyoka.set_logger_level_error()  # trial steps into a singularity are rejected and need no log message
    return True


class Single:
    """heyoka's integrator of one trajectory of some equations, compiled once, in one kind of numbers."""

    def __init__(self, equations: Symbolic, tolerance: float, kind: type = float) -> None:
        import heyoka as hy

        self.equations, self.kind = equations, kind
        system, compact = with_derivatives(equations)
        start = np.zeros(len(equations.states), kind)
        self._taylor = hy.taylor_adaptive(
            system, start, tol=kind(tolerance), fp_type=kind, compact_mode=compact
        )

    def __call__(self, start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        """The ends and the derivatives of trajectories, one after the other."""
        import heyoka as hy

        taylor, identity = self._taylor, self.equations.identity
        (n, m), count = identity.shape, len(start)
        found = np.empty((count, n * (1 + m)))
        for i in range(count):
            taylor.time = self.kind(begin[i])
            taylor.state[:n], taylor.state[n:] = start[i], identity.ravel()
            taylor.pars[:] = values[i, : len(taylor.pars)]
            outcome, *_ = taylor.propagate_until(self.kind(end[i]), max_steps=STEPS)
            if outcome != hy.taylor_outcome.time_limit:
                left = float(abs(end[i] - taylor.time))
                raise NotConverged("the Taylor integrator stopped before the end", left)
            found[i] = taylor.state
        return found[:, :n], found[:, n:].reshape(count, n, m)


class VectorMode:
    """heyoka's integrator of several trajectories of some equations, compiled once.

    A group of trajectories is finished as a whole before the next one begins.
    """

    def __init__(self, equations: Symbolic, tolerance: float) -> None:
        import heyoka as hy

        self.equations = equations
        system, compact = with_derivatives(equations)
        start = np.zeros((len(equations.states), hy.recommended_simd_size()))
        self._taylor = hy.taylor_adaptive_batch(system, start, tol=tolerance, compact_mode=compact)

    def __call__(self, start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        """The ends and the derivatives of trajectories; see `pontryagin.numerics.lanes.ends`."""
        import heyoka as hy

        taylor, identity = self._taylor, self.equations.identity
        (n, m), count = identity.shape, len(start)
        lanes, held = taylor.state.shape[1], len(taylor.pars)
        states, slopes = np.empty((count, n)), np.empty((count, n, m))
        for i in range(0, count, lanes):
            chosen = np.minimum(np.arange(i, i + lanes), count - 1)
            taylor.set_time(begin[chosen])
            taylor.state[:n], taylor.state[n:] = start[chosen].T, identity.reshape(-1, 1)
            taylor.pars[:] = values[chosen, :held].T
            taylor.propagate_until(end[chosen], max_steps=STEPS)
            if any(outcome != hy.taylor_outcome.time_limit for outcome, *_ in taylor.propagate_res):
                left = float(np.abs(end[chosen] - taylor.time).max())
                raise NotConverged("the Taylor integrator stopped before the end", left)
            part, filled = slice(i, i + lanes), min(lanes, count - i)
            states[part] = taylor.state[:n, :filled].T
            slopes[part] = taylor.state[n:, :filled].reshape(n, m, filled).transpose(2, 0, 1)
        return states, slopes


def with_derivatives(equations: Symbolic) -> tuple[Any, bool]:
    """The system with its variational equations, if any, and whether its code is to be compact."""
    import heyoka as hy

    e = equations
    system, table = heyoka_system(e.states, e.expressions, e.parameters, e.clock)
    wrt = [table[symbol] for symbol in e.wrt]
    return (hy.var_ode_sys(system, wrt, order=1), True) if wrt else (system, large(e.expressions))


def heyoka_system(
    states: Sequence[Any], rates: Sequence[Any], parameters: Sequence[Any], clock: Hashable
) -> tuple[list[tuple[Any, Any]], dict[Any, Any]]:
    """SymPy equations in heyoka's expressions, with shared parts built once, and the table of symbols."""
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


def with_floats(expression: Any) -> Any:
    """The expression with floats for fractions that heyoka cannot take: denominators not a power of two."""
    import sympy as sp

    taken = sp.sympify(expression)
    fractions = [r for r in taken.atoms(sp.Rational) if r.q & (r.q - 1)]
    return taken.xreplace({r: sp.Float(float(r)) for r in fractions})


def large(rates: Sequence[Any]) -> bool:
    """Whether SymPy rates hold more than `SMALL` operations."""
    import sympy as sp

    return bool(sp.count_ops(list(rates)) > SMALL)
