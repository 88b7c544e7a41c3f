"""Free-time extremals without a bound on the thrust, as stationary points of the cost over the duration."""

import math
from collections.abc import Iterator, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    INK,
    styled,
    subplots,
)
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.continuation import follow
from pontryagin.rendezvous.figures.labels import CRAFT, OTHER
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import over_duration
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.root import scales

MARGIN = 1.25
"""Factor by which curves extend beyond the shortest and the longest duration of the extremals found."""
DEAREST = 1.6
"""Cost up to which curves are drawn, in units of the best cost."""


@styled
def revolutions(found: Mapping[str, Extremal]) -> Figure:
    """Cost against t_k for the fixed-time extremals on every branch, and the free-time extremals as dots."""
    figure, axes = subplots(1, len(found), height=3.6, squeeze=False)
    for ax, (name, best) in zip(axes[0], found.items(), strict=True):
        _draw_branches(ax, best)
        ax.set_title(name, loc="left")
        ax.set_xlabel("duration $t_k$")
    axes[0, 0].set_ylabel("cost $J$")
    return figure


def _draw_branches(ax: Axes, best: Extremal) -> None:
    several = [best, *best.others]
    shortest, longest = (pick(one.duration for one in several) for pick in (min, max))
    limits = shortest / MARGIN, longest * MARGIN
    for extremal in several:
        longer, shorter = (branch(extremal, sign, limits, DEAREST * best.cost) for sign in (1, -1))
        for curve in (longer, shorter):
            ax.plot(*curve.T, color=CRAFT, linewidth=1.1)
        is_peak = all(curve[:2, 1].argmax() == 0 for curve in (longer, shorter))
        ax.plot(extremal.duration, extremal.cost, "o", color=INK if extremal is best else OTHER, zorder=4)
        ax.annotate(
            f"{extremal.revolutions:.2f}",
            (extremal.duration, extremal.cost),
            (0, 5 if is_peak else -12),
            textcoords="offset points",
            ha="center",
            fontsize=9.5,
            path_effects=[withStroke(linewidth=2, foreground="white")],
        )
    ax.set_ylim(0.93 * best.cost, DEAREST * best.cost)


def branch(extremal: Extremal, sign: int, limits: tuple[float, float], dearest: float) -> Array:
    """t_k and J, (k, 2), of the fixed-time extremals on the branch through one, in one direction of t_k.

    Raises
    ------
    ValueError
        If the thrust is bounded, since the branch might cross switches.
    """
    problem = extremal.problem
    scaled = problem.scaled
    if problem.peak < math.inf:
        raise ArgumentValueError(
            f"extremal must be of a problem without a bound on the thrust, got a peak of {problem.peak:g}",
            "extremal",
        )
    points = []
    for duration, scaled_cost in _points(extremal, sign):
        time, cost = duration * scaled.time, scaled_cost * scaled.value
        points.append((time, cost))
        if not limits[0] <= time <= limits[1] or cost > dearest:
            break
    return np.array(points)


def _points(extremal: Extremal, sign: int) -> Iterator[tuple[float, float]]:
    """Duration and cost along the branch, in the solver's units."""
    scaled = extremal.problem.scaled
    setting = Setting(scaled, scaled.ratio, math.inf)
    start = math.log(extremal.flight.duration)
    unknowns = extremal.root.unknowns[:6]
    points = follow(
        over_duration(setting),
        unknowns,
        start,
        sign,
        scales=scales,
        step=0.03,
        largest=0.05,
        steps=120,
        rows=6,
    )
    for point in points:
        flight = point.equations.flight
        yield flight.duration, scaled.ratio * flight.duration + energy(flight)
