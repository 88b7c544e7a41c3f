"""Plots: time against the number of steps, and the roots at which root finders end."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from benchmarks.figures import MARKS
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
def growth(table: Mapping[str, Sequence], aim: tuple[int, float]) -> Figure:
    """Time of one gauge against the number of steps, a panel for each set; a cross marks the aim."""
    names = list(dict.fromkeys(table["impulses"]))
    figure, axes = subplots(1, len(names), height=3.9, sharex=True, sharey=True, squeeze=False)
    rows = list(zip(*(table[key] for key in ("impulses", "steps", "method", "microseconds")), strict=True))
    handles = {}
    for axis, name in zip(axes.flat, names, strict=True):
        for method in dict.fromkeys(method for impulses, _, method, _ in rows if impulses == name):
            steps, times = zip(*[(s, t) for i, s, m, t in rows if (i, m) == (name, method)], strict=True)
            label = "pontryagin" if method.startswith("pontryagin") else method
            marker, colour = MARKS[label.replace(",", "").split(" ")[0]]
            line = LINES.get(label.split(", ")[-1], "-")
            (handle,) = axis.loglog(
                steps, np.array(times) / 1000, line, marker=marker, color=colour, markersize=4, label=label
            )
            handles.setdefault(label, handle)
        (cross,) = axis.plot(aim[0], 1000 * aim[1], "x", color=INK, markersize=8, linestyle="none")
        axis.set(title=name, xlabel="steps $N$")
    axes[0, 0].set_ylabel("processor time of one gauge, ms")
    handles["aim"] = cross
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=4)
    return figure


@styled
def root_finders(table: Mapping[str, Sequence], start: str) -> Figure:
    """Shares of starts of each finder that end at the right root, at the spurious one, and at none."""
    figure, axis = subplots(height=3.2)
    chosen = [i for i, kind in enumerate(table["start"]) if kind == start]
    methods = [table["method"][i] for i in chosen]
    left = np.zeros(len(chosen))
    for heading, colour, label in (
        ("right root", BLUE, r"the costate, $(\psi, \alpha)$"),
        ("spurious root", RED, r"the spurious root, $(-\psi, -\alpha)$"),
        ("no root", "#cccccc", "none"),
    ):
        share = 100 * np.array([table[heading][i] for i in chosen])
        axis.barh(methods, share, left=left, color=colour, label=label, height=0.7)
        for k, (begin, width) in enumerate(zip(left, share, strict=True)):
            if width >= 5:
                text = INK if colour == "#cccccc" else "white"
                axis.text(begin + width / 2, k, f"{width:.0f}", ha="center", va="center", color=text)
        left += share
    axis.invert_yaxis()
    axis.grid(visible=False)
    axis.set(xlim=(0, 100), xlabel="starts, %")
    figure.legend(loc="outside lower center", ncols=3)
    return figure
