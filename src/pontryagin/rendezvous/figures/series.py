"""The time series of a rendezvous: thrust, switching function, H, costates."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    BLUE,
    INK,
    styled,
    subplots,
)
from pontryagin.rendezvous.figures.labels import BOUND, COMPONENTS, THRUST, saturated_arcs, units
from pontryagin.rendezvous.reduced.certificate import (
    anomaly_constant,
    flown_thrust,
    hamiltonian,
)
from pontryagin.rendezvous.reduced.flight import switching
from pontryagin.rendezvous.reduced.solution import Extremal

COUNT = 601
"""Number of times at which a series is drawn."""


@styled
def series(extremal: Extremal) -> Figure:
    """Components and magnitude of the thrust, |n|, the drift of H, and the costates of a rendezvous.

    |n| and the costates are in the solver's units, p* = c* = fM = 1 and alpha2 = 1, or alpha1 = 1 for
    the least time; H is over the largest running cost. Arcs on the bound are shaded.
    """
    figure, axes = subplots(3, 2, height=6.3, sharex=True)
    own = units(extremal.problem)
    times = np.linspace(0, extremal.flight.duration, COUNT)
    states = extremal.flight.sample(times)
    shown = times * extremal.problem.scaled.time / own.time
    _components(axes[0, 0], extremal, shown, states)
    _size(axes[0, 1], extremal, shown, states)
    _switching(axes[1, 0], extremal, shown, states)
    axes[1, 1].plot(shown, 1e14 * drift(extremal, times, states), color=BLUE, linewidth=0.9)
    axes[1, 1].set_ylabel("drift of $H$ [$10^{-14}$]")
    _costates(axes[2, 0], shown, states[:, 4:7], (r"$\rho$", "$s_1$", "$e$"))
    _costates(axes[2, 1], shown, states[:, 7:10], (r"$\nu_1$", r"$\nu_2$", r"$\nu_3$"))
    for ax in axes.flat:
        ax.set_xlim(0, shown[-1])
        _shade(ax, extremal, own.time)
    for ax in axes[2]:
        ax.set_xlabel(own.axis("time $t$", "time"))
    figure.align_ylabels(axes)
    return figure


def drift(extremal: Extremal, times: Array, states: Array) -> Array:
    """H over the largest running cost; for a prescribed duration H minus its value at t_k."""
    flight, weights = extremal.flight, extremal.problem.scaled.weights
    thrust = flown_thrust(flight, times, states)
    largest = np.max(weights[0] + weights[1] * np.sum(thrust**2, axis=1))
    energy = hamiltonian(states, thrust, anomaly_constant(flight), weights)
    return np.asarray((energy - (0.0 if extremal.problem.free else energy[-1])) / largest)


def _thrust(extremal: Extremal, states: Array, times: Array) -> Array:
    own = units(extremal.problem)
    time = times * own.time / extremal.problem.scaled.time
    return (
        flown_thrust(extremal.flight, time, states) * extremal.problem.scaled.acceleration / own.acceleration
    )


def _components(ax: Axes, extremal: Extremal, times: Array, states: Array) -> None:
    thrust = _thrust(extremal, states, times)
    names = ("$p_1$, radial", "$p_2$, transversal", "$p_3$, out of the plane")
    _named_curves(ax, times, thrust, names, room=0.55)
    ax.set_ylabel(units(extremal.problem).axis(r"thrust $p_\eta$", "acceleration"))
    ax.legend(loc="upper left", labelspacing=0.15, borderaxespad=0.1, handlelength=1.4)


def _size(ax: Axes, extremal: Extremal, times: Array, states: Array) -> None:
    own = units(extremal.problem)
    size = np.linalg.norm(_thrust(extremal, states, times), axis=1)
    ax.plot(times, size, color=THRUST, label="$|p|$")
    top = float(size.max())
    if extremal.problem.peak < np.inf:
        top = extremal.problem.peak / own.acceleration
        ax.axhline(top, color=BOUND, linestyle="--", linewidth=1.0, label=r"$p_{\max}$")
        ax.legend(loc="lower left", ncols=2)
    ax.set_ylim(0, 1.12 * top)
    ax.set_ylabel(own.axis("size of the thrust", "acceleration"))


def _switching(ax: Axes, extremal: Extremal, times: Array, states: Array) -> None:
    size = np.linalg.norm(switching(states), axis=1)
    ax.plot(times, size, color=BLUE)
    alpha2 = extremal.problem.scaled.weights[1]
    if alpha2 and extremal.flight.peak < np.inf:
        ax.axhline(2 * alpha2 * extremal.flight.peak, color=INK, linestyle="--", linewidth=1.0)
        ax.text(
            times[-1], 2 * alpha2 * extremal.flight.peak, r"$2\alpha_2p_{\max}$ ", ha="right", va="bottom"
        )
    ax.set_ylim(0, None)
    ax.set_ylabel("switching function $|n|$")


def _costates(ax: Axes, times: Array, values: Array, names: tuple[str, str, str]) -> None:
    _named_curves(ax, times, values, names, room=0.2)
    ax.set_ylabel("costates")
    ax.legend(loc="upper left", ncols=3, borderaxespad=0.1, handlelength=1.2, columnspacing=1.0)


def _named_curves(ax: Axes, times: Array, values: Array, names: Sequence[str], room: float) -> None:
    """Draw three columns, and leave room for the legend above them, as a share of the axis."""
    for series, name, colour in zip(values.T, names, COMPONENTS, strict=True):
        ax.plot(times, series, color=colour, label=name)
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + room * (high - low))


def _shade(ax: Axes, extremal: Extremal, unit: float) -> None:
    """Shade the arcs on the bound if there are others too."""
    if len(set(extremal.modes)) > 1:
        for begin, end in saturated_arcs(extremal):
            ax.axvspan(begin / unit, end / unit, color="#f0e6d2", zorder=0, linewidth=0)
