"""The convex equation for the level of the least-peak control, and the functions that its roots give."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.optimize import brentq

from pontryagin.arrays import Array
from pontryagin.display.plotting import INK, RED, SKY, styled, subplots
from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.figures import labels
from pontryagin.triple_integrator.kernels import level_equation
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver


@styled
def convex_level_equation(maneuver: Maneuver) -> Figure:
    """G(t), t = 1/v, with a root on either side of zero, and the function of the time to go for each root.

    The function is v on [0, T] minus 2 v on the inner interval. If that interval reaches beyond [0, T], the
    function is not a control.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre whose G has two roots.

    Raises
    ------
    ValueError
        If the manoeuvre is a stack, the control is constant, or G has only one root.
    """
    labels.single(maneuver)
    T = float(maneuver.duration)
    k = maneuver.moments * np.array([6 / T**3, 2 / T**2, 1 / T])
    nearer, farther = _roots(float(minimum_peak(maneuver).levels), k)
    figure, (left, right) = subplots(1, 2, height=3.3, width_ratios=(1.25, 1))
    _draw_equation(left, k, nearer, farther)
    for root, colour in ((farther, SKY), (nearer, RED)):
        right.step(*_function_of(root, k, T), where="post", color=colour)
    right.axhline(0, color=INK, linewidth=0.6)
    right.axvspan(0, T, color=INK, alpha=0.06, linewidth=0)
    right.set(xlabel="time to go $s$, s", ylabel="control, rad/s³")
    right.text(T / 2, 1.0, "manoeuvre", transform=right.get_xaxis_transform(), ha="center", va="bottom")
    return figure


def _draw_equation(ax: Axes, k: Array, nearer: float, farther: float) -> None:
    low, high = sorted((nearer, farther))
    margin = 0.45 * (high - low)
    pole = 1 / k[2] if k[2] else np.inf
    t = np.linspace(low - margin, high + 2 * margin if nearer == low else high + margin, 500)
    t = t[1 - k[2] * t > 0.02]
    ax.plot(t, level_equation(t, *k)[0], color=INK)
    ax.axhline(0, color=INK, linewidth=0.6)
    if low - margin < pole < high + margin:
        ax.axvline(pole, color=INK, linewidth=0.8, linestyle=":")
    inward = 1 if nearer == low else -1
    marks = (
        (nearer, RED, f"nearer root:\nleast peak\n$v = {1 / nearer:.3g}$", inward, 10),
        (farther, SKY, f"farther root:\nno control\n$v = {1 / farther:.3g}$", inward, -8),
    )
    for root, colour, words, side, rise in marks:
        ax.plot(root, 0, "o", color=colour, markersize=7)
        ax.annotate(
            words, (root, 0), xytext=(5 * side, rise), textcoords="offset points", fontsize=9.5,
            ha="left" if side > 0 else "right", va="bottom" if rise > 0 else "top",
            color=colour if colour == RED else INK,
        )  # fmt: skip
    ax.plot(0, level_equation(0.0, *k)[0], "o", color=INK, markersize=4)
    ax.annotate(
        "$G(0) = -3/16$", (0, -3 / 16), xytext=(-7, -3), textcoords="offset points", ha="right", va="top"
    )
    ax.set(xlabel="$t = 1/v$, s³/rad", ylabel="$G(t)$", ylim=(-0.32, 0.75))


def _roots(level: float, k: Array) -> tuple[float, float]:
    """The root of the least peak, and the one on the other side."""
    if not abs(level) > 0 or 1 - k[2] / level < 1e-9:
        raise ArgumentValueError(
            "maneuver must need a control with two switches, got one with a constant control", "maneuver"
        )
    nearer = 1 / level
    side = -np.sign(nearer)
    limit = 0.999 * abs(1 / k[2]) if side * k[2] > 0 else 100 * abs(nearer)
    if level_equation(side * limit, *k)[0] < 0:
        raise ArgumentValueError(
            f"maneuver must give G(t) a root on either side of t = 0, got one root only, t = {nearer:.6g}",
            "maneuver",
        )
    farther = brentq(lambda t: level_equation(t, *k)[0], side * abs(nearer) * 1e-9, side * limit)
    return nearer, float(farther)


def _function_of(root: float, k: Array, T: float) -> tuple[Array, Array]:
    """v on [0, T] minus 2 v on [b, a], as the corners of a step function over [-T, 2T]."""
    y = 1 - k[2] * root
    d, m = y / 2, 1 - (k[1] - k[2]) * root / y
    corners = np.sort([-0.8, 0.0, (m - d) / 2, (m + d) / 2, 1.0, 1.8])
    middles = np.append((corners[1:] + corners[:-1]) / 2, corners[-1])
    inside = (middles > 0) & (middles < 1)
    inner = np.abs(middles - m / 2) < d / 2
    return corners * T, (1.0 * inside - 2.0 * inner) / root
