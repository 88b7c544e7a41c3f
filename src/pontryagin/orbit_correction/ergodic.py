"""The limit of N alpha(N) for many steps, a mean over the phase of the orbit.

alpha(N) = max (-z0, psi) / sum |G_k'psi|, and G_k depends on k through the phase of the orbit only. If the
interval is an irrational share of a revolution the phases are equidistributed on the circle (Weyl), and the
sum over k tends to N times the mean over the phase:

    alpha N  ->  max over psi of (-z0, psi) / mean of |G(phi)'psi|.

The mean does not depend on the phase at which the circle begins. It therefore depends on psi through two
numbers only: the component of psi along the constant part of the motion, and the length of its component
along the oscillation.
"""

from math import lcm

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.plan.thrust import thrust_of
from pontryagin.orbit_correction.system import satellite
from pontryagin.validation import vectors

PHASES = 1 << 14
"""Number of phases over which the mean is taken."""

LARGEST_PERIOD = 64
"""Largest number of intervals for which it is checked whether they make whole revolutions."""

MODES = np.array([[-1.0, 0.0, -2.0], [0.0, 1.0, 0.0], [2.0, 0.0, 2.0]])
"""The rows give components of z: the first two rotate under e^{At}, the third is constant."""


def modes(z0: ArrayLike) -> Array:
    """The amplitude of the oscillation and the constant part of deviations (..., 3), as (..., 2).

    The motion rotates the first two of the components of `MODES`. The third, twice the deviation of the
    angular momentum, is constant.

    Examples
    --------
    >>> modes([0.0, 0.001, 0.0]).tolist()
    [0.001, 0.0]
    """
    parts = vectors("z0", z0, 3) @ MODES.T
    return np.stack([np.hypot(parts[..., 0], parts[..., 1]), parts[..., 2]], axis=-1)


def mean_support(
    amplitude: ArrayLike, constant: ArrayLike, interval: float, peak: float, thrust: str
) -> Array:
    """Mean of |G(phi)'psi| over the phase, for psi with given components in the dual of `modes`, (...).

    Parameters
    ----------
    amplitude, constant : (...) array_like
        Length of the component of psi along the oscillation, and its component along the constant part.
    interval, peak, thrust
        As in `correct`. Only the mean of the ball depends on the interval, since its steps contain
        neighbouring impulses.

    Examples
    --------
    >>> round(float(mean_support(1.0, 0.0, 0.25, 1.0, "box")), 6) == round(6 / np.pi, 6)
    True
    """
    rho, rest = np.broadcast_arrays(np.asarray(amplitude, float), np.asarray(constant, float))
    psi = np.stack([rho, np.zeros_like(rho), rest], axis=-1) @ MODES
    phases = 2 * np.pi * np.arange(PHASES) / PHASES
    columns = peak * satellite.transition(-phases)[:, :, 1:]
    if thrust != "ball":
        along = np.einsum("...i,kij->...kj", psi, columns)
        each = np.abs(along).sum(axis=-1) if thrust == "box" else np.linalg.norm(along, axis=-1)
        return np.asarray(each.mean(axis=-1))
    total = np.zeros(rho.shape)
    for step in peak * satellite.step_factors(2, interval):
        rotated = np.einsum("kij,jl->kil", satellite.transition(-phases), step)
        total += np.linalg.norm(np.einsum("...i,kij->...kj", psi, rotated), axis=-1).mean(axis=-1)
    return total / 2


def limit(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035, thrust: str = "ball") -> float:
    """The limit of alpha N as the number of steps grows.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation, dimensionless.
    interval, peak, thrust
        As in `correct`. Where 64 intervals or fewer make whole revolutions the phases repeat, and the mean
        is over the phases that occur.

    Returns
    -------
    float
        The limit, where N counts steps: of three impulse components for the ball, else of one impulse.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If no number of impulses brings the state back.

    Examples
    --------
    >>> z0 = [-0.0037787, -0.0039109, 0.0141512]
    >>> thrust = thrust_of("ball", 0.25, 0.0035)
    >>> many = float(thrust.gauges(np.array([z0]), np.array([20_000])).lower[0]) * 20_000
    >>> abs(many - limit(z0)) < 1e-3
    True
    """
    state, engine = arguments.state(z0), thrust_of(thrust, interval, peak)
    if not state.any():
        return 0.0
    period = _period(engine.interval)
    if period:
        count = 2 * lcm(period, 3) // 3 if thrust == "ball" else period
        count *= -(-engine.fewest // count)
        return count * float(engine.gauges(state[None], np.array([count])).lower[0])
    oscillation, rest = modes(state)

    def proved(angle: float) -> float:
        across, along = np.cos(angle), np.sin(angle)
        mean = mean_support(across, along, engine.interval, engine.peak, thrust)
        return float((oscillation * across + rest * along) / mean)

    from scipy.optimize import minimize_scalar

    inside = np.arctan2(rest, oscillation)
    ends = max(-np.pi / 2, inside - np.pi / 2), min(np.pi / 2, inside + np.pi / 2)
    found = minimize_scalar(lambda a: -proved(a), bounds=ends, method="bounded", options={"xatol": 1e-12})
    return float(max(-found.fun, proved(ends[0]), proved(ends[1])))


def _period(interval: float) -> int:
    """The least number of intervals that make whole revolutions; 0 if it exceeds `LARGEST_PERIOD`."""
    turns = np.arange(1, LARGEST_PERIOD + 1) * interval / (2 * np.pi)
    whole = np.flatnonzero(np.abs(turns - np.round(turns)) < 1e-12)
    return int(whole[0]) + 1 if whole.size else 0


def approach(
    z0: ArrayLike, counts: ArrayLike, interval: float = 0.25, peak: float = 0.0035, thrust: str = "ball"
) -> Array:
    """alpha(N) N, (k,), for numbers of steps N (k,)."""
    steps = np.asarray(counts, dtype=np.int64)
    correct(z0, interval, peak, thrust)
    state = np.broadcast_to(vectors("z0", z0, 3), (len(steps), 3))
    engine = thrust_of(thrust, interval, peak)
    return np.array([engine.gauges(state[:1], steps[i : i + 1]).lower[0] for i in range(len(steps))]) * steps
