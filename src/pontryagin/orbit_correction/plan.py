"""The fewest steps that bring a satellite back to its circle, and the plan of least peak among them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible
from pontryagin.orbit_correction.thrust import THRUSTS, Gauges, Thrust
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
    z0: NDArray[np.float64]
    steps: NDArray[np.int64]
    shorter_gauge: NDArray[np.float64]
    initial_costate: NDArray[np.float64]
    step_controls: NDArray[np.float64]
    certificate: Certificate

    @property
    def gauge(self) -> NDArray[np.float64]:
        """alpha(N_min), the share of the peak that the plan uses, (...)."""
        return self.certificate.primal_value

    @property
    def impulse_count(self) -> NDArray[np.int64]:
        """How many impulses the plan fires, (...); a ball's step holds one and a half."""
        return -(-3 * self.steps // 2) if self.thrust.name == "ball" else self.steps

    @cached_property
    def impulses(self) -> NDArray[np.float64]:
        """Radial and transverse impulse at the start of each interval, (..., M, 2)."""
        components = self.step_controls.reshape(*self.steps.shape, -1)
        missing = components.shape[-1] % 2
        padded = np.concatenate([components, np.zeros((*components.shape[:-1], missing))], axis=-1)
        return padded.reshape(*self.steps.shape, -1, 2)

    @cached_property
    def controls(self) -> NDArray[np.float64]:
        """u(k) of x(k+1) = A(k) x(k) + u(k), (..., N, 3)."""
        inputs = np.zeros((self.step_controls.shape[-2], 3, self.step_controls.shape[-1]))
        for k in range(len(inputs)):
            inputs[k] = self.thrust.step_input(k)
        return np.einsum("kij,...kj->...ki", inputs, self.step_controls)

    @cached_property
    def states(self) -> NDArray[np.float64]:
        """x(k) from z0 to the end, (..., N + 1, 3)."""
        states = [self.z0]
        for k in range(self.controls.shape[-2]):
            states.append(states[-1] @ self.thrust.step_transition(k).T + self.controls[..., k, :])
        return np.stack(states, axis=-2)

    @cached_property
    def costates(self) -> NDArray[np.float64]:
        """psi(k), with psi(k+1) = A(k)^-T psi(k), (..., N, 3)."""
        costates = np.empty_like(self.controls)
        current = self.initial_costate
        for k in range(costates.shape[-2]):
            costates[..., k, :] = current
            current = current @ np.linalg.inv(self.thrust.step_transition(k))
        return costates


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
        at the same place and none changes the radius.

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
    shape = states.shape[:-1]
    lengths = np.linalg.norm(found.costates, axis=-1, keepdims=True)
    costates = np.divide(found.costates, lengths, out=np.zeros_like(found.costates), where=lengths > 0)
    return Plan(
        engine,
        states,
        steps.reshape(shape),
        shorter.reshape(shape),
        costates.reshape(*shape, 3),
        engine.peak * found.controls[:, : steps.max(initial=0)].reshape(*shape, -1, found.controls.shape[2]),
        Certificate(residual.reshape(shape), found.upper.reshape(shape), found.lower.reshape(shape)),
    )


def fewest_steps(thrust: Thrust, rows: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """N_min of the states (rows, 3), and what proves that one step fewer does not do.

    alpha(N) falls strictly and N alpha(N) tends to a constant, so that N alpha(N), rounded up, is a good
    next guess; it is kept between the largest N known to be too few and the smallest known to do.
    """
    moving = rows.any(axis=1)
    too_few = np.where(moving, thrust.fewest - 1, 0)
    enough = np.where(moving, MOST_STEPS + 1, 0)
    proof = np.full(len(rows), np.inf)
    guess = np.maximum(too_few + 1, 1)
    while (open_rows := np.flatnonzero(enough - too_few > 1)).size:
        count = guess[open_rows]
        found: Gauges = thrust.gauges(rows[open_rows], count)
        reached = found.upper <= 1 + ROUNDING
        enough[open_rows] = np.where(reached, count, enough[open_rows])
        too_few[open_rows] = np.where(reached, too_few[open_rows], count)
        proof[open_rows] = np.where(reached, proof[open_rows], found.lower)
        following = np.ceil(count * np.minimum(found.lower, 100.0)).astype(np.int64)
        guess[open_rows] = np.clip(following, too_few[open_rows] + 1, np.maximum(enough[open_rows] - 1, 1))
        if (too_few >= MOST_STEPS).any():
            worst = rows[int(np.argmax(too_few))]
            raise Infeasible(
                f"z0 = {worst.tolist()} is not corrected in {MOST_STEPS} steps of interval {thrust.interval}"
            )
    return enough, proof
