"""Figures and tables of the rendezvous in Sapunkov's elements."""

import itertools
import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALETTE,
    RED,
    SEQUENTIAL,
    styled,
    subplots,
)
from pontryagin.errors import NotConverged
from pontryagin.io.kept_results import kept
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.elements.flight import switching
from pontryagin.rendezvous.elements.least_fuel import least_fuel
from pontryagin.rendezvous.elements.solution import ElementsExtremal
from pontryagin.rendezvous.elements.solve import solve_in_elements
from pontryagin.rendezvous.figures.labels import saturated_arcs
from pontryagin.rendezvous.judge.table import (
    MESHES,
    direct_results,
)
from pontryagin.rendezvous.problem.cases import (
    cases,
    fuel_cases,
)
from pontryagin.rendezvous.reduced.solution import Extremal

TIME = r"time $t$"
SHADE = 0.28
"""Opacity of the shade behind arcs with thrust."""
SAMPLES = 601
"""Number of times at which a series is drawn."""


@styled
def elements_along(solution: ElementsExtremal) -> Figure:
    """A, B and the spinor u against time; arcs with thrust are shaded.

    Examples
    --------
    >>> from pontryagin.rendezvous.problem.cases import case
    >>> elements_along(solve_in_elements(case("circle-energy").problem)).get_label()
    'elements-along'
    """
    t = np.linspace(0.0, solution.duration, SAMPLES)
    elements = solution.elements(t)
    panels = ((elements.u, "u"), (np.asarray(elements.A), "A"), (np.asarray(elements.B), "B"))
    figure, axes = subplots(3, sharex=True, height=5.6)
    for ax, (values, name) in zip(axes, panels, strict=True):
        _shade_burns(ax, solution)
        draw_components(ax, t, values, name)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=5)
    axes[-1].set_xlabel(TIME)
    axes[-1].set_xlim(0, solution.duration)
    figure.align_ylabels(list(axes))
    return figure


def draw_components(ax: Axes, t: Array, values: Array, name: str) -> None:
    """Draw the four components (k, 4) of a quaternion."""
    for k in range(4):
        ax.plot(t, values[:, k], color=PALETTE[k], label=f"component {k}")
    ax.set_ylabel(f"${name}$")


def _shade_burns(ax: Axes, solution: ElementsExtremal) -> None:
    """Shade the arcs with thrust if there are coasting arcs too."""
    if "coast" not in solution.modes:
        return
    for place, (begin, end) in enumerate(saturated_arcs(solution)):
        label = None if place else "thrust"
        ax.axvspan(begin, end, color=GREY, alpha=SHADE, zorder=0, linewidth=0, label=label)


@styled
def sharpening(solution: ElementsExtremal) -> Figure:
    """|n|/alpha2 and the thrust over its peak, for the smoothed extremals and the one that switches."""
    scaled = solution.problem.scaled
    figure, (above, below) = subplots(2, sharex=True, height=4.6)
    colours = _colours(len(solution.smoothed))
    for root, colour in zip(solution.smoothed, colours, strict=True):
        flight = root.flight
        phi = np.linspace(0.0, flight.phi, SAMPLES)
        states = flight.sample(phi)
        t = states[:, 16] * scaled.time
        above.plot(t, np.linalg.norm(switching(states, phi), axis=1), color=colour, linewidth=1.2)
        thrust = np.linalg.norm(flight.thrust(states, phi), axis=1) / flight.law.peak
        below.plot(t, thrust, color=colour, linewidth=1.2, label=f"width {flight.law.width:.2g}")
    t, size, thrust = _series(solution)
    above.plot(t, size / solution.problem.energy_weight, color=INK, linewidth=2)
    above.axhline(1.0, color=RED, linewidth=0.9, linestyle="--")
    below.plot(t, thrust / solution.problem.peak, color=INK, linewidth=2, label="on or off")
    for ax in (above, below):
        for switch in solution.switch_times:
            ax.axvline(switch, color=RED, linewidth=0.7, linestyle=":")
    above.set_ylabel(r"$|n|/\alpha_2$")
    below.set_ylabel(r"$|p|/p_{\max}$")
    below.set_xlabel(TIME)
    figure.legend(*below.get_legend_handles_labels(), loc="outside right center")
    return figure


def _colours(count: int) -> list[Any]:
    import matplotlib as mpl

    return [mpl.colormaps[SEQUENTIAL](x) for x in np.linspace(0.9, 0.15, count)]


def _series(solution: ElementsExtremal) -> tuple[Array, Array, Array]:
    """Times that include both sides of each switch, and |n| and |p| at them."""
    edges = [0.0, *solution.switch_times, solution.duration]
    nudge = 1e-9 * solution.duration
    parts = [np.linspace(a + nudge, b - nudge, 201) for a, b in itertools.pairwise(edges)]
    t = np.concatenate(parts)
    return t, np.linalg.norm(solution.switching(t), axis=1), np.linalg.norm(solution.control(t), axis=1)


@styled
def two_functionals(energy: ElementsExtremal, fuel: ElementsExtremal) -> Figure:
    """One meeting with the least integral of p^2 and of |p|: paths in the plane, and the thrust."""
    figure, (left, right) = subplots(1, 2, height=3.3, width_ratios=(1, 1.15))
    for solution, colour, name in ((energy, BLUE, r"$\int p^2 dt$"), (fuel, RED, r"$\int |p|\, dt$")):
        t = np.linspace(0.0, solution.duration, SAMPLES)
        place = solution.elements(t).position
        left.plot(*place.T[:2], color=colour, linewidth=1.3)
        times = np.linspace(0.0, solution.duration, 31)
        at, thrust = solution.elements(times).position, solution.control(times)
        left.quiver(
            *at.T[:2], *thrust.T[:2], color=colour, angles="xy", scale_units="xy", scale=0.35, width=0.005
        )
        t, _, size = _series(solution)
        right.plot(t, size, color=colour, label=name)
    ends = fuel.elements([0.0, fuel.duration]).position
    left.plot(*ends[0, :2], "o", color=GREEN, zorder=5)
    left.plot(*ends[1, :2], "s", color=ORANGE, zorder=5)
    left.plot(0, 0, "+", color=INK)
    left.annotate("start", ends[0, :2], xytext=(6, -10), textcoords="offset points", color=GREEN)
    left.annotate("meeting", ends[1, :2], xytext=(6, 4), textcoords="offset points", color=ORANGE)
    left.set_aspect("equal")
    left.set_xlabel("$X$")
    left.set_ylabel("$Y$")
    right.set_xlabel(TIME)
    right.set_ylabel("thrust $|p|$")
    figure.legend(*right.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure


def in_elements(name: str) -> ElementsExtremal:
    """The extremal of a case of the report that `solve` found, computed in Sapunkov's elements."""
    return _with_start(name)[0]


@kept
def _with_start(name: str) -> tuple[ElementsExtremal, str]:
    """The extremal of `in_elements`, and a description of the start from which it was found.

    The start is "cold" if `solve_in_elements` finds the extremal by itself. Otherwise the costates of `solve`
    are carried over, and the description gives the result of a cold start: the cost of another extremal, or
    "none" if it does not converge.
    """
    other = solved(name)
    try:
        cold = solve_in_elements(other.problem)
    except NotConverged:
        return solve_in_elements(other.problem, start=other), "carried (cold: none)"
    if math.isclose(cold.cost, other.cost, rel_tol=1e-6):
        return cold, "cold"
    return solve_in_elements(other.problem, start=other), f"carried (cold: {cold.cost:.4g})"


@kept
def fuel_solved(name: str) -> ElementsExtremal:
    """The extremal of a case of least fuel, computed once."""
    one = fuel_cases()[name]
    return least_fuel(one.problem, one.more)


def agreement() -> dict[str, list[Any]]:
    """The cases of the report in the axes eta and in the elements: costs, durations, thrusts, residuals."""
    pairs = [(name, solved(name), *_with_start(name)) for name in cases()]
    return {
        "case": [name for name, *_ in pairs],
        "start": [start for *_, start in pairs],
        "$J$": [f"{mine.cost:.9g}" for _, _, mine, _ in pairs],
        "difference of $J$": [f"{abs(mine.cost / other.cost - 1):.0e}" for _, other, mine, _ in pairs],
        "of $t_k$": [f"{abs(mine.duration / other.duration - 1):.0e}" for _, other, mine, _ in pairs],
        "of $|p(0)|$": [f"{_initial(mine, other):.0e}" for _, other, mine, _ in pairs],
        "residual": [f"{float(mine.certificate.residual):.0e}" for _, _, mine, _ in pairs],
        "condition, $A, B$": [f"{float(mine.certificate.condition):.0f}" for _, _, mine, _ in pairs],
        "condition, $\\eta$": [f"{float(other.certificate.condition):.0f}" for _, other, _, _ in pairs],
    }


def _initial(mine: ElementsExtremal, other: Extremal) -> float:
    """Relative difference of the thrust at t0."""
    sizes = [np.linalg.norm(solution.control(0.0)) for solution in (mine, other)]
    return float(abs(sizes[0] / sizes[1] - 1))


def fuel() -> dict[str, list[Any]]:
    """The cases of least fuel: costs, durations, burns, switches and residuals."""
    known = fuel_cases()
    found = [fuel_solved(name) for name in known]
    return {
        "case": [one.title for one in known.values()],
        "$J_2$": [f"{one.cost:.9f}" for one in found],
        "$t_k$": [f"{one.duration:.6f}" for one in found],
        "burns": [one.modes.count("saturated") for one in found],
        "switches": [", ".join(f"{t:.3f}" for t in one.switch_times) for one in found],
        "residual": [f"{float(one.certificate.residual):.0e}" for one in found],
        "off the level": [f"{float(one.certificate.switching):.0e}" for one in found],
    }


def fuel_judge() -> dict[str, list[Any]]:
    """The direct costs of the cases of least fuel at two meshes; `tables.judge` has the other cases."""
    known = fuel_cases()
    found = {name: fuel_solved(name).cost for name in known}
    kept = {name: one for name, one in direct_results().items() if name in found}
    columns: dict[str, list[Any]] = {
        "case": [one.title for one in known.values()],
        "$J_2$": [f"{cost:.9g}" for cost in found.values()],
    }
    for j, mesh in enumerate(MESHES):
        columns[f"direct, {mesh} intervals"] = [f"{kept[name].costs[j]:.9g}" for name in found]
        columns[f"direct/$J_2$ − 1, {mesh}"] = [
            f"{kept[name].costs[j] / cost - 1:+.0e}" for name, cost in found.items()
        ]
    columns["Ipopt's iterations"] = [" + ".join(map(str, kept[name].iterations)) for name in found]
    return columns
