"""Impulses in p-balls: between the paper's ball (p = 2) and the square (p infinite), strictly convex still.

Three successive impulse components form u with |u|_p <= peak, the larger p the closer to the square. All
that the paper proves of strictly convex sets applies; the support function of G_k U is |G_k'psi|_q with
1/p + 1/q = 1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.orbit_correction.gauges.columns import Columns, mixture, whitened
from pontryagin.orbit_correction.system.satellite import step_factors
from pontryagin.validation import finite, positive, vectors

ITERATIONS = 200
CLOSED = 5e-10
"""Relative gap between the peak of the controls and the bound at which columns are enough."""

MOST_STEPS = 2000


@dataclass(frozen=True, eq=False)
class PowerGauge:
    """How much of its peak a satellite needs, for impulses in p-balls.

    Attributes
    ----------
    p : float
        Exponent.
    steps : int
        Steps of three impulse components.
    costate : (3,) array
        psi_0, unit; zeros for the zero state.
    step_controls : (steps, 3) array
        Impulse components, orbital speeds.
    certificate : Certificate
        What the controls miss, relative to the state; their alpha; the bound that psi_0 proves.
    """

    p: float
    steps: int
    costate: Array
    step_controls: Array
    certificate: Certificate

    @property
    def alpha(self) -> float:
        """The gauge of the state in the controllable set."""
        return float(self.certificate.primal_value)

    @property
    def impulse_count(self) -> int:
        """Impulses of these steps."""
        return -(-3 * self.steps // 2)


def power_gauge(
    z0: ArrayLike, steps: int, p: float, interval: float = 0.25, peak: float = 0.0035
) -> PowerGauge:
    """Gauge of a state in the set of those corrected in given steps, |u|_p <= peak in each.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation, dimensionless.
    steps : int
        Steps of three impulse components, at least one.
    p : float
        Exponent, 1 < p < infinity.
    interval, peak : float
        As in `correct`.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If the impulses of these steps do not span the space.
    pontryagin.NotConverged
        If the bounds do not meet.

    Examples
    --------
    >>> z0 = [-0.0037787, -0.0039109, 0.0141512]
    >>> [round(power_gauge(z0, 4, p).alpha, 4) for p in (2, 8, 16)]
    [0.9286, 0.6944, 0.6585]
    """
    state = vectors("z0", z0, 3)
    if state.ndim != 1:
        raise ValueError(f"z0 must be (3,), got shape {state.shape}")
    if not isinstance(steps, int | np.integer) or steps < 1:
        raise ValueError(f"steps must be a positive whole number, got {steps!r}")
    exponent = float(finite("p", p, "a number greater than 1"))
    if exponent <= 1:
        raise ValueError(f"p must be greater than 1, got {p}")
    size = float(np.linalg.norm(state))
    plain = float(positive("peak", peak)) * step_factors(int(steps), float(positive("interval", interval)))
    if np.linalg.matrix_rank(np.hstack(list(plain)), tol=1e-9 * float(peak)) < 3:
        raise Infeasible(f"{steps} steps of interval {interval} do not span the space of states")
    if size == 0:
        zero = np.array(0.0)
        return PowerGauge(exponent, int(steps), state, 0 * plain[:, 0], Certificate(zero, zero, zero))
    factors, target = whitened(plain, -state / size)
    controls, psi, bound = _generate(factors, target, exponent)
    missed = np.abs(np.einsum("kij,kj->i", plain, controls) + state / size).max()
    alpha = np.linalg.norm(controls, ord=exponent, axis=1).max()
    normal = np.linalg.lstsq(_root(plain).T, psi, rcond=None)[0]
    certificate = Certificate(np.array(missed), np.array(size * alpha), np.array(size * bound))
    return PowerGauge(
        exponent, int(steps), normal / np.linalg.norm(normal), float(peak) * size * controls, certificate
    )


def fewest_power_steps(
    z0: ArrayLike, p: float, interval: float = 0.25, peak: float = 0.0035
) -> tuple[PowerGauge, float]:
    """The gauge at N_min, and the lower bound on alpha(N_min - 1) that proves it (infinite below one step).

    Raises
    ------
    pontryagin.Infeasible
        If no number of steps up to 2000 does.

    Examples
    --------
    >>> found, shorter = fewest_power_steps([-0.0037787, -0.0039109, 0.0141512], 16)
    >>> found.steps, found.alpha <= 1 < shorter
    (3, True)
    """
    too_few, enough, proof = 0, MOST_STEPS + 1, np.inf
    guess, best = 1, None
    while enough - too_few > 1:
        try:
            found = power_gauge(z0, guess, p, interval, peak)
            reached, lower = found.alpha <= 1, float(found.certificate.dual_value)
        except Infeasible:
            reached, lower = False, np.inf
        if reached:
            enough, best = guess, found
        else:
            too_few, proof = guess, lower
            if too_few >= MOST_STEPS:
                break
        following = int(np.ceil(guess * min(lower, 1e3)))
        guess = min(max(following, too_few + 1), enough - 1, MOST_STEPS)
    if best is None:
        raise Infeasible(f"z0 = {np.asarray(z0).tolist()} is not corrected in {MOST_STEPS} steps")
    return best, proof


def _root(factors: NDArray) -> Array:
    return np.linalg.cholesky(np.einsum("kij,klj->il", factors, factors))


def _generate(factors: NDArray, target: NDArray, p: float) -> tuple[NDArray, NDArray, float]:
    """Controls (steps, 3) of the least largest p-norm, the costate and its bound."""
    steps = len(factors)
    axes = np.tile(np.concatenate([np.eye(3), -np.eye(3)]), (steps, 1))
    columns = Columns(np.repeat(np.arange(steps), 6), axes, np.zeros(len(axes)))
    bound, costate = 0.0, target
    for _ in range(ITERATIONS):
        _, psi, controls = mixture(factors, target, columns, shared=True)
        offered, support = _support_points(np.einsum("kij,i->kj", factors, psi), p)
        proved = float(target @ psi / support.sum())
        if proved > bound:
            bound, costate = proved, psi
        peak = float(np.linalg.norm(controls, ord=p, axis=1).max())
        if peak - bound <= CLOSED * peak:
            return controls, costate, bound
        columns = columns.joined(np.arange(steps), offered, np.zeros(steps))
    raise NotConverged("the gauge of p-balls was not found", peak / bound - 1)


def _support_points(along: NDArray, p: float) -> tuple[NDArray, NDArray]:
    """u of the unit p-ball with the largest (v, u), and that value |v|_q."""
    q = p / (p - 1)
    largest = np.abs(along).max(axis=1, keepdims=True)
    scaled = along / np.maximum(largest, 1e-300)
    sizes = np.linalg.norm(scaled, ord=q, axis=1)
    points = np.sign(scaled) * (np.abs(scaled) / np.maximum(sizes, 1e-300)[:, None]) ** (q - 1)
    return points, sizes * largest[:, 0]
