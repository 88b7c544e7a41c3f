"""Figures of 0-controllable sets: in space, scaled to unit size, and edge-on to supporting planes."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.axes3d import Axes3D

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, WIDTH, styled, subplots
from pontryagin.errors import ArgumentValueError
from pontryagin.orbit_correction import sets
from pontryagin.orbit_correction.plan.correction import Plan, single

SHADES = (PURPLE, GREEN, BLUE, SKY, RED, INK)
"""Colours of X(1, 0), X(2, 0), ...; they repeat after six."""

PERCENT = 100.0

VIEWS = ((1, 0), (1, 2))
"""The horizontal and the vertical axis of each plane view."""


@styled
def controllable_sets(plan: Plan) -> Figure:
    """The sets X(1, 0) ... X(N, 0), the states of the plan and their adjoint vectors -psi.

    Left: in space. Right: their outlines, seen along two of the axes.

    Parameters
    ----------
    plan : Plan
        A plan of one state, with at least one step.

    Raises
    ------
    ValueError
        If the plan is that of a stack, or of no step.
    """
    steps = _steps(plan)
    square, factors = plan.thrust.name == "box", plan.thrust.factors(steps)
    frame = sets.frame_of(factors, square)
    figure = Figure(figsize=(WIDTH, 4.9))
    figure.set_layout_engine("none")
    space = Axes3D(figure, (-0.05, 0.13, 0.68, 0.81), computed_zorder=False)
    figure.add_axes(space)
    planes = [figure.add_axes((0.7, 0.63 - 0.48 * row, 0.29, 0.35)) for row in range(2)]
    normals = frame.back(sets.sphere_grid(40, 80))
    for count in range(steps, 0, -1):
        shade = SHADES[(count - 1) % len(SHADES)]
        surface = frame.points(sets.support_points(factors[:count], normals, square))
        x, y, z = np.moveaxis(surface, -1, 0)
        space.plot_surface(x, y, z, color=shade, alpha=0.16, linewidth=0, rcount=40, ccount=80)
        for ax, (across, up) in zip(planes, VIEWS, strict=True):
            outline = _outline(factors[:count], frame.back(np.eye(3)[[across, up]]), square)
            ax.fill(*frame.points(outline)[:, [across, up]].T, facecolor=shade, alpha=0.16)
            ax.plot(*frame.points(outline)[:, [across, up]].T, color=shade, linewidth=1.2)
        space.plot([], [], color=shade, linewidth=5, alpha=0.6, label=rf"$X({count}, 0)$")
    path, towards = frame.points(plan.states), -0.55 * frame.normals(plan.costates)
    space.quiver(*path[:-1].T, *towards.T, color=ORANGE, linewidth=1.8, arrow_length_ratio=0.25, zorder=9)
    space.plot(*path.T, "o-", color=INK, markersize=4, linewidth=1.4, label=r"states $x^*(k)$")
    space.plot([], [], color=ORANGE, linewidth=1.8, label=r"$-\psi(k)$")
    for ax, view in zip(planes, VIEWS, strict=True):
        _plane(ax, path[:, view], towards[:, view])
        ax.set(xlabel=f"axis {view[0] + 1}", ylabel=f"axis {view[1] + 1}")
    for k, (x, y, z) in enumerate(path):
        space.text(x - 0.16, y, z + 0.03, f"{k}", color=INK)
    _dress(space)
    space.view_init(20, -50)
    figure.legend(
        *space.get_legend_handles_labels(),
        loc="upper left",
        bbox_to_anchor=(0.0, 1.01),
        ncols=2,
        columnspacing=1.0,
    )
    figure.text(0.02, 0.115, _description(frame), va="top", fontsize=9.5, linespacing=1.35)
    return figure


@styled
def remaining_sets(plan: Plan) -> Figure:
    """At each step the set alpha X(N - k, k), the state on its boundary, and the normal -psi(k) there.

    By Theorem 1 for the system (7), and Theorem 4, the states stay on these boundaries. Each set is seen
    along its supporting plane at the state, all on the same scale.

    Parameters
    ----------
    plan : Plan
        Of one state, with one to six steps.

    Raises
    ------
    ValueError
        If the plan is that of a stack, or has no step or more than six.
    """
    steps = _steps(plan)
    if steps > 6:
        raise ArgumentValueError(f"plan must have at most 6 steps, got {steps}", "plan")
    figure, grid = subplots(1, steps, height=3.25, sharey=True, squeeze=False)
    axes, square = grid[0], plan.thrust.name == "box"
    for k, ax in enumerate(axes):
        factors = _at_step(plan, steps, k)
        seen = edge_on(factors, -plan.costates[k])
        outline = PERCENT * _outline(factors, seen, square) @ seen.T
        state = PERCENT * plan.states[k] @ seen.T
        ax.plot(*outline.T, "--", color=BLUE, linewidth=0.9, label="$X(N - k, k)$")
        ax.fill(*(plan.gauge * outline).T, facecolor=SKY, edgecolor=BLUE, label=r"$\alpha X(N - k, k)$")
        ax.axvline(state[0], color=INK, linewidth=0.8)
        look = {"arrowstyle": "-|>", "color": ORANGE, "shrinkA": 0, "shrinkB": 0, "lw": 1.6}
        ax.annotate("", (state[0] + 0.7, state[1]), state, arrowprops=look)
        ax.plot(*state, "o", color=INK, markersize=4, label="$x^*(k)$")
        ax.plot([], [], color=ORANGE, label=r"$-\psi(k)$")
        ax.set(aspect="equal", title=f"$k = {k}$", xlabel=rf"along $-\psi({k})$, $10^{{-2}}$")
    reach = max(ax.get_xlim()[1] for ax in axes) + 0.65
    for ax in axes:
        ax.set_xlim(-reach, reach)
    axes[0].set_ylabel("across, $10^{-2}$")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def edge_on(factors: Array, normal: Array) -> Array:
    """Two unit vectors (2, 3): along the normal, and across it where the sum of G_k U is widest.

    Examples
    --------
    >>> edge_on(np.diag([1.0, 3.0, 2.0])[None], np.array([0.0, 2.0, 0.0])).round(12).tolist()
    [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    along = normal / np.linalg.norm(normal)
    flat = factors - along[:, None] * np.einsum("i,kij->kj", along, factors)[:, None]
    across = np.linalg.eigh(np.einsum("kij,klj->il", flat, flat))[1][:, -1]
    return np.stack([along, across * np.sign(across[np.abs(across).argmax()])])


def _outline(factors: Array, plane: Array, square: bool) -> Array:
    """Support points (361, 3) whose normals lie in a plane: the outline of a set projected on the plane."""
    turn = np.linspace(0, 2 * np.pi, 361)
    return sets.support_points(factors, np.column_stack([np.cos(turn), np.sin(turn)]) @ plane, square)


def _plane(ax: Axes, path: Array, towards: Array) -> None:
    """Draw the states and their adjoint vectors in one of the plane views."""
    ax.plot(*path.T, "o-", color=INK, markersize=3, linewidth=1.1)
    for k, (start, step) in enumerate(zip(path, towards, strict=False)):
        look = {"arrowstyle": "-|>", "color": ORANGE, "mutation_scale": 7, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", start + step, start, arrowprops=look)
        ax.annotate(f"{k}", start - 0.19 * step / np.linalg.norm(step), ha="center", va="center", fontsize=8)
    ax.set(aspect="equal", xlim=(-1.15, 1.25), ylim=(-1.15, 1.15), xticks=[-1, 0, 1], yticks=[-1, 0, 1])


def _at_step(plan: Plan, steps: int, k: int) -> Array:
    """Factors whose sum is X(N - k, k), for steps as the paper counts them."""
    carried = np.eye(3)
    for before in range(k):
        carried = plan.thrust.step_transition(before) @ carried
    return np.asarray(carried @ plan.thrust.factors(steps)[k:])


def _steps(plan: Plan) -> int:
    """The number of steps of a plan of one state, at least one."""
    steps = int(single(plan).steps)
    if steps == 0:
        raise ArgumentValueError("plan must have a step, got a plan without any", "plan")
    return steps


def _dress(ax: Axes3D) -> None:
    """Equal scales and named axes."""
    ax.set_box_aspect((1, 1, 1))
    ax.set(xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), zlim=(-1.1, 1.1))
    for number, axis in enumerate((ax.xaxis, ax.yaxis, ax.zaxis), start=1):
        axis.set_ticks([-1, 0, 1])
        axis.set_label_text(f"axis {number}")


def _description(frame: sets.Frame) -> str:
    """Direction and unit of each axis, in lines of text."""
    lines = []
    for number, (row, extent) in enumerate(zip(frame.axes, frame.extents, strict=True), start=1):
        direction = ", ".join(f"{value:.2f}".replace("-", "−") for value in row)
        lines.append(f"axis {number}: along ({direction}), 1 is ${_power(extent)}$")
    return "\n".join(lines)


def _power(value: float) -> str:
    """A number as a mantissa times a power of ten, in LaTeX."""
    mantissa, exponent = f"{value:.1e}".split("e")
    return rf"{mantissa}\cdot 10^{{{int(exponent)}}}"
