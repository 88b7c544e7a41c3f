"""Many extremals of the reduced form at once, each from its own costates, by heyoka's vector mode.

Flights with different switches are integrated side by side: the mode is a parameter m of each lane, 0 for
unsaturated and 1 for saturated, and the rates are (1 - m) unsaturated + m saturated. Without heyoka SciPy's
DOP853 integrates the flights one by one. Units are those of `Scaled`.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.arcs import (
    CHART,
    COLUMNS,
    COUNT,
    ECCENTRICITY,
    SATURATED,
    STEPS_PER_UNIT,
    lanes,
)
from pontryagin.rendezvous.reduced.flight import (
    SWITCHES,
    fly,
    switching,
)


@dataclass(frozen=True)
class Flights:
    """The ends of k extremals, in the units of `Scaled`.

    Attributes
    ----------
    costates : (k, 6) array
        rho, s1, e, nu1, nu2, nu3 at t0.
    durations : (k,) array
        Duration of each flight.
    charts : (k,) array of int
        Chart of chi in each flight, +1 or -1.
    reached : (k,) array of bool
        Whether the extremal could be followed to its end; where not, its other rows hold nan.
    ends : (k, 12) array
        As in `pontryagin.rendezvous.reduced.flight.Flight`.
    slopes : (k, 12, 7) array or None
        Derivatives of the ends in the costates and in p_max; None if they were not integrated.
    switches : (k,) array of int
        Number of times that the thrust met its bound or left it.
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
    """Integrate the extremals with the initial costates (k, 6) over the durations, (k,) or one for all."""
    spans = np.broadcast_to(np.asarray(durations, dtype=float), (len(costates),))
    run = _side_by_side if taylor else _one_by_one
    return run(scaled, np.array(costates), spans, peak, bang, slopes)


def charts_of(costates: Array) -> NDArray[np.int64]:
    """The chart of chi of each flight, (k,)."""
    return np.where(costates[:, 5] >= 0, 1, -1)


def _side_by_side(
    scaled: Scaled, costates: Array, durations: Array, peak: float, bang: bool, slopes: bool
) -> Flights:
    kind: Literal["unsaturated", "saturated", "both"] = (
        "saturated" if bang else "unsaturated" if peak == np.inf else "both"
    )
    count, bound, charts = len(costates), peak if peak < np.inf else 1.0, charts_of(costates)
    starts = np.zeros((count, COUNT))
    starts[:, :4], starts[:, 4:10], starts[:, 11] = [*scaled.start, scaled.anomaly], costates, bound
    parameters = np.empty((count, 3))
    parameters[:, ECCENTRICITY], parameters[:, CHART] = scaled.eccentricity, charts
    parameters[:, SATURATED] = np.sum(switching(starts) ** 2, axis=1) > (2 * bound) ** 2

    def switched(_: int, values: Array) -> Array:
        values[SATURATED] = 1 - values[SATURATED]
        return values

    steps = STEPS_PER_UNIT * (1 + durations)
    found = lanes(kind, slopes).carry(
        starts, np.zeros(count), durations, parameters, steps, switched, SWITCHES
    )
    return Flights(
        costates,
        durations,
        charts,
        found.left == 0,
        found.states,
        found.slopes if slopes else None,
        found.switches,
    )


def _one_by_one(
    scaled: Scaled, costates: Array, durations: Array, peak: float, bang: bool, slopes: bool
) -> Flights:
    count = len(costates)
    flights = Flights(
        costates,
        durations,
        charts_of(costates),
        np.zeros(count, dtype=bool),
        np.full((count, COUNT), np.nan),
        np.full((count, COUNT, COLUMNS), np.nan) if slopes else None,
        np.zeros(count, dtype=np.int64),
    )
    for i, (one, duration) in enumerate(zip(costates, durations, strict=True)):
        try:
            flight = fly(scaled, one, float(duration), peak, bang, taylor=False)
        except NotConverged:
            continue
        flights.reached[i], flights.ends[i] = True, flight.end
        flights.switches[i] = len(flight.pieces) - 1
        if flights.slopes is not None:
            flights.slopes[i] = flight.slopes
    return flights
