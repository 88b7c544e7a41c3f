"""Figure of the number of impulses and of their controllability against the interval between them."""

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.display.plotting import BLUE, GREEN, GREY, ORANGE, styled, subplots
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.intervals import singular_values, sweep
from pontryagin.orbit_correction.plan.thrust import THRUSTS


@styled
def impulses_over_interval(
    z0: ArrayLike, peak: float = 0.0035, longest: float = 6.8, points: int = 272
) -> Figure:
    """Above: the fewest impulses. Below: singular values of the controllability matrix of four impulses.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation.
    peak : float
        As in `correct`.
    longest : float
        Largest interval, rad.
    points : int
        Number of intervals at which plans are made.
    """
    figure, (above, below) = subplots(2, height=4.8, sharex=True)
    intervals = longest * np.arange(1, points + 1) / points
    for name in THRUSTS:
        found = sweep(z0, intervals, peak, name)
        style = {"color": labels.COLOURS[name], "label": labels.NAMES[name]}
        above.plot(intervals, found.impulses, drawstyle="steps-mid", linewidth=1.3, **style)
    above.set(ylabel=labels.IMPULSES, ylim=(0, 30))
    above.legend(loc="upper center", ncols=3)
    fine = np.linspace(0.01, longest, 1400)
    for values, colour, name in zip(
        singular_values(fine, 4).T, (BLUE, GREEN, ORANGE), ("largest", "middle", "least"), strict=True
    ):
        below.plot(fine, values, color=colour, label=name)
    below.set(yscale="log", ylim=(1e-3, 20), ylabel="singular values\nof four impulses")
    below.legend(loc=(0.62, 0.04))
    for ax in (above, below):
        for turn in (np.pi, 2 * np.pi):
            ax.axvline(turn, color=GREY, linewidth=0.8, linestyle=":")
    below.set_xticks(np.pi / 2 * np.arange(5), ["0", r"$\pi/2$", r"$\pi$", r"$3\pi/2$", r"$2\pi$"])
    below.set_xlabel(r"interval $\Delta t$, rad of the orbit")
    figure.align_ylabels()
    return figure
