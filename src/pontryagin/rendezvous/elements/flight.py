"""A whole extremal in Sapunkov's elements: its arcs, its end, and how the end depends on the costates.

The six unknown costates are those across the turn and the relation, in which nothing is seen of a flight.
Where the thrust jumps, the rates do: what was delta x before the switch is after it
delta x + (f+ - f-) (grad g, delta x)/g', g = |n|^2 - 1 (the saltation matrix).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.elements.arcs import (
    COLUMNS,
    COSTATES,
    COUNT,
    ELEMENTS,
    NUMERIC,
    SPENT,
    TIME,
    Mode,
    arc,
    rates_of,
    steered,
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
"""Rate of |n|^2 by phi at a switch below which the thrust may switch off and on again in between."""
STEP = 1e-30


@value_class
@dataclass(frozen=True, eq=False)
class Piece:
    """One arc: phi where it begins, its mode, states and derivatives there."""

    begin: float
    mode: Mode
    whole: Array


@value_class
@dataclass(frozen=True, eq=False)
class ElementFlight:
    """An extremal in the units of `Scaled`.

    Attributes
    ----------
    scaled : Scaled
        The problem.
    law : Law
        Of the thrust.
    costates : (6,) array
        In the columns of `basis`.
    phi : float
        Half-angle at the end.
    pieces : tuple of Piece
        Its arcs.
    end : (18,) array
        A, B, a, b, the time, and the integral of p^2 or |p|.
    slopes : (18, 6) array
        Derivatives of the end in the costates.
    taylor : bool or None
        As for `pontryagin.numerics.flow.flow`.
    """

    scaled: Scaled
    law: Law
    costates: Array
    phi: float
    pieces: tuple[Piece, ...]
    end: Array
    slopes: Array
    taylor: bool | None

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
        """phi where the thrust switches."""
        return np.array([piece.begin for piece in self.pieces[1:]])

    @cached_property
    def switch_times(self) -> Array:
        """The times there."""
        return np.array([piece.whole[TIME] for piece in self.pieces[1:]])

    def sample(self, grid: Array) -> Array:
        """The 18 states at ascending phi, (k, 18)."""
        starts = np.array([piece.begin for piece in self.pieces])
        which = np.clip(np.searchsorted(starts, grid, side="right") - 1, 0, None)
        rows = np.empty((len(grid), COUNT))
        for i in np.unique(which):
            piece, chosen = self.pieces[i], np.flatnonzero(which == i)
            inside, back = np.unique(np.append(grid[chosen], piece.begin), return_inverse=True)
            constants = self.law.constants(piece.mode)
            states = arc(piece.mode, self.taylor).sample(piece.whole, inside, constants)
            rows[chosen] = states[back[:-1]]
        return rows

    def modes(self, grid: Array) -> list[Mode]:
        """The mode flown at each phi."""
        starts = np.array([piece.begin for piece in self.pieces])
        return [self.pieces[i].mode for i in np.searchsorted(starts, grid, side="right") - 1]

    def thrust(self, states: Array, grid: Array) -> Array:
        """p in inertial axes (k, 3) of the modes flown."""
        n = switching(states, grid)
        rows = np.empty_like(n)
        for i, mode in enumerate(self.modes(grid)):
            rows[i] = steered(mode, n[i], self.law.constants(mode), np.sqrt, np.tanh)[0]
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
    """Six orthonormal costates (8, 6) of A and B, across the turn and across the relation."""
    turn = np.concatenate([product(I1, craft.A), product(I1, craft.B)])
    return np.linalg.svd(np.stack([turn, relation_gradient(craft)]))[2][2:].T


def fly_elements(
    scaled: Scaled,
    costates: Array,
    phi: float,
    law: Law,
    taylor: bool | None = None,
    rough: bool = False,
) -> ElementFlight:
    """Follow the extremal that starts with the given costates up to a half-angle; roughly, as a guess.

    Raises
    ------
    NotConverged
        Where the integrator stops short, |n| = 0 under a thrust that does not vanish with it, or the thrust
        switches where |n| only touches its level.
    """
    start = start_of(scaled)
    across = basis(start)
    columns = np.zeros((COUNT, COLUMNS))
    columns[COSTATES] = across
    state = np.concatenate([start.A, start.B, across @ costates, [0.0, 0.0]])
    whole = np.concatenate([state, columns.ravel()])
    mode = law.mode(float(np.linalg.norm(switching(state, np.array(0.0)))))
    pieces: list[Piece] = []
    begin, switched = 0.0, True
    while switched:
        pieces.append(Piece(begin, mode, whole))
        if len(pieces) > SWITCHES:
            raise NotConverged("the thrust switches too often", phi - begin)
        begin, whole, switched = arc(mode, taylor, rough).run(whole, begin, phi, law.constants(mode))
        if switched:
            following = OTHER[law.kind, mode]
            whole = _over(whole, begin, law, mode, following) if law.jumps else whole
            mode = following
    if not np.isfinite(whole).all():
        raise NotConverged("the extremal leaves the domain of the equations", float("inf"))
    end, slopes = whole[:COUNT], whole[COUNT:].reshape(COUNT, -1)
    return ElementFlight(scaled, law, np.array(costates), phi, tuple(pieces), end, slopes, taylor)


OTHER: dict[tuple[str, Mode], Mode] = {
    ("square", "saturated"): "unsaturated",
    ("square", "unsaturated"): "saturated",
    ("fuel", "saturated"): "coast",
    ("fuel", "coast"): "saturated",
}


def _over(whole: Array, phi: float, law: Law, before: Mode, after: Mode) -> Array:
    """States and derivatives on the other side of a switch at which the thrust jumps."""
    state, columns = whole[:COUNT], whole[COUNT:].reshape(COUNT, -1)
    gradient, by_phi = switching_gradient(state, phi)
    rates = [np.array(rates_of(mode, state, phi, law.constants(mode), NUMERIC)) for mode in (before, after)]
    pace = gradient @ rates[0] + by_phi
    if abs(pace) < GRAZING:
        raise NotConverged("|n| only touches the level at which the thrust switches", float(abs(pace)))
    jump = np.outer(rates[1] - rates[0], gradient @ columns) / pace
    return np.concatenate([state, (columns + jump).ravel()])


def switching_gradient(state: Array, phi: float) -> tuple[Array, float]:
    """Gradient of |n|^2 in the 18 states, and its derivative in phi, by complex steps."""
    inputs = np.append(state[:16], phi)[:, None] + 1j * STEP * np.eye(17)
    n = np.array(kernels.element_switching(*inputs))
    slopes = np.sum(n**2, axis=0).imag / STEP
    return np.concatenate([slopes[:16], [0.0, 0.0]]), float(slopes[16])


def end_rates(flight: ElementFlight) -> Array:
    """Rates of the 18 states at the end."""
    mode = flight.pieces[-1].mode
    return np.array(rates_of(mode, flight.end, flight.phi, flight.law.constants(mode), NUMERIC))
