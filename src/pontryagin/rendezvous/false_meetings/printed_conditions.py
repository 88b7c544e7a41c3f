"""The end conditions as printed, in numbers: (5), (15), (16) and (17), and their exact derivatives.

Eight equations for six costates, t_k and C_phi; everything in units with p* = c* = fM = 1.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import derivative
from pontryagin.numerics.rotation import conjugate, product, rotated
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.reduced.certificate import anomaly_constant
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.shooting import end_rates


def reduced(row: Array, eccentricity: float) -> Array:
    """r, v1, c, phi*, rho, s1, e, nu1, nu2, nu3 and C_phi (11,) of the 16 variables."""
    nu = product(conjugate(row[4:8]), row[12:])[1:]
    constant = row[11] * (1 + eccentricity * math.cos(row[3])) ** 2
    return np.concatenate([row[:4], row[8:11], nu, [constant]])


def hamiltonian(flight: Flight, variables: NDArray, mode: str) -> complex:
    """H of (17)."""
    r, v1, c, _, rho, s1, e, nu1, nu2, nu3, constant = variables
    alpha1, alpha2 = flight.scaled.weights
    n = kernels.switching(r, c, s1, e, nu1)
    size = np.sqrt(sum(part**2 for part in n))
    share = flight.peak / size if mode == "saturated" else 1 / (2 * alpha2)
    thrust = [share * part for part in n]
    inputs = [r, v1, c, rho, s1, e, nu1, nu2, nu3, *thrust, constant, 1.0, 1.0, 1.0, alpha1, alpha2]
    return kernels.hamiltonian(*inputs)


def printed_conditions(flight: Flight, end: NDArray, nu_start: NDArray, constant: complex) -> NDArray:
    """(5), (15), (16) and (17), (8,): what they leave at the end, with p* = c* = fM = 1.

    Parameters
    ----------
    flight : Flight
        Whose problem it is, and in which mode it ends.
    end : (10,) array
        r, v1, c, phi*, rho, s1, e, nu1, nu2, nu3 at t_k; real or complex.
    nu_start : (3,) array
        nu at t0.
    constant : float
        C_phi.
    """
    r, v1, c, phi, rho, s1, _, *nu = end
    scaled = flight.scaled
    goal = np.delete(np.array(kernels.target(phi, 1.0, scaled.eccentricity, 1.0, *scaled.orientation)), 3)
    turned = rotated(np.array(nu), goal[3:])
    wanted = kernels.anomaly_constant(rho, s1, nu[2], phi, 1.0, scaled.eccentricity, 1.0)
    left = hamiltonian(flight, np.append(end, constant), flight.mode)
    return np.array([*(np.array([r, v1, c]) - goal[:3]), *(turned - nu_start), constant - wanted, left])


def printed_jacobian(flight: Flight) -> Array:
    """Derivatives of the printed conditions in the six costates, t_k and C_phi at a meeting, (8, 8)."""
    constant = anomaly_constant(flight)
    inputs = np.concatenate([flight.end[:10], flight.costates[3:], [constant]])

    def column(direction: Array) -> Array:
        return derivative(lambda x: printed_conditions(flight, x[:10], x[10:13], x[13]), inputs, direction)[1]

    slopes = np.column_stack([column(direction) for direction in np.eye(14)])
    by_end, by_start, by_constant = slopes[:, :10], slopes[:, 10:13], slopes[:, 13]
    by_costates = by_end @ flight.slopes[:10, :6]
    by_costates[:, 3:] += by_start
    by_time = by_end @ end_rates(flight)[:10]
    return np.column_stack([by_costates, by_time, by_constant])
