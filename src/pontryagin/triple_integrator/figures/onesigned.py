"""Programmes of one sign with the same total impulse, among them the limit of least L_q norm for q -> 1."""

from collections.abc import Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from pontryagin.display.plotting import GREEN, INK, ORANGE, SEQUENTIAL, styled, subplots
from pontryagin.triple_integrator.figures import labels
from pontryagin.triple_integrator.figures.programmes import draw_impulses
from pontryagin.triple_integrator.norms.entropy import maximum_entropy
from pontryagin.triple_integrator.norms.impulse import minimum_impulse
from pontryagin.triple_integrator.norms.norm import minimum_norm
from pontryagin.triple_integrator.problem.maneuver import Maneuver


@styled
def equally_cheap(maneuver: Maneuver, exponents: Sequence[float] = (2.0, 1.3, 1.03)) -> Figure:
    """The two impulses of `minimum_impulse`, L_q programmes for q near 1, the control of greatest entropy.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre whose moments lie inside the moment cone.
    exponents : sequence of float
        The exponents q, in falling order.
    """
    labels.single(maneuver)
    impulse, entropy = minimum_impulse(maneuver), maximum_entropy(maneuver)
    figure, ax = subplots(height=3.1)
    t = np.linspace(float(maneuver.t0), float(maneuver.tf), 601)
    paint = mpl.colormaps[SEQUENTIAL]
    ax.axhline(0, color=INK, linewidth=0.6)
    for place, q in enumerate(exponents):
        ax.plot(
            t, minimum_norm(maneuver, q).control(t), color=paint(0.15 + 0.6 * place / len(exponents)),
            label=f"least $L_q$ norm, $q = {q:g}$",
        )  # fmt: skip
    ax.plot(
        t, entropy.control(t), color=ORANGE, linewidth=2.6, linestyle=(0, (4, 2)), label="greatest entropy"
    )
    ax.plot([], [], color=GREEN, linewidth=2, label="two impulses, rad/s²")
    draw_impulses(ax, impulse.impulse_times, impulse.impulses, 2.3 * float(np.abs(entropy.peak)), GREEN)
    ax.set(xlabel=labels.TIME, ylabel=labels.CONTROL)
    ax.set_ylim(min(0.0, *ax.get_ylim()) * 0.1, None)
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
