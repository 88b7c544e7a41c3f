"""The set of states that the remaining impulses of a plan bring back, at any instant."""

from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.orbit_correction import sets
from pontryagin.orbit_correction.plan.correction import Plan


@dataclass(frozen=True)
class Remaining:
    """The remaining impulses at an instant: whole steps, and the rest of a step that has begun.

    Attributes
    ----------
    factors : (steps, 3, m) array
        Factors G_k of the steps that have not begun.
    rest : (3, c) array
        Columns of G_k of the remaining components of the step that has begun, times the radius of the ball
        that the components already fired leave for them.
    """

    factors: Array
    rest: Array

    def boundary(self, normals: Array, square: bool) -> Array:
        """Support points of the set for outward normals (..., 3)."""
        steps = sets.support_points(self.factors, normals, square)
        return steps + sets.support_points(self.rest[None], normals, False)


def remaining(plan: Plan, fired: int) -> Remaining:
    """The impulses that remain after the given number of them, for states carried back to the start."""
    factors = plan.thrust.factors(int(plan.steps))
    begun, spent = divmod(2 * fired, factors.shape[2])
    if not spent or begun >= len(factors):
        return Remaining(factors[begun:], np.zeros((3, 1)))
    done = plan.step_controls[begun, :spent] / (plan.gauge * plan.thrust.peak)
    left = np.sqrt(max(0.0, 1.0 - float(done @ done)))
    return Remaining(factors[begun + 1 :], left * factors[begun, :, spent:])
