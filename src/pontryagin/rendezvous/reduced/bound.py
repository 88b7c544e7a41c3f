"""An extremal under the bound: p_max lowered to its value, and for least time alpha1/alpha2 raised."""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.homotopy import (
    Point,
    Root,
    between,
    follow,
    newton,
)
from pontryagin.rendezvous.reduced.shooting import (
    Equations,
    Setting,
    equations,
)

RUNAWAY = 1e4
"""Growth of the costates at which a bound is taken to be the least for the duration."""
LOWER = 120
"""Points of a curve along which the bound is lowered."""
RISE = 80
"""Points of a curve along which alpha1/alpha2 is raised."""
STEEPEST = 1e12
"""alpha1/alpha2, in units of p_max^2, at which the thrust must be saturated throughout."""


def bounded(setting: Setting, loose: Setting, root: Root) -> Root:
    """The extremal under the bound, and under alpha2 = 0 if that is asked for."""
    lowered = _lowered(loose, root, setting.peak)
    return _least_time(loose.but(peak=setting.peak), lowered) if setting.bang else lowered


def largest_thrust(flight: Flight) -> float:
    """Largest |p| on a fine grid."""
    times = np.linspace(0, flight.duration, 200 + int(40 * flight.duration))
    return float(np.linalg.norm(flight.thrust(times), axis=1).max())


def _lowered(loose: Setting, root: Root, peak: float) -> Root:
    """Bring the bound down to p_max.

    Raises
    ------
    Infeasible
        Where the costates run away: there the bound is the least with which this family makes its duration.
    NotConverged
        Where the family turns back, or cannot be followed.
    """
    if peak == math.inf:
        return root
    highest = 1.001 * largest_thrust(root.flight)
    if highest < peak:
        return newton(loose.but(peak=peak), root.unknowns)

    def family(unknowns: Array, parameter: float) -> tuple[Equations, Array]:
        values = equations(loose.but(peak=math.exp(parameter), rough=True), unknowns)
        return values, values.by_peak

    start, end = math.log(highest), math.log(peak)
    last: Point | None = None
    least = start
    for point in follow(family, root.unknowns, start, end, steps=LOWER, largest=1.0):
        if last is not None and last.parameter > end >= point.parameter:
            return newton(loose.but(peak=peak), between(last, point, end))
        if np.abs(point.unknowns[:6]).max() > RUNAWAY * np.abs(root.unknowns[:6]).max():
            raise Infeasible(f"{_how_far(loose, least, end)}: the costates grow beyond measure")
        if point.parameter > start:
            break
        last, least = point, min(least, point.parameter)
    raise NotConverged(f"{_how_far(loose, least, end)}: the family turns back or ends", least - end)


def _how_far(loose: Setting, least: float, end: float) -> str:
    reached, wanted = (math.exp(x) * loose.scaled.acceleration for x in (least, end))
    return f"the bound went down to {reached:.6g}, not to {wanted:.6g}"


def _least_time(setting: Setting, root: Root) -> Root:
    """Raise alpha1/alpha2 until everything is saturated, or as far as it goes; then alpha2 = 0."""

    def family(unknowns: Array, parameter: float) -> tuple[Equations, Array]:
        """In costates over |n(t_k)|, which stay of one size."""
        there = setting.but(ratio=math.exp(parameter), rough=True)
        size, growth = there.end_switching, there.end_switching_slopes[0]
        scale = np.array([size] * 6 + [1.0])
        values = equations(there, unknowns * scale)
        by_ratio = values.by_ratio + values.jacobian[:, :6] @ unknowns[:6] * growth
        return values.scaled(scale), by_ratio

    scale = np.array([setting.end_switching] * 6 + [1.0])
    start, end = math.log(setting.ratio), math.log(STEEPEST * setting.peak**2)
    bang = setting.but(ratio=math.inf)
    reason = "alpha1/alpha2 could not be raised"
    last: Point | None = None
    for point in follow(family, root.unknowns / scale, start, end, step=0.3, steps=RISE, largest=3.0):
        pieces = point.equations.flight.pieces
        last = point
        if len(pieces) == 1 and pieces[0].mode == "saturated":
            break
        if point.parameter > end:
            reason = "the thrust vanishes on the way"
            break
        if point.parameter < start:
            reason = "the family turns back"
            break
    try:
        assert last is not None
        return newton(bang, np.append(last.unknowns[:6] / setting.peak, last.unknowns[6]))
    except NotConverged as failure:
        raise NotConverged(reason, failure.residual) from failure
