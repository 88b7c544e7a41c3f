"""One exact extremal beside the averaged solution: slow variables, costates, control."""

import numpy as np
from matplotlib.figure import Figure

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.averaging.figures.labels import EXACT, MEAN, SLOW_TIME
from pontryagin.display.plotting import (
    PALETTE,
    styled,
    subplots,
)


@styled
def extremal_figure(solution: AveragedSolution, extremal: Extremal) -> Figure:
    """Slow variables and costates of an exact extremal over the averaged ones, and its control.

    Parameters
    ----------
    solution : AveragedSolution
        The averaged solution of one problem.
    extremal : Extremal
        An exact extremal of the same problem.
    """
    names = solution.names
    figure, axes = subplots(2 * len(names) + 1, sharex=True, height=0.6 + 1.15 * (2 * len(names) + 1))
    tau = np.linspace(0.0, extremal.duration, max(400, int(60 * extremal.turns)))
    mean_tau = np.linspace(0.0, float(solution.duration), 101)
    exact = np.hstack([extremal.slow(tau), extremal.costate(tau)])
    mean = np.hstack([solution.slow(mean_tau), solution.costate(mean_tau)])
    labels = [f"${name}$" for name in names] + [f"$p_{name}$" for name in names]
    for ax, label, fast, slow in zip(axes[:-1], labels, exact.T, mean.T, strict=True):
        ax.plot(tau, fast, color=EXACT, linewidth=1.0, label="exact")
        ax.plot(mean_tau, slow, color=MEAN, label="averaged")
        ax.set_ylabel(label)
    for i, control in enumerate(extremal.control(tau).T):
        axes[-1].plot(tau, control, linewidth=1.0, color=PALETTE[i], label=f"$u_{i + 1}$" if i else "$u$")
    axes[-1].set(ylabel="control $u$", xlabel=SLOW_TIME)
    axes[0].legend(ncols=2)
    figure.align_ylabels(axes)
    return figure
