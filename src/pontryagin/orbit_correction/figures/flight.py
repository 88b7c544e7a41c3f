"""Figures of flights on the nonlinear equations: the deviation left by a plan, and by further plans."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.display.plotting import GREY, INK, styled, subplots
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.flight import ClosedLoop, residuals
from pontryagin.orbit_correction.plan.thrust import THRUSTS


@styled
def nonlinear_residual(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035) -> Figure:
    """The deviation that the nonlinear flight of a plan leaves, against |z0|: a line of slope 2.

    State and peak are scaled together.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation whose multiples are flown.
    interval, peak : float
        As in `correct`.
    """
    figure, ax = subplots(height=3.3)
    scales = np.geomspace(1e-5, 10, 25)
    for name in THRUSTS:
        sizes, left = residuals(z0, scales, interval, peak, name)
        slope = fitted_slope(sizes, left)
        words = f"{labels.NAMES[name]}: slope {slope:.3f}"
        style = {"color": labels.COLOURS[name], "marker": labels.MARKERS[name], "markersize": 3.5}
        ax.plot(sizes, left, linewidth=1.0, label=words, **style)
    ends = np.array([1e-6, 1e-1])
    ax.plot(ends, 3 * ends**2, "--", color=INK, linewidth=0.9, label=r"$3\,|z_0|^2$")
    ax.axhline(2**-53, color=GREY, linewidth=0.8)
    ax.annotate("rounding", (sizes[-1], 2**-53), (0, 3), textcoords="offset points", ha="right")
    ax.set(xscale="log", yscale="log", xlabel=labels.DEVIATION, ylabel="left after the plan")
    ax.legend()
    return figure


def fitted_slope(sizes: np.ndarray, left: np.ndarray) -> float:
    """Slope of log(left) against log(size) where the deviation left is well above rounding."""
    clear = left > 1e-12
    return float(np.polyfit(np.log(sizes[clear]), np.log(left[clear]), 1)[0])


@styled
def replanning(loops: Mapping[str, ClosedLoop]) -> Figure:
    """The deviation after each plan of a closed loop, against the impulses fired so far.

    Parameters
    ----------
    loops : mapping of str to ClosedLoop
        By the name of the set of impulses.
    """
    figure, ax = subplots(height=3.0)
    for name, loop in loops.items():
        fired = np.concatenate([[0], np.cumsum(loop.impulse_counts)])
        left = np.maximum(loop.residuals, 2**-56)
        style = {"color": labels.COLOURS[name], "marker": labels.MARKERS[name]}
        ax.plot(fired, left, label=labels.NAMES[name], **style)
    ax.axhline(2**-53, color=GREY, linewidth=0.8)
    ax.annotate("rounding of a number near 1", (0, 2**-53), (0, 3), textcoords="offset points")
    ax.set(yscale="log", xlabel="impulses fired", ylabel="deviation left")
    labels.whole_numbers(ax)
    ax.legend()
    return figure
