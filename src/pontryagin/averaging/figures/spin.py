"""Example 3: the decay of the precession, and the path of the control in its ellipse."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.examples.braking import (
    Braking,
    brake,
)
from pontryagin.averaging.examples.spin_down import spin_down
from pontryagin.averaging.figures.labels import EXACT, MEAN, SLOW_TIME
from pontryagin.display.plotting import (
    INK,
    SKY,
    styled,
    subplots,
)


@styled
def braking(omega0: ArrayLike, semiaxes: ArrayLike, ratio: float, epsilon: float) -> Figure:
    """The transverse rates under the synthesis, the control in its ellipse beside the printed one, and a.

    Parameters
    ----------
    omega0 : (3,) array_like
    semiaxes : (3,) array_like
    ratio, epsilon : float
        As in `braking.brake`.
    """
    flight, mean = brake(omega0, semiaxes, ratio, epsilon), spin_down(omega0, semiaxes, ratio)
    figure, axes = subplots(1, 3, height=2.7)
    _rates(axes[0], flight)
    _controls(axes[1], flight, np.asarray(semiaxes, dtype=float))
    axes[2].plot(flight.tau, flight.transverse, color=EXACT, linewidth=1.0, label="flown")
    axes[2].plot(
        [0, mean.duration],
        mean.slow([0.0, float(mean.duration)])[:, 0],
        color=MEAN,
        linestyle="--",
        label="averaged",
    )
    axes[2].set(xlabel=SLOW_TIME, ylabel="transverse rate $a$", ylim=(0, None), xlim=(0, None))
    axes[2].legend()
    return figure


def _rates(ax: Axes, flight: Braking) -> None:
    ax.plot(*flight.rates[:, :2].T, color=EXACT, linewidth=0.9)
    ax.plot(*flight.rates[0, :2], "o", color=INK)
    ax.annotate("start", tuple(flight.rates[0, :2]), (5, 4), textcoords="offset points")
    ax.set(aspect="equal", xlabel=r"$\omega_x$", ylabel=r"$\omega_y$")


def _controls(ax: Axes, flight: Braking, semiaxes: Array) -> None:
    lx, ly, _ = semiaxes
    turn = np.linspace(0, 2 * np.pi, 181)
    ax.fill(lx * np.cos(turn), ly * np.sin(turn), color=SKY, alpha=0.35)
    ax.plot(*flight.control[:, :2].T, color=EXACT, linewidth=1.4)
    ax.plot(*_printed(flight, semiaxes), color=MEAN, linewidth=1.3)
    words: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 9.5}
    ax.text(0, 0, "admissible", color=INK, **words)
    ax.text(0, ly + 0.17, "derived", color=EXACT, **words)
    ax.text(0, 1.17, "printed", color=MEAN, **words)
    ax.set(aspect="equal", xlabel="$u_x$", ylabel="$u_y$", ylim=(-1.35, 1.35), xlim=(-1.5, 1.5))


def _printed(flight: Braking, semiaxes: Array) -> tuple[Array, Array]:
    """The paper's control as printed: -l_x w_x/r and -l_y w_y/r, r^2 = l_x^2 w_x^2 + l_y^2 w_y^2."""
    lx, ly, _ = semiaxes
    wx, wy = flight.rates[:, :2].T
    r = np.hypot(lx * wx, ly * wy)
    return -lx * wx / r, -ly * wy / r
