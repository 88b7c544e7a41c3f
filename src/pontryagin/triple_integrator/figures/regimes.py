"""The regimes of problem 3, (1.20), over the directions of c."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, styled, subplots
from pontryagin.triple_integrator.figures import sphere
from pontryagin.triple_integrator.norms.impulse import REGIMES, minimum_impulse

COLOURS = dict(zip(REGIMES[1:], (ORANGE, GREEN, BLUE, PURPLE), strict=True))
WORDS = {
    "chebyshev": "start, middle, end",
    "start": "start, and one in the second half",
    "end": "one in the first half, and end",
    "moment": "one sign: any that fit",
}
PLACES = {
    "chebyshev": ((0.0, 0.58), (0.0, -0.62)),
    "start": ((-0.82, 0.18), (0.76, -0.12)),
    "end": ((-0.66, -0.09), (0.87, 0.13)),
    "moment": ((0.2, 0.005),),
}
SIZE = 700
"""Number of cells along each side of the map."""


@styled
def impulse_regimes() -> Figure:
    """Regimes of the least total impulse over half the sphere of directions, with the exact boundaries.

    A pictogram in each region shows the impulses against time, for the direction in its middle.
    """
    figure, (ax, aside) = subplots(1, 2, height=4.6, width_ratios=(2.1, 1))
    directions, inside = sphere.grid(SIZE)
    solution = minimum_impulse(sphere.maneuvers(directions))
    regime = np.where(inside, solution.regime_index, np.nan)
    _fill(ax, regime)
    _draw_boundaries(ax)
    for name, places in PLACES.items():
        for place in places:
            _pictogram(ax, place, COLOURS[name])
    _explain(aside, {name: float(np.sum(regime == i) / inside.sum()) for i, name in enumerate(REGIMES)})
    return figure


def _fill(ax: Axes, regime: Array) -> None:
    sphere.prepare(ax)
    paint = ListedColormap([COLOURS[name] for name in REGIMES[1:]])
    ax.imshow(
        regime, origin="lower", extent=(-1, 1, -1, 1), cmap=paint, vmin=0.5, vmax=4.5, alpha=0.28,
        interpolation="nearest",
    )  # fmt: skip


def _draw_boundaries(ax: Axes) -> None:
    """Edges of the regimes: single impulses, both ends, and Chebyshev's cone."""
    start, end, middle = sphere.unit_impulse(np.array([1.0, 0.0, 0.5]))
    line = {"color": INK, "linewidth": 1.1}
    sphere.draw(ax, sphere.unit_impulse(np.linspace(0, 1, 400)), **line)
    for first, last in ((start, end), (start, -middle), (end, -middle), (start, -end)):
        sphere.draw(ax, sphere.arc(first, last, 400), **line)
    for sigma, words, shift in (
        (1.0, "one impulse\nat the start", (0.04, 0.17)),
        (0.0, "one impulse\nat the end", (0.0, 0.16)),
        (0.4, "one impulse", (0.0, -0.15)),
    ):
        x, y = sphere.to_disc(sphere.unit_impulse(np.array(sigma)))
        line = {"arrowstyle": "-", "lw": 0.6, "shrinkA": 1, "shrinkB": 2}
        ax.annotate(
            words, (x, y), (x + shift[0], y + shift[1]), ha="center", va="center", fontsize=9, arrowprops=line
        )
        ax.plot(x, y, "o" if sigma in (0.0, 1.0) else "", color=INK, markersize=4)


def _pictogram(ax: Axes, place: tuple[float, float], colour: str) -> None:
    solution = minimum_impulse(sphere.maneuvers(sphere.from_disc(np.array(place))))
    width, height = 0.2, 0.17
    inset = ax.inset_axes(
        (place[0] - width / 2, place[1] - height / 2, width, height), transform=ax.transData
    )
    inset.axis("off")
    largest = np.abs(solution.impulses).max()
    inset.axhline(0, color=INK, linewidth=0.8)
    happens = solution.impulses != 0
    for time, size in zip(solution.impulse_times[happens], solution.impulses[happens] / largest, strict=True):
        inset.plot([time, time], [0, size], color=colour, linewidth=2.6, solid_capstyle="butt")
    inset.set(xlim=(-0.08, 1.08), ylim=(-1.1, 1.1))


def _explain(ax: Axes, shares: dict[str, float]) -> None:
    ax.axis("off")
    handles = [Patch(facecolor=COLOURS[name], alpha=0.45) for name in WORDS]
    words = [f"{name}: {shares[name]:.1%}\n{text}".replace("%", " %") for name, text in WORDS.items()]
    ax.legend(
        handles, words, loc="center left", bbox_to_anchor=(-0.08, 0.5), labelspacing=1.2, handlelength=1.2,
        title="impulses at", alignment="left",
    )  # fmt: skip
