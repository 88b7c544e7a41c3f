"""Controls and the motions that they cause, for one solution or three side by side."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.display.plotting import INK, styled, subplots
from pontryagin.triple_integrator.figures import labels
from pontryagin.triple_integrator.figures.labels import Solution
from pontryagin.triple_integrator.norms.impulse import ImpulseSolution
from pontryagin.triple_integrator.problem.maneuver import Maneuver


@styled
def three_programmes(maneuver: Maneuver) -> Figure:
    """Control and states of the least energy, the least peak and the least impulse, side by side.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre.

    Examples
    --------
    >>> three_programmes(Maneuver([0, 0, 0], [1, 0, 0], tf=1.0)).get_label()
    'three-programmes'
    """
    solutions: list[Solution] = [*labels.three(maneuver)]
    figure, axes = subplots(4, 3, height=6.6, sharex=True, sharey="row")
    for column, solution in zip(axes.T, solutions, strict=True):
        column[0].set_title(
            f"{labels.name(solution)}\n{labels.value(solution)}", color=labels.colour(solution)
        )
        draw_control(column[0], solution, peak=max(finite_peak(s) for s in solutions))
        for state, ax in zip((2, 1, 0), column[1:], strict=True):
            draw_state(ax, solution, state)
        column[-1].set_xlabel(labels.TIME)
    axes[0, 0].set_ylabel(labels.CONTROL)
    for state, ax in zip((2, 1, 0), axes[1:, 0], strict=True):
        ax.set_ylabel(labels.STATES[state])
    figure.align_ylabels(axes[:, 0])
    return figure


@styled
def solution_figure(solution: Solution) -> Figure:
    """Control and states of one solution against time.

    Parameters
    ----------
    solution : EnergySolution, PeakSolution, ImpulseSolution, NormSolution or TimeSolution
        What a solver returned for one manoeuvre.

    Raises
    ------
    ValueError
        If the solution is that of a stack.
    """
    labels.single(solution)
    figure, axes = subplots(2, 2, height=4.6, sharex=True)
    panels = axes.ravel()
    draw_control(panels[0], solution, finite_peak(solution))
    panels[0].set_ylabel(labels.CONTROL)
    if isinstance(solution, ImpulseSolution):
        panels[0].set(ylabel="impulses of $u$, rad/s²", yticks=[0.0])
    for ax, state in zip(panels[1:], (2, 1, 0), strict=True):
        draw_state(ax, solution, state)
        ax.set_ylabel(labels.STATES[state])
    for ax in axes[-1]:
        ax.set_xlabel(labels.TIME)
    figure.suptitle(f"{labels.name(solution)}: {labels.value(solution)}", color=labels.colour(solution))
    return figure


def draw_control(ax: Axes, solution: Solution, peak: float) -> None:
    """Draw u(t); impulses are arrows in proportion to their size, the largest as high as `peak`."""
    t = labels.instants(solution)
    u, colour = solution.control(t), labels.colour(solution)
    ax.axhline(0, color=INK, linewidth=0.6)
    if isinstance(solution, ImpulseSolution):
        draw_impulses(ax, solution.impulse_times, solution.impulses, peak, colour)
    else:
        ax.plot(t, u, color=colour)
        ax.fill_between(t, u, color=colour, alpha=0.12, linewidth=0)
    m = solution.maneuver
    margin = 0.08 * float(m.duration)
    ax.set_xlim(float(m.t0) - margin, float(m.tf) + margin)


def draw_impulses(
    ax: Axes,
    times: Sequence[float] | Array,
    sizes: Sequence[float] | Array,
    peak: float,
    colour: str,
) -> None:
    """Draw impulses as arrows from the axis, each with its size in rad/s²."""
    present = [(time, size) for time, size in zip(times, sizes, strict=True) if size]
    largest = max((abs(size) for _, size in present), default=1.0)
    for time, size in present:
        height = 0.85 * peak * size / largest
        arrow = {"arrowstyle": "-|>,head_length=0.5,head_width=0.2", "color": colour, "linewidth": 2.0}
        ax.annotate("", (time, height), (time, 0), arrowprops={**arrow, "shrinkA": 0, "shrinkB": 0})
        ax.annotate(
            f"${labels.number(size)}$",
            (time, height),
            xytext=(0, 4 if size > 0 else -4),
            textcoords="offset points",
            ha="center",
            va="bottom" if size > 0 else "top",
            color=colour,
            fontsize=9.5,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.8},
        )
    ax.update_datalim([(times[0], -1.1 * peak), (times[0], 1.1 * peak)] if present else [])
    ax.autoscale_view()


def draw_state(ax: Axes, solution: Solution, state: int) -> None:
    """Draw one of x1, x2, x3 against time, with its ends; x3 includes its jumps at impulses."""
    m = solution.maneuver
    t = labels.instants(solution)
    x = solution.state(t)[:, state]
    if state == 2:
        ax.axhline(0, color=INK, linewidth=0.6)
    ax.plot(t, x, color=labels.colour(solution))
    ends = [float(m.t0), float(m.tf)], [m.x0[state], m.xf[state]]
    ax.plot(*ends, "o", color=INK, markersize=4, clip_on=False)


def finite_peak(solution: Solution) -> float:
    """Largest finite modulus of a control; 1 where it is zero or consists of impulses."""
    u = np.abs(solution.control(labels.instants(solution)))
    return float(np.max(u[np.isfinite(u)], initial=0.0)) or 1.0
