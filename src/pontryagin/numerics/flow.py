"""Flows of differential equations by a Runge-Kutta method of order 8 in native code.

This module integrates one trajectory at a time; `pontryagin.numerics.lanes` integrates many. `integrator`
follows any `pontryagin.numerics.equations.Equations` up to an event, `flow` samples the trajectories of SymPy
equations. The code is ready in a millisecond once the machine has made it.
"""

import functools
import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.arc_loop import EVENT
from pontryagin.numerics.equations import Equations, Values
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.trajectory import compiled

Flow = Callable[..., Array]

TOLERANCE = 1e-14
ROUGH = 1e-10
"""Tolerance of trajectories that only give a guess, which is polished later with `TOLERANCE`."""
STEPS = 100_000
"""Largest number of steps of one call, unless another limit is given."""
NO_TIMES = np.empty(0)


def flow(
    states: Sequence[Any],
    rates: Sequence[Any],
    parameters: Sequence[Any] = (),
    clock: Hashable = None,
) -> Flow:
    """Compile x' = rates(x, p) into a function that integrates it.

    Parameters
    ----------
    states : sequence of sympy.Symbol
        The state x.
    rates : sequence of sympy.Expr
        Its derivative, one expression for each state.
    parameters : sequence of sympy.Symbol
        The constants p.
    clock : sympy.Symbol, optional
        The independent variable, if the rates hold it.

    Returns
    -------
    function (start, times, parameters=()) -> (k, n) array
        The states at the times (k,), ascending, from ``start`` (n,) at the first of them. The function
        raises `pontryagin.NotConverged` where the integrator stops short.

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
    follow = integrator(Symbolic(tuple(states), tuple(rates), tuple(parameters), clock))

    def sample(start: ArrayLike, times: ArrayLike, values: ArrayLike = ()) -> Array:
        grid = np.asarray(times, dtype=float)
        return follow.sample(np.asarray(start, dtype=float), grid, np.asarray(values, dtype=float))[0]

    return sample


class Reached(NamedTuple):
    """Where an arc ended.

    Attributes
    ----------
    time : float
        Time at the end of the arc.
    whole : array
        The n states there, followed by the rows of their derivatives if these were integrated.
    event : int or None
        Index of the event that ended the arc; None if it reached its end time.
    """

    time: float
    whole: Array
    event: int | None


@dataclass(frozen=True)
class Integrator:
    """Follows one system of equations, one trajectory at a time.

    ``whole`` holds the n states followed by the n m derivatives, row by row, or the states alone. ``longest``
    bounds the steps. Both methods raise `pontryagin.NotConverged` where the integrator stops short.

    Attributes
    ----------
    equations : Equations
        The equations that are integrated.
    tolerance : float
        Relative error allowed in a step.
    steps_per_unit : float
        Steps allowed per unit of time.
    """

    equations: Equations
    tolerance: float
    steps_per_unit: float

    def run(
        self, whole: Array, begin: float, end: float, parameters: Values, longest: float = math.inf
    ) -> Reached:
        """Integrate the states and derivatives up to ``end``, or to an event before it."""
        return self._follow(whole, begin, end, NO_TIMES, parameters, longest)[1]

    def sample(
        self, whole: Array, times: Array, parameters: Values, longest: float = math.inf
    ) -> tuple[Array, Reached]:
        """The states, (k, n), at ascending times, beginning at the first; none after an event."""
        return self._follow(whole, times[0], times[-1], times, parameters, longest)

    def _follow(
        self, whole: Array, begin: float, end: float, times: Array, parameters: Values, longest: float
    ) -> tuple[Array, Reached]:
        """The states at the times, and where the arc ended."""
        most = STEPS
        if self.steps_per_unit < math.inf:
            most = int(self.steps_per_unit * (1 + abs(end - begin)))
        given = np.asarray(parameters, dtype=float)
        found = compiled(self.equations).follow(
            whole, begin, end, given, self.tolerance, longest, most, times
        )
        if found.code > EVENT:
            raise NotConverged("the integrator stopped before the end", float(end - found.time))
        return found.rows, Reached(found.time, found.whole, found.event if found.event >= 0 else None)


@functools.lru_cache(maxsize=64)
def integrator(
    equations: Equations, tolerance: float = TOLERANCE, steps_per_unit: float = math.inf
) -> Integrator:
    """The integrator of some equations.

    Parameters
    ----------
    equations : Equations
        The equations to be integrated; hashable.
    tolerance : float
        Relative error allowed in a step.
    steps_per_unit : float
        The integrator is stopped where an arc of duration d takes more than (1 + d) times as many steps as
        this, since it then runs into a singularity.
    """
    return Integrator(equations, tolerance, steps_per_unit)
