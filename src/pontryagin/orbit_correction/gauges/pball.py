"""The gauge for impulses in p-balls, strictly convex sets between the paper's ball (p = 2) and the cube.

Three successive impulse components form a control u with |u|_p <= peak; as p grows the set tends to the cube.
The paper's results on strictly convex sets, Lemma 2, Lemma 3, Lemma 4 and Lemma 5, apply. The support
function of G_k U is |G_k'psi|_q with 1/p + 1/q = 1.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentValueError, Infeasible, NotConverged
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.gauges.columns import Columns, gram_root, mixture, whitened
from pontryagin.orbit_correction.system.satellite import step_factors
from pontryagin.validation import finite
from pontryagin.value import value_class

ITERATIONS = 200
"""Largest number of rounds of column generation."""

CLOSED = 5e-10
"""Column generation ends when the gap between peak and bound, relative to the peak, is at most this."""

MOST_STEPS = 2000
"""Largest number of steps that `fewest_power_steps` tries."""


@value_class
@dataclass(frozen=True, eq=False)
class PowerGauge:
    """The share of its peak that a satellite needs, for impulses in p-balls.

    Attributes
    ----------
    p : float
        Exponent of the p-balls.
    steps : int
        Number of steps of three impulse components.
    costate : (3,) array
        psi_0, unit; zeros for the zero state.
    step_controls : (steps, 3) array
        Impulse components of each step, orbital speeds.
    certificate : Certificate
        The residual is what the controls leave of the state, relative to the state; the value is their alpha;
        the bound is the one that psi_0 proves.
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
        """The number of impulses in these steps."""
        return -(-3 * self.steps // 2)


def power_gauge(
    z0: ArrayLike, steps: int, p: float, interval: float = 0.25, peak: float = 0.0035
) -> PowerGauge:
    """Gauge of a state in the set of states that given steps correct, with |u|_p <= peak in each step.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation, dimensionless.
    steps : int
        Number of steps of three impulse components, at least one.
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
        If the gap between the bounds does not close.

    Examples
    --------
    >>> z0 = [-0.0037787, -0.0039109, 0.0141512]
    >>> [round(power_gauge(z0, 4, p).alpha, 4) for p in (2, 8, 16)]
    [0.9286, 0.6944, 0.6585]
    """
    state, number = arguments.state(z0), arguments.count("steps", steps)
    given = finite("p", p, "a number greater than 1")
    if given.ndim or not given > 1:
        raise ArgumentValueError(f"p must be a number greater than 1, got {given.tolist()}", "p")
    exponent = float(given)
    spacing, bound = arguments.positive_number("interval", interval), arguments.positive_number("peak", peak)
    size, plain = float(np.linalg.norm(state)), bound * step_factors(number, spacing)
    if np.linalg.matrix_rank(np.hstack(list(plain)), tol=1e-9 * bound) < 3:
        reason = f"steps = {number} of interval = {spacing} do not span the space of states"
        raise Infeasible(reason, "steps")
    if size == 0:
        zero = np.array(0.0)
        return PowerGauge(exponent, number, state, 0 * plain[:, 0], Certificate(zero, zero, zero))
    factors, target = whitened(plain, -state / size)
    controls, psi, proved = _generate(factors, target, exponent)
    missed = np.abs(np.einsum("kij,kj->i", plain, controls) + state / size).max()
    alpha = np.linalg.norm(controls, ord=exponent, axis=1).max()
    normal = np.linalg.lstsq(gram_root(plain).T, psi, rcond=None)[0]
    certificate = Certificate(np.array(missed), np.array(size * alpha), np.array(size * proved))
    return PowerGauge(exponent, number, normal / np.linalg.norm(normal), bound * size * controls, certificate)


def fewest_power_steps(
    z0: ArrayLike, p: float, interval: float = 0.25, peak: float = 0.0035
) -> tuple[PowerGauge, float]:
    """The gauge at N_min, and a lower bound above 1 on alpha(N_min - 1), which is infinite if N_min = 1.

    Raises
    ------
    pontryagin.Infeasible
        If no number of steps up to 2000 corrects the state.

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
        state = np.asarray(z0).tolist()
        raise Infeasible(f"z0 = {state} is not corrected in {MOST_STEPS} steps of interval {interval}", "z0")
    return best, proof


def _generate(factors: Array, target: Array, p: float) -> tuple[Array, Array, float]:
    """The controls (steps, 3) whose largest p-norm is least, the costate, and the bound that it proves."""
    steps = len(factors)
    axes = np.tile(np.concatenate([np.eye(3), -np.eye(3)]), (steps, 1))
    columns = Columns(np.repeat(np.arange(steps), 6), axes, np.zeros(len(axes)))
    bound, costate = 0.0, target
    for _ in range(ITERATIONS):
        _, psi, controls = mixture(factors, target, columns)
        offered, support = _support_points(np.einsum("kij,i->kj", factors, psi), p)
        proved = float(target @ psi / support.sum())
        if proved > bound:
            bound, costate = proved, psi
        peak = float(np.linalg.norm(controls, ord=p, axis=1).max())
        if peak - bound <= CLOSED * peak:
            return controls, costate, bound
        columns = columns.joined(np.arange(steps), offered, np.zeros(steps))
    raise NotConverged(f"the gauge for p = {p} was not found in {ITERATIONS} iterations", peak / bound - 1)


def _support_points(along: Array, p: float) -> tuple[Array, Array]:
    """For each v the point u of the unit p-ball with the largest (v, u), and this value |v|_q."""
    q = p / (p - 1)
    largest = np.abs(along).max(axis=1, keepdims=True)
    scaled = along / np.maximum(largest, 1e-300)
    sizes = np.linalg.norm(scaled, ord=q, axis=1)
    points = np.sign(scaled) * (np.abs(scaled) / np.maximum(sizes, 1e-300)[:, None]) ** (q - 1)
    return points, sizes * largest[:, 0]
