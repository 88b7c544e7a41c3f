"""Many trajectories of one system, each from its own start, in the vector mode of heyoka's Taylor integrator.

As many trajectories as the processor has lanes go side by side. An event in one lane stops all of them; the
parameters of its lane change, and they go on. A lane whose trajectory has ended takes up the next one.
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
from pontryagin.numerics.equations import Equations, Symbolic
from pontryagin.numerics.flow import LEAST_DOP853, STEPS, TOLERANCE, compiled_taylor, event_of, has_heyoka

Ends = Callable[..., tuple[Array, Array]]


@dataclass(frozen=True)
class Carried:
    """Where k trajectories of n states with m derivatives end.

    Attributes
    ----------
    states : (k, n) array
        nan where the end was not reached.
    slopes : (k, n, m) array
        Derivatives in the initial values; nan there too.
    left : (k,) array
        Time that was left where the integrator stopped; 0 at the end, inf where numbers overflowed.
    switches : (k,) array of int
        Events on the way.
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

    def _taylor(self) -> Any:
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
    ) -> Carried:
        """Carry trajectories to their ends.

        Parameters
        ----------
        starts : (k, n) array
            Initial states.
        begin, end : (k,) arrays
            Times; an end may lie before its beginning.
        parameters : (k, p) array
            Of each.
        steps : (k,) array
            Most steps of each.
        switched : function (event, parameters (p,)) -> parameters (p,), optional
            What an event changes; states and derivatives go on without a jump.
        most_switches : int
            A trajectory with more events is given up.
        """
        import heyoka as hy

        taylor = self._taylor()
        (count, n), m = starts.shape, self.equations.identity.shape[1]
        lanes, held = taylor.state.shape[-1], len(taylor.pars)
        identity = self.equations.identity.ravel()
        found = Carried(
            np.full((count, n), np.nan),
            np.full((count, n, m), np.nan),
            np.array(np.abs(end - begin)),
            np.zeros(count, dtype=np.int64),
        )
        waiting = list(np.argsort(-np.abs(end - begin), kind="stable"))[::-1]  # the longest ones first
        doing: list[int | None] = [None] * lanes
        used, now, ends = np.zeros(lanes), np.zeros(lanes), np.zeros(lanes)

        def take_up(lane: int) -> None:
            """The next trajectory; with none left, one that has ended already."""
            doing[lane] = i = waiting.pop() if waiting else None
            chosen = 0 if i is None else i
            taylor.state[:n, lane], taylor.state[n:, lane] = starts[chosen], identity
            taylor.pars[:, lane] = parameters[chosen, :held]
            used[lane], now[lane] = 0, begin[chosen]
            ends[lane] = begin[chosen] if i is None else end[chosen]
            if self.equations.events:
                taylor.reset_cooldowns(lane)

        for lane in range(lanes if count else 0):
            take_up(lane)
        while any(i is not None for i in doing):
            taylor.set_time(now)
            allowed = min(steps[i] - used[lane] for lane, i in enumerate(doing) if i is not None)
            taylor.propagate_until(ends, max_steps=max(1, int(allowed)))
            now[:] = taylor.time
            for lane, (outcome, *_, taken) in enumerate(taylor.propagate_res):
                i = doing[lane]
                if i is None:
                    continue
                used[lane] += taken
                event = event_of(outcome)
                if event is not None and switched is not None and found.switches[i] < most_switches:
                    found.switches[i] += 1
                    taylor.pars[:, lane] = switched(event, taylor.pars[:, lane].copy())[:held]
                    taylor.reset_cooldowns(lane)
                    continue
                if outcome == hy.taylor_outcome.time_limit:
                    _store(found, i, taylor.state[:, lane])
                elif used[lane] < steps[i] and outcome in (
                    hy.taylor_outcome.success,
                    hy.taylor_outcome.step_limit,
                ):
                    continue
                else:
                    found.left[i] = abs(ends[lane] - now[lane])
                take_up(lane)
        return found


def _store(found: Carried, i: int, whole: Array) -> None:
    n = found.states.shape[1]
    if np.isfinite(whole).all():
        found.states[i], found.slopes[i], found.left[i] = whole[:n], whole[n:].reshape(n, -1), 0.0
    else:
        found.left[i] = math.inf


def ends(
    states: Sequence[Any],
    rates: Sequence[Any],
    parameters: Sequence[Any] = (),
    clock: Hashable = None,
    wrt: Sequence[Any] = (),
    taylor: bool | None = None,
    tolerance: float = TOLERANCE,
) -> Ends:
    """Compile x' = rates(x, p) into a function that carries many trajectories to their ends.

    Parameters
    ----------
    states, rates, parameters, taylor, clock
        As for `pontryagin.numerics.flow.flow`.
    wrt : sequence of sympy.Symbol
        States in whose initial values the ends are differentiated, by the variational equations.
    tolerance : float
        Relative error allowed in a step; a rougher one is faster where only derivatives are wanted.

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
    equations = Symbolic(tuple(states), tuple(rates), tuple(parameters), clock, tuple(wrt))
    use_taylor = has_heyoka() if taylor is None else taylor
    run = _side_by_side(equations, tolerance) if use_taylor else _as_one_system(equations, tolerance)

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
    lanes = Lanes(equations, tolerance)

    def run(start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        found = lanes.carry(start, begin, end, values, np.full(len(start), STEPS))
        if found.left.any():
            raise NotConverged("the Taylor integrator stopped short of the end", float(found.left.max()))
        return found.states, found.slopes

    return run


@functools.lru_cache(maxsize=64)
def _as_one_system(equations: Symbolic, tolerance: float) -> Run:
    """By DOP853: all trajectories as one system over the share of their times."""
    from scipy.integrate import solve_ivp

    rtol = max(tolerance, LEAST_DOP853)

    def run(start: Array, begin: Array, end: Array, values: Array) -> tuple[Array, Array]:
        (count, n), span, identity = start.shape, end - begin, equations.identity

        def rate(share: float, flat: Array) -> Array:
            whole = flat.reshape(count, n, -1)
            slopes = equations.variational(begin + share * span, whole[..., 0], whole[..., 1:], values)
            flown: Array = (slopes * span[:, None, None]).ravel()
            return flown

        first = np.concatenate(
            [start[..., None], np.broadcast_to(identity, (count, *identity.shape))], axis=-1
        )
        result = solve_ivp(rate, (0.0, 1.0), first.ravel(), method="DOP853", rtol=rtol, atol=rtol / 10)
        if not result.success or not np.isfinite(result.y[:, -1]).all():
            raise NotConverged(
                f"the Runge-Kutta integrator stopped: {result.message}", float(1.0 - result.t[-1])
            )
        last = result.y[:, -1].reshape(count, n, -1)
        return last[..., 0], last[..., 1:]

    return run
