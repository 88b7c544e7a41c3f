"""The costates of Sapunkov's elements along a rendezvous, and the drift of H there."""

import numpy as np
from matplotlib.figure import Figure

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    BLUE,
    styled,
    subplots,
)
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.elements.arcs import COSTATES
from pontryagin.rendezvous.elements.certificate import running_cost
from pontryagin.rendezvous.elements.flight import switching
from pontryagin.rendezvous.elements.solution import ElementsExtremal
from pontryagin.rendezvous.figures.elements import SAMPLES, draw_components


@styled
def costates_along(solution: ElementsExtremal) -> Figure:
    """The costates a and b and the `drift` of H against time, in units with p* = c* = fM = alpha2 = 1.

    Examples
    --------
    >>> from pontryagin.rendezvous.problem.cases import case
    >>> from pontryagin.rendezvous.elements.solve import solve_in_elements
    >>> costates_along(solve_in_elements(case("circle-energy").problem)).get_label()
    'costates-along'
    """
    times = np.linspace(0.0, solution.duration, SAMPLES)
    phi = solution.flight.angle_at(times / solution.problem.scaled.time)
    states = solution.flight.sample(phi)
    figure, axes = subplots(3, sharex=True, height=5.6)
    for ax, name, values in zip(axes, "ab", np.split(states[:, COSTATES], 2, axis=1), strict=False):
        draw_components(ax, times, values, name)
    axes[2].plot(times, 1e14 * drift(solution, states, phi), color=BLUE, linewidth=0.9)
    axes[2].set(ylabel="drift of $H$ [$10^{-14}$]", xlabel="time $t$", xlim=(0, solution.duration))
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    figure.align_ylabels(list(axes))
    return figure


def drift(solution: ElementsExtremal, states: Array, phi: Array) -> Array:
    """H = -L + (n, p) + kappa/t' minus its value at the end, over the largest running cost."""
    thrust = solution.flight.thrust(states, phi)
    spent = running_cost(solution.flight, thrust)
    phase = np.asarray(kernels.element_phase(*[*states[:, :16].T, phi]))
    energy = np.sum(switching(states, phi) * thrust, axis=1) - spent + phase
    return np.asarray((energy - energy[-1]) / spent.max())
