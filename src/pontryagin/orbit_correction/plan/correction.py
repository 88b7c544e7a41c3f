"""The fewest steps that bring a satellite back to its circle, and their plan of least peak: Theorem 4."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentValueError, Infeasible, NotConverged
from pontryagin.orbit_correction.gauges.proof import PROVED, require_closed, unit
from pontryagin.orbit_correction.plan.thrust import Thrust, thrust_of
from pontryagin.validation import members_of, require_digits, vectors
from pontryagin.value import value_class

ROUNDING = 1e-12
"""A gauge that exceeds 1 by at most this counts as 1."""

MOST_STEPS = 1_000_000
"""Largest number of steps that `correct` tries."""


@value_class
@dataclass(frozen=True, eq=False)
class Plan:
    """The correction with the fewest steps and, among those, the least peak: the control of Theorem 4.

    Attributes
    ----------
    thrust : Thrust
        Set of impulses, interval and peak.
    z0 : (..., 3) array
        Deviations (dr, dv_R, dv_T) in units of the orbit's radius and speed.
    steps : (...) int array
        N_min: for "ball" the paper's steps of three impulse components, else steps of one impulse.
    shorter_gauge : (...) array
        Lower bound on alpha(N_min - 1), above 1: the proof that the state lies outside X(N_min - 1, 0), as
        (5) says. Infinite where fewer impulses do not bring the state back at any peak.
    initial_costate : (..., 3) array
        psi_0 of Lemma 9, unit; zeros for the zero state.
    step_controls : (..., N, components) array
        Impulse components of each step, by Theorem 3 and Lemma 10 with the factor alpha; zeros beyond the
        steps of a state.
    certificate : Certificate
        The residual is what remains of the state at the end, relative to z0; the value is alpha of the plan;
        the bound is the one that psi_0 proves.
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
        """alpha(N_min), the Minkowski functional of X(N_min, 0) at z0: the share of the peak used, (...)."""
        return self.certificate.primal_value

    @property
    def impulse_count(self) -> NDArray[np.int64]:
        """How many instants of the plan fire an impulse, (...): the rows of `impulses` that are not zero."""
        return np.asarray(self.impulses.any(axis=-1).sum(axis=-1))

    @property
    def instants(self) -> NDArray[np.int64]:
        """How many instants the plan has, fired or not, (...); two steps of the ball have three."""
        return -(-3 * self.steps // 2) if self.thrust.name == "ball" else self.steps

    @cached_property
    def impulses(self) -> Array:
        """Radial and transverse impulse at the start of each interval, zero rows included, (..., M, 2)."""
        count = self.step_controls.shape[-2] * self.step_controls.shape[-1]
        components = self.step_controls.reshape(*self.steps.shape, count)
        padded = np.concatenate([components, np.zeros((*components.shape[:-1], count % 2))], axis=-1)
        return padded.reshape(*self.steps.shape, -(-count // 2), 2)

    @cached_property
    def controls(self) -> Array:
        """u(k) of the system (7), x(k+1) = A(k) x(k) + u(k), (..., N, 3)."""
        inputs = np.zeros((self.step_controls.shape[-2], 3, self.step_controls.shape[-1]))
        for k in range(len(inputs)):
            inputs[k] = self.thrust.step_input(k)
        return np.asarray(np.einsum("kij,...kj->...ki", inputs, self.step_controls))

    @cached_property
    def states(self) -> Array:
        """x(k) from z0 to the end, step by step as in (3), (..., N + 1, 3).

        By Corollary 1 each step leads from X(N - k, k) to X(N - k - 1, k + 1). By Theorem 1 for the system
        (7) x(k) is on the boundary of alpha X(N - k, k).
        """
        states = [self.z0]
        for k in range(self.controls.shape[-2]):
            states.append(states[-1] @ self.thrust.step_transition(k).T + self.controls[..., k, :])
        return np.stack(states, axis=-2)

    @cached_property
    def costates(self) -> Array:
        """psi(k), with psi(k+1) = A(k)^-T psi(k) of Theorem 2 and (6), (..., N, 3).

        By (4) psi(k+1) is a normal of the controls at u(k), and its negative one of the states at x(k+1).
        """
        costates = np.empty_like(self.controls)
        current = self.initial_costate
        for k in range(costates.shape[-2]):
            costates[..., k, :] = current
            current = current @ np.linalg.inv(self.thrust.step_transition(k))
        return costates


def single(plan: Plan) -> Plan:
    """The plan itself if it is that of one state; otherwise `ValueError` is raised."""
    if plan.steps.shape:
        raise ArgumentValueError(
            f"plan must be that of one state, got a stack of shape {plan.steps.shape}", "plan"
        )
    return plan


def correct(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035, thrust: str = "ball") -> Plan:
    """Bring a satellite near its circular orbit back to it in the fewest steps, section 7.

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
        For a stack of states, arrays are padded with zeros beyond the steps of each state.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If no number of impulses brings a state back, or more than a million steps are needed. The first
        happens at intervals of whole revolutions, where every impulse acts at the same place of the orbit and
        none changes the radius there.
    pontryagin.NotConverged
        If rounding leaves a gap between the bounds on a plan.

    Examples
    --------
    >>> plan = correct([-0.0037787, -0.0039109, 0.0141512])
    >>> int(plan.steps), round(float(plan.gauge), 4), int(plan.impulse_count)
    (4, 0.9286, 6)
    """
    states = vectors("z0", z0, 3)
    engine = thrust_of(thrust, interval, peak)
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
    moving = states.any(axis=-1)
    require_digits("z0", "with interval and peak a plan", moving, plan.gauge, engine.peak * plan.gauge)
    require_closed(plan.certificate, "the plan")
    return plan


def fewest_steps(thrust: Thrust, rows: Array) -> tuple[NDArray[np.int64], Array]:
    """N_min of the states (rows, 3), and the bound on alpha(N_min - 1) that proves that fewer do not suffice.

    alpha(N) decreases strictly and N alpha(N) tends to a constant. While no number of steps is known to
    suffice, the next one tried is therefore N alpha(N), but larger than the last by at least an amount that
    doubles with every try. Once a number that is too small and one that suffices are known, log alpha is
    interpolated in log N between them. After ten tries every third number is the middle of the two, which
    bounds the length of the search.
    """
    moving = rows.any(axis=1)
    too_few = np.where(moving, thrust.fewest - 1, 0)
    enough = np.where(moving, MOST_STEPS + 1, 0)
    reaching, proof = np.full(len(rows), np.nan), np.full(len(rows), np.inf)
    if thrust.fewest > 1:
        proof = np.where(moving, thrust.first_impulse(rows).lower, np.inf)
        enough = np.where(moving & (proof <= 1 + ROUNDING), 1, enough)
        too_few, proof = np.where(enough == 1, 0, too_few), np.where(enough == 1, np.inf, proof)
    guess, following, tries = too_few + 1, too_few.astype(float), 0
    while (open_rows := np.flatnonzero(enough - too_few > 1)).size:
        count = guess[open_rows]
        lower, upper = thrust.bounds(rows[open_rows], count)
        reached = ~(lower > 1 + ROUNDING)
        if (unproved := reached & ~(upper <= 1 + PROVED)).any():
            reason = "the gauge could not be proved: rounding leaves a gap between its bounds"
            members = tuple(open_rows[unproved].tolist())
            raise NotConverged(reason, float((upper - lower)[reached].max()), members)
        enough[open_rows] = np.where(reached, count, enough[open_rows])
        reaching[open_rows] = np.where(reached, lower, reaching[open_rows])
        too_few[open_rows] = np.where(reached, too_few[open_rows], count)
        proof[open_rows] = np.where(reached, proof[open_rows], lower)
        if (too_few >= MOST_STEPS).any():
            worst = rows[int(np.argmax(too_few))]
            raise Infeasible(
                f"z0 = {worst.tolist()} is not corrected in {MOST_STEPS} steps of interval {thrust.interval}",
                "z0",
                members_of(too_few >= MOST_STEPS),
            )
        following[open_rows] = count * np.minimum(lower, 100.0)
        between = _between(too_few, proof, enough, reaching, middle=tries > 9 and tries % 3 == 0)
        onwards = np.where(enough > MOST_STEPS, np.maximum(following, too_few + 2.0**tries), between)
        guess = np.clip(np.ceil(onwards), too_few + 1, np.maximum(enough - 1, 1)).astype(np.int64)
        tries += 1
    return enough, proof


def _between(low: Array, above: Array, high: Array, below: Array, middle: bool) -> Array:
    """N with log alpha = 0, linear in log N from alpha(low) > 1 to alpha(high) <= 1, or the middle."""
    with np.errstate(all="ignore"):
        share = np.log(above) / np.log(above / below)
        found = np.exp(np.log(low) + share * np.log(high / low))
    return np.asarray(np.where(np.isfinite(found) & np.logical_not(middle), found, (low + high) / 2))
