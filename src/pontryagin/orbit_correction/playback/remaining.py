"""The states that the impulses still to come bring back, at any instant of a plan."""

from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.orbit_correction import sets
from pontryagin.orbit_correction.plan.correction import Plan


@dataclass(frozen=True)
class Remaining:
    """What is still to come at an instant: whole steps, and what is left of one that has begun.

    Attributes
    ----------
    factors : (steps, 3, m) array
        Of the steps not begun, for the initial state.
    rest : (3, c) array
        Of the components still to come in the step that has begun, within what they have left of its ball.
    """

    factors: Array
    rest: Array

    def boundary(self, normals: Array, square: bool) -> Array:
        """Support points for outward normals (..., 3)."""
        whole = sets.support_points(self.factors, normals, square)
        return whole + sets.support_points(self.rest[None], normals, False)


def remaining(plan: Plan, fired: int) -> Remaining:
    """What is still to come once so many impulses have been fired, for states carried back to the start."""
    factors = plan.thrust.factors(int(plan.steps))
    begun, spent = divmod(2 * fired, factors.shape[2])
    if not spent or begun >= len(factors):
        return Remaining(factors[begun:], np.zeros((3, 1)))
    done = plan.step_controls[begun, :spent] / (plan.gauge * plan.thrust.peak)
    left = np.sqrt(max(0.0, 1.0 - float(done @ done)))
    return Remaining(factors[begun + 1 :], left * factors[begun, :, spent:])
