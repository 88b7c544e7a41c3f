"""The transfer in Cartesian coordinates, which no inclination and no loss of angular momentum makes singular.

K = (S(|n|^2) + c + (l_R, V) + (l_V, g)) dt/ds with g = -R/r^3, n = l_V and dt/ds = r^(3/2).
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.hamiltonian import VARIABLES, Cost, Hamiltonian
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import cartesian_of, target_by_kepler

NEAREST = 0.01
"""Smallest distance from the centre, in units of p*, on the way of an iteration."""
UPPER = np.array([[0, 1, 2], [1, 3, 4], [2, 4, 5]])
"""Where the entries of a symmetric matrix stand among xx, xy, xz, yy, yz, zz."""
R, V, OF_R, OF_V = (slice(start, start + 3) for start in (0, 3, 6, 9))
"""Position, velocity and their costates among the twelve variables."""


def attraction(position: Array, factors: Array) -> tuple[Array, Array, Array]:
    """g (..., 3) at positions (..., 3), its derivatives, and the second ones of (m, g), (..., 3, 3) each."""
    found = np.stack(kernels.attraction(*np.moveaxis(position, -1, 0), *np.moveaxis(factors, -1, 0)), axis=-1)
    return found[..., :3], found[..., 3:9][..., UPPER], found[..., 9:][..., UPPER]


@dataclass(frozen=True, eq=False)
class Transfer:
    """The ends of a transfer in the axes eta of t0, in the units of `Scaled`.

    Attributes
    ----------
    scaled : Scaled
        The problem.
    """

    scaled: Scaled

    @cached_property
    def start(self) -> Array:
        """R and V of the craft at t0, (6,)."""
        return cartesian_of(self.scaled.start, np.array([1.0, 0, 0, 0]))

    def meeting(self, duration: float) -> tuple[Array, Array]:
        """R and V of the target after a time, (6,), and their rates, (6,)."""
        there = target_by_kepler(self.scaled, duration)
        return there, np.append(there[3:], -there[:3] / np.linalg.norm(there[:3]) ** 3)

    def hamiltonian(self, cost: Cost, nodes: Array, price: float) -> Hamiltonian:
        """K and its derivatives at positions, velocities and costates (12, n), for the price c of time."""
        count = nodes.shape[1]
        velocity, of_position, n = nodes[V].T, nodes[OF_R].T, nodes[OF_V].T
        pull, turn, bend = attraction(nodes[R].T, n)
        pace = np.stack(kernels.cartesian_pace(*nodes[R]), axis=-1)
        weight, weight_slopes = pace[:, 0], np.zeros((count, VARIABLES))
        weight_slopes[:, R] = pace[:, 1:4]
        gain, slope, curve = cost.gain(self.square(nodes))
        gain_slopes = np.zeros((count, VARIABLES))
        gain_slopes[:, OF_V] = 2 * slope[:, None] * n
        plain = gain + price + np.einsum("ij,ij->i", of_position, velocity) + np.einsum("ij,ij->i", n, pull)
        slopes = np.hstack([np.einsum("ij,ijk->ik", n, turn), of_position, velocity, pull]) + gain_slopes
        curvatures = np.zeros((count, VARIABLES, VARIABLES))
        curvatures[:, R, R], curvatures[:, R, OF_V], curvatures[:, OF_V, R] = bend, turn, turn
        curvatures[:, V, OF_R] = curvatures[:, OF_R, V] = np.eye(3)
        curvatures[:, OF_V, OF_V] = 2 * slope[:, None, None] * np.eye(3)
        curvatures[:, OF_V, OF_V] += 4 * curve[:, None, None] * n[:, :, None] * n[:, None, :]
        mixed = slopes[:, :, None] * weight_slopes[:, None, :]
        curvatures *= weight[:, None, None]
        curvatures += mixed + mixed.transpose(0, 2, 1)
        curvatures[:, R, R] += plain[:, None, None] * pace[:, 4:][:, UPPER]
        slopes = slopes * weight[:, None] + plain[:, None] * weight_slopes
        return Hamiltonian(plain * weight, slopes, curvatures, weight, weight_slopes, gain, gain_slopes)

    def square(self, nodes: Array) -> Array:
        """|n|^2 at nodes (12, ...)."""
        return np.asarray((nodes[OF_V] ** 2).sum(axis=0))

    def weight(self, nodes: Array) -> Array:
        """dt/ds at nodes (12, ...)."""
        return np.asarray(kernels.cartesian_pace(*nodes[R])[0])

    def admissible(self, nodes: Array) -> bool:
        """Whether a path keeps away from the centre."""
        return bool((np.linalg.norm(nodes[R], axis=0) > NEAREST).all())

    @property
    def inclination(self) -> float:
        """The angle between the planes of craft and target, in radians."""
        first, second = (np.cross(x[:3], x[3:]) for x in (self.start, target_by_kepler(self.scaled, 0.0)))
        return math.atan2(float(np.linalg.norm(np.cross(first, second))), float(first @ second))


def reduced_costates(scaled: Scaled, in_space: Array) -> Array:
    """rho, s1, e, nu1, nu2, nu3 (6,) at t0 of the costates of R and V there, (6,), in the axes eta of t0."""
    columns = np.array([kernels.primer(*scaled.start, *axis) for axis in np.eye(6)]).T
    return np.asarray(np.linalg.solve(columns, in_space))
