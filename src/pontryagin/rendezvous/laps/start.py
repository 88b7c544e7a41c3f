"""First paths for a lap: transfers of least energy for equations linearised about a given path.

The elements of the reference path go from those of the craft to those of the target. Along it the best thrust
is linear in six constants, the costates at the end and the price of time, and so are the changes of the
elements and of the duration: six linear equations. Then the path found is the next reference. This is done
for a stack of durations side by side.
"""

import math
from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import jacobian
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import TAU, Lap
from pontryagin.rendezvous.laps.hamiltonian import square
from pontryagin.rendezvous.laps.transcription import FEWEST, NODES_PER_LAP, Path

ROUNDS = 4
"""Number of references, the first of which is straight."""
NEAREST = 1e-3
"""Least longitude of the meeting, in radians, measured from the craft's at t0."""
THINNEST, ROUNDEST = 0.05, 0.95
"""Smallest parameter, in units of p*, and largest square of the eccentricity, of a reference."""


@dataclass(frozen=True, eq=False)
class Guesses:
    """Paths of least energy, for alpha1 = 0 and alpha2 = 1, at those durations for which there is one.

    Attributes
    ----------
    durations : (D,) array
        The durations.
    nodes : (12, D, N + 1) array
        Elements and costates at equal steps of the longitude.
    prices : (D,) array
        Prices of time.
    """

    durations: Array
    nodes: Array
    prices: Array

    def path(self, index: int) -> Path:
        """One of the paths."""
        nodes = self.nodes[:, index]
        return Path(nodes, float(self.prices[index]), float(nodes[5, -1]), float(self.durations[index]))

    @property
    def energies(self) -> Array:
        """The integrals of p^2, (D,)."""
        rate = square(self.nodes) / 4 * kernels.equinoctial_weight(*[*self.nodes[:3], self.nodes[5]])
        return np.asarray((rate[:, 1:] + rate[:, :-1]).sum(axis=1) / 2 * self.nodes[5, :, 1])


def least_energy_guesses(
    lap: Lap, durations: Array, rounds: int = ROUNDS, per_lap: int = NODES_PER_LAP
) -> Guesses:
    """Paths of least energy after some rounds.

    There is none where the meeting is not ahead of the craft, or where a reference path leaves the ellipses.
    """
    ends, _ = lap.longitude(durations)
    durations, ends = durations[ends > NEAREST], ends[ends > NEAREST]
    count = max(FEWEST, math.ceil(per_lap * ends.max(initial=0.0) / TAU))
    share = np.linspace(0.0, 1.0, count + 1)
    reference = (lap.start[:5] + share[:, None, None] * (lap.goal - lap.start[:5])).T
    reference = np.repeat(reference, ends.size, axis=1)
    nodes, prices = np.zeros((12, 0, count + 1)), np.zeros(0)
    for _ in range(rounds):
        with np.errstate(all="ignore"):
            nodes, prices = _best_about(lap, reference, ends[:, None] * share, durations)
            p, f, g = nodes[:3]
            kept = ((p > THINNEST) & (f**2 + g**2 < ROUNDEST) & np.isfinite(nodes[11])).all(axis=1)
        nodes, prices, durations, ends = nodes[:, kept], prices[kept], durations[kept], ends[kept]
        reference = nodes[:5]
    return Guesses(durations, nodes, prices)


def _best_about(lap: Lap, reference: Array, longitude: Array, durations: Array) -> tuple[Array, Array]:
    """Nodes (12, D, N + 1) and prices (D,) of the best thrust for equations linearised about references."""
    steps = longitude[:, 1:2]

    def integral(values: Array) -> Array:
        found = np.zeros(values.shape)
        np.cumsum((values[..., 1:] + values[..., :-1]) / 2 * steps, axis=-1, out=found[..., 1:])
        return found

    change = lap.goal - lap.start[:5]
    weight, by_element = _weight(reference, longitude)
    factors = _thrust_factors(reference, longitude)
    spread = np.einsum("iK...,jK...->ij...", factors, factors) * weight / 2
    passed = integral(by_element)
    left = passed[..., -1:] - passed
    by_costate = integral(spread)
    by_price = integral(np.einsum("ij...,j...->i...", spread, left))
    matrix = np.zeros((6, 6, durations.size))
    matrix[:5, :5], matrix[:5, 5] = by_costate[..., -1], by_price[..., -1]
    matrix[5, :5] = integral(np.einsum("i...,ij...->j...", by_element, by_costate))[..., -1]
    matrix[5, 5] = integral((by_element * by_price).sum(axis=0))[..., -1]
    off = (by_element * (lap.start[:5, None, None] - reference)).sum(axis=0)
    late = durations - integral(weight + off)[:, -1]
    right = np.vstack([np.repeat(change[:, None], durations.size, axis=1), late])
    found = _solutions(matrix, right)
    costates = found[:5, :, None] + found[5, :, None] * left
    elements = lap.start[:5, None, None] + np.einsum("ijdn,jd->idn", by_costate, found[:5])
    elements += by_price * found[5, :, None]
    gain = (np.einsum("iK...,i...->K...", factors, costates) ** 2).sum(axis=0) / 4
    fast = -_weight(elements, longitude)[0] * (gain + found[5, :, None])
    return np.concatenate([elements, longitude[None], costates, fast[None]]), found[5]


def _solutions(matrix: Array, right: Array) -> Array:
    """Solutions (6, D) of a stack of linear systems (6, 6, D); nan where one is singular or not finite."""
    systems = np.moveaxis(matrix, -1, 0)
    finite = np.isfinite(systems).all(axis=(1, 2), keepdims=True)
    regular = np.linalg.det(np.where(finite, systems, 0.0)) != 0
    systems = np.where(regular[:, None, None], systems, np.eye(6))
    found = np.linalg.solve(systems, right.T[..., None])[..., 0].T
    return np.where(regular, found, np.nan)


def _weight(elements: Array, longitude: Array) -> tuple[Array, Array]:
    """dt/ds, (D, n), and its derivatives in p, f, g, h, k, (5, D, n)."""
    value, slopes = jacobian(lambda x: [kernels.equinoctial_weight(*[*x, longitude])], elements[:3])
    return value[0], np.concatenate([slopes[0], np.zeros((2, *longitude.shape))])


def _thrust_factors(elements: Array, longitude: Array) -> Array:
    """The factors of the five costates in n, (5, 3, D, n)."""
    units = np.moveaxis(np.eye(6)[:5, :, None, None], 1, 0)
    n = kernels.equinoctial_switching(*[*elements[:, None], longitude[None], *units])
    return np.stack([np.broadcast_to(part, (5, *longitude.shape)) for part in n], axis=1)
