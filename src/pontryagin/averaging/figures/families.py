"""The exact family of extremals over its end time, sampled finely, and its cost beside the averaged one."""

import numpy as np
from matplotlib.axes import Axes
from scipy.interpolate import CubicSpline

from pontryagin.arrays import Array
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.averaging.figures.labels import EXACT, KINDS, MEAN

PER_TURN = 60
"""Samples for each turn of the anomaly at the end."""


def sampled(found: Extremals, *columns: Array) -> list[Array]:
    """Columns (k,) of the traced family, interpolated over the anomaly at the end."""
    theta = found.traced.theta
    fine = np.arange(theta[0], theta[-1], 2 * np.pi / PER_TURN)
    return [CubicSpline(theta, column)(fine) for column in columns]


def draw_costs(ax: Axes, found: Extremals, averaged: tuple[Array, Array]) -> None:
    """Draw J over the end time, exact and averaged, and mark the minima and maxima of the exact one."""
    ax.plot(
        *sampled(found, found.traced.duration, found.traced.cost),
        color=EXACT,
        linewidth=1.1,
        label="$J$, exact",
    )
    ax.plot(*averaged, color=MEAN, label="$J_0$, averaged")
    for kind, style in KINDS.items():
        chosen = [one for one in found if one.kind == kind]
        at, values = [one.duration for one in chosen], [one.cost for one in chosen]
        ax.plot(at, values, label=f"{kind[:-2]}a", **style)
    ax.set_ylabel("cost $J$")
