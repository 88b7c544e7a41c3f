"""Example 2: the spiral of small thrust, and the oscillation of its elements about their means."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.averaging.examples.spiral import fly
from pontryagin.averaging.figures.labels import EXACT, MEAN, SLOW_TIME
from pontryagin.display.plotting import (
    GREEN,
    INK,
    WIDTH,
    styled,
)


@styled
def spiral(solution: AveragedSolution, extremal: Extremal) -> Figure:
    """The exact flight in the plane with its thrust, beside its energy, angular momentum and eccentricity.

    Parameters
    ----------
    solution : AveragedSolution
        A solution of `kepler`.
    extremal : Extremal
        One of its exact extremals.
    """
    figure = Figure(figsize=(WIDTH, 3.9), layout="constrained")
    grid = GridSpec(3, 2, figure=figure, width_ratios=(1.25, 1.0))
    _plane(figure.add_subplot(grid[:, 0]), extremal)
    flown = fly(extremal)
    mean = solution.slow(tau := np.linspace(0, float(solution.duration), 101))
    constant = np.sqrt(1 + 2 * mean[:, 0] * mean[:, 1] ** 2)
    rows = (
        ("energy $E$", flown.slow[:, 0], mean[:, 0]),
        ("momentum $K$", flown.slow[:, 1], mean[:, 1]),
        ("eccentricity $e$", np.sqrt(1 + 2 * flown.slow[:, 0] * flown.slow[:, 1] ** 2), constant),
    )
    axes = [figure.add_subplot(grid[row, 1]) for row in range(3)]
    for ax, (name, exact, averaged) in zip(axes, rows, strict=True):
        ax.plot(flown.tau, exact, color=EXACT, linewidth=1.0, label="exact")
        ax.plot(tau, averaged, color=MEAN, label="averaged")
        ax.set_ylabel(name)
    for ax in axes[:2]:
        ax.tick_params(labelbottom=False)
    axes[0].legend(loc="upper left")
    axes[2].set_xlabel(SLOW_TIME)
    figure.align_ylabels(axes)
    return figure


def _plane(ax: Axes, extremal: Extremal) -> None:
    flown = fly(extremal)
    ends = flown.ellipses(121)[[0, -1]]
    ax.plot(*ends[0].T, "--", color=INK, linewidth=1.0, label="first orbit")
    ax.plot(*ends[1].T, "-.", color=GREEN, linewidth=1.3, label="last osculating orbit")
    ax.plot(*flown.place.T, color=EXACT, linewidth=0.9, label="flown")
    some = slice(0, None, 10)
    ax.quiver(*flown.place[some].T, *flown.thrust[some].T, color=MEAN, width=0.005, scale=6, zorder=3)
    ax.plot(0, 0, "o", color=INK, markersize=5)
    ax.set(aspect="equal", xlabel="$r\\cos\\varphi$", ylabel="$r\\sin\\varphi$")
    ax.set_title(rf"$\varepsilon = {extremal.epsilon:g}$, thrust as arrows", loc="left")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, -0.36), ncols=2, columnspacing=1.0)
