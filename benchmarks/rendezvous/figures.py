"""Plots: operations of the forms, outcomes of random starts, solve times, stacks of flights."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from benchmarks.figures import FLOOR, Table, bars_of_shares, where
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    styled,
    subplots,
)

MARKS = {
    "pontryagin": ("o", BLUE),
    "solve_bvp": ("v", PURPLE),
    "CasADi + Ipopt": ("^", RED),
    "pykep": ("P", GREEN),
}


@styled
def form_costs(table: Table) -> Figure:
    """Operations of the right-hand side and time of a flight over the number of equations."""
    figure, axes = subplots(1, 2, height=3.0)
    columns = (
        ("operations", "operations a right-hand side", 1.0),
        ("microseconds a flight", "flight, ms", 1e-3),
    )
    for axis, (heading, label, unit) in zip(axes, columns, strict=True):
        for mode, colour in (("unsaturated", BLUE), ("saturated", ORANGE)):
            for derivatives, line in (("without", ":"), ("with", "-")):
                rows = where(table, {"arc": mode, "derivatives": derivatives})
                sizes, values = [int(form) for form in rows["form"]], [unit * x for x in rows[heading]]
                if sizes:
                    name = f"{mode}, {derivatives} derivatives"
                    axis.plot(sizes, values, line, marker="o", color=colour, markersize=4, label=name)
        axis.set(yscale="log", xlabel="equations", ylabel=label, xticks=[10, 11, 14, 16])
        axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.yaxis.set_major_formatter("{x:g}")
        axis.yaxis.set_minor_formatter(NullFormatter())
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


@styled
def starts(table: Table) -> Figure:
    """Shares of starts that converge to a true meeting, to a false one, or not at all, by inclination."""
    panels = list(dict.fromkeys(table["inclination"]))
    figure, axes = subplots(1, len(panels), height=2.6, sharey=True, squeeze=False)
    for axis, panel in zip(axes.flat, panels, strict=True):
        rows = where(table, {"inclination": panel})
        parts = (
            (rows["meetings"], BLUE, "meeting"),
            (rows["false meetings"], RED, "false meeting"),
            (rows["no convergence"], GREY, "none"),
        )
        bars_of_shares(axis, rows["form"], parts, written=12)
        axis.set_title(panel.replace(" deg", "°"))
    axes[0, 0].invert_yaxis()
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


@styled
def solve_times(table: Table, aim: float) -> Figure:
    """Error of the cost over the time of a warm solve, for each problem, with a line for the aim."""
    panels = list(dict.fromkeys(table["problem"]))
    lines = (len(panels) + 1) // 2
    figure, axes = subplots(lines, 2, height=1.9 * lines + 0.5, sharex=True, sharey=True, squeeze=False)
    handles = {}
    for axis, panel in zip(axes.flat, panels, strict=False):
        rows = where(table, {"problem": panel})
        for method, time, error in zip(rows["method"], rows["milliseconds"], rows["error"], strict=True):
            name = next(name for name in MARKS if method.startswith(name))
            marker, colour = MARKS[name]
            (handle,) = axis.plot(time, max(error, FLOOR), marker, color=colour, linestyle="none")
            handles.setdefault(name, handle)
        handles["aim"] = axis.axvline(1e3 * aim, color=SKY, linestyle="--", linewidth=1)
        axis.set(title=panel, xscale="log", yscale="log")
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.tick_params(labelbottom=True)
        axis.margins(0.1, 0.15)
    for axis in axes.flat[len(panels) :]:
        axis.set_axis_off()
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=len(handles))
    figure.supxlabel("processor time of a solve, ms", fontsize="medium")
    figure.supylabel("relative error of the cost", fontsize="medium")
    return figure


@styled
def stacks(table: Table) -> Figure:
    """Flights per second, one by one and many in one call."""
    figure, axis = subplots(height=2.6)
    places = np.arange(len(table["flights"]))
    ways = (
        ("one by one, microseconds", ORANGE, "one by one, with derivatives"),
        ("many, microseconds", BLUE, "many in one call, with derivatives"),
        ("many, ends alone, microseconds", SKY, "many in one call, ends alone"),
    )
    for k, (heading, colour, label) in enumerate(ways):
        speeds = 1e6 / np.array(table[heading])
        bars = axis.barh(places + 0.26 * (k - 1), speeds, height=0.24, color=colour, label=label)
        axis.bar_label(bars, [f"{speed:.0f}" for speed in speeds], padding=2, fontsize="small")
    axis.set(xscale="log", xlabel="flights a second", yticks=places, yticklabels=table["flights"])
    axis.margins(x=0.15)
    axis.invert_yaxis()
    figure.legend(loc="outside lower center", ncols=3)
    return figure
