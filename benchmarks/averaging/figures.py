"""Plots of the averaging benchmark: times over epsilon, integrators, extremals that solve_bvp finds."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from benchmarks.averaging.flows import LANES, OURS, TAYLOR, TOGETHER
from benchmarks.figures import Table, where
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    RED,
    styled,
    subplots,
)

TIMES = {
    "averaged, ms": ("averaged solve", "o", BLUE),
    "one exact shot, ms": ("one exact shot", "s", GREEN),
    "all exact extremals, ms": ("all exact extremals", "D", RED),
}
INTEGRATORS = {
    OURS: ("D", GREEN),
    LANES: ("X", GREEN),
    TAYLOR: ("o", BLUE),
    TOGETHER: ("P", BLUE),
    "DOP853, solve_ivp": ("s", RED),
    "LSODA, solve_ivp": ("^", ORANGE),
    "LSODA, odeint": ("v", PURPLE),
}


@styled
def price_of_exactness(table: Table) -> Figure:
    """Times of the averaged solve, of one exact shot and of all exact extremals, as functions of epsilon."""
    names = list(dict.fromkeys(table["example"]))
    figure, axes = subplots(2, 2, height=4.4, sharex=True, sharey=True)
    for ax, name in zip(axes.flat, names, strict=False):
        rows = where(table, {"example": name})
        for heading, (label, marker, colour) in TIMES.items():
            ax.loglog(rows["epsilon"], rows[heading], marker=marker, color=colour, markersize=4, label=label)
        ax.set_title(_title(name), loc="left")
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_xticks([0.002, 0.01, 0.05], ["0.002", "0.01", "0.05"])
    for ax in axes[1]:
        ax.set_xlabel(r"$\varepsilon$")
    for ax in axes[:, 0]:
        ax.set_ylabel("processor time, ms")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


@styled
def integrators(table: Table, what: str = "states and sensitivities") -> Figure:
    """Error against time of each integrator on the exact equations, one panel per example."""
    names = list(dict.fromkeys(table["example"]))
    figure, axes = subplots(2, 2, height=4.4, sharex=True, sharey=True)
    handles = {}
    for ax, name in zip(axes.flat, names, strict=False):
        rows = where(table, {"example": name, "what": what})
        for method, time, error in zip(rows["integrator"], rows["ms"], rows["error"], strict=True):
            marker, colour = INTEGRATORS[method]
            (handles[method],) = ax.loglog(time, error, marker, color=colour, linestyle="none")
        ax.set_title(_title(name), loc="left")
    for ax in axes[1]:
        ax.set_xlabel("processor time of a trajectory, ms")
    for ax in axes[:, 0]:
        ax.set_ylabel("relative error at the end")
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=3)
    return figure


@styled
def where_solve_bvp_lands(landings: Mapping[float, tuple[Extremals, tuple[float, float]]]) -> Figure:
    """Cost and end time of all extremals of the smooth example, and of the result of solve_bvp."""
    figure, axes = subplots(1, len(landings), height=2.9, squeeze=False)
    for ax, (epsilon, (found, end)) in zip(axes.flat, landings.items(), strict=True):
        ax.plot(
            *end, "o", color="none", markeredgecolor=RED, markersize=11, label="solve_bvp, from the average"
        )
        for kind, marker, colour in (("minimum", "v", BLUE), ("maximum", "^", ORANGE)):
            some = np.array([(one.duration, one.cost) for one in found if one.kind == kind])
            ax.plot(*some.T, marker, color=colour, linestyle="none", label=f"{kind[:-2]}a")
        ax.plot(found[0].duration, found[0].cost, "+", color=INK, markersize=9, label="the optimum")
        ax.set_title(rf"$\varepsilon = {epsilon:g}$", loc="left")
        ax.set_xlabel(r"end time $\tau_1$")
    axes[0, 0].set_ylabel("cost $J$")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def _title(name: str) -> str:
    return name[0].upper() + name[1:]
