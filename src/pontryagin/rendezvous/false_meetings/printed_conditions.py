"""The end conditions as printed, (5), (15), (16) and (17), in numbers, with their exact derivatives.

They are eight equations for six costates, t_k and C_phi, in units with p* = c* = fM = 1.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import derivative
from pontryagin.numerics.rotation import conjugate, product, rotated
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.reduced.certificate import anomaly_constant
from pontryagin.rendezvous.reduced.conditions import end_rates
from pontryagin.rendezvous.reduced.flight import Flight

Numbers = NDArray[Any]
"""Real numbers, or complex ones where derivatives are taken by a complex step."""


def reduced_variables(row: Array, eccentricity: float) -> Array:
    """r, v1, c, phi*, rho, s1, e, nu1, nu2, nu3 and C_phi, (11,), as functions of the 16 variables."""
    nu = product(conjugate(row[4:8]), row[12:])[1:]
    constant = row[11] * (1 + eccentricity * math.cos(row[3])) ** 2
    return np.concatenate([row[:4], row[8:11], nu, [constant]])


def hamiltonian(flight: Flight, variables: Numbers, mode: str) -> Any:
    """H of (17) at the optimal thrust of a mode."""
    r, v1, c, _, rho, s1, e, nu1, nu2, nu3, constant = variables
    alpha1, alpha2 = flight.scaled.weights
    n = kernels.switching(r, c, s1, e, nu1)
    size = np.sqrt(sum(part**2 for part in n))
    share = flight.peak / size if mode == "saturated" else 1 / (2 * alpha2)
    thrust = [share * part for part in n]
    inputs = [r, v1, c, rho, s1, e, nu1, nu2, nu3, *thrust, constant, 1.0, 1.0, 1.0, alpha1, alpha2]
    return kernels.hamiltonian(*inputs)


def printed_conditions(flight: Flight, end: Numbers, nu_start: Numbers, constant: complex) -> Numbers:
    """Residuals of (5), (15), (16) and (17), (8,), with p* = c* = fM = 1.

    Parameters
    ----------
    flight : Flight
        The extremal: it gives the problem and the mode of the last arc.
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
    invariant = rotated(np.array(nu), goal[3:])
    transversal = kernels.anomaly_constant(rho, s1, nu[2], phi, 1.0, scaled.eccentricity, 1.0)
    energy = hamiltonian(flight, np.append(end, constant), flight.mode)
    return np.array(
        [*(np.array([r, v1, c]) - goal[:3]), *(invariant - nu_start), constant - transversal, energy]
    )


def printed_residual(flight: Flight, ends: Array, free: bool) -> float:
    """Largest residual of (5), (15), (16) and (17) at t0 and t_k, with p* = c* = fM = 1.

    Parameters
    ----------
    flight : Flight
        The extremal.
    ends : (2, 16) array
        The 16 variables at t0 and t_k.
    free : bool
        Whether t_k is free. Where it is prescribed, (17) asks only that H is constant.
    """
    first, last = (reduced_variables(row, flight.scaled.eccentricity) for row in ends)
    at_start = hamiltonian(flight, first, flight.pieces[0].mode)
    *conditions, at_end = printed_conditions(flight, last[:-1], flight.costates[3:], last[-1])
    energies = [at_start, at_end] if free else [at_start - at_end]
    return float(np.abs([*conditions, *energies]).max())


def printed_jacobian(flight: Flight) -> Array:
    """Derivatives of the printed conditions by the six costates, t_k and C_phi at a meeting, (8, 8)."""
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
