"""Figures of plans: against time, as hodographs in the square, and plans of equal length side by side."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle
from matplotlib.patheffects import withStroke

from pontryagin.display.plotting import BLUE, GREEN, INK, ORANGE, RED, styled, subplots
from pontryagin.errors import ArgumentValueError
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.plan.alternatives import Alternative, least_energy, least_fuel, least_peak
from pontryagin.orbit_correction.plan.correction import Plan, single
from pontryagin.orbit_correction.system import satellite

MEASURES = {"peak": BLUE, "energy": ORANGE, "fuel": GREEN}


@styled
def plan_figure(plan: Plan) -> Figure:
    """Above: the deviations between the impulses of a plan. Below: the two components of the impulses.

    Parameters
    ----------
    plan : Plan
        Of one state, with at least one impulse.

    Raises
    ------
    ValueError
        If the plan is that of a stack, or of no impulse.
    """
    count = len(single(plan).impulses)
    if count == 0:
        raise ArgumentValueError("plan must have an impulse, got a plan without any", "plan")
    figure, (above, below) = subplots(2, height=4.6, sharex=True, height_ratios=(1.5, 1))
    times, states = linear_path(plan)
    for values, colour, name in zip(states.T, (BLUE, RED, GREEN), labels.STATES, strict=True):
        above.plot(times, values, color=colour, label=name)
    above.axhline(0, color=INK, linewidth=0.6)
    above.set_ylabel("deviation, radii\nand speeds of the orbit")
    above.legend(ncols=3)
    at, width = plan.thrust.interval * np.arange(count), 0.16 * plan.thrust.interval
    for side, (name, colour) in enumerate((("radial", RED), ("transverse", GREEN))):
        heights = plan.impulses[:, side] / plan.thrust.peak
        below.bar(at + (side - 0.5) * width, heights, width, color=colour, label=name)
    below.axhline(0, color=INK, linewidth=0.6)
    below.set(xlabel=labels.TIME, ylabel=r"impulse over $\alpha_{\max}$", ylim=(-1.1, 1.1))
    below.legend(ncols=2, loc="upper right")
    figure.align_ylabels()
    return figure


def linear_path(plan: Plan, samples: int = 30) -> tuple[np.ndarray, np.ndarray]:
    """Times (k,) and deviations (k, 3) of the linear motion, before and after every impulse."""
    grid = np.linspace(0.0, plan.thrust.interval, samples)
    flow = satellite.transition(grid)
    times, states, state = [np.zeros(1)], [plan.z0[None]], plan.z0
    for j, impulse in enumerate(plan.impulses):
        arc = flow @ (state + np.array([0.0, *impulse]))
        times.append(j * plan.thrust.interval + grid)
        states.append(arc)
        state = arc[-1]
    return np.concatenate(times), np.concatenate(states)


@styled
def hodograph(plans: Sequence[Plan]) -> Figure:
    """The impulses of several plans for one state, in the square of admissible impulses and its disc.

    Parameters
    ----------
    plans : sequence of Plan
        One for each panel, each of one state.
    """
    figure, axes = subplots(1, len(plans), height=2.75, sharey=True, squeeze=False)
    for ax, plan in zip(axes[0], plans, strict=True):
        name = single(plan).thrust.name
        points = plan.impulses / plan.thrust.peak
        _square(ax)
        ax.plot(*points.T, color=labels.COLOURS[name], linewidth=0.7, alpha=0.6)
        ax.plot(*points.T, labels.MARKERS[name], color=labels.COLOURS[name], markersize=5)
        for place, words in _numbered(points).items():
            words_at = {"xytext": (5, 4), "textcoords": "offset points", "fontsize": 8.5}
            ax.annotate(
                words, place, path_effects=[withStroke(linewidth=2.5, foreground="#f3f3f3")], **words_at
            )
        ax.set_title(f"{labels.NAMES[name]}: {len(points)} impulses", color=labels.COLOURS[name])
        ax.set_xlabel(r"radial, $w_1/\alpha_{\max}$")
    axes[0, 0].set_ylabel(r"transverse, $w_2/\alpha_{\max}$")
    return figure


def _numbered(points: np.ndarray) -> dict[tuple[float, float], str]:
    """The numbers of the impulses at each place, joined where several impulses are the same."""
    found: dict[tuple[float, float], str] = {}
    for j, point in enumerate(points):
        x, y = (float(value) for value in point.round(3))
        found[x, y] = f"{found[x, y]}, {j}" if (x, y) in found else str(j)
    return found


def _square(ax: Axes) -> None:
    """Draw the square of admissible impulses and its inscribed disc."""
    ax.add_patch(Rectangle((-1, -1), 2, 2, facecolor="#f3f3f3", edgecolor=INK, linewidth=1.0))
    ax.add_patch(Circle((0, 0), 1, facecolor="none", edgecolor=INK, linewidth=0.8, linestyle="--"))
    ax.set(xlim=(-1.15, 1.15), ylim=(-1.15, 1.15), aspect="equal", xticks=(-1, 0, 1), yticks=(-1, 0, 1))


def same_length(plan: Plan) -> tuple[Alternative, Alternative, Alternative]:
    """The plans of least peak, energy and fuel with as many impulses as one plan."""
    return least_peak(plan), least_energy(plan), least_fuel(plan)


@styled
def alternatives(plan: Plan) -> Figure:
    """Plans of least peak, least energy and least fuel with the same number of impulses.

    Parameters
    ----------
    plan : Plan
        Of one state, with at least one impulse.
    """
    figure, axes = subplots(2, height=3.9, sharex=True, sharey=True)
    width = 0.27
    for place, one in enumerate(same_length(plan)):
        at = np.arange(len(one.impulses)) + (place - 1) * width
        for ax, heights in zip(axes, one.impulses.T / plan.thrust.peak, strict=True):
            ax.bar(at, heights, width, color=MEASURES[one.least], label=f"least {one.least}")
    for ax, name in zip(axes, ("radial", "transverse"), strict=True):
        ax.axhline(0, color=INK, linewidth=0.6)
        ax.set(ylabel=f"{name},\n" + r"over $\alpha_{\max}$", ylim=(-1.1, 1.1))
    labels.whole_numbers(axes[1])
    axes[1].set_xlabel("impulse")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure
