"""One extremal on a page: its path from above and from the side, thrust, |n| and H against time."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    RED,
    styled,
    subplots,
)
from pontryagin.rendezvous.playback.motion import RendezvousMotion, motion_of
from pontryagin.rendezvous.reduced.solution import Extremal

POINTS = 241
"""Number of points with which an orbit is drawn."""
ARROWS = 24
"""Number of thrust arrows along the path."""
FLOOR = 1e-17
"""Values of |H| below this one are drawn at it."""


@styled
def profile(extremal: Extremal) -> Figure:
    """The path in the target's axes, and thrust, |n| and H against time.

    Parameters
    ----------
    extremal : Extremal
        The solution to draw.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> problem = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6),
    ...                      time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
    >>> profile(solve(problem)).get_label()
    'profile'
    """
    motion = motion_of(extremal)
    figure, axes = subplots(3, 2, height=7.2, height_ratios=[1.7, 1, 1])
    _path(axes[0, 0], motion, (0, 1))
    _path(axes[0, 1], motion, (0, 2))
    axes[0, 0].legend(loc="upper left", bbox_to_anchor=(0.0, 1.2), ncols=3, columnspacing=1.0)
    _thrust(axes[1, 0], axes[1, 1], motion)
    _switching(axes[2, 0], motion)
    _hamiltonian(axes[2, 1], motion)
    for ax in axes[2]:
        ax.set_xlabel("time $t$")
    return figure


def _path(ax: Axes, motion: RendezvousMotion, shown: tuple[int, int]) -> None:
    """The path and both orbits on two of the target's axes, in units of p*."""
    where = list(shown)
    target = motion.on_orbit(np.linspace(0.0, 2 * np.pi, POINTS))
    start = motion.osculating(POINTS, slice(1))[0]
    place = motion.place[: motion.meeting]
    ax.plot(*start[:, where].T, color=GREY, linewidth=1.0, label="orbit at $t_0$")
    ax.plot(*target[:, where].T, color=GREEN, linewidth=1.0, label="target's orbit")
    ax.plot(*place[:, where].T, color=BLUE, label="craft")
    samples = np.unique(np.searchsorted(motion.t, np.linspace(0, motion.t[-1], ARROWS)))
    arrows = motion.thrust[samples] / np.linalg.norm(motion.thrust, axis=1).max()
    ax.quiver(*place[samples][:, where].T, *arrows[:, where].T, color=RED, width=0.006, scale=9, zorder=3)
    ax.plot(*place[0, where], "o", color=GREY)
    ax.plot(*motion.target[0, where], "o", color=GREEN, fillstyle="none")
    ax.plot(*motion.target[motion.meeting - 1, where], "o", color=GREEN)
    ax.plot(0, 0, "o", color=INK, markersize=3.5)
    names = ("x", "y", "z")
    ax.set(xlabel=f"${names[shown[0]]}/p^*$", ylabel=f"${names[shown[1]]}/p^*$")
    ax.set_aspect("equal", adjustable="datalim")


def _thrust(components: Axes, magnitude: Axes, motion: RendezvousMotion) -> None:
    for i, (values, colour) in enumerate(zip(motion.control.T, (BLUE, ORANGE, PURPLE), strict=True), start=1):
        components.plot(motion.t, values, color=colour, label=f"$p_{i}$")
    components.set_ylabel(r"thrust in $\eta$")
    components.margins(y=0.28)
    components.legend(ncols=3, loc="upper center", columnspacing=1.0, handlelength=1.2)
    magnitude.plot(motion.t, np.linalg.norm(motion.control, axis=1), color=RED, label="$|p|$")
    peak = motion.extremal.problem.peak
    if np.isfinite(peak):
        magnitude.axhline(peak, color=INK, linewidth=0.9, linestyle="--", label=r"$p_{\max}$")
        magnitude.legend(loc="best")
    magnitude.set_ylabel("magnitude $|p|$")
    magnitude.set_ylim(bottom=0.0)


def _switching(ax: Axes, motion: RendezvousMotion) -> None:
    ax.plot(motion.t, motion.primer, color=BLUE, label="$|n|$")
    if motion.saturation is not None:
        label = r"$2\alpha_2 p_{\max}$"
        ax.axhline(motion.saturation, color=INK, linewidth=0.9, linestyle="--", label=label)
        ax.legend(loc="best")
    ax.set_ylabel("switching function $|n|$")
    ax.set_ylim(bottom=0.0)


def _hamiltonian(ax: Axes, motion: RendezvousMotion) -> None:
    ax.semilogy(motion.t, np.maximum(np.abs(motion.hamiltonian), FLOOR), color=BLUE, linewidth=0.9)
    energy = "|H|" if motion.extremal.problem.free else "|H-H(t_k)|"
    ax.set_ylabel(f"${energy}$ over cost rate")
    ax.set_ylim(FLOOR, 1.0)
