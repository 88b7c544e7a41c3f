"""From a control given by few numbers to control, state and costate at any times; shared by the solvers."""

from math import isfinite

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.jit import Batched
from pontryagin.triple_integrator import kernels
from pontryagin.triple_integrator.problem.maneuver import Maneuver


def over_stack(solver: Batched, maneuver: Maneuver) -> Array:
    """Run a scalar solver (c1, c2, c3, T) -> numbers over a manoeuvre or a stack, as (..., numbers)."""
    c = _within_range(maneuver.moments)
    if c.ndim == 1:
        result = solver.one(*c.tolist(), float(maneuver.duration))
    else:
        flat = c.reshape(-1, 3)
        result = solver(flat[:, 0], flat[:, 1], flat[:, 2], maneuver.duration.ravel())
        result = result.reshape(*maneuver.shape, result.shape[-1])
    return _within_range(result)


def _within_range(numbers: NDArray) -> Array:
    if not (all(map(isfinite, numbers.tolist())) if numbers.ndim == 1 else np.isfinite(numbers).all()):
        lost = np.argwhere(~np.isfinite(numbers))[0, :-1].tolist()
        where = f"; not so at index {lost}" if lost else ""
        raise ValueError(
            f"xf must give, with x0 and tf - t0, a control within the range of floating point{where}"
        )
    return numbers


def truncated_power(t: NDArray, knots: NDArray, order: int) -> Array:
    """(t - knot)_+^n / n! for times (..., k) and knots (..., j), as (..., k, j); a knot of nan gives 0."""
    elapsed = t[..., :, None] - knots[..., None, :]
    if order == 0:
        return np.where(elapsed >= 0, 1.0, 0.0)
    past = np.where(elapsed > 0, elapsed, 0.0)
    return past**order / (1, 1, 2, 6, 24, 120)[order]


def response(t: NDArray, knots: NDArray, amplitudes: NDArray, order: int) -> Array:
    """State reached from rest under sums of amplitude (t - knot)_+^n / n! in u, (..., k, 3).

    ``order`` is n + 1, what x3 receives: 0 for impulses, 1 for steps, 2 for ramps.
    """
    weights = amplitudes[..., :, None]
    parts = [(truncated_power(t, knots, order + i) @ weights)[..., 0] for i in (2, 1, 0)]
    return np.stack(parts, axis=-1)


def bang_bang(t: NDArray, switches: NDArray, first: NDArray) -> Array:
    """u = first, changing sign at each switch; at a switch the later value."""
    count = truncated_power(t, switches, 0).sum(axis=-1)
    return first[..., None] * np.where(count % 2 == 0, 1.0, -1.0)


def bang_bang_response(t: NDArray, t0: NDArray, switches: NDArray, first: NDArray) -> Array:
    """State reached from rest under `bang_bang`."""
    start = np.broadcast_to(t0[..., None], (*switches.shape[:-1], 1))
    knots = np.concatenate([start, switches], axis=-1)
    return response(t, knots, first[..., None] * np.array([1.0, -2.0, 2.0]), order=1)


def switch_times(tf: NDArray, duration: NDArray, shares: NDArray) -> Array:
    """Times of the switches that happen, in order, then nan, (..., 2)."""
    a, b = shares[..., 0], shares[..., 1]
    first = np.where((a < 1) & (a > b), tf - duration * a, np.nan)
    second = np.where((b > 0) & (a > b), tf - duration * b, np.nan)
    missing = np.isnan(first)
    return np.stack([np.where(missing, second, first), np.where(missing, np.nan, second)], axis=-1)


def first_sign(levels: NDArray, shares: NDArray) -> Array:
    """Sign of the control at the start: that of the level unless the inner piece reaches the start."""
    a, b = shares[..., 0], shares[..., 1]
    return np.where((a == 1) & (a > b), -1.0, 1.0) * np.sign(levels)


def breakpoints(events: NDArray) -> Array:
    """The events of one problem that happen, sorted."""
    if events.ndim != 1:
        raise ValueError(f"breakpoints are those of one manoeuvre, got a stack of shape {events.shape[:-1]}")
    return np.sort(events[np.isfinite(events)])


def switching_quadratic(shares: NDArray, duration: NDArray) -> Array:
    """Multipliers of (s - aT)(s - bT), whose sign the control has, (..., 3)."""
    a, b = shares[..., 0], shares[..., 1]
    return np.stack([np.full(a.shape, 2.0), -duration * (a + b), duration * duration * a * b], axis=-1)


def normalised(multipliers: NDArray, moments: NDArray) -> Array:
    """Multipliers scaled so that l'c = 1, (1.16); zeros where c = 0 and no scaling does it."""
    pairing = (multipliers * moments).sum(axis=-1, keepdims=True)
    return np.divide(multipliers, pairing, out=np.zeros_like(multipliers), where=pairing != 0)


def costate(tf: NDArray, t: NDArray, multipliers: NDArray) -> Array:
    """psi(t) = Phi(tf, t)' l, solution of (1.15), (..., k, 3)."""
    s = tf[..., None] - t
    l1, l2, l3 = (multipliers[..., None, i] for i in range(3))
    third = kernels.dual_function(l1, l2, l3, s)
    return np.stack(np.broadcast_arrays(l1, l1 * s + l2, third), axis=-1)


def switch_condition(shares: NDArray) -> Array:
    """Displacement of each switch of `switch_times` per relative change of the scaled moments, (..., 2).

    From the derivative of the moments by (v, a, b): 1 outside and -1 inside, -2 v (3a^2, 2a, 1) and
    2 v (3b^2, 2b, 1).
    """
    a, b = shares[..., 0], shares[..., 1]
    happens = np.stack([(a < 1) & (a > b), (b > 0) & (a > b)], axis=-1)
    rows = [1 - 2 * (a**i - b**i) for i in (3, 2, 1)]
    level = np.stack(rows, axis=-1)
    at_a = np.stack([3 * a**2, 2 * a, np.ones_like(a)], axis=-1)
    at_b = np.stack([3 * b**2, 2 * b, np.ones_like(b)], axis=-1)
    jacobian = np.stack([level, -2 * at_a, 2 * at_b], axis=-1)
    narrow = np.abs(np.linalg.det(jacobian)) < 1e-290
    inverse = np.linalg.inv(np.where(narrow[..., None, None], np.eye(3), jacobian))
    reaction = np.abs(inverse[..., 1:, :]).sum(axis=-1)
    result = np.where(happens & ~narrow[..., None], reaction, np.inf)
    alone = happens[..., 1:] & ~happens[..., :1]
    return np.where(alone, result[..., ::-1], result)
