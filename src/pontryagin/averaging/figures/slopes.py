"""The error of the cost against epsilon: averaged, corrected at the ends, corrected in full."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from pontryagin.arrays import Array
from pontryagin.averaging import cost_errors
from pontryagin.averaging.figures.labels import EXACT, MEAN
from pontryagin.display.plotting import (
    INK,
    ORANGE,
    styled,
    subplots,
)


@styled
def error_slopes() -> Figure:
    """A panel for each problem of `cost_errors.problems`, with lines of slope 1 and 2."""
    names = list(cost_errors.problems())
    figure, axes = subplots(2, 3, height=4.2, sharex=True, sharey=True)
    for ax, name in zip(axes.flat, names, strict=False):
        found = cost_errors.errors(name)
        _lines(ax, found.epsilon)
        ax.plot(found.epsilon, found.averaged, "o", color=MEAN, label="averaged, $J_0$")
        ax.plot(found.epsilon, found.ends, "s", color=ORANGE, markerfacecolor="white", label="ends only")
        ax.plot(found.epsilon, found.corrected, "D", color=EXACT, label=r"$J_0 + \varepsilon J_1$")
        ax.set(xscale="log", yscale="log")
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_xticks([0.01, 0.04], ["0.01", "0.04"])
        ax.set_title(name, loc="left")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    spare = axes.flat[len(names)]
    spare.axis("off")
    spare.legend(handles, labels, loc="center")
    for ax in axes[:, 0]:
        ax.set_ylabel("error of the cost")
    for ax in (*axes[1, :2], axes[0, 2]):
        ax.set_xlabel(r"$\varepsilon$")
        ax.tick_params(labelbottom=True)
    return figure


def _lines(ax: Axes, epsilon: Array) -> None:
    ends = np.array([epsilon.min(), epsilon.max()])
    ax.plot(ends, 0.5 * ends, "-", color=INK, linewidth=0.7, label="slope 1")
    ax.plot(ends, 0.5 * ends**2, "--", color=INK, linewidth=0.7, label="slope 2")


@styled
def cost_convergence(
    name: str = "rippled flywheel",
    epsilons: tuple[float, ...] = (0.1, 0.07, 0.05, 0.035, 0.02, 0.014, 0.01, 0.005, 0.002),
) -> Figure:
    """Least exact cost of one of `cost_errors.problems` against epsilon, with averaged and corrected costs.

    Parameters
    ----------
    name : str
        One of `cost_errors.problems`.
    epsilons : tuple of float
    """
    figure, ax = subplots(height=2.9)
    found = cost_errors.errors(name, epsilons)
    line = np.linspace(0, max(epsilons), 50)
    ax.axhline(found.first, color=MEAN, label="averaged, $J_0$")
    ax.plot(line, found.first + found.correction * line, "--", color=INK, label=r"$J_0 + \varepsilon J_1$")
    ax.plot(found.epsilon, found.exact, "o", color=EXACT, label="least exact cost $J^*$")
    ax.set(xlabel=r"$\varepsilon$", ylabel="cost", xlim=(0, None))
    ax.legend()
    return figure
