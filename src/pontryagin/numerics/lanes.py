"""The ends of many trajectories of one system, each with its own start, several of them side by side.

`lane_loop` follows as many as the processor's vectors hold numbers, each with its own steps, and
`lane_assembly` compiles the equations for it.
"""

import ctypes
import functools
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics import lane_assembly, lane_loop
from pontryagin.numerics.equations import Equations
from pontryagin.numerics.flow import STEPS, TOLERANCE, integrator
from pontryagin.numerics.lane_loop import HELD, LANES
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.tape import Tape
from pontryagin.numerics.trajectory import Loop, native_loop, native_text

FEW = 2
"""So many trajectories are followed one after the other, which is faster."""

Ends = Callable[..., tuple[Array, Array]]


def ends(
    states: Sequence[Any],
    rates: Sequence[Any],
    parameters: Sequence[Any] = (),
    clock: Hashable = None,
    wrt: Sequence[Any] = (),
    tolerance: float = TOLERANCE,
) -> Ends:
    """Compile x' = rates(x, p) into a function that integrates many trajectories to their ends.

    Parameters
    ----------
    states, rates, parameters, clock
        As for `pontryagin.numerics.flow.flow`.
    wrt : sequence of sympy.Symbol
        States in whose initial values the ends are differentiated, by the variational equations.
    tolerance : float
        Relative error allowed in a step; a larger one is faster where only derivatives are needed.

    Returns
    -------
    function (starts, begin, end, parameters=()) -> (k, n) array, (k, n, m) array
        The states at ``end`` (k,) of the trajectories from ``starts`` (k, n) at ``begin`` (k,), and their
        derivatives in the m initial values ``wrt``. ``parameters`` is (p,) or (k, p). The function raises
        `pontryagin.NotConverged` where a trajectory cannot be followed. The same equations are compiled once.

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
    equations = Symbolic(tuple(states), tuple(rates), tuple(parameters), clock, tuple(wrt))

    def carry(
        starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike = ()
    ) -> tuple[Array, Array]:
        given = stacked(starts, begin, end, values, len(equations.parameters))
        return compiled_lanes(equations).run(*given, tolerance)

    return carry


def stacked(
    starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike, parameters: int
) -> tuple[Array, Array, Array, Array]:
    """Starts (k, n), beginnings (k,), ends (k,) and parameters (k, p) of k trajectories."""
    start = np.asarray(starts, dtype=float)
    count = len(start)
    first, last = (np.broadcast_to(np.asarray(t, dtype=float), (count,)) for t in (begin, end))
    return start, first, last, np.broadcast_to(np.asarray(values, dtype=float), (count, parameters))


@dataclass(frozen=True)
class CompiledLanes:
    """The native right-hand side of some equations for several trajectories side by side.

    Attributes
    ----------
    rates, step : int
        The addresses of the rates and of a step; see `lane_loop.follow_lanes`.
    equations : Equations
        The equations, of n states and m derivatives of each.
    code : object
        What keeps the code in memory.
    """

    rates: int
    step: int
    equations: Equations
    code: object

    def evaluate(self, t: Array, x: Array, p: Array, out: Array) -> None:
        """The rates of all lanes at t (LANES,), x (size, LANES) and p (p, LANES), written to ``out``."""
        pointers = (array.ctypes.data for array in (t, x, p, out))
        ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)(self.rates)(*pointers)

    def run(
        self, start: Array, begin: Array, end: Array, values: Array, tolerance: float
    ) -> tuple[Array, Array]:
        """The ends (k, n) and the derivatives (k, n, m) of k trajectories; see `ends`."""
        identity, count = self.equations.identity, len(start)
        n, size = len(identity), len(identity) + identity.size
        places = _places(size, max(values.shape[1], 1))
        room = np.zeros((places[-1], LANES))
        y, p, t, last, *_ = (room[a:b] for a, b in pairwise(places))
        at = [room.ctypes.data + 8 * LANES * place for place in places]
        found = np.empty((count, size))
        for i in range(0, count, LANES):
            if count - i <= FEW:
                found[i:] = self._one_by_one(start[i:], begin[i:], end[i:], values[i:], tolerance)
                break
            chosen = np.minimum(np.arange(i, i + LANES), count - 1)
            y[:n], y[n:] = start[chosen].T, identity.reshape(-1, 1)
            t[0], last[0], p[: values.shape[1]] = begin[chosen], end[chosen], values[chosen].T
            if _loop().follow(self.rates, self.step, size, *at[:4], tolerance, STEPS, *at[4:-1]):
                left = float(np.abs(last[0] - t[0]).max())
                raise NotConverged("the integrator stopped before the end", left)
            found[i : i + LANES] = y.T[: count - i]
        return found[:, :n], found[:, n:].reshape(count, *identity.shape)

    def _one_by_one(
        self, start: Array, begin: Array, end: Array, values: Array, tolerance: float
    ) -> list[Array]:
        """The ends and the derivatives of few trajectories."""
        along = integrator(self.equations, tolerance)
        identity = self.equations.identity
        return [
            along.run(np.append(start[i], identity), begin[i], end[i], values[i]).whole
            for i in range(len(start))
        ]


@functools.lru_cache(maxsize=256)
def _places(size: int, parameters: int) -> tuple[int, ...]:
    """Where the parts of the room for several trajectories begin, in vectors, and where the last one ends."""
    parts = (size, parameters, 1, 1, 2 * size, size, size, 1, 1, HELD, 1)
    return (0, *accumulate(parts))


@functools.lru_cache(maxsize=256)
def compiled_lanes(equations: Equations) -> CompiledLanes:
    """The native right-hand side of some equations, opened or made."""
    tape = Tape()
    n, m = equations.identity.shape
    states = [tape.record("state", i) for i in range(n)]
    rates, _ = equations.record(tape)
    slopes = [
        tape.derivatives(rates, {state: tape.record("column", i, j) for i, state in enumerate(states)})
        for j in range(m)
    ]
    results = [*rates, *(slopes[j][i] for i in range(n) for j in range(m))]
    text = lane_assembly.declarations() + lane_assembly.function("rates", tape, n, m, results)
    text += lane_assembly.step("step", "rates", n * (1 + m))
    opened = native_text(text, ["rates", "step"])
    rates_at, step_at = opened.addresses
    return CompiledLanes(rates_at, step_at, equations, opened)


ARGUMENTS = ("i64", "i64", "i64", *["ptr"] * 4, "double", "i64", *["ptr"] * 7)
"""The types of the arguments of `lane_loop.follow_lanes`."""


@functools.cache
def _loop() -> Loop:
    """`lane_loop.follow_lanes` in native code."""
    return native_loop(lane_loop.follow_lanes, ARGUMENTS, {"evaluate_lanes": _rates, "step_lanes": _step})


def _rates() -> Any:
    """`lane_loop.evaluate_lanes` for Numba: a call of the address that stands for the function."""
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic

    @intrinsic
    def evaluate_lanes(context: Any, function: Any, t: Any, x: Any, p: Any, out: Any, at: Any) -> Any:
        def emit(target_context: Any, builder: Any, _: Any, given: Any) -> Any:
            address, time, states, values, target, place = given
            kind = ir.FunctionType(ir.VoidType(), [ir.DoubleType().as_pointer()] * 4)
            called = builder.inttoptr(address, kind.as_pointer())
            builder.call(called, [time, states, values, builder.gep(target, [place])])
            return target_context.get_dummy_value()

        return types.void(function, t, x, p, out, at), emit

    return evaluate_lanes


def _step() -> Any:
    """`lane_loop.step_lanes` for Numba, likewise."""
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic

    @intrinsic
    def step_lanes(
        context: Any, step: Any, t: Any, h: Any, y: Any, p: Any, k: Any, new: Any, off: Any, tolerance: Any
    ) -> Any:
        def emit(target_context: Any, builder: Any, _: Any, given: Any) -> Any:
            real = ir.DoubleType()
            kind = ir.FunctionType(ir.VoidType(), [*[real.as_pointer()] * 7, real])
            builder.call(builder.inttoptr(given[0], kind.as_pointer()), given[1:])
            return target_context.get_dummy_value()

        return types.void(step, t, h, y, p, k, new, off, tolerance), emit

    return step_lanes
