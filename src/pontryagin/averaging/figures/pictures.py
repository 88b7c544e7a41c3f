"""Figures 1 and 2 of the paper: the end condition and the cost against the end time.

The paper gives no system for its two figures. Here they are those of the smooth example with a ripple, whose
frequency is its speed: h* at the end is -y v1, and its mean over the phase is known in closed form.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solve_averaged
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.averaging.examples.smooth import smooth_example
from pontryagin.averaging.figures.families import draw_costs, sampled
from pontryagin.averaging.figures.labels import END_TIME, EXACT, KINDS, MEAN
from pontryagin.display.plotting import (
    INK,
    styled,
    subplots,
)

V0, V1, K, RIPPLE = 1.0, 2.0, 1.0, 0.5


@styled
def end_condition(epsilons: Sequence[float] = (0.04, 0.01), around: float = 0.25) -> Figure:
    """Figure 1: h* at the end and its mean over the phase, each against the end time; the roots marked.

    Parameters
    ----------
    epsilons : sequence of float
        Values of epsilon; each has its own panel.
    around : float
        Range of the end time on either side of the averaged optimum, in slow time.
    """
    figure, axes = subplots(len(epsilons), sharex=True, height=4.4)
    for ax, epsilon in zip(axes, epsilons, strict=True):
        found = _extremals(epsilon)
        tau, y, multiplier = sampled(
            found, found.traced.duration, found.traced.y, found.traced.unknowns[:, -1]
        )
        ax.plot(tau, -V1 * y, color=EXACT, linewidth=1.1, label=r"$h^*$ at the end")
        ax.plot(tau, multiplier**2 / 4 - K, color=MEAN, label=r"its mean $\langle h^*\rangle$ over the phase")
        ax.axhline(0.0, color=INK, linewidth=0.8)
        for kind, style in KINDS.items():
            at = [one.duration for one in found if one.kind == kind]
            ax.plot(at, np.zeros(len(at)), label=f"roots: {kind[:-2]}a of $J$", **style)
        centre = float(_averaged().duration)
        ax.set(xlim=(centre - around, centre + around), ylabel=r"$h^*$", ylim=(-2.2, 2.2))
        ax.set_title(rf"$\varepsilon = {epsilon:g}$", loc="left")
    ax.set_xlabel(END_TIME)
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=4, columnspacing=1.2)
    return figure


@styled
def cost_over_end(epsilons: Sequence[float] = (0.04, 0.01), around: float = 0.25) -> Figure:
    """Figure 2: the cost of the exact and of the averaged family against the end time; the roots marked."""
    figure, axes = subplots(len(epsilons), sharex=True, height=4.4)
    averaged = averaged_family()
    for ax, epsilon in zip(axes, epsilons, strict=True):
        draw_costs(ax, _extremals(epsilon), averaged)
        centre, base = float(_averaged().duration), float(_averaged().cost)
        ax.set(xlim=(centre - around, centre + around), ylim=(base - 0.06, base + 0.16))
        ax.set_title(rf"$\varepsilon = {epsilon:g}$", loc="left")
    ax.set_xlabel(END_TIME)
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def averaged_family(reach: float = 0.8, size: int = 81) -> tuple[Array, Array]:
    """tau_1 and J_0 of the members kappa of the averaged family, |kappa| <= reach, by rising tau_1."""
    kappas = np.linspace(-reach, 0.45 * reach, size)
    members = solve_averaged(_averaged().system, [V0], kappa=kappas)
    order = np.argsort(members.duration)
    return members.duration[order], members.cost[order]


def _averaged() -> AveragedSolution:
    return smooth_example(V0, V1, k=K, ripple=RIPPLE)


@lru_cache
def _extremals(epsilon: float) -> Extremals:
    return _averaged().exact(epsilon)
