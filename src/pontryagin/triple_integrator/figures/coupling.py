"""How fast the iteration over the cross-coupling of three channels settles, and from what angle on it does not."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from pontryagin.plotting import BLUE, INK, RED, SEQUENTIAL, styled, subplots
from pontryagin.triple_integrator.coupling import CoupledManeuver, spherical_factor


@styled
def coupling_convergence(turns: Sequence[CoupledManeuver]) -> Figure:
    """What each iterate misses of the target, and the factor between iterates against the angle of the turn.

    Parameters
    ----------
    turns : sequence of CoupledManeuver
        Turns from rest to rest by increasing angles, that settled.
    """
    import matplotlib as mpl

    figure, (left, right) = subplots(1, 2, height=3.4, width_ratios=(1.15, 1))
    angles = np.array([_angle(turn) for turn in turns])
    for turn, angle in zip(turns, angles, strict=True):
        paint = mpl.colormaps[SEQUENTIAL](0.85 * angle / angles.max())
        left.semilogy(turn.misses, "o-", color=paint, markersize=3, label=f"{np.rad2deg(angle):.0f}°")
    left.set(xlabel="iteration", ylabel="miss of the target, rad")
    left.legend(title="angle", loc="upper right")
    every = np.linspace(0.01, 2.6, 300)
    right.axhspan(1, 2, color=RED, alpha=0.08, linewidth=0)
    right.text(8, 1.03, "leads away", color=RED, va="bottom")
    right.plot(np.rad2deg(every), spherical_factor(every), color=INK, label="spherical body, exact")
    right.plot(np.rad2deg(angles), [turn.factor for turn in turns], "o", color=BLUE, label="this body")
    right.set(xlabel="angle of the turn, degrees", ylabel="factor per iteration")
    right.set(xlim=(0, np.rad2deg(every[-1])), ylim=(0, 1.6))
    right.legend(loc="lower right")
    return figure


def _angle(turn: CoupledManeuver) -> float:
    """Angle of the rotation vector that the channels are to reach."""
    return float(np.linalg.norm([programme.maneuver.xf[0] for programme in turn.programmes]))
