"""Figure of the gauge against the number of impulses, for every set of impulses."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.display.plotting import INK, styled, subplots
from pontryagin.errors import Infeasible
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.gauges.pball import power_gauge
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from pontryagin.validation import vectors


def gauges(
    z0: ArrayLike, name: str, most: int, interval: float, peak: float
) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of impulses up to `most`, and alpha for each."""
    thrust = Thrust(name, interval, peak)
    fewest = thrust.fewest
    steps = np.arange(fewest, (2 * most // 3 if name == "ball" else most) + 1)
    state = vectors("z0", z0, 3)
    alpha = thrust.gauges(np.broadcast_to(state, (len(steps), 3)), steps).upper
    return (-(-3 * steps // 2) if name == "ball" else steps), alpha


@styled
def gauge_over_impulses(
    z0: ArrayLike,
    most: int = 24,
    powers: Sequence[float] = (8.0, 16.0),
    interval: float = 0.25,
    peak: float = 0.0035,
) -> Figure:
    """The gauge against the number of impulses, for ball, disc, square and p-balls.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation.
    most : int
        Largest number of impulses.
    powers : sequence of float
        Exponents of the p-balls.
    interval, peak : float
        As in `correct`.
    """
    figure, ax = subplots(height=3.7)
    for name in THRUSTS:
        counts, alpha = gauges(z0, name, most, interval, peak)
        style = {"markersize": 4, "color": labels.COLOURS[name], "label": labels.NAMES[name]}
        ax.plot(counts, alpha, marker=labels.MARKERS[name], linewidth=1.2, **style)
    for p, colour in zip(powers, labels.POWERS.values(), strict=False):
        steps = np.arange(1, 2 * most // 3 + 1)
        alpha = np.array([_power(z0, int(count), p, interval, peak) for count in steps])
        name = rf"$p$-ball, $p = {p:g}$"
        ax.plot(-(-3 * steps // 2), alpha, "^--", color=colour, markersize=4, linewidth=1.0, label=name)
    ax.axhline(1.0, color=INK, linewidth=0.9)
    ax.annotate("enough at or below 1", (most, 1.0), (0, 4), textcoords="offset points", ha="right")
    ax.set(xscale="log", yscale="log", xlabel=labels.IMPULSES, ylabel=r"gauge $\alpha$")
    ticks = [count for count in (2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48, 64, 96) if count <= most]
    ax.set_xticks(ticks, [str(count) for count in ticks])
    ax.set_xticks([], minor=True)
    levels = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20]
    ax.set_yticks(levels, [f"{level:g}" for level in levels])
    ax.set_yticks([], minor=True)
    low = min(line.get_ydata()[-1] for line in ax.lines if len(line.get_xdata()) > 2)
    ax.set_ylim(0.8 * low, 12)
    ax.legend()
    return figure


def _power(z0: ArrayLike, steps: int, p: float, interval: float, peak: float) -> float:
    """The gauge for a p-ball, or nan where the impulses do not span the space."""
    try:
        return power_gauge(z0, steps, p, interval, peak).alpha
    except Infeasible:
        return np.nan
