"""Figures of false meetings: residuals as small as those of true meetings, and the distance missed."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.display.plotting import (
    BLUE,
    GREY,
    INK,
    RED,
    WIDTH,
    styled,
    subplots,
)
from pontryagin.rendezvous.false_meetings.family import FalseFamily
from pontryagin.rendezvous.false_meetings.meeting import RotatedMeeting
from pontryagin.rendezvous.false_meetings.printed_conditions import printed_jacobian
from pontryagin.rendezvous.false_meetings.rotated_target import in_one_plane
from pontryagin.rendezvous.figures.labels import CRAFT, ROTATED, TARGET, THRUST, power
from pontryagin.rendezvous.figures.orbit import equal
from pontryagin.rendezvous.figures.paths import flight_path, rotated_orbit, target_at, target_orbit
from pontryagin.rendezvous.reduced.solution import Extremal

COLUMNS = 3
"""Number of panels in a row."""
FLOOR = 1e-18
"""Value at which smaller singular values are drawn, since they are 0 to rounding."""


@styled
def false_meetings(family: FalseFamily) -> Figure:
    """A panel for each member: the craft's path, the target's place at t_k, and the residuals.

    The dashed orbit is the target's, rotated about nu*: the craft is on it at t_k.
    """
    rows = -(-len(family.members) // COLUMNS)
    figure = Figure(figsize=(WIDTH, 2.85 * rows + 0.5), layout="constrained")
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 0.97))
    space = not in_one_plane(family.solution.problem.scaled)
    for number, member in enumerate(family.members, 1):
        ax = figure.add_subplot(rows, COLUMNS, number, projection="3d" if space else None)
        _panel(ax, member, 3 if space else 2)
        ax.set_title(_title(member), fontsize=9.5, linespacing=1.25)
    figure.legend(
        *figure.axes[-1].get_legend_handles_labels(), loc="outside lower center", ncols=3, columnspacing=1.2
    )
    return figure


def _title(member: RotatedMeeting) -> str:
    angle = f"turned by ${np.degrees(member.angle):.0f}$°" if member.angle else "the true meeting"
    distance = f"{member.distance:.2f}" if member.distance > 1e-6 else power(member.distance)
    cost = f"$J = {member.cost:.4f}$"
    return f"{angle}, {cost}\nprinted conditions leave {power(member.printed)}\nmisses by {distance}"


def _panel(ax: Axes, member: RotatedMeeting, axes: int) -> None:
    problem = member.problem
    _, places, _ = flight_path(problem, member.flight)
    target, place = target_orbit(problem), target_at(problem, member.duration)
    rotated = rotated_orbit(problem, member.turn)
    ax.plot(*target.T[:axes], color=TARGET, linewidth=1.0, label="orbit of the target")
    ax.plot(*rotated.T[:axes], "--", color=ROTATED, linewidth=1.0, label="target's orbit, turned")
    ax.plot(*places.T[:axes], color=CRAFT, linewidth=1.3, label="way of the craft")
    gap = np.array([places[-1], place])
    ax.plot(*gap.T[:axes], ":", color=THRUST, linewidth=1.6, label="distance missed")
    ax.plot(*place[None].T[:axes], "*", color=TARGET, markersize=11, label="target at $t_k$")
    ax.plot(*places[-1:].T[:axes], "o", color=CRAFT, markersize=5, label="craft at $t_k$")
    ax.plot(*np.zeros((axes, 1)), "+", color=INK, markersize=6)
    if axes == 3:
        equal(ax, np.vstack([target, rotated, places]))
    else:
        ax.set_aspect("equal")
    ax.set_axis_off()


@styled
def missed(family: FalseFamily) -> Figure:
    """Along the curve: the residuals of the printed conditions and of (6), the distance missed, the cost."""
    figure, axes = subplots(3, height=5.6, sharex=True)
    turns = np.degrees(family.angles)
    true = family.distances < 1e-6
    axes[0].semilogy(
        turns, np.maximum(family.printed, 1e-17), ".", color=BLUE, label="(5), (15), (16), (17), as printed"
    )
    axes[0].semilogy(
        turns, np.maximum(family.mismatches, 1e-17), ".", color=RED, label="(6), angle in radians"
    )
    axes[0].set(ylabel="residual", ylim=(1e-17, 1e3))
    axes[0].legend(loc="center", ncols=2)
    axes[1].plot(turns, family.distances, color=RED)
    axes[1].plot(turns[true], family.distances[true], "o", color=BLUE)
    axes[1].set(ylabel="distance missed")
    axes[2].plot(turns, family.costs, color=RED, label="false meetings")
    axes[2].plot(turns[true], family.costs[true], "o", color=BLUE, label="true meetings")
    plane = in_one_plane(family.solution.problem.scaled)
    about = "the normal of the plane" if plane else r"$\nu^*$"
    axes[2].set(ylabel="cost $J$", xlabel=rf"turn of $\lambda(t_k)$ about {about} [°]")
    axes[2].legend(loc="best")
    tick = 90 if np.ptp(turns) > 180 else 10
    for ax in axes:
        ax.set_xticks(np.arange(np.ceil(turns.min() / tick), np.floor(turns.max() / tick) + 1) * tick)
    figure.align_ylabels(axes)
    return figure


@styled
def singular_values(solutions: Mapping[str, Extremal]) -> Figure:
    """Singular values of the printed and of the repaired conditions' Jacobian, over the largest one."""
    figure, ax = subplots(height=0.75 + 0.55 * len(solutions))
    for row, extremal in enumerate(solutions.values()):
        for jacobian, colour, shift, marker, name in (
            (printed_jacobian(extremal.flight), RED, 0.16, "o", "printed: (5), (15), (16), (17)"),
            (extremal.root.equations.jacobian, BLUE, -0.16, "s", "repaired: (5), (6), law at the end"),
        ):
            values = np.linalg.svd(jacobian, compute_uv=False)
            shown = np.maximum(values / values[0], FLOOR)
            ax.semilogx(
                shown,
                np.full(len(shown), row + shift),
                marker,
                color=colour,
                markerfacecolor="white" if marker == "o" else colour,
                label="" if row else name,
            )
    ax.axvspan(FLOOR / 3, 1e-15, color=GREY, alpha=0.14, linewidth=0, zorder=0)
    ax.text(1.5e-18, len(solutions) - 0.62, "zero to rounding", va="bottom", fontsize=9.5)
    ax.set_yticks(range(len(solutions)), list(solutions))
    ax.set(ylim=(-0.6, len(solutions) - 0.2), xlim=(FLOOR / 3, 3), xlabel="singular value over the largest")
    figure.legend(loc="outside upper center", ncols=2)
    return figure
