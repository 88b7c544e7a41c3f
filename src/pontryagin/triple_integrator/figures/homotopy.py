"""The programmes of least L_q norm for q from 1 (impulses) over 2 (a parabola) to infinity (bang-bang)."""

from collections.abc import Iterable, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, INK, RED, SEQUENTIAL, styled, subplots
from pontryagin.triple_integrator.figures import labels
from pontryagin.triple_integrator.figures.programmes import draw_impulses
from pontryagin.triple_integrator.norms.energy import minimum_energy
from pontryagin.triple_integrator.norms.impulse import minimum_impulse
from pontryagin.triple_integrator.norms.norm import minimum_norm
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver

EXPONENTS = (1.06, 1.15, 1.3, 1.6, 2.0, 3.0, 5.0, 10.0, 40.0)


@styled
def norm_family(maneuver: Maneuver, exponents: Sequence[float] = EXPONENTS) -> Figure:
    """Programmes of least L_q norm, and their mean norms between the total impulse over T and the peak.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre.
    exponents : sequence of float
        The exponents q, each 1 < q < infinity; q = 1 and infinity are added.
    """
    labels.single(maneuver)
    figure, (left, right) = subplots(1, 2, height=3.8, width_ratios=(1.55, 1))
    t = np.linspace(float(maneuver.t0), float(maneuver.tf), 801)
    paint = mpl.colormaps[SEQUENTIAL]
    peak, impulse = minimum_peak(maneuver), minimum_impulse(maneuver)
    limit = 4.2 * float(peak.norm)
    left.axhline(0, color=INK, linewidth=0.6)
    for q in exponents:
        programme = minimum_norm(maneuver, q)
        at = np.union1d(t, labels.instants(programme))
        left.plot(at, programme.control(at), color=paint(0.92 * (1 - 1 / q)), linewidth=1.5, label=f"${q:g}$")
    at = labels.instants(peak)
    left.plot(at, peak.control(at), color=RED, linewidth=1.8, label=r"$\infty$")
    draw_impulses(left, impulse.impulse_times, impulse.impulses, limit / 0.95, GREEN)
    left.set(ylim=(-1.05 * limit, 1.05 * limit), xlabel=labels.TIME, ylabel=labels.CONTROL)
    left.legend(title="$q$", ncols=2, fontsize=8.5, loc="best", handlelength=1.2, columnspacing=0.8)
    _draw_norms(right, maneuver)
    return figure


def mean_norms(maneuver: Maneuver, exponents: Iterable[float]) -> Array:
    """Least values of (mean of |u|^q)^(1/q) over one manoeuvre, rad/s^3, (len(exponents),)."""
    T = float(maneuver.duration)
    return np.array([float(minimum_norm(maneuver, q).norm) * T ** (-1 / q) for q in exponents])


def _draw_norms(ax: Axes, maneuver: Maneuver) -> None:
    T = float(maneuver.duration)
    inverse = np.linspace(0.04, 0.96, 24)
    impulse, peak = float(minimum_impulse(maneuver).norm) / T, float(minimum_peak(maneuver).norm)
    energy = float(minimum_energy(maneuver).norm) / np.sqrt(T)
    curve = [peak, *mean_norms(maneuver, 1 / inverse), impulse]
    ax.plot([0, *inverse, 1], curve, color=INK)
    marks = ((0.0, peak, RED, "peak"), (0.5, energy, BLUE, "energy"), (1.0, impulse, GREEN, "impulse"))
    for place, level, colour, words in marks:
        ax.plot(place, level, "o", color=colour, markersize=6, clip_on=False)
        ax.annotate(
            f"{words}\n${level:.4g}$", (place, level),
            xytext=(-6 if place else 8, -6), textcoords="offset points",
            ha="right" if place else "left", va="top", color=colour,
        )  # fmt: skip
    ax.set_xticks([0, 0.25, 0.5, 0.75, 1], [r"$\infty$", "$4$", "$2$", "$4/3$", "$1$"])
    ax.set(xlim=(0, 1), ylim=(0, None), xlabel="$q$ (in steps of $1/q$)", ylabel="least mean norm, rad/s³")
