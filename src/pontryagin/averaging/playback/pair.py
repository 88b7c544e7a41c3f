"""An averaged and an exact extremal, with the plots of both against time that all recordings share.

Time is t = tau/epsilon. The averaged extremal is orange, the exact one blue.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
)
from pontryagin.display.recording import (
    Plot,
    Recording,
    View,
)
from pontryagin.errors import ArgumentValueError

AVERAGED, EXACT = ORANGE, BLUE
SECONDS = 40.0
"""Duration of a replay in seconds."""
AVERAGED_SAMPLES = 201
"""Number of samples of the averaged extremal."""


@dataclass(frozen=True, eq=False)
class Pair:
    """An averaged solution of one problem and an exact extremal of it.

    Raises
    ------
    ValueError
        If the averaged solution is that of a stack.
    """

    averaged: AveragedSolution
    exact: Extremal

    def __post_init__(self) -> None:
        shape = self.averaged.duration.shape
        if shape:
            raise ArgumentValueError(
                f"solution must be that of one problem, got a stack of shape {shape}", "solution"
            )

    @property
    def epsilon(self) -> float:
        """The epsilon of the exact extremal."""
        return self.exact.epsilon

    @property
    def last(self) -> float:
        """Time t of the later of the two arrivals."""
        return max(self.exact.duration, float(self.averaged.duration)) / self.epsilon

    @property
    def speed(self) -> float:
        """Units of t per second, so that a replay lasts `SECONDS`."""
        return self.last / SECONDS

    @cached_property
    def grid(self) -> Array:
        """Slow times of the averaged extremal, (k,)."""
        return np.linspace(0.0, float(self.averaged.duration), AVERAGED_SAMPLES)

    def averaged_cost(self) -> Array:
        """Integral of the mean running cost over `grid`: its rate is eta d xi/d tau, since h0 = 0."""
        solution = self.averaged
        rate = (solution.costate(self.grid) * solution.mean_rate(self.grid)).sum(axis=-1)
        return CubicSpline(self.grid, rate).antiderivative()(self.grid)


def panel(title: str, entity: str, legend: str = "LeftTop") -> Plot:
    """A plot over all times."""
    return Plot(title, entity, whole=True, legend=legend)


def slow_plots(pair: Pair, words: Mapping[str, str]) -> tuple[list[View], list[View]]:
    """Two columns of plots: slow variables and their differences; the cost and the anomaly's costate."""
    slow = [panel(words[name], f"slow-{name}") for name in pair.averaged.names]
    return [*slow, panel("exact less averaged, over epsilon", "difference")], [
        panel("cost so far", "cost"),
        panel("costate of the anomaly over epsilon", "costate", "LeftBottom"),
    ]


def slow_curves(recording: Recording, pair: Pair, tau: Array) -> None:
    """Record the curves of `slow_plots`, the exact ones at slow times (k,)."""
    averaged, exact = pair.averaged.slow(pair.grid), pair.exact.slow(tau)
    both = tau[tau <= float(pair.averaged.duration)]
    differences = (exact[: len(both)] - pair.averaged.slow(both)) / pair.epsilon
    curves = {f"slow-{name}": (averaged[:, i], exact[:, i]) for i, name in enumerate(pair.averaged.names)}
    curves["cost"] = (pair.averaged_cost(), pair.exact.spent(tau))
    curves["costate"] = (np.zeros(len(pair.grid)), pair.exact.phase_costate(tau) / pair.epsilon)
    for entity, (first, second) in curves.items():
        recording.curve(f"{entity}/averaged", pair.grid / pair.epsilon, first, "averaged", AVERAGED)
        recording.curve(f"{entity}/exact", tau / pair.epsilon, second, "exact", EXACT)
    for name, values, colour in zip(pair.averaged.names, differences.T, (GREEN, PURPLE), strict=False):
        recording.curve(f"difference/{name}", both / pair.epsilon, values, name, colour)


def arrivals(recording: Recording, pair: Pair) -> None:
    """Record the arrivals of the averaged and the exact extremal, with their costs, as events."""
    arrived = {
        "averaged": (float(pair.averaged.duration), float(pair.averaged.cost)),
        f"exact {pair.exact.kind}": (pair.exact.duration, pair.exact.cost),
    }
    for name, (duration, cost) in sorted(arrived.items(), key=lambda item: item[1]):
        t = duration / pair.epsilon
        recording.event("events", t, f"t = {t:.2f}: {name} arrives, cost {cost:.6f}")
