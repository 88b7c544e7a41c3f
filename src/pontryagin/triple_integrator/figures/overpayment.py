"""The printed formula (4.10) outside the cone where it holds: its value, and the cost of its impulses."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.display.plotting import INK, styled, subplots
from pontryagin.triple_integrator import kernels
from pontryagin.triple_integrator.figures import sphere
from pontryagin.triple_integrator.norms.impulse import minimum_impulse

SIZE = 500
"""Cells along each side of the map."""


@styled
def printed_impulses() -> Figure:
    """The printed value |F|/T^2, and the total of the printed impulses, over the least total impulse.

    Both are drawn over half the sphere of directions. The value is a lower bound and falls to zero. The
    impulses reach the target everywhere, but cost up to a quarter more than the least total impulse.
    """
    figure, axes = subplots(1, 2, height=3.9)
    directions, inside = sphere.grid(SIZE)
    maneuvers = sphere.maneuvers(directions)
    least = minimum_impulse(maneuvers).norm
    value, total = printed(maneuvers.moments)
    ratio = r"printed value $|F|/T^2$ over the least"
    _map(axes[0], value / least, (0, 1), "Blues_r", ratio, inside)
    _map(axes[1], total / least, (1, 1.25), "Blues", "printed impulses over the least", inside)
    for place, shift in ((0.25, (0.0, -0.3)), (0.75, (-0.16, -0.22))):
        x, y = sphere.to_disc(sphere.unit_impulse(np.array(place)))
        axes[1].plot(x, y, "o", color="white", markeredgecolor=INK, markersize=5)
        words = f"impulse at\n$t = {1 - place:g}\\,T$"
        line = {"arrowstyle": "-", "lw": 0.7}
        axes[1].annotate(words, (x, y), (x + shift[0], y + shift[1]), ha="center", va="top", arrowprops=line)
    return figure


def printed(moments: Array) -> tuple[Array, Array]:
    """|F|/T^2 and |a0| + |am| + |aT| of (4.10) for T = 1, (..., 3) -> (...), (...)."""
    c1, c2, c3 = np.moveaxis(moments, -1, 0)
    m = c3, c2, 2 * c1
    amplitudes = kernels.chebyshev_amplitudes(*m)
    return np.abs(kernels.pairing(2.0, *m)), np.abs(amplitudes).sum(axis=0)


def _map(
    ax: Axes,
    ratio: Array,
    limits: tuple[float, float],
    colours: str,
    words: str,
    inside: NDArray[np.bool_],
) -> None:
    sphere.prepare(ax)
    image = ax.imshow(
        np.where(inside, ratio, np.nan), origin="lower", extent=(-1, 1, -1, 1), cmap=colours, vmin=limits[0],
        vmax=limits[1],
    )  # fmt: skip
    start, end, middle = sphere.unit_impulse(np.array([1.0, 0.0, 0.5]))
    for first, last in ((start, end), (start, -middle), (end, -middle)):
        sphere.draw(ax, sphere.arc(first, last, 400), color=INK, linewidth=1.0)
    ax.text(0, 0.6, "paper is right", ha="center")
    ax.text(0, -0.84, "paper is right", ha="center")
    bar = ax.figure.colorbar(image, ax=ax, orientation="horizontal", shrink=0.85, pad=0.02)
    bar.set_label(words)
    bar.outline.set_visible(False)
