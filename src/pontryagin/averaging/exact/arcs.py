"""Integration, arc by arc, of equations that contain modes: the signs of switching functions.

A mode is a parameter, 1 or -1, that is constant on an arc and changes where its function vanishes.
"""

import math
from collections.abc import Hashable, Sequence
from functools import lru_cache

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.exact.modes import Modes
from pontryagin.numerics.arcs import Arc, SwitchedFlow, follow, follow_on_grid
from pontryagin.numerics.flow import STEPS, Flow, Integrator, integrator
from pontryagin.numerics.lanes import Ends, stacked
from pontryagin.numerics.symbolic import Symbolic

Signs = tuple[float, ...]


def switched_ends(
    modes: Modes,
    states: Sequence[sp.Symbol],
    rates: Sequence[sp.Expr],
    parameters: Sequence[sp.Symbol] = (),
    clock: Hashable = None,
    wrt: Sequence[sp.Symbol] = (),
) -> Ends:
    """`pontryagin.numerics.lanes.ends` for rates that contain modes.

    Parameters
    ----------
    modes : tuple of (sympy.Symbol, sympy.Expr)
        Modes and the functions whose signs they are, in states, parameters, clock and earlier modes.
    states, rates, parameters, clock, wrt
        As in `pontryagin.numerics.lanes.ends`.

    Examples
    --------
    A ball is drawn to the origin by a force of modulus 1. Released at rest at 1/2, it is back there after
    four arcs of unit duration.

    >>> x, v, m = sp.symbols("x v m")
    >>> fall = switched_ends(((m, x),), [x, v], [v, -m], wrt=[v])
    >>> states, slopes = fall([[0.5, 0.0]], 0.0, 4.0)
    >>> (states.round(12) + 0.0).tolist(), (slopes.round(12) + 0.0).tolist()
    ([[0.5, 0.0]], [[[0.0], [1.0]]])
    """
    along = _integrator(modes, tuple(states), tuple(rates), tuple(parameters), clock, tuple(wrt))
    identity = along.equations.identity

    def carry(
        starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike = ()
    ) -> tuple[Array, Array]:
        table = stacked(starts, begin, end, values, len(parameters))
        wholes = np.empty((len(table[0]), identity.size + len(identity)))
        for i, (start, first, last, constants) in enumerate(zip(*table, strict=True)):
            whole, signs = np.append(start, identity), signs_at(along, first, start, constants)
            _, wholes[i] = follow(_flow(along, constants), whole, signs, first, last)
        n = len(identity)
        return wholes[:, :n], wholes[:, n:].reshape(len(wholes), *identity.shape)

    return carry


def switched_flow(
    modes: Modes,
    states: Sequence[sp.Symbol],
    rates: Sequence[sp.Expr],
    parameters: Sequence[sp.Symbol] = (),
    clock: Hashable = None,
) -> Flow:
    """`pontryagin.numerics.flow.flow` for rates that contain modes."""
    along = _integrator(modes, tuple(states), tuple(rates), tuple(parameters), clock, ())

    def sample(
        start: ArrayLike, times: ArrayLike, values: ArrayLike = (), longest: float = math.inf
    ) -> Array:
        state, grid, constants = (np.asarray(value, dtype=float) for value in (start, times, values))
        signs = signs_at(along, float(grid[0]), state, constants)
        return follow_on_grid(_flow(along, constants, longest), state, signs, grid)

    return sample


@lru_cache(maxsize=32)
def _integrator(
    modes: Modes,
    states: tuple[sp.Symbol, ...],
    rates: tuple[sp.Expr, ...],
    parameters: tuple[sp.Symbol, ...],
    clock: Hashable,
    wrt: tuple[sp.Symbol, ...],
) -> Integrator:
    """An integrator with the modes as last parameters and an event where a mode must change its sign."""
    symbols = tuple(mode for mode, _ in modes)
    events = tuple(-mode * switching for mode, switching in modes)
    return integrator(Symbolic(states, rates, (*parameters, *symbols), clock, wrt, events))


def _flow(along: Integrator, constants: Array, longest: float = math.inf) -> SwitchedFlow[Signs]:
    return SwitchedFlow(
        arc=lambda signs: Arc(along, np.append(constants, signs), longest),
        following=lambda signs, i: (*signs[:i], -signs[i], *signs[i + 1 :]),
        jumps=True,
        most=STEPS,
    )


def signs_at(along: Integrator, time: float, state: Array, constants: Array) -> Signs:
    """Values of the modes just after a point; where a function vanishes there, the sign of its slope."""
    equations = along.equations
    signs = np.ones(equations.events)
    for i in range(len(signs)):
        values = np.append(constants, signs)
        sign = -np.sign(equations.event(i, time, state, values))
        if sign == 0:
            by_state, by_time = equations.event_gradient(i, time, state, values)
            sign = -np.sign(by_state @ equations.rates(time, state, values) + by_time) or 1.0
        signs[i] = sign
    return tuple(signs)
