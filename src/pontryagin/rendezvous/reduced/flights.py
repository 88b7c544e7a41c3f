"""The ends of many extremals of the reduced form, each from its own costates, in the units of `Scaled`."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.arcs import COLUMNS, COUNT
from pontryagin.rendezvous.reduced.flight import arcs_of


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
) -> Flights:
    """Integrate the extremals with the initial costates (k, 6) over the durations, (k,) or one for all."""
    count = len(costates)
    flights = Flights(
        np.array(costates),
        np.broadcast_to(np.asarray(durations, dtype=float), (count,)),
        charts_of(costates),
        np.zeros(count, dtype=bool),
        np.full((count, COUNT), np.nan),
        np.full((count, COUNT, COLUMNS), np.nan) if slopes else None,
        np.zeros(count, dtype=np.int64),
    )
    for i in range(count):
        one, duration, chart = flights.costates[i], float(flights.durations[i]), int(flights.charts[i])
        try:
            pieces, end = arcs_of(scaled, one, duration, peak, bang, chart, derivatives=slopes)
        except NotConverged:
            continue
        flights.reached[i], flights.ends[i], flights.switches[i] = True, end[:COUNT], len(pieces) - 1
        if flights.slopes is not None:
            flights.slopes[i] = end[COUNT:].reshape(COUNT, COLUMNS)
    return flights


def charts_of(costates: Array) -> NDArray[np.int64]:
    """The chart of chi of each flight, (k,)."""
    return np.where(costates[:, 5] >= 0, 1, -1)
