"""Figure of alpha N for many steps, and of its limit."""

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.display.plotting import INK, styled, subplots
from pontryagin.orbit_correction import ergodic
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.plan.thrust import THRUSTS


@styled
def ergodic_limit(
    z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035, most: int = 3000, points: int = 90
) -> Figure:
    """Left: alpha times the number of impulses, and its limit. Right: the distance from the limit.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation.
    interval, peak : float
        As in `correct`.
    most, points : int
        Largest number of steps, and how many numbers of steps are computed.
    """
    figure, (left, right) = subplots(1, 2, height=3.2)
    steps = np.unique(np.geomspace(2, most, points).round().astype(int))
    for name in THRUSTS:
        each = 1.5 if name == "ball" else 1.0
        end = each * ergodic.limit(z0, interval, peak, name)
        reached = each * ergodic.approach(z0, steps, interval, peak, name)
        colour = labels.COLOURS[name]
        left.plot(each * steps, reached, color=colour, linewidth=1.2, label=labels.NAMES[name])
        left.axhline(end, color=colour, linewidth=0.9, linestyle="--")
        left.annotate(f"{end:.4f}", (each * most, end), (0, 3), textcoords="offset points", ha="right")
        style = {"color": colour, "markersize": 2.5, "linestyle": "none"}
        right.plot(each * steps, np.abs(reached - end), labels.MARKERS[name], **style)
    right.plot([10, 1.5 * most], 10 / np.array([10, 1.5 * most]), "--", color=INK, linewidth=0.9)
    right.annotate("$10/M$", (1000, 0.01), (10, 10), textcoords="offset points")
    left.set(xscale="log", xlabel=f"{labels.IMPULSES} $M$", ylabel=r"$\alpha M$", ylim=(3, 14))
    right.set(xscale="log", yscale="log", xlabel=f"{labels.IMPULSES} $M$", ylabel="distance from the limit")
    right.set_ylim(1e-5, 20)
    left.legend()
    return figure
