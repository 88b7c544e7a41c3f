"""The flight of given initial costates: its arcs, its end, and the derivatives of the end in the costates.

A flight starts in the mode that |n| selects and changes the mode at every switch. Whether it ends at the
target is not considered here.
"""

from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.arcs import Arc, Piece, SwitchedFlow, follow, sample
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.arcs import (
    COUNT,
    OTHER,
    Mode,
    arc,
    equations,
)
from pontryagin.value import value_class

SWITCHES = 200
"""A flight with more switches than this is given up."""


@value_class
@dataclass(frozen=True, eq=False)
class Flight:
    """An extremal in the units of `Scaled`.

    Attributes
    ----------
    scaled : Scaled
        The problem.
    costates : (6,) array
        rho, s1, e, nu1, nu2, nu3 at t0.
    duration : float
        Time at the end.
    peak : float
        p_max.
    bang : bool
        Whether alpha2 = 0, so that the thrust is saturated throughout.
    chart : int
        Chart of chi, +1 or -1.
    pieces : tuple of Piece
        The arcs of the flight: beginning, mode, and states with derivatives at the beginning.
    end : (12,) array
        r, v1, c, phi*, rho, s1, e, nu1, nu2, nu3, chi, p_max at the end.
    slopes : (12, 7) array
        Derivatives of the end in the costates and in p_max.
    """

    scaled: Scaled
    costates: Array
    duration: float
    peak: float
    bang: bool
    chart: int
    pieces: tuple[Piece[Mode], ...]
    end: Array
    slopes: Array

    @property
    def switch_times(self) -> Array:
        """Times at which the thrust meets or leaves its bound."""
        return np.array([piece.begin for piece in self.pieces[1:]])

    @property
    def has_switches(self) -> bool:
        """Whether the thrust can meet its bound and leave it again."""
        return not self.bang and self.peak < np.inf

    @property
    def mode(self) -> Mode:
        """The mode at the end."""
        return self.pieces[-1].mode

    def sample(self, times: Array) -> Array:
        """The twelve states at ascending times, (k, 12)."""
        flow = flow_of(self.scaled.eccentricity, self.has_switches, self.chart)
        return sample(flow, self.pieces, times)

    def attitude(self, states: Array) -> Array:
        """lambda0~ o lambda, (..., 4), at states (..., 12)."""
        values = [*self.costates[3:], *np.moveaxis(states[..., 7:11], -1, 0), float(self.chart)]
        return np.stack(kernels.attitude(*values), axis=-1)

    def thrust(self, times: Array) -> Array:
        """p in the axes eta at ascending times, (k, 3)."""
        return thrust(self.sample(times), self.peak, self.bang)


def switching(states: Array) -> Array:
    """n in the axes eta, (..., 3), at states (..., 12)."""
    r, _, c, _, _, s1, e, nu1 = np.moveaxis(states[..., :8], -1, 0)
    return np.stack(kernels.switching(r, c, s1, e, nu1), axis=-1)


def thrust(states: Array, peak: float, bang: bool) -> Array:
    """The thrust that maximises H, (8) and (10): n/2, or p_max n/|n| if that is smaller or alpha2 = 0."""
    n = switching(states)
    size = np.linalg.norm(n, axis=-1, keepdims=True)
    bounded = peak / np.where(size > 0, size, 1.0)
    return n * (bounded if bang else np.minimum(0.5, bounded))


def chart_of(costates: Array) -> int:
    """The chart whose singular direction is farther from nu."""
    return 1 if costates[5] >= 0 else -1


def flow_of(eccentricity: float, has_switches: bool, chart: int, rough: bool = False) -> SwitchedFlow[Mode]:
    """The switched flow of the thrust: every event changes to the other mode, without a jump."""
    parameters = (eccentricity, float(chart))
    return SwitchedFlow(
        arc=lambda mode: Arc(arc(mode, has_switches, rough), parameters),
        following=lambda mode, _: OTHER[mode],
        most=SWITCHES,
    )


def fly(
    scaled: Scaled,
    costates: Array,
    duration: float,
    peak: float = np.inf,
    bang: bool = False,
    chart: int | None = None,
    rough: bool = False,
) -> Flight:
    """Integrate the extremal with the given initial costates; ``rough`` flights are less accurate and faster.

    Raises
    ------
    NotConverged
        If the integrator stops short, at the centre of attraction or at |n| = 0 under alpha2 = 0, or if the
        thrust switches too often.
    """
    chosen = chart_of(costates) if chart is None else chart
    pieces, last = arcs_of(scaled, costates, duration, peak, bang, chosen, rough)
    end, slopes = last[:COUNT], last[COUNT:].reshape(COUNT, -1)
    return Flight(scaled, np.array(costates), duration, peak, bang, chosen, pieces, end, slopes)


def arcs_of(
    scaled: Scaled,
    costates: Array,
    duration: float,
    peak: float,
    bang: bool,
    chart: int,
    rough: bool = False,
    derivatives: bool = True,
) -> tuple[tuple[Piece[Mode], ...], Array]:
    """The arcs of an extremal, and its states at the end, followed by their derivatives if these are wanted.

    Raises
    ------
    NotConverged
        As `fly`.
    """
    bound = peak if peak < np.inf else 1.0
    start = np.concatenate([scaled.start, [scaled.anomaly], costates, [0.0, bound]])
    saturated = bang or float(np.sum(switching(start) ** 2)) > (2 * peak) ** 2
    mode: Mode = "saturated" if saturated else "unsaturated"
    has_switches = not bang and peak < np.inf
    whole = np.append(start, equations(mode, has_switches).identity) if derivatives else start
    flow = flow_of(scaled.eccentricity, has_switches, chart, rough)
    pieces, last = follow(flow, whole, mode, 0.0, duration)
    if not np.isfinite(last).all():
        raise NotConverged(
            "the flight is not finite at its end: it left the domain of the equations", float("inf")
        )
    return pieces, last
