"""The least peak as a function of the duration: where it rises, and the durations with a given peak."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, INK, ORANGE, RED, styled, subplots
from pontryagin.triple_integrator.least_time.time import minimum_time
from pontryagin.triple_integrator.norms.peak import PeakSolution, minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver

COUNT = 1201
"""How many durations are sampled."""


@styled
def peak_over_duration(
    x0: ArrayLike, xf: ArrayLike, durations: tuple[float, float], bound: float | None = None
) -> Figure:
    """u0(T) between two states; it falls where the Hamiltonian is positive and rises where it is negative.

    Parameters
    ----------
    x0, xf : (3,) array_like
        The two states.
    durations : (float, float)
        Least and greatest T shown.
    bound : float, optional
        A bound U on |u|: the durations with u0(T) = U are marked, and the one that `minimum_time` returns.
    """
    T = np.geomspace(*durations, COUNT)
    solution = minimum_peak(Maneuver(np.broadcast_to(x0, (COUNT, 3)), np.broadcast_to(xf, (COUNT, 3)), T))
    peak, rising = solution.norm, hamiltonian(solution) < 0
    figure, ax = subplots(height=3.3)
    ax.plot(T, np.where(rising, np.nan, peak), color=BLUE, label=r"$\mathcal{H} > 0$: falls")
    ax.plot(T, np.where(rising, peak, np.nan), color=RED, label=r"$\mathcal{H} < 0$: rises", linewidth=2.2)
    if bound is not None:
        _mark_times(ax, x0, xf, bound, T, peak)
    top = np.nanmax(peak[rising], initial=0.0) or float(np.median(peak))
    ax.set(xlim=durations, ylim=(0, 2.2 * max(top, bound or 0.0)))
    ax.set(xlabel="duration $T$, s", ylabel="least peak $u_0$, rad/s³")
    ax.legend(loc="upper right")
    return figure


def hamiltonian(solution: PeakSolution) -> Array:
    """psi'x' at the start for the costate with l'c = 1, (...); du0/dT is -u0 times this."""
    m = solution.maneuver
    force = 0.0 if m.disturbance is None else np.asarray(m.disturbance, dtype=float)
    x2, x3 = m.x0[..., 1], m.x0[..., 2] + force
    l1, l2, l3 = np.moveaxis(solution.multipliers, -1, 0)
    T = m.duration
    third = l1 * T * T / 2 + l2 * T + l3
    return np.asarray(l1 * x2 + (l1 * T + l2) * x3 + np.abs(third) * solution.norm)


def crossings(T: Array, peak: Array, bound: float) -> Array:
    """Durations at which the sampled u0 - bound changes sign, by linear interpolation, (j,)."""
    excess = peak - bound
    at = np.flatnonzero(excess[:-1] * excess[1:] < 0)
    share = excess[at] / (excess[at] - excess[at + 1])
    return np.asarray(T[at] + share * (T[at + 1] - T[at]))


def _mark_times(ax: Axes, x0: ArrayLike, xf: ArrayLike, bound: float, T: Array, peak: Array) -> None:
    ax.axhline(bound, color=INK, linewidth=0.9, linestyle="--")
    ax.text(T[-1], bound, f"$U = {bound:g}$", ha="right", va="bottom")
    times = crossings(T, peak, bound)
    ax.plot(times, np.full(len(times), bound), "o", color="white", markeredgecolor=INK, markersize=7)
    least = minimum_time(x0, xf, bound)
    ax.plot(least.duration, bound, "o", color=ORANGE, markeredgecolor=INK, markersize=8, zorder=4)
    ax.annotate(
        f"least time\n$T = {float(least.duration):.4g}$ s", (float(least.duration), bound), xytext=(16, 78),
        textcoords="offset points", ha="left", arrowprops={"arrowstyle": "-", "lw": 0.7},
    )  # fmt: skip
    for time in times[np.abs(times - float(least.duration)) > 1e-3 * T[-1]]:
        ax.annotate(
            f"${time:.4g}$ s", (time, bound), xytext=(5, -5), textcoords="offset points", ha="left", va="top"
        )
