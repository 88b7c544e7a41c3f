"""Plots: time against the size of the stack, and failures of ruckig against the scale."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from benchmarks.figures import Table
from benchmarks.triple_integrator.transfers import Cell
from pontryagin.display.plotting import SEQUENTIAL, styled, subplots


@styled
def stack_size(table: Table) -> Figure:
    """Time per problem against the number of problems in one call."""
    figure, axis = subplots(height=3.2)
    sizes, *times = table.values()
    for heading, marker, values in zip(list(table)[1:], "osDv^", times, strict=False):
        axis.loglog(sizes, values, marker=marker, label=heading.split(",")[0])
    axis.set_xlabel("problems in the stack")
    axis.set_ylabel(r"processor time per problem, $\mu$s")
    axis.legend(loc="lower left")
    return figure


@styled
def failures_by_scale(cells: Sequence[Cell]) -> Figure:
    """Share of least-time inputs on which each solver fails, over the scales of states and jerk."""
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
