"""The benchmark's plots: accuracy against time, time against the size of the stack, ruckig against scale."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from benchmarks.contest import Row
from benchmarks.transfers import Cell
from pontryagin.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SEQUENTIAL, SKY, styled, subplots

MARKS = {
    "pontryagin": ("o", BLUE),
    "Clarabel": ("s", GREEN),
    "HiGHS": ("D", ORANGE),
    "CasADi": ("^", RED),
    "solve_bvp": ("v", PURPLE),
    "ruckig": ("P", SKY),
}
"""Marker and colour of each contestant."""

FLOOR = 1e-16
"""Errors below this are drawn here."""


@styled
def accuracy_and_time(rows: Sequence[Row]) -> Figure:
    """Worst relative error against time per problem, one panel a problem."""
    problems = list(dict.fromkeys(row.problem for row in rows))
    columns = 2
    figure, axes = subplots(
        -(-len(problems) // columns),
        columns,
        sharex=True,
        sharey=True,
        height=2.1 * -(-len(problems) // columns) + 0.7,
        squeeze=False,
    )
    handles: dict[str, Line2D] = {}
    for axis, problem in zip(axes.flat, problems, strict=False):
        axis.set_title(problem[0].upper() + problem[1:])
        axis.set_xscale("log")
        axis.set_yscale("log")
        for row in rows:
            if row.problem != problem or not row.error >= 0:
                continue
            marker, colour = MARKS[row.method.split(",")[0].split(" ")[0]]
            (handle,) = axis.plot(
                1e6 * row.timing.typical, max(row.error, FLOOR), marker, color=colour, linestyle="none"
            )
            handles.setdefault(row.method.split(",")[0], handle)
    for axis in axes.flat[len(problems) :]:
        axis.set_visible(False)
    for axis in axes[-1]:
        axis.set_xlabel(r"processor time per problem, $\mu$s")
    for axis in axes[:, 0]:
        axis.set_ylabel("worst relative error")
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=len(handles))
    return figure


@styled
def stack_size(table: Mapping[str, Sequence], compiled_from: int) -> Figure:
    """Time per problem against the number of problems handed over at once."""
    figure, axis = subplots(height=3.2)
    sizes, *times = table.values()
    for heading, marker, values in zip(list(table)[1:], "osD^", times, strict=True):
        axis.loglog(sizes, values, marker=marker, label=heading.split(",")[0])
    axis.axvline(compiled_from, color=INK, linestyle=":", linewidth=1.0)
    axis.annotate(
        "compiled from here",
        (compiled_from, 1),
        xycoords=("data", "axes fraction"),
        xytext=(5, -3),
        textcoords="offset points",
        va="top",
    )
    axis.set_xlabel("problems in the stack")
    axis.set_ylabel(r"processor time per problem, $\mu$s")
    axis.legend(loc="lower left")
    return figure


@styled
def failures_by_scale(cells: Sequence[Cell]) -> Figure:
    """Share of least-time inputs that each side fails on, over the scales of the states and of the jerk."""
    figure, axes = subplots(1, 2, sharey=True, height=3.3)
    shown = [c for c in cells if c.ends == "full states" and not c.states.startswith("each")]
    states = list(dict.fromkeys(cell.states for cell in shown))
    jerks = list(dict.fromkeys(cell.jerk for cell in shown))
    for axis, side in zip(axes, ("ruckig", "pontryagin"), strict=True):
        share = np.array([cell.failed[side] / cell.count for cell in shown]).reshape(len(states), len(jerks))
        image = axis.imshow(100 * share, origin="lower", cmap=SEQUENTIAL, vmin=0, vmax=100, aspect="auto")
        for (i, j), value in np.ndenumerate(share):
            colour = "white" if value < 0.6 else "black"
            axis.text(j, i, f"{100 * value:.3g}", ha="center", va="center", color=colour, fontsize=9)
        axis.set_title(side)
        axis.set_xticks(range(len(jerks)), [_power(jerk) for jerk in jerks])
        axis.set_yticks(range(len(states)), [_power(state) for state in states])
        axis.set_xlabel("bound on $|u|$ (consistent units)")
        axis.grid(visible=False)
    axes[0].set_ylabel("scale of the states")
    figure.colorbar(image, ax=axes, label="inputs failed, %")
    return figure


def _power(text: str) -> str:
    return rf"$10^{{{text[2:]}}}$"
