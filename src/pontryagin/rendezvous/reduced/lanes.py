"""Many extremals at once, each from its own costates, in the vector mode of heyoka's Taylor integrator.

As many flights as the processor has lanes go side by side. A lane that meets the bound, or leaves it, stops
all of them; its mode is turned and they go on, so that flights with different switches share one integrator:
the mode is a parameter of its lane, m = 0 unsaturated, 1 saturated, and the rates are
(1 - m) unsaturated + m saturated. A lane whose flight has ended takes up the next one. Without heyoka the
flights go one by one through SciPy's DOP853. Units are those of `Scaled`.
"""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.flow import (
    TOLERANCE,
    has_heyoka,
)
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.arcs import (
    BOUND,
    COLUMNS,
    COSTATES,
    COUNT,
    HYSTERESIS,
    STATES,
    STEPS_PER_UNIT,
    identity,
    lifted,
    rates,
    saturation,
)
from pontryagin.rendezvous.reduced.flight import (
    SWITCHES,
    fly,
    switching,
)


@dataclass(frozen=True)
class Flights:
    """Where k extremals end, in the units of `Scaled`.

    Attributes
    ----------
    costates : (k, 6) array
        rho, s1, e, nu1, nu2, nu3 at t0.
    durations : (k,) array
        Of each.
    charts : (k,) array of int
        Of chi.
    reached : (k,) array of bool
        Whether the extremal could be followed to its end; where not, its other rows hold nan.
    ends : (k, 12) array
        As in `pontryagin.rendezvous.reduced.flight.Flight`.
    slopes : (k, 12, 7) array or None
        Derivatives of the ends in the costates and in p_max, if asked for.
    switches : (k,) array of int
        How often the thrust met its bound or left it.
    """

    costates: Array
    durations: Array
    charts: NDArray[np.int64]
    reached: NDArray[np.bool_]
    ends: Array
    slopes: Array | None
    switches: NDArray[np.int64]


def fly_all(
    scaled: Scaled,
    costates: Array,
    durations: ArrayLike,
    peak: float = np.inf,
    bang: bool = False,
    slopes: bool = True,
    taylor: bool | None = None,
) -> Flights:
    """Follow the extremals that start with the costates (k, 6) for the durations, (k,) or one."""
    count = len(costates)
    flights = Flights(
        np.array(costates),
        np.broadcast_to(np.asarray(durations, dtype=float), (count,)),
        np.where(costates[:, 5] >= 0, 1, -1),
        np.zeros(count, dtype=bool),
        np.full((count, COUNT), np.nan),
        np.full((count, COUNT, COLUMNS), np.nan) if slopes else None,
        np.zeros(count, dtype=int),
    )
    use_taylor = has_heyoka() if taylor is None else taylor
    if use_taylor:
        kind = "saturated" if bang else "unsaturated" if peak == np.inf else "both"
        _lanes(kind, slopes).carry(scaled, flights, peak)
    else:
        _one_by_one(scaled, flights, peak, bang)
    return flights


def _one_by_one(scaled: Scaled, flights: Flights, peak: float, bang: bool) -> None:
    for i, (costates, duration) in enumerate(zip(flights.costates, flights.durations, strict=True)):
        try:
            flight = fly(scaled, costates, float(duration), peak, bang, taylor=False)
        except NotConverged:
            continue
        flights.reached[i], flights.ends[i] = True, flight.end
        flights.switches[i] = len(flight.pieces) - 1
        if flights.slopes is not None:
            flights.slopes[i] = flight.slopes


ECCENTRICITY, CHART, MODE = 0, 1, 2
"""Places of the parameters of a lane."""


@functools.cache
def _lanes(kind: str, slopes: bool) -> "_Lanes":
    return _Lanes(kind, slopes)


class _Lanes:
    """One vector integrator: of one mode without a bound to meet, or of both."""

    def __init__(self, kind: str, slopes: bool) -> None:
        import heyoka as hy

        from pontryagin.rendezvous import kernels

        x = hy.make_vars(*STATES)
        mode = hy.par[MODE]
        of = {m: rates(lifted(getattr(kernels, m)), x, hy.par[0], hy.par[1]) for m in _modes(kind)}
        if kind == "both":
            pairs = zip(of["unsaturated"], of["saturated"], strict=True)
            system = [(1.0 - mode) * loose + mode * tight for loose, tight in pairs]
            leaving = (1.0 - 2.0 * mode) * saturation(lifted(kernels.switching_square), x) - HYSTERESIS
            events = [hy.t_event_batch(leaving, direction=hy.event_direction.positive)]
        else:
            system, events = of[kind], []
        system[BOUND] = hy.expression(0.0)
        equations = list(zip(x, system, strict=True))
        if slopes:
            equations = hy.var_ode_sys(equations, [*x[COSTATES], x[BOUND]], order=1)
        self._hy, self._kind, self._slopes = hy, kind, slopes
        self.width = hy.recommended_simd_size()
        self._integrator = hy.taylor_adaptive_batch(
            equations,
            np.ones((COUNT, self.width)),
            pars=np.zeros((3 if events else 2, self.width)),
            tol=TOLERANCE,
            compact_mode=True,
            t_events=events,
        )

    def carry(self, scaled: Scaled, flights: Flights, peak: float) -> None:
        """Fill in where the flights end."""
        hy, integrator = self._hy, self._integrator
        bound = peak if peak < np.inf else 1.0
        first = self._first(scaled, flights, bound)
        loud = np.sum(switching(first[:, :COUNT]) ** 2, axis=1) > (2 * bound) ** 2
        waiting = list(np.argsort(-flights.durations, kind="stable"))[::-1]
        doing: list[int | None] = [None] * self.width
        used, ends = np.zeros(self.width), np.zeros(self.width)
        time = np.zeros(self.width)
        integrator.pars[ECCENTRICITY] = scaled.eccentricity

        def take_up(lane: int) -> None:
            """The next flight, or a flight that has ended already."""
            doing[lane] = i = waiting.pop() if waiting else None
            chosen = 0 if i is None else i
            integrator.state[:, lane] = first[chosen]
            integrator.pars[CHART, lane] = flights.charts[chosen]
            time[lane], used[lane] = 0.0, 0
            ends[lane] = 0.0 if i is None else flights.durations[i]
            if self._kind == "both":
                integrator.pars[MODE, lane] = float(loud[chosen])
                integrator.reset_cooldowns(lane)

        if not len(flights.costates):
            return
        for lane in range(self.width):
            take_up(lane)
        while any(i is not None for i in doing):
            integrator.set_time(time)
            allowed = STEPS_PER_UNIT * (1 + ends)
            busy = np.array([i is not None for i in doing])
            integrator.propagate_until(ends, max_steps=max(1, int((allowed - used)[busy].min())))
            time[:] = integrator.time
            for lane, (outcome, *_, steps) in enumerate(integrator.propagate_res):
                i = doing[lane]
                if i is None:
                    continue
                used[lane] += steps
                if int(outcome) == -1 and flights.switches[i] < SWITCHES:
                    flights.switches[i] += 1
                    integrator.pars[MODE, lane] = 1 - integrator.pars[MODE, lane]
                    integrator.reset_cooldowns(lane)
                elif outcome == hy.taylor_outcome.time_limit:
                    self._store(flights, i, integrator.state[:, lane])
                    take_up(lane)
                elif used[lane] >= allowed[lane] or outcome not in (
                    hy.taylor_outcome.success,
                    hy.taylor_outcome.step_limit,
                ):
                    take_up(lane)

    def _first(self, scaled: Scaled, flights: Flights, bound: float) -> Array:
        count = len(flights.costates)
        begin = np.append(scaled.start, scaled.anomaly)
        states = np.hstack(
            [
                np.broadcast_to(begin, (count, 4)),
                flights.costates,
                np.broadcast_to([0.0, bound], (count, 2)),
            ]
        )
        if not self._slopes:
            return states
        return np.hstack([states, np.broadcast_to(identity().ravel(), (count, COUNT * COLUMNS))])

    def _store(self, flights: Flights, i: int, whole: Array) -> None:
        if not np.isfinite(whole).all():
            return
        flights.reached[i], flights.ends[i] = True, whole[:COUNT]
        if flights.slopes is not None:
            flights.slopes[i] = whole[COUNT:].reshape(COUNT, COLUMNS)


def _modes(kind: str) -> tuple[str, ...]:
    return ("unsaturated", "saturated") if kind == "both" else (kind,)
