"""The trajectories of several rendezvous in space, side by side."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from pontryagin.display.plotting import (
    WIDTH,
    styled,
)
from pontryagin.rendezvous.figures.orbit import draw
from pontryagin.rendezvous.reduced.solution import Extremal

COLUMNS = 3
"""Number of panels in a row."""


@styled
def trajectories(found: Mapping[str, Extremal]) -> Figure:
    """The paths of the craft in inertial axes, each on its own scale, by the names of the cases."""
    rows = -(-len(found) // COLUMNS)
    figure = Figure(figsize=(WIDTH, 1.85 * rows + 0.4), layout="constrained")
    for number, (name, extremal) in enumerate(found.items(), 1):
        ax = figure.add_subplot(rows, COLUMNS, number, projection="3d")
        draw(ax, extremal, arrows=16, width=1.3)
        ax.set_axis_off()
        ax.set_title(name, y=0.97)
    figure.legend(*figure.axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
