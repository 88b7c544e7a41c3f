"""The fewest steps that bring a satellite back to its circle, and the plan of least peak among them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.orbit_correction.gauges.proof import CLOSED, require_closed, unit
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from pontryagin.validation import positive, vectors

ROUNDING = 1e-12
"""A gauge this much above 1 is 1, rounded."""

MOST_STEPS = 1_000_000


@dataclass(frozen=True, eq=False)
class Plan:
    """A correction in the fewest steps and, among those, of the least peak.

    Attributes
    ----------
    thrust : Thrust
        Set of impulses, interval and peak.
    z0 : (..., 3) array
        Deviations (dr, dv_R, dv_T) in units of the orbit's radius and speed.
    steps : (...) int array
        N_min: the paper's steps of three impulse components for "ball", else one impulse a step.
    shorter_gauge : (...) array
        Lower bound on alpha(N_min - 1), above 1: the proof that fewer steps do not do. Infinite where
        fewer impulses do not span the space.
    initial_costate : (..., 3) array
        psi_0, unit; zeros for the zero state.
    step_controls : (..., N, components) array
        Impulse components of each step; zeros beyond the steps of a state.
    certificate : Certificate
        What remains of the state at the end, relative to z0; alpha of the plan; the bound psi_0 proves.
    """

    thrust: Thrust
    z0: Array
    steps: NDArray[np.int64]
    shorter_gauge: Array
    initial_costate: Array
    step_controls: Array
    certificate: Certificate

    @property
    def gauge(self) -> Array:
        """alpha(N_min), the share of the peak that the plan uses, (...)."""
        return self.certificate.primal_value

    @property
    def impulse_count(self) -> NDArray[np.int64]:
        """How many impulses the plan fires, (...); a ball's step holds one and a half."""
        return -(-3 * self.steps // 2) if self.thrust.name == "ball" else self.steps

    @cached_property
    def impulses(self) -> Array:
        """Radial and transverse impulse at the start of each interval, (..., M, 2)."""
        count = self.step_controls.shape[-2] * self.step_controls.shape[-1]
        components = self.step_controls.reshape(*self.steps.shape, count)
        padded = np.concatenate([components, np.zeros((*components.shape[:-1], count % 2))], axis=-1)
        return padded.reshape(*self.steps.shape, -(-count // 2), 2)

    @cached_property
    def controls(self) -> Array:
        """u(k) of x(k+1) = A(k) x(k) + u(k), (..., N, 3)."""
        inputs = np.zeros((self.step_controls.shape[-2], 3, self.step_controls.shape[-1]))
        for k in range(len(inputs)):
            inputs[k] = self.thrust.step_input(k)
        return np.einsum("kij,...kj->...ki", inputs, self.step_controls)

    @cached_property
    def states(self) -> Array:
        """x(k) from z0 to the end, (..., N + 1, 3)."""
        states = [self.z0]
        for k in range(self.controls.shape[-2]):
            states.append(states[-1] @ self.thrust.step_transition(k).T + self.controls[..., k, :])
        return np.stack(states, axis=-2)

    @cached_property
    def costates(self) -> Array:
        """psi(k), with psi(k+1) = A(k)^-T psi(k), (..., N, 3)."""
        costates = np.empty_like(self.controls)
        current = self.initial_costate
        for k in range(costates.shape[-2]):
            costates[..., k, :] = current
            current = current @ np.linalg.inv(self.thrust.step_transition(k))
        return costates


def single(plan: Plan) -> Plan:
    """The plan itself, if it is that of one state; else `ValueError`."""
    if plan.steps.shape:
        raise ValueError(f"plan must be that of one state, got a stack of shape {plan.steps.shape}")
    return plan


def correct(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035, thrust: str = "ball") -> Plan:
    """Bring a satellite near its circular orbit back to it with the fewest impulses, section 7.

    Parameters
    ----------
    z0 : (..., 3) array_like
        Deviations of radius, radial and transverse speed, in units of the orbit's radius and speed.
    interval : float
        Time between impulses, in radians of the orbit.
    peak : float
        Bound on an impulse, in orbital speeds.
    thrust : {"ball", "disc", "box"}
        Set of admissible impulses; "ball" is the paper's.

    Returns
    -------
    Plan
        For a stack of states, arrays padded with zeros beyond each state's own steps.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If no number of impulses brings a state back: at intervals of whole revolutions every impulse acts
        at the same place and none changes the radius. Also if a million steps do not.
    pontryagin.NotConverged
        If rounding leaves a plan without its proof.

    Examples
    --------
    >>> plan = correct([-0.0037787, -0.0039109, 0.0141512])
    >>> int(plan.steps), round(float(plan.gauge), 4), int(plan.impulse_count)
    (4, 0.9286, 6)
    """
    states = vectors("z0", z0, 3)
    if thrust not in THRUSTS:
        raise ValueError(f"thrust must be one of {', '.join(THRUSTS)}, got {thrust!r}")
    spacing, bound = positive("interval", interval), positive("peak", peak)
    if spacing.ndim or bound.ndim:
        raise ValueError(
            f"interval and peak must be single numbers, got shapes {spacing.shape} and {bound.shape}"
        )
    engine = Thrust(thrust, float(spacing), float(bound))
    rows = states.reshape(-1, 3)
    steps, shorter = fewest_steps(engine, rows)
    found = engine.gauges(rows, steps)
    residual = engine.miss(rows, steps, found.controls)
    most, shape = int(steps.max(initial=0)), states.shape[:-1]
    controls = found.controls[:, :most].reshape(*shape, most, found.controls.shape[2])
    plan = Plan(
        engine,
        states,
        steps.reshape(shape),
        shorter.reshape(shape),
        unit(found.costates).reshape(*shape, 3),
        engine.peak * controls,
        Certificate(residual.reshape(shape), found.upper.reshape(shape), found.lower.reshape(shape)),
    )
    require_closed(plan.certificate, "the plan")
    return plan


def fewest_steps(thrust: Thrust, rows: Array) -> tuple[NDArray[np.int64], Array]:
    """N_min of the states (rows, 3), and what proves that one step fewer does not do.

    alpha(N) falls strictly and N alpha(N) tends to a constant, so that N alpha(N) is a good next guess; it
    is moved on further from try to try. Between a number too few and one that does, log alpha is
    interpolated in log N; in the long run every third try is the middle, so that the search is bounded.
    """
    moving = rows.any(axis=1)
    too_few = np.where(moving, thrust.fewest - 1, 0)
    enough = np.where(moving, MOST_STEPS + 1, 0)
    proof, reaching = np.full(len(rows), np.inf), np.full(len(rows), np.nan)
    guess, following, tries = too_few + 1, too_few.astype(float), 0
    while (open_rows := np.flatnonzero(enough - too_few > 1)).size:
        count = guess[open_rows]
        lower, upper = thrust.bounds(rows[open_rows], count)
        reached = ~(lower > 1 + ROUNDING)
        if (reached & ~(upper <= 1 + CLOSED)).any():
            raise NotConverged("the gauge could not be proved: lost to rounding", float(upper[reached].max()))
        enough[open_rows] = np.where(reached, count, enough[open_rows])
        reaching[open_rows] = np.where(reached, lower, reaching[open_rows])
        too_few[open_rows] = np.where(reached, too_few[open_rows], count)
        proof[open_rows] = np.where(reached, proof[open_rows], lower)
        if (too_few >= MOST_STEPS).any():
            worst = rows[int(np.argmax(too_few))]
            raise Infeasible(
                f"z0 = {worst.tolist()} is not corrected in {MOST_STEPS} steps of interval {thrust.interval}"
            )
        following[open_rows] = count * np.minimum(lower, 100.0)
        between = _between(too_few, proof, enough, reaching, middle=tries > 9 and tries % 3 == 0)
        onwards = np.where(enough > MOST_STEPS, np.maximum(following, too_few + 2.0**tries), between)
        guess = np.clip(np.ceil(onwards), too_few + 1, np.maximum(enough - 1, 1)).astype(np.int64)
        tries += 1
    return enough, proof


def _between(low: NDArray, above: NDArray, high: NDArray, below: NDArray, middle: bool) -> Array:
    """Where log alpha, linear in log N, is 0 between alpha(low) > 1 and alpha(high) <= 1; or the middle."""
    with np.errstate(all="ignore"):
        share = np.log(above) / np.log(above / below)
        found = np.exp(np.log(low) + share * np.log(high / low))
    return np.where(np.isfinite(found) & np.logical_not(middle), found, (low + high) / 2)
