"""Plots: time against the number of steps, and the roots at which root finders end."""

import numpy as np
from matplotlib.figure import Figure

from benchmarks.figures import MARKS, PALE, Table, bars_of_shares, where
from pontryagin.display.plotting import (
    BLUE,
    INK,
    RED,
    styled,
    subplots,
)

LINES = {"costate": ":", "linprog": ":"}
"""Line styles: the second form of a solver is drawn dotted."""


@styled
def growth(table: Table, aim: tuple[int, float]) -> Figure:
    """Time of one gauge against the number of steps, a panel for each set; a cross marks the aim."""
    names = list(dict.fromkeys(table["impulses"]))
    figure, axes = subplots(1, len(names), height=3.9, sharex=True, sharey=True, squeeze=False)
    handles = {}
    for axis, name in zip(axes.flat, names, strict=True):
        for method in dict.fromkeys(where(table, {"impulses": name})["method"]):
            drawn = where(table, {"impulses": name, "method": method})
            times = np.array(drawn["microseconds"]) / 1000
            label = "pontryagin" if method.startswith("pontryagin") else method
            marker, colour = MARKS[label.replace(",", "").split(" ")[0]]
            line = LINES.get(label.split(", ")[-1], "-")
            (handle,) = axis.loglog(
                drawn["steps"], times, line, marker=marker, color=colour, markersize=4, label=label
            )
            handles.setdefault(label, handle)
        (cross,) = axis.plot(aim[0], 1000 * aim[1], "x", color=INK, markersize=8, linestyle="none")
        axis.set(title=name, xlabel="steps $N$")
    axes[0, 0].set_ylabel("processor time of one gauge, ms")
    handles["aim"] = cross
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4)
    return figure


@styled
def root_finders(table: Table, start: str) -> Figure:
    """Shares of starts of each finder that end at the right root, at the spurious one, and at none."""
    figure, axis = subplots(height=3.2)
    drawn = where(table, {"start": start})
    parts = (
        (drawn["right root"], BLUE, r"the costate, $(\psi, \alpha)$"),
        (drawn["spurious root"], RED, r"the spurious root, $(-\psi, -\alpha)$"),
        (drawn["no root"], PALE, "none"),
    )
    bars_of_shares(axis, drawn["method"], parts, written=5)
    axis.invert_yaxis()
    figure.legend(loc="outside lower center", ncols=3)
    return figure
