"""What the plots of several papers share: accuracy against time, bars of shares, rows of a panel."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from benchmarks.contest import CALL, STACK, Row
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    styled,
    subplots,
)

MARKS = {
    "pontryagin": ("o", BLUE),
    "Clarabel": ("s", GREEN),
    "HiGHS": ("D", ORANGE),
    "CasADi": ("^", RED),
    "CVXPY": ("^", RED),
    "solve_bvp": ("v", PURPLE),
    "ruckig": ("P", SKY),
}
"""Marker and colour of each contestant."""

OURS = {CALL: ("one call", 5, "bottom"), STACK: ("stack", -5, "top")}
"""Label of our points, its vertical offset in points, and its vertical alignment."""

PALE = "#cccccc"
"""A fill that is written on in black."""

FLOOR = 1e-16
"""Smaller errors are drawn at this value."""


Table = Mapping[str, Sequence[Any]]
"""Columns of a table by their headings."""


def where(table: Table, wanted: Mapping[str, Any]) -> dict[str, list[Any]]:
    """The rows of a table that hold the wanted values, as columns."""
    values = zip(*(table[heading] for heading in wanted), strict=True)
    rows = [i for i, row in enumerate(values) if row == tuple(wanted.values())]
    return {heading: [column[i] for i in rows] for heading, column in table.items()}


def bars_of_shares(axis: Axes, names: Sequence[str], parts: Iterable[tuple], written: float) -> None:
    """A bar of 100 % for each name; its parts are shares, colour and label, numbered from `written` % on."""
    left = np.zeros(len(names))
    for shares, colour, label in parts:
        share, ink = 100 * np.array(shares), INK if colour == PALE else "white"
        axis.barh(names, share, left=left, color=colour, label=label, height=0.7)
        for k in np.flatnonzero(share >= written):
            axis.text(left[k] + share[k] / 2, k, f"{share[k]:.0f}", ha="center", va="center", color=ink)
        left += share
    axis.grid(visible=False)
    axis.set(xlim=(0, 100), xlabel="starts, %")


@styled
def accuracy_and_time(rows: Sequence[Row]) -> Figure:
    """Worst relative error against time per problem, a panel for each; a free panel holds the legend."""
    problems = list(dict.fromkeys(row.problem for row in rows))
    lines = (len(problems) + 1) // 2
    figure, axes = subplots(lines, 2, height=2.1 * lines, sharex=True, sharey=True, squeeze=False)
    handles: dict[str, Line2D] = {}
    for axis, problem in zip(axes.flat, problems, strict=False):
        axis.set(title=problem[0].upper() + problem[1:], xscale="log", yscale="log")
        axis.tick_params(labelbottom=True)
        axis.margins(0.12, 0.22)
        for row in rows:
            if row.problem != problem or not row.error >= 0:
                continue
            name = row.method.split(",")[0]
            marker, colour = MARKS[name.split(" ")[0]]
            place = (1e6 * row.timing.typical, max(row.error, FLOOR))
            (handle,) = axis.plot(*place, marker, color=colour, linestyle="none")
            handles.setdefault(name, handle)
            if row.method in OURS:
                label, height, side = OURS[row.method]
                offset = {"xytext": (0, height), "textcoords": "offset points"}
                axis.annotate(label, place, **offset, ha="center", va=side)
    if len(problems) % 2:
        axes.flat[-1].set_axis_off()
        axes.flat[-1].legend(handles.values(), handles.keys(), loc="center", ncols=2)
    else:
        figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=len(handles))
    figure.supxlabel(r"processor time per problem, $\mu$s", fontsize="medium")
    figure.supylabel("worst relative error of the cost", fontsize="medium")
    return figure
