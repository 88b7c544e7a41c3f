"""The minimal elements h0 of (1.13) in three norms."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.display.plotting import INK, styled, subplots
from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.figures import labels
from pontryagin.triple_integrator.figures.labels import Solution
from pontryagin.triple_integrator.norms.impulse import ImpulseSolution
from pontryagin.triple_integrator.problem.maneuver import Maneuver


@styled
def dual_functions(maneuver: Maneuver) -> Figure:
    """The least dual function h0 with l'c = 1 in the norms conjugate to L2, L-infinity and L1.

    The shading shows what the norm of h0 measures: the area for L-infinity, the range for L1.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre with c other than zero.

    Raises
    ------
    ValueError
        If it is a stack, or c = 0, where no dual function has l'c = 1.
    """
    energy, peak, impulse = labels.three(maneuver)
    if not maneuver.moments.any():
        raise ArgumentValueError("maneuver must have moments c other than 0, got c = 0", "maneuver")
    solutions: list[Solution] = [energy, peak, impulse]
    figure, axes = subplots(1, 3, height=2.9, sharex=True, sharey=True)
    t = labels.instants(peak)
    for ax, solution in zip(axes, solutions, strict=True):
        ax.axhline(0, color=INK, linewidth=0.6)
        ax.plot(t, solution.costate(t)[:, 2], color=labels.colour(solution))
        ax.set_xlabel(labels.TIME)
    axes[0].set_ylabel("dual function $h_0$, s²/rad")
    _shade_to_zero(axes[0], t, energy.costate(t)[:, 2], labels.colour(energy))
    _shade_to_zero(axes[1], t, peak.costate(t)[:, 2], labels.colour(peak))
    _mark_signs(axes[1], t, peak.costate(t)[:, 2], labels.colour(peak))
    _mark_touching(axes[2], impulse)
    titles = (
        r"$u = h_0/\rho_0^2$,  $\rho_0^2 = \int h_0^2\,dt$",
        r"$u = \mathrm{sign}\,h_0/\rho_0$,  $\rho_0 = \int\,|h_0|\,dt$",
        r"impulses where $|h_0| = \rho_0$",
    )
    for ax, solution, words in zip(axes, solutions, titles, strict=True):
        ax.set_title(words, fontsize=9.5, color=labels.colour(solution))
    return figure


def _shade_to_zero(ax: Axes, t: Array, h: Array, colour: str) -> None:
    ax.fill_between(t, h, color=colour, alpha=0.15, linewidth=0)


def _mark_signs(ax: Axes, t: Array, h: Array, colour: str) -> None:
    """Write the sign of the control over each piece."""
    cuts = np.flatnonzero(np.diff(np.sign(h)) != 0)
    pieces = np.split(np.arange(len(t)), cuts + 1)
    for piece in pieces:
        if len(piece) < len(t) // 20:
            continue
        sign = np.sign(h[piece].sum())
        place = float(np.average(t[piece], weights=np.abs(h[piece])))
        height = np.interp(place, t, h) / 2
        ax.text(place, height, "$+$" if sign > 0 else "$-$", ha="center", va="center", color=colour)


def _mark_touching(ax: Axes, impulse: ImpulseSolution) -> None:
    colour, bound = labels.colour(impulse), 1 / float(impulse.norm)
    ax.axhspan(-bound, bound, color=colour, alpha=0.12, linewidth=0)
    for side, words in ((bound, r"$+\rho_0$"), (-bound, r"$-\rho_0$")):
        ax.axhline(side, color=colour, linewidth=0.9, linestyle="--")
        ax.annotate(
            words,
            (0.12, side),
            xycoords=("axes fraction", "data"),
            xytext=(4, -4 if side > 0 else 3),
            textcoords="offset points",
            va="top" if side > 0 else "bottom",
            color=colour,
        )
    times = impulse.impulse_times[impulse.impulses != 0]
    ax.plot(times, impulse.costate(times)[:, 2], "o", color=colour, markersize=6, clip_on=False)
