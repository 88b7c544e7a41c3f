"""Example 2, (3.3) to (3.9): the energy of a Kepler orbit is changed by small thrust."""

from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solved
from pontryagin.averaging.examples.models import example_model, example_system
from pontryagin.errors import ArgumentValueError
from pontryagin.validation import common_shape, finite, positive

ROUND = 1e-6
"""Orbits with at most this eccentricity count as round, without a pericentre as the phase's origin."""


def kepler(E0: ArrayLike, K0: ArrayLike, E1: ArrayLike, l: ArrayLike) -> AveragedSolution:
    """Bring the energy of a Kepler orbit from E0 to E1 at the least cost l tau_1 + integral of u^2, (3.7).

    The gravitational parameter of the attracting centre is 1. The phase is the mean anomaly, and the anomaly
    x is the eccentric one.

    Parameters
    ----------
    E0, E1 : (...) array
        Energies, negative.
    K0 : (...) array
        Angular momentum at the start, with 0 < e0 = sqrt(1 + 2 E0 K0^2) < 1. The approximation also
        requires epsilon to be small compared with e0: a nearly round orbit's pericentre does not move slowly.
    l : (...) array
        Price of a unit of slow time, positive.

    Returns
    -------
    AveragedSolution
        In the slow variables (E, K): duration sqrt(2/l) | |E1|^(1/2) - |E0|^(1/2) |, cost 2 l tau_1; E K^2,
        and with it the eccentricity, stays constant.

    Raises
    ------
    ValueError
        If an argument is not finite, an energy not negative, K0 or l not positive, or the orbit not an
        ellipse or round.

    Examples
    --------
    >>> solution = kepler(E0=-0.5, K0=0.95, E1=-0.35, l=0.1)
    >>> bool(abs(solution.cost - 0.2 * solution.duration) < 1e-12)
    True
    """
    begin, end = _bound("E0", E0), _bound("E1", E1)
    momentum, price = positive("K0", K0), positive("l", l)
    shape = common_shape(E0=begin.shape, K0=momentum.shape, E1=end.shape, l=price.shape)
    squared = 1 + 2 * begin * momentum**2
    if (squared < -1e-14).any():
        most = np.sqrt(-1 / (2 * begin))
        raise ArgumentValueError(
            f"K0 must be below that of the round orbit of the energy E0, 1/sqrt(2|E0|) = "
            f"{np.broadcast_to(most, squared.shape)[squared < -1e-14].flat[0]:.6g}, "
            f"got {np.broadcast_to(momentum, squared.shape)[squared < -1e-14].flat[0]:.6g}",
            "K0",
        )
    if (squared <= ROUND**2).any():
        least = np.sqrt(max(squared.min(), 0.0))
        raise ArgumentValueError(
            f"K0 must leave an eccentricity above {ROUND:g}, got {least:.3g}: the phase is "
            "counted from the pericentre, which a round orbit does not have",
            "K0",
        )
    if (squared == 1).any():
        small = np.broadcast_to(momentum, squared.shape)[squared == 1].flat[0]
        message = f"K0 must leave an eccentricity below 1, got {small:g}, which is too small for that"
        raise ArgumentValueError(message, "K0")
    numbers = (end, price)
    start = np.stack([np.broadcast_to(begin, shape), np.broadcast_to(momentum, shape)], axis=-1)
    return solved(
        example_model("kepler"),
        ("E", "K"),
        start,
        numbers,
        partial(example_system, "kepler", numbers),
    )


def _bound(name: str, value: ArrayLike) -> np.ndarray:
    energy = finite(name, value, "a negative number or an array of them")
    if not (energy < 0).all():
        message = (
            f"{name} must be negative, as the energy of a bound orbit is, got {energy[~(energy < 0)].flat[0]}"
        )
        raise ArgumentValueError(message, name)
    return energy
