"""Many impulses: alpha N tends to a constant, an ergodic mean over the phase of the orbit.

alpha(N) = max (-z0, psi) / sum |G_k'psi|, and G_k depends on k through the phase of the orbit only. For an
interval that is no rational share of a revolution the phases fill the circle evenly (Weyl), and the sum
over k becomes N times the mean over the phase:

    alpha N  ->  max over psi of (-z0, psi) / mean of |G(phi)'psi|.

The mean does not care where on the circle it begins, so it depends on psi through two numbers only: what
psi pairs with the motion that stays, and the amplitude of what it pairs with the oscillation.
"""

from math import lcm

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from pontryagin.orbit_correction.system import satellite
from pontryagin.validation import positive, vectors

PHASES = 1 << 14
LARGEST_PERIOD = 64
MODES = np.array([[-1.0, 0.0, -2.0], [0.0, 1.0, 0.0], [2.0, 0.0, 2.0]])
"""Rows: two components that turn under e^{At}, and one that stays."""


def modes(z0: ArrayLike) -> Array:
    """Deviations (..., 3) as the amplitude of the oscillation and what stays, (..., 2).

    In the rows of `MODES` the motion is a rotation of the first two components; the third is twice the
    deviation of the angular momentum and stays.

    Examples
    --------
    >>> modes([0.0, 0.001, 0.0]).tolist()
    [0.001, 0.0]
    """
    turned = vectors("z0", z0, 3) @ MODES.T
    return np.stack([np.hypot(turned[..., 0], turned[..., 1]), turned[..., 2]], axis=-1)


def mean_support(
    amplitude: ArrayLike, constant: ArrayLike, interval: float, peak: float, thrust: str
) -> Array:
    """Mean of |G(phi)'psi| over the phase, for psi with given parts in the dual of `modes`, (...).

    Parameters
    ----------
    amplitude, constant : (...) array_like
        Length of psi's part in the turning components, and its part in what stays.
    interval, peak, thrust
        As in `correct`; the interval matters to the ball only, whose steps hold neighbouring impulses.

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
        turned = np.einsum("kij,jl->kil", satellite.transition(-phases), step)
        total += np.linalg.norm(np.einsum("...i,kij->...kj", psi, turned), axis=-1).mean(axis=-1)
    return total / 2


def limit(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035, thrust: str = "ball") -> float:
    """The limit of alpha N as the number of steps grows.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation, dimensionless.
    interval, peak, thrust
        As in `correct`. Where 64 intervals or fewer make whole revolutions the phases repeat, and the
        mean is over those that occur.

    Returns
    -------
    float
        In steps: three impulse components for the ball, else one impulse.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If no number of impulses brings the state back.

    Examples
    --------
    >>> z0 = [-0.0037787, -0.0039109, 0.0141512]
    >>> thrust = Thrust("ball", 0.25, 0.0035)
    >>> many = float(thrust.gauges(np.array([z0]), np.array([20_000])).lower[0]) * 20_000
    >>> abs(many - limit(z0)) < 1e-3
    True
    """
    state = vectors("z0", z0, 3)
    if state.ndim != 1:
        raise ValueError(f"z0 must be (3,), got shape {state.shape}")
    if thrust not in THRUSTS:
        raise ValueError(f"thrust must be one of {', '.join(THRUSTS)}, got {thrust!r}")
    spacing, bound = float(positive("interval", interval)), float(positive("peak", peak))
    if not state.any():
        return 0.0
    period = _period(spacing)
    if period:
        count = 2 * lcm(period, 3) // 3 if thrust == "ball" else period
        engine = Thrust(thrust, spacing, bound)
        count *= -(-engine.fewest // count)
        return count * float(engine.gauges(state[None], np.array([count])).lower[0])
    oscillation, rest = modes(state)

    def proved(angle: float) -> float:
        across, along = np.cos(angle), np.sin(angle)
        paired = oscillation * across + rest * along
        return paired / float(mean_support(across, along, spacing, bound, thrust))

    from scipy.optimize import minimize_scalar

    inside = np.arctan2(rest, oscillation)
    ends = max(-np.pi / 2, inside - np.pi / 2), min(np.pi / 2, inside + np.pi / 2)
    found = minimize_scalar(lambda a: -proved(a), bounds=ends, method="bounded", options={"xatol": 1e-12})
    return float(max(-found.fun, proved(ends[0]), proved(ends[1])))


def _period(interval: float) -> int:
    """How many intervals make whole revolutions; 0 if more than `LARGEST_PERIOD`."""
    turns = np.arange(1, LARGEST_PERIOD + 1) * interval / (2 * np.pi)
    whole = np.flatnonzero(np.abs(turns - np.round(turns)) < 1e-12)
    return int(whole[0]) + 1 if whole.size else 0


def approach(
    z0: ArrayLike, counts: ArrayLike, interval: float = 0.25, peak: float = 0.0035, thrust: str = "ball"
) -> Array:
    """alpha(N) N for whole numbers of steps (k,), (k,)."""
    steps = np.asarray(counts, dtype=np.int64)
    correct(z0, interval, peak, thrust)
    state = np.broadcast_to(vectors("z0", z0, 3), (len(steps), 3))
    engine = Thrust(thrust, float(interval), float(peak))
    return np.array([engine.gauges(state[:1], steps[i : i + 1]).lower[0] for i in range(len(steps))]) * steps
