"""Averaged and exact extremals of one problem against slow time."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.display.plotting import (
    BLUE,
    ORANGE,
    styled,
    subplots,
)
from pontryagin.errors import ArgumentValueError

TAU = r"slow time $\tau=\varepsilon t$"
SAMPLES = 1201
TURN = np.linspace(0.0, 2 * np.pi, 121)


@styled
def drift(solution: AveragedSolution, exact: Extremal | None = None) -> Figure:
    """Slow variables and control: averaged, with the control's range over a turn, and exact if given.

    Parameters
    ----------
    solution : AveragedSolution
        The averaged solution of one problem.
    exact : Extremal, optional
        One of the extremals that its `exact` found.

    Raises
    ------
    ValueError
        If the solution is that of a stack.

    Examples
    --------
    >>> from pontryagin.averaging import smooth_example
    >>> drift(smooth_example(1.0, 2.0)).get_label()
    'drift'
    """
    if solution.duration.shape:
        shape = solution.duration.shape
        raise ArgumentValueError(
            f"solution must be that of one problem, got a stack of shape {shape}", "solution"
        )
    names = [*solution.names, *(str(u) for u in solution.system.control)]
    figure, axes = subplots(len(names), height=1.0 + 1.25 * len(names), sharex=True, squeeze=False)
    panels = list(axes[:, 0])
    slow, controls = panels[: len(solution.names)], panels[len(solution.names) :]
    grid = np.linspace(0.0, float(solution.duration), 201)
    _averaged(solution, grid, slow, controls)
    if exact is not None:
        tau = np.linspace(0.0, exact.duration, SAMPLES)
        label = rf"exact {exact.kind}, $\varepsilon={exact.epsilon:g}$"
        for ax, values in zip(panels, np.hstack([exact.slow(tau), exact.control(tau)]).T, strict=True):
            ax.plot(tau, values, color=BLUE, linewidth=0.9, label=label)
    for ax, name in zip(panels, names, strict=True):
        ax.set_ylabel(f"${_tex(name)}$")
    panels[-1].set_xlabel(TAU)
    handles, labels = slow[0].get_legend_handles_labels()
    band, name = controls[0].get_legend_handles_labels()
    figure.legend(handles + band[:1], labels + name[:1], loc="outside upper center", ncols=3)
    figure.align_ylabels(panels)
    return figure


def _averaged(solution: AveragedSolution, grid: Array, slow: list[Axes], controls: list[Axes]) -> None:
    for ax, values in zip(slow, solution.slow(grid).T, strict=True):
        ax.plot(grid, values, color=ORANGE, linewidth=2.2, label="averaged")
    over_a_turn = np.stack([solution.control(grid, np.full(len(grid), x)) for x in TURN])
    for i, ax in enumerate(controls):
        values = over_a_turn[..., i]
        low, high = values.min(axis=0), values.max(axis=0)
        label = "averaged, range over a turn"
        ax.fill_between(
            grid, low, high, label=label, facecolor=to_rgba(ORANGE, 0.3), edgecolor=ORANGE, linewidth=1.2
        )


def _tex(name: str) -> str:
    """A symbol's name in TeX.

    Examples
    --------
    >>> _tex("u_phi"), _tex("E")
    ('u_{\\\\phi}', 'E')
    """
    stem, _, index = name.partition("_")
    greek = {"phi": r"\phi", "psi": r"\psi", "omega": r"\omega"}
    return f"{stem}_{{{greek.get(index, index)}}}" if index else stem
