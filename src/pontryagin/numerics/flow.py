"""Flows of differential equations by heyoka's Taylor integrator, or by SciPy's DOP853 without heyoka.

This module integrates one trajectory at a time; `pontryagin.numerics.lanes` integrates many. `integrator`
follows any `pontryagin.numerics.equations.Equations` up to an event, `flow` samples the trajectories of SymPy
equations. Without heyoka the same right-hand sides are integrated tens of times slower.
"""

import functools
import math
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.equations import Equations, Values
from pontryagin.numerics.packages import installed
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.trajectory import compiled

Flow = Callable[..., Array]

TOLERANCE = 1e-14
ROUGH = 1e-10
"""Tolerance of trajectories that only give a guess, which is polished later with `TOLERANCE`."""
STEPS = 100_000
"""Largest number of steps of one call, unless another limit is given."""


@functools.cache
def has_heyoka() -> bool:
    """Whether heyoka can be imported; if not, warn once per process."""
    if not installed("heyoka", "trajectories are integrated by SciPy's DOP853, which is slower"):
        return False
    import heyoka

    heyoka.set_logger_level_error()  # trial steps into a singularity are rejected and need no log message
    return True


def flow(
    states: Sequence[Any],
    rates: Sequence[Any],
    parameters: Sequence[Any] = (),
    taylor: bool | None = None,
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
    taylor : bool, optional
        Whether to use heyoka; by default wherever it is installed.
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
    follow = integrator(Symbolic(tuple(states), tuple(rates), tuple(parameters), clock), taylor)

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


class Integrator(ABC):
    """Follows one system of equations, one trajectory at a time.

    ``whole`` holds the n states followed by the n m derivatives, row by row. ``longest`` bounds the steps.
    ``resume`` states that the arc begins where an event ended the last arc of the same integrator; that
    event then does not end the new arc at once. Both methods raise `pontryagin.NotConverged` where the
    integrator stops short.

    Attributes
    ----------
    equations : Equations
        The equations that are integrated.
    """

    def __init__(self, equations: Equations, tolerance: float, steps_per_unit: float) -> None:
        self.equations, self._tolerance, self._per_unit = equations, tolerance, steps_per_unit

    def _most(self, span: float) -> int:
        """Largest number of steps of an arc."""
        return STEPS if self._per_unit == math.inf else int(self._per_unit * (1 + abs(span)))

    def run(
        self,
        whole: Array,
        begin: float,
        end: float,
        parameters: Values,
        longest: float = math.inf,
        resume: bool = False,
    ) -> Reached:
        """Integrate the states and derivatives up to ``end``, or to an event before it."""
        return self._follow(whole, begin, end, None, parameters, longest, resume)[1]

    def sample(
        self,
        whole: Array,
        times: Array,
        parameters: Values,
        longest: float = math.inf,
        resume: bool = False,
    ) -> tuple[Array, Reached]:
        """The states, (k, n), at ascending times, beginning at the first; none after an event."""
        return self._follow(whole, times[0], times[-1], times, parameters, longest, resume)

    @abstractmethod
    def _follow(
        self,
        whole: Array,
        begin: float,
        end: float,
        times: Array | None,
        parameters: Values,
        longest: float,
        resume: bool,
    ) -> tuple[Array, Reached]:
        """The states at the times (without times of no use), and where the arc ended."""


@functools.lru_cache(maxsize=64)
def integrator(
    equations: Equations,
    taylor: bool | None = None,
    tolerance: float = TOLERANCE,
    steps_per_unit: float = math.inf,
) -> Integrator:
    """The integrator of some equations, compiled once in each thread that uses it.

    Parameters
    ----------
    equations : Equations
        The equations to be integrated; hashable.
    taylor : bool, optional
        Whether to use heyoka; by default wherever it is installed.
    tolerance : float
        Relative error allowed in a step.
    steps_per_unit : float
        heyoka is stopped where an arc of duration d takes more than (1 + d) times as many steps as this,
        since it then runs into a singularity.
    """
    if taylor:
        return _Taylor(equations, tolerance, steps_per_unit)
    return _RungeKutta(equations, tolerance, steps_per_unit)


def compiled_taylor(equations: Equations, tolerance: float, lanes: int = 0, backwards: bool = False) -> Any:
    """heyoka's integrator of some equations, with derivatives and events; scalar if ``lanes`` is 0."""
    import heyoka as hy

    pairs, wrt, functions = equations.in_heyoka()
    event = hy.t_event_batch if lanes else hy.t_event
    growing = hy.event_direction.negative if backwards else hy.event_direction.positive
    return (hy.taylor_adaptive_batch if lanes else hy.taylor_adaptive)(
        hy.var_ode_sys(pairs, wrt, order=1) if wrt else pairs,
        np.zeros((len(pairs), lanes) if lanes else len(pairs)),
        tol=tolerance,
        compact_mode=equations.large,
        t_events=[event(function, direction=growing) for function in functions],
    )


def event_of(outcome: Any) -> int | None:
    """The index of the event that stopped heyoka, if one did."""
    index = -int(outcome) - 1
    return index if 0 <= index < 2**31 else None


class _Taylor(Integrator):
    def __init__(self, equations: Equations, tolerance: float, steps_per_unit: float) -> None:
        super().__init__(equations, tolerance, steps_per_unit)
        self._own = threading.local()  # heyoka's object holds the trajectory that is being followed

    def _compiled(self, backwards: bool) -> Any:
        compiled, sense = self._own.__dict__, "backwards" if backwards else "forwards"
        if sense not in compiled:
            compiled[sense] = compiled_taylor(self.equations, self._tolerance, backwards=backwards)
        return compiled[sense]

    def _follow(
        self,
        whole: Array,
        begin: float,
        end: float,
        times: Array | None,
        parameters: Values,
        longest: float,
        resume: bool,
    ) -> tuple[Array, Reached]:
        import heyoka as hy

        taylor = self._compiled(end < begin and self.equations.events > 0)
        if self.equations.events and not resume:
            taylor.reset_cooldowns()
        taylor.time = begin
        taylor.state[:] = whole
        taylor.pars[:] = parameters[: len(taylor.pars)]
        steps = self._most(end - begin)
        if times is None:
            outcome, states = taylor.propagate_until(end, max_delta_t=longest, max_steps=steps)[0], whole
        else:
            outcome, *_, found = taylor.propagate_grid(times, max_delta_t=longest, max_steps=steps)
            states = found[:, : len(self.equations.identity)]
            states = states[np.isfinite(states).all(axis=1)]
        event = event_of(outcome)
        if event is None and outcome != hy.taylor_outcome.time_limit:
            message = f"the Taylor integrator stopped before the end: {outcome}"
            raise NotConverged(message, float(end - taylor.time))
        return states, Reached(float(taylor.time), taylor.state.copy(), event)


class _RungeKutta(Integrator):
    def _follow(
        self,
        whole: Array,
        begin: float,
        end: float,
        times: Array | None,
        parameters: Values,
        longest: float,
        resume: bool,
    ) -> tuple[Array, Reached]:
        most = self._most(end - begin)
        given = np.asarray(parameters, dtype=float)
        n = len(self.equations.identity)
        grid = np.empty(0) if times is None else times
        start = whole if times is None else whole[:n]
        found = compiled(self.equations).follow(
            start, begin, end, given, self._tolerance, longest, most, grid
        )
        if found.code > 1:
            message = "the Runge-Kutta integrator stopped before the end"
            raise NotConverged(message, float(end - found.time))
        return found.rows, Reached(found.time, found.whole, found.event if found.event >= 0 else None)
