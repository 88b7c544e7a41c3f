"""The cost over the end time for any problem: the exact family, its extremals, the averaged family."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solve_averaged
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.averaging.figures.families import draw_costs
from pontryagin.averaging.figures.labels import END_TIME
from pontryagin.display.plotting import (
    styled,
    subplots,
)
from pontryagin.errors import Infeasible, NotConverged


@styled
def landscape(solution: AveragedSolution, epsilons: Sequence[float]) -> Figure:
    """J of the exact family against its end time, with its minima and maxima, over the averaged family.

    Parameters
    ----------
    solution : AveragedSolution
        The averaged solution of one problem.
    epsilons : sequence of float
        Values of epsilon; each has its own panel.
    """
    figure, axes = subplots(len(epsilons), sharex=True, height=1.0 + 1.7 * len(epsilons))
    for ax, epsilon in zip(np.atleast_1d(axes), epsilons, strict=True):
        found = solution.exact(epsilon)
        low, high = (kappa_at(found, end) for end in (0, -1))
        draw_costs(ax, found, averaged_family(solution, low, high))
        best, worst = min(one.cost for one in found), max(one.cost for one in found)
        margin = 0.1 * (worst - best)
        ends = [one.duration for one in found]
        reach = 0.08 * (max(ends) - min(ends))
        ax.set(ylim=(best - margin, worst + margin), xlim=(min(ends) - reach, max(ends) + reach))
        ax.set_title(rf"$\varepsilon = {epsilon:g}$", loc="left")
    ax.set_xlabel(END_TIME)
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def kappa_at(found: Extremals, end: int) -> float:
    """kappa of the exact family's first or last turn: minus the mean of y over it."""
    family = found.traced
    edge = family.theta[end]
    turn = np.abs(family.theta - edge) <= 2 * np.pi
    return -float(np.trapezoid(family.y[turn], family.theta[turn]) / np.ptp(family.theta[turn]))


def averaged_family(solution: AveragedSolution, low: float, high: float) -> tuple[Array, Array]:
    """tau_1 and J_0 of the averaged family between two kappas, where it exists, by rising tau_1.

    tau_1 grows without bound towards the largest kappa, so the members are taken closer together there.
    """
    least, most = (_reached(solution, kappa) for kappa in sorted((low, high)))
    shares = 1 - (1 - np.linspace(0, 1, 61)) ** 3
    members = [_member(solution, least + (most - least) * share) for share in shares]
    found = [(float(one.duration), float(one.cost)) for one in members if one is not None]
    tau, cost = np.array(sorted(found)).T
    return tau, cost


def _reached(solution: AveragedSolution, kappa: float, halvings: int = 20) -> float:
    """kappa, or the last value on the way to it from zero at which the averaged family exists."""
    inside, outside = 0.0, kappa
    if _member(solution, kappa) is not None:
        return kappa
    for _ in range(halvings):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if _member(solution, middle) is not None else (inside, middle)
    return inside


def _member(solution: AveragedSolution, kappa: float) -> AveragedSolution | None:
    """A member of the family; None where kappa omega exceeds the mean running cost."""
    try:
        return solve_averaged(solution.system, solution.start, kappa=kappa)
    except (ValueError, NotConverged, Infeasible):
        return None
