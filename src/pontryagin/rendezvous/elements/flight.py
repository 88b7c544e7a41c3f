"""A flight in Sapunkov's elements: its arcs, its end, and the derivatives of the end in the costates.

The six unknown costates are orthogonal to a turn of the elements and to the gradient of their relation, two
directions in which the flight does not change. Units are those of `Scaled`.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.arcs import Arc, Piece, SwitchedFlow, follow, places, rates, sample
from pontryagin.numerics.complex_step import jacobian
from pontryagin.numerics.equations import ON_ARRAYS
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.elements.arcs import (
    COLUMNS,
    COSTATES,
    COUNT,
    ELEMENTS,
    OTHER,
    SPENT,
    TIME,
    Mode,
    arc,
    longest_step,
    thrust_of,
)
from pontryagin.rendezvous.elements.elements import (
    I1,
    Elements,
    relation_gradient,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import cartesian_of
from pontryagin.value import value_class

SWITCHES = 200
"""A flight with more switches than this is given up."""
GRAZING = 1e-7
"""Rate in phi of the event function at a switch, up to which |n| counts as only touching its level."""


@value_class
@dataclass(frozen=True, eq=False)
class ElementFlight:
    """An extremal in the units of `Scaled`.

    Attributes
    ----------
    scaled : Scaled
        The problem.
    law : Law
        The law of thrust.
    costates : (6,) array
        Initial costates, as coefficients of the columns of `basis`.
    phi : float
        phi at the end.
    pieces : tuple of Piece
        The arcs of the flight: phi at the beginning, mode, and states with derivatives at the beginning.
    end : (18,) array
        A, B, a, b, the time, and the integral of p^2 or |p|, at the end.
    slopes : (18, 6) array
        Derivatives of the end in the costates.
    """

    scaled: Scaled
    law: Law
    costates: Array
    phi: float
    pieces: tuple[Piece[Mode], ...]
    end: Array
    slopes: Array

    @property
    def duration(self) -> float:
        """Time at the end."""
        return float(self.end[TIME])

    @property
    def cost(self) -> float:
        """The integral of alpha1 + alpha2 p^2, or of alpha1 + alpha2 |p|."""
        return self.duration if self.law.bang else self.law.ratio * self.duration + float(self.end[SPENT])

    @cached_property
    def switch_angles(self) -> Array:
        """Values of phi at which the thrust switches."""
        return np.array([piece.begin for piece in self.pieces[1:]])

    @cached_property
    def switch_times(self) -> Array:
        """Times at which the thrust switches."""
        return np.array([piece.whole[TIME] for piece in self.pieces[1:]])

    def sample(self, grid: Array) -> Array:
        """The 18 states at ascending phi, (k, 18)."""
        return sample(flow_of(self.law), self.pieces, grid)

    def modes(self, grid: Array) -> list[Mode]:
        """The mode of thrust at each phi."""
        return [self.pieces[i].mode for i in places(self.pieces, grid)]

    def thrust(self, states: Array, grid: Array) -> Array:
        """p in inertial axes, (k, 3), at states (k, 18) in the modes of the flight at each phi."""
        n = switching(states, grid)
        rows = np.empty_like(n)
        for i, mode in enumerate(self.modes(grid)):
            rows[i] = thrust_of(mode, ON_ARRAYS, n[i], self.law.constants(mode))[0]
        return rows

    def angle_at(self, times: Array) -> Array:
        """phi at ascending times, by Newton's method on t(phi)."""
        known = np.linspace(0.0, self.phi, 200 + int(40 * self.phi))
        phi = np.interp(times, self.sample(known)[:, TIME], known)
        for _ in range(4):
            states = self.sample(phi)
            size = np.sum(states[:, ELEMENTS] ** 2, axis=1)
            spinor = states[:, :4] * np.cos(phi)[:, None] + states[:, 4:8] * np.sin(phi)[:, None]
            rate = np.sum(spinor**2, axis=1) * np.sqrt(2 * size)
            phi = np.clip(phi - (states[:, TIME] - times) / rate, 0.0, self.phi)
        return phi


def switching(states: Array, phi: Array) -> Array:
    """n in inertial axes, (..., 3)."""
    columns = [*np.moveaxis(states[..., :16], -1, 0), phi]
    return np.stack(kernels.element_switching(*columns), axis=-1)


def start_of(scaled: Scaled) -> Elements:
    """The craft's elements at t0, in its axes eta there; phi = 0."""
    state = cartesian_of(scaled.start, np.array([1.0, 0, 0, 0]))
    return Elements.from_state(state[:3], state[3:])


def basis(craft: Elements) -> Array:
    """Six orthonormal costates (8, 6) of A and B, normal to the turn and to the relation's gradient."""
    turn = np.concatenate([product(I1, craft.A), product(I1, craft.B)])
    return np.linalg.svd(np.stack([turn, relation_gradient(craft)]))[2][2:].T


def flow_of(law: Law, rough: bool = False) -> SwitchedFlow[Mode]:
    """The switched flow of a law of thrust; where the thrust jumps, the rates jump too."""

    def arc_of(mode: Mode) -> Arc:
        constants = law.constants(mode)
        return Arc(arc(mode, rough), constants, longest_step(mode, constants))

    return SwitchedFlow(arc_of, lambda mode, _: OTHER[law.kind, mode], law.jumps, GRAZING, SWITCHES)


def fly_elements(
    scaled: Scaled,
    costates: Array,
    phi: float,
    law: Law,
    rough: bool = False,
) -> ElementFlight:
    """Integrate the extremal with the given initial costates up to phi; ``rough`` flights are less accurate.

    Raises
    ------
    NotConverged
        If the integrator stops short, |n| = 0 under a thrust that does not vanish with it, the thrust
        switches where |n| only touches its level, or it switches too often.
    """
    start = start_of(scaled)
    across = basis(start)
    columns = np.zeros((COUNT, COLUMNS))
    columns[COSTATES] = across
    state = np.concatenate([start.A, start.B, across @ costates, [0.0, 0.0]])
    mode = law.mode(float(np.linalg.norm(switching(state, np.array(0.0)))))
    pieces, last = follow(flow_of(law, rough), np.append(state, columns), mode, 0.0, phi)
    if not np.isfinite(last).all():
        raise NotConverged(
            "the flight is not finite at its end: it left the domain of the equations", float("inf")
        )
    end, slopes = last[:COUNT], last[COUNT:].reshape(COUNT, -1)
    return ElementFlight(scaled, law, np.array(costates), phi, pieces, end, slopes)


def switching_gradient(state: Array, phi: float) -> tuple[Array, float]:
    """Gradient of |n|^2 in the 18 states, and its derivative in phi, by complex steps."""
    _, (slopes,) = jacobian(
        lambda x: [sum(part**2 for part in kernels.element_switching(*x))], np.append(state[:16], phi)
    )
    return np.append(slopes[:16], [0.0, 0.0]), float(slopes[16])


def end_rates(flight: ElementFlight) -> Array:
    """Rates of the 18 states at the end."""
    return rates(flow_of(flight.law).arc(flight.pieces[-1].mode), flight.phi, flight.end)
