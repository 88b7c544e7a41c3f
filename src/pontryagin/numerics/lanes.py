"""The ends of many trajectories of one system, each with its own start.

Native code integrates one after the other. Where heyoka is installed, its vector mode integrates several of a
small system side by side: it is up to 25 times faster on long oscillations, which its Taylor series follow in
few steps. Large systems are left to native code, which is up to 3 times faster there.
"""

import functools
import math
from collections.abc import Callable, Hashable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.flow import NO_TIMES, STEPS, TOLERANCE
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.trajectory import compiled
from pontryagin.numerics.vector_mode import VectorMode, has_heyoka, large

Ends = Callable[..., tuple[Array, Array]]


def ends(
    states: Sequence[Any],
    rates: Sequence[Any],
    parameters: Sequence[Any] = (),
    clock: Hashable = None,
    wrt: Sequence[Any] = (),
    taylor: bool | None = None,
    tolerance: float = TOLERANCE,
) -> Ends:
    """Compile x' = rates(x, p) into a function that integrates many trajectories to their ends.

    Parameters
    ----------
    states, rates, parameters, clock
        As for `pontryagin.numerics.flow.flow`.
    wrt : sequence of sympy.Symbol
        States in whose initial values the ends are differentiated, by the variational equations.
    taylor : bool, optional
        Whether to use heyoka's vector mode; by default for small systems where it is installed.
    tolerance : float
        Relative error allowed in a step; a larger one is faster where only derivatives are needed.

    Returns
    -------
    function (starts, begin, end, parameters=()) -> (k, n) array, (k, n, m) array
        The states at ``end`` (k,) of the trajectories from ``starts`` (k, n) at ``begin`` (k,), and their
        derivatives in the m initial values ``wrt``. ``parameters`` is (p,) or (k, p). The function raises
        `pontryagin.NotConverged` where an integrator stops short. The same equations are compiled once.

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
    vectors = has_heyoka() and not large(rates) if taylor is None else taylor
    run = _run(equations, tolerance, vectors)

    def carry(
        starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike = ()
    ) -> tuple[Array, Array]:
        return run(*stacked(starts, begin, end, values, len(equations.parameters)))

    return carry


def stacked(
    starts: ArrayLike, begin: ArrayLike, end: ArrayLike, values: ArrayLike, parameters: int
) -> tuple[Array, Array, Array, Array]:
    """Starts (k, n), beginnings (k,), ends (k,) and parameters (k, p) of k trajectories."""
    start = np.asarray(starts, dtype=float)
    count = len(start)
    first, last = (np.broadcast_to(np.asarray(t, dtype=float), (count,)) for t in (begin, end))
    return start, first, last, np.broadcast_to(np.asarray(values, dtype=float), (count, parameters))


Run = Callable[[Array, Array, Array, Array], tuple[Array, Array]]


@functools.lru_cache(maxsize=64)
def _run(equations: Symbolic, tolerance: float, taylor: bool) -> Run:
    """The integration of many trajectories, side by side or one after the other."""
    if taylor:
        return VectorMode(equations, tolerance)
    (n, m), native = equations.identity.shape, compiled(equations)

    def run(start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        count = len(start)
        states, slopes = np.empty((count, n)), np.empty((count, n, m))
        for i in range(count):
            whole = np.append(start[i], equations.identity)
            found = native.follow(whole, begin[i], end[i], values[i], tolerance, math.inf, STEPS, NO_TIMES)
            if found.code:
                raise NotConverged("the integrator stopped before the end", float(abs(end[i] - found.time)))
            states[i], slopes[i] = found.whole[:n], found.whole[n:].reshape(n, m)
        return states, slopes

    return run
