"""The conditions of a meeting in Sapunkov's elements and their exact derivatives.

The unknowns are six costates at the start and phi at the end. Six conditions state that craft and target have
the same place and velocity at the time t(phi). The seventh is the fixed duration, or for a free one the
terminal law for |n(t_k)|. During the continuation from coasting, a goal takes the target's place.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import jacobian
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.elements.arcs import TIME
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
    end_rates,
    fly_elements,
    switching,
    switching_gradient,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import target_by_kepler
from pontryagin.value import value_class

Goal = Callable[[float], tuple[Array, Array]]
"""A function of the time that returns R and V of the goal (6,) and their rates (6,)."""


@value_class
@dataclass(frozen=True, eq=False)
class ElementsSetting:
    """A problem with the law of thrust under which it is solved, in the units of `Scaled`.

    Parameters
    ----------
    scaled : Scaled
        The problem.
    law : Law
        The functional, alpha1/alpha2 and the bound.
    duration : float or None
        t_k if it is fixed.
    goal : function of the time, optional
        The goal that takes the target's place.
    rough : bool
        Whether flights are integrated only to 1e-10, as along families, whose points are only guesses.
    """

    scaled: Scaled
    law: Law
    duration: float | None = None
    goal: Goal | None = None
    rough: bool = False

    @property
    def ratio(self) -> float:
        """alpha1/alpha2; inf for alpha2 = 0."""
        return self.law.ratio

    @property
    def peak(self) -> float:
        """p_max."""
        return self.law.peak

    @property
    def end_switching(self) -> float:
        """|n(t_k)| by the terminal law."""
        return self.law.end_switching

    def replace(self, **changes: Any) -> "ElementsSetting":
        """A copy with some attributes changed; "ratio", "peak" and "width" change the law."""
        of_law = {name: changes.pop(name) for name in ("ratio", "peak", "width") if name in changes}
        return replace(self, law=replace(self.law, **of_law), **changes)


@value_class
@dataclass(frozen=True, eq=False)
class ElementsEquations:
    """Residual (7,) and Jacobian (7, 7) of the conditions at the unknowns of a flight."""

    flight: ElementFlight
    residual: Array
    jacobian: Array


def target(scaled: Scaled) -> Goal:
    """The target as a goal: R and V by Kepler's equation, their rates by Newton's law."""

    def at(time: float) -> tuple[Array, Array]:
        state = target_by_kepler(scaled, time)
        return state, np.concatenate([state[3:], -state[:3] / np.linalg.norm(state[:3]) ** 3])

    return at


def equations(setting: ElementsSetting, unknowns: Array) -> ElementsEquations:
    """Residuals of a setting and their derivatives.

    Raises
    ------
    NotConverged
        If the flight cannot be integrated to its end.
    """
    flight = fly_elements(setting.scaled, unknowns[:6], float(unknowns[6]), setting.law, setting.rough)
    columns = np.column_stack([flight.slopes, end_rates(flight)])
    values, by_state, by_phi = _place(flight)
    goal, moving = (setting.goal or target(setting.scaled))(flight.duration)
    meeting = by_state @ columns[:8] - np.outer(moving, columns[TIME])
    meeting[:, 6] += by_phi
    if setting.duration is not None:
        last, row = flight.duration / setting.duration - 1, columns[TIME] / setting.duration
    else:
        last, row = _terminal(flight, columns)
    return ElementsEquations(flight, np.append(values - goal, last), np.vstack([meeting, row]))


def _place(flight: ElementFlight) -> tuple[Array, Array, Array]:
    """R and V at the end, (6,), and their derivatives in A and B, (6, 8), and in phi, (6,)."""
    inputs = np.append(flight.end[:8], flight.phi)
    values, slopes = jacobian(lambda x: kernels.element_place(*x), inputs)
    return values, slopes[:, :8], slopes[:, 8]


def _terminal(flight: ElementFlight, columns: Array) -> tuple[float, Array]:
    """|n| at the end relative to that of the terminal law, minus 1, and its derivatives in the unknowns."""
    n = switching(flight.end, np.array(flight.phi))
    gradient, by_phi = switching_gradient(flight.end, flight.phi)
    row = gradient @ columns
    row[6] += by_phi
    size, wanted = float(np.linalg.norm(n)), flight.law.end_switching
    return size / wanted - 1, row / (2 * size * wanted)
