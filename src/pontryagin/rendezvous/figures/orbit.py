"""A rendezvous in space: both orbits, the path of the craft, the thrust as arrows."""

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import Axes3D

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    INK,
    WIDTH,
    styled,
)
from pontryagin.rendezvous.figures.labels import CRAFT, START, TARGET, THRUST, units
from pontryagin.rendezvous.figures.paths import flight_path, initial_orbit, target_orbit
from pontryagin.rendezvous.reduced.solution import Extremal

VIEW = {"elev": 28, "azim": -60}


@styled
def orbit(extremal: Extremal) -> Figure:
    """The path of the craft in inertial axes with its thrust, and the orbits that it leaves and reaches."""
    figure = Figure(figsize=(WIDTH, 5.0), layout="constrained")
    ax = figure.add_subplot(projection="3d")
    draw(ax, extremal, arrows=28)
    own = units(extremal.problem)
    ax.set(
        xlabel=own.axis("$x$", "length"), ylabel=own.axis("$y$", "length"), zlabel=own.axis("$z$", "length")
    )
    ax.locator_params(nbins=5)
    ax.locator_params(axis="z", nbins=3)
    figure.legend(loc="outside lower center", ncols=3)
    return figure


def draw(ax: Axes3D, extremal: Extremal, arrows: int, width: float = 1.6) -> None:
    """Draw the orbits, the path and some thrust arrows, lengths in the units of `labels.units`."""
    problem, length = extremal.problem, units(extremal.problem).length
    _, places, thrust = flight_path(problem, extremal.flight)
    places = places / length
    ax.plot(
        *(initial_orbit(problem) / length).T,
        "--",
        color=START,
        linewidth=0.9,
        label="orbit of the craft at $t_0$",
    )
    ax.plot(*(target_orbit(problem) / length).T, color=TARGET, linewidth=1.1, label="orbit of the target")
    ax.plot(*places.T, color=CRAFT, linewidth=width, label="the way of the craft")
    samples = np.linspace(0, len(places) - 1, arrows).astype(int)
    size = 0.45 * np.abs(places).max() / np.linalg.norm(thrust, axis=1).max()
    ax.quiver(
        *places[samples].T,
        *(size * thrust[samples]).T,
        color=THRUST,
        linewidth=0.8,
        arrow_length_ratio=0.25,
        label="thrust",
    )
    ax.plot(*places[:1].T, "o", color=INK, markersize=4, label="start")
    ax.plot(*places[-1:].T, "*", color=INK, markersize=9, label="meeting")
    ax.plot([0], [0], [0], "+", color=INK, markersize=6)
    equal(ax, np.vstack([places, target_orbit(problem) / length, initial_orbit(problem) / length]))


def equal(ax: Axes3D, points: Array) -> None:
    """Set the same scale along all axes; coplanar points get some room normal to their plane."""
    low, high = points.min(axis=0), points.max(axis=0)
    reach = np.maximum(high - low, 0.25 * (high - low).max())
    middle = (low + high) / 2
    for name, centre, width in zip("xyz", middle, 1.06 * reach, strict=True):
        getattr(ax, f"set_{name}lim")(centre - width / 2, centre + width / 2)
    ax.set_box_aspect(tuple(reach), zoom=0.98)
    ax.view_init(**VIEW)
