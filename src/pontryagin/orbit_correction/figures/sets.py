"""Controllable sets in space, in a frame that stretches them to unit size."""

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D

from pontryagin.orbit_correction import sets
from pontryagin.orbit_correction.flight import single
from pontryagin.orbit_correction.plan import Plan
from pontryagin.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, WIDTH, styled

SHADES = (PURPLE, GREEN, BLUE, SKY, RED, INK)


@styled
def controllable_sets(plan: Plan) -> Figure:
    """The sets X(1, 0) ... X(N, 0), the states of the plan and their adjoint vectors -psi.

    Parameters
    ----------
    plan : Plan
        Of one state, at least one step.

    Raises
    ------
    ValueError
        If the plan is that of a stack, or of no step.
    """
    steps = _steps(plan)
    square, factors = plan.thrust.name == "box", plan.thrust.factors(steps)
    frame = sets.frame_of(factors, square)
    figure = Figure(figsize=(WIDTH, 4.6))
    figure.set_layout_engine("none")
    ax = Axes3D(figure, (-0.06, 0.0, 0.78, 1.0), computed_zorder=False)
    figure.add_axes(ax)
    normals = frame.back(sets.sphere_grid(20, 40))
    for count in range(steps, 0, -1):
        surface = frame.points(sets.support_points(factors[:count], normals, square))
        shade = SHADES[(count - 1) % len(SHADES)]
        name = rf"$X({count}, 0)$"
        _net(ax, surface, shade, name, 0.8)
    path = frame.points(plan.states)
    _arrows(ax, path[:-1], -frame.normals(plan.costates), 0.55)
    ax.plot(*path.T, "o-", color=INK, markersize=4, linewidth=1.4, label=r"states $x^*(k)$")
    for k, (x, y, z) in enumerate(path):
        ax.text(x + 0.06, y, z + 0.06, f"{k}", color=INK)
    ax.plot([], [], color=ORANGE, linewidth=1.8, label=r"$-\psi(k)$, normal")
    _dress(ax)
    ax.view_init(20, -50)
    handles, names = ax.get_legend_handles_labels()
    figure.legend(handles, names, loc="upper left", bbox_to_anchor=(0.7, 0.9))
    figure.text(0.7, 0.36, _description(frame), va="top", fontsize=9.5, linespacing=1.5)
    return figure


@styled
def remaining_sets(plan: Plan) -> Figure:
    """At each step the set alpha X(N - k, k), the state on its boundary, and the normal -psi(k) there.

    Each panel has a frame of its own, in which its set has unit size.

    Parameters
    ----------
    plan : Plan
        Of one state, with one to six steps, under the ball.

    Raises
    ------
    ValueError
        If the plan is that of a stack, or its number of steps is another.
    """
    steps = _steps(plan)
    if steps > 6 or plan.thrust.name != "ball":
        raise ValueError(f"plan must be for the ball and of at most 6 steps, got {plan.thrust.name}, {steps}")
    figure = Figure(figsize=(WIDTH, 2.5 * -(-steps // 4)), layout="constrained")
    normals = sets.sphere_grid(12, 24)
    for k in range(steps):
        ax = figure.add_subplot(-(-steps // 4), min(steps, 4), k + 1, projection="3d", computed_zorder=False)
        factors = plan.gauge * _at_step(plan, steps, k)
        frame = sets.frame_of(factors, square=False)
        surface = frame.points(sets.support_points(factors, frame.back(normals), False))
        ax.plot_surface(*np.moveaxis(surface, -1, 0), color=SKY, alpha=0.25, linewidth=0, shade=False)
        _net(ax, surface, BLUE, "", 0.5)
        state, normal = frame.points(plan.states[k]), -frame.normals(plan.costates[k])
        _arrows(ax, state[None], normal[None], 0.9)
        ax.plot(*state[:, None], "o", color=INK, markersize=4)
        _dress(ax)
        ax.set(xticklabels=[], yticklabels=[], zticklabels=[], xlabel="", ylabel="", zlabel="")
        sides = [f"${_power(value)}$" for value in frame.extents]
        ax.set_title(f"$k = {k}$: half-widths\n{sides[0]},\n{sides[1]},\n{sides[2]}", fontsize=9)
        ax.view_init(22, *_towards(normal))
    return figure


def _at_step(plan: Plan, steps: int, k: int) -> np.ndarray:
    """Factors whose sum is X(N - k, k) as the paper counts its steps."""
    carried = np.eye(3)
    for before in range(k):
        carried = plan.thrust.step_transition(before) @ carried
    return np.asarray(carried @ plan.thrust.factors(steps)[k:])


def _steps(plan: Plan) -> int:
    steps = int(single(plan).steps)
    if steps == 0:
        raise ValueError("plan must have a step, got that of no deviation")
    return steps


def _net(ax: Axes3D, surface: np.ndarray, colour: str, name: str, alpha: float) -> None:
    x, y, z = np.moveaxis(surface, -1, 0)
    ax.plot_wireframe(x, y, z, rcount=10, ccount=16, color=colour, linewidth=0.5, alpha=alpha)
    if name:
        ax.plot([], [], color=colour, label=name)


def _arrows(ax: Axes3D, starts: np.ndarray, directions: np.ndarray, length: float) -> None:
    ax.quiver(
        *starts.T, *(length * directions).T, color=ORANGE, linewidth=1.8, arrow_length_ratio=0.25, zorder=9
    )


def _dress(ax: Axes3D) -> None:
    ax.set_box_aspect((1, 1, 1))
    ax.set(xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), zlim=(-1.1, 1.1))
    for number, axis in enumerate((ax.xaxis, ax.yaxis, ax.zaxis), start=1):
        axis.set_ticks([-1, 0, 1])
        axis.set_label_text(f"axis {number}")


def _description(frame: sets.Frame) -> str:
    lines = []
    for number, (row, extent) in enumerate(zip(frame.axes, frame.extents, strict=True), start=1):
        direction = ", ".join(f"{value:.2f}".replace("-", "−") for value in row)
        lines += [f"axis {number}: along ({direction}),", f"    1 is ${_power(extent)}$"]
    return "\n".join(lines)


def _power(value: float) -> str:
    mantissa, exponent = f"{value:.1e}".split("e")
    return rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def _towards(normal: np.ndarray) -> tuple[float]:
    """Azimuth from which the normal is seen from the side."""
    return (float(np.degrees(np.arctan2(normal[1], normal[0]))) + 65,)
