"""Many trajectories of one system at once, in the vector mode of heyoka's Taylor integrator.

Each trajectory has its own start. As many are integrated side by side as the processor has lanes. An event in
one lane stops all lanes; the parameters of its lane are changed, and all continue. A lane whose trajectory
has ended takes the next one.
"""

import functools
import math
import threading
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.equations import Equations
from pontryagin.numerics.flow import STEPS, TOLERANCE, compiled_taylor, event_of, has_heyoka
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.trajectory import compiled

Ends = Callable[..., tuple[Array, Array]]


@dataclass(frozen=True)
class LaneEnds:
    """The ends of k trajectories of n states with m derivatives.

    Attributes
    ----------
    states : (k, n) array
        States at the ends; nan where the end was not reached.
    slopes : (k, n, m) array
        Derivatives of the states in the initial values; nan where the end was not reached.
    left : (k,) array
        Remaining time where the integrator stopped; 0 at the end, inf where numbers overflowed.
    switches : (k,) array of int
        Number of events on the way.
    """

    states: Array
    slopes: Array
    left: Array
    switches: NDArray[np.int64]


class Lanes:
    """The vector integrator of some equations, compiled once in each thread that uses it."""

    def __init__(self, equations: Equations, tolerance: float = TOLERANCE) -> None:
        self.equations, self._tolerance = equations, tolerance
        self._own = threading.local()  # heyoka's object holds the trajectories that are being followed

    def taylor(self) -> Any:
        """heyoka's integrator for the current thread."""
        import heyoka as hy

        try:
            return self._own.integrator
        except AttributeError:
            lanes = hy.recommended_simd_size()
            self._own.integrator = compiled_taylor(self.equations, self._tolerance, lanes)
            return self._own.integrator

    def carry(
        self,
        starts: Array,
        begin: Array,
        end: Array,
        parameters: Array,
        steps: Array,
        switched: Callable[[int, Array], Array] | None = None,
        most_switches: int = 0,
    ) -> LaneEnds:
        """Integrate trajectories to their ends.

        Parameters
        ----------
        starts : (k, n) array
            Initial states.
        begin, end : (k,) arrays
            Times; an end may lie before its beginning.
        parameters : (k, p) array
            Parameters of each trajectory.
        steps : (k,) array
            Largest number of steps of each trajectory.
        switched : function (event, parameters (p,)) -> parameters (p,), optional
            Parameters after an event; states and derivatives continue without a jump.
        most_switches : int
            A trajectory with more events is given up.
        """
        import heyoka as hy

        taylor = self.taylor()
        (count, n), m = starts.shape, self.equations.identity.shape[1]
        lanes, held = taylor.state.shape[-1], len(taylor.pars)
        identity = self.equations.identity.reshape(-1, 1)
        found = LaneEnds(
            np.full((count, n), np.nan),
            np.full((count, n, m), np.nan),
            np.array(np.abs(end - begin)),
            np.zeros(count, dtype=np.int64),
        )
        order = np.argsort(-found.left, kind="stable")  # the longest ones first
        doing = np.full(lanes, -1)  # which trajectory each lane follows, -1 for none
        used, now, ends = np.zeros(lanes), np.zeros(lanes), np.zeros(lanes)
        state, time_limit = taylor.state, hy.taylor_outcome.time_limit
        going_on = (hy.taylor_outcome.success, hy.taylor_outcome.step_limit)

        def take_up(free: NDArray[np.int64]) -> None:
            """Give the next trajectories to free lanes; with none left, lanes idle at the first start."""
            nonlocal order
            chosen, order = order[: len(free)], order[len(free) :]
            source = np.zeros(len(free), dtype=np.int64)
            source[: len(chosen)] = chosen
            state[:n, free], state[n:, free] = starts[source].T, identity
            taylor.pars[:, free] = parameters[source, :held].T
            used[free], now[free], ends[free] = 0, begin[source], end[source]
            idle = free[len(chosen) :]
            doing[free], doing[idle], ends[idle] = source, -1, now[idle]
            for lane in free if self.equations.events else ():
                taylor.reset_cooldowns(lane)

        free = np.arange(lanes)
        while len(order) or len(free) < lanes:
            if len(free):
                take_up(free)
            busy = np.flatnonzero(doing >= 0)
            taylor.set_time(now)
            allowed = (steps[doing[busy]] - used[busy]).min()
            taylor.propagate_until(ends, max_steps=max(1, int(allowed)))
            now, results = taylor.time.copy(), taylor.propagate_res
            arrived = np.array([result[0] == time_limit for result in results]) & (doing >= 0)
            _store(found, doing[arrived], state[:, arrived])
            doing[arrived] = -1
            for lane in np.flatnonzero(doing >= 0).tolist():
                outcome, *_, taken = results[lane]
                i, event = doing[lane], event_of(outcome)
                used[lane] += taken
                if event is not None and switched is not None and found.switches[i] < most_switches:
                    found.switches[i] += 1
                    taylor.pars[:, lane] = switched(event, taylor.pars[:, lane].copy())[:held]
                    taylor.reset_cooldowns(lane)
                elif used[lane] >= steps[i] or outcome not in going_on:
                    found.left[i], doing[lane] = abs(ends[lane] - now[lane]), -1
            free = np.flatnonzero(doing < 0)
        return found


def _store(found: LaneEnds, which: NDArray[np.int64], wholes: Array) -> None:
    """Store those ends, columns of ``wholes``, that are finite."""
    n, finite = found.states.shape[1], np.isfinite(wholes).all(axis=0)
    kept = which[finite]
    found.left[which] = np.where(finite, 0.0, math.inf)
    found.states[kept] = wholes[:n, finite].T
    found.slopes[kept] = wholes[n:, finite].T.reshape(len(kept), *found.slopes.shape[1:])


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
    states, rates, parameters, taylor, clock
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
    use_taylor = has_heyoka() if taylor is None else taylor
    run = _side_by_side(equations, tolerance) if use_taylor else _one_by_one(equations, tolerance)

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
def _side_by_side(equations: Symbolic, tolerance: float) -> Run:
    """Integration by heyoka in groups of as many trajectories as lanes; a group is finished as a whole."""
    own, n, m = Lanes(equations, tolerance), *equations.identity.shape

    def run(start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        import heyoka as hy

        taylor = own.taylor()
        count, (lanes, held) = len(start), (taylor.state.shape[1], len(taylor.pars))
        states, slopes = np.empty((count, n)), np.empty((count, n, m))
        for i in range(0, count, lanes):
            chosen = np.minimum(np.arange(i, i + lanes), count - 1)
            taylor.set_time(begin[chosen])
            taylor.state[:n], taylor.state[n:] = start[chosen].T, equations.identity.reshape(-1, 1)
            taylor.pars[:] = values[chosen, :held].T
            taylor.propagate_until(end[chosen], max_steps=STEPS)
            if any(outcome != hy.taylor_outcome.time_limit for outcome, *_ in taylor.propagate_res):
                left = float(np.abs(end[chosen] - taylor.time).max())
                raise NotConverged("the Taylor integrator stopped before the end", left)
            part, filled = slice(i, i + lanes), min(lanes, count - i)
            states[part] = taylor.state[:n, :filled].T
            slopes[part] = taylor.state[n:, :filled].reshape(n, m, filled).transpose(2, 0, 1)
        return states, slopes

    return run


@functools.lru_cache(maxsize=64)
def _one_by_one(equations: Symbolic, tolerance: float) -> Run:
    """Integration of one trajectory after the other."""
    (n, m), native = equations.identity.shape, compiled(equations)

    def run(start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        count = len(start)
        states, slopes = np.empty((count, n)), np.empty((count, n, m))
        for i in range(count):
            whole = np.append(start[i], equations.identity)
            found = native.follow(
                whole, begin[i], end[i], values[i], tolerance, math.inf, STEPS, np.empty(0)
            )
            if found.code:
                left = float(abs(end[i] - found.time))
                raise NotConverged("the Runge-Kutta integrator stopped before the end", left)
            states[i], slopes[i] = found.whole[:n], found.whole[n:].reshape(n, m)
        return states, slopes

    return run
