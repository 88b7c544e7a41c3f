"""A cost between least energy and least time: a power of the thrust, whose exponent grows without limit.

Under the cost kappa + nu theta (|p|/p_max)^(1/theta) the thrust is not bounded. For theta = 1/2 this is the
energy. As theta tends to 0 the thrust tends to p_max wherever n does not vanish, and the extremal to one of
least time. Costates are scaled such that p_max |n| = 1 at the meeting, for each theta.
"""

from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array

SMOOTHING = 0.05
"""Values of p_max |n| above this are little changed; below it the thrust falls to 0 as n does."""


@dataclass(frozen=True)
class PowerCost:
    """The cost for one exponent.

    Attributes
    ----------
    theta : float
        The reciprocal of the exponent, from 1/2 for least energy to 0 for least time.
    end_thrust : float
        |p| at the meeting for theta = 1/2, in units of p_max; it determines nu.
    peak : float
        p_max.
    """

    theta: float
    end_thrust: float
    peak: float

    @property
    def time_weight(self) -> float:
        """kappa, for which p_max |n| is 1 where the meeting's time is free."""
        return float(self.gain(np.array(1 / self.peak**2))[0])

    def gain(self, square: Array) -> tuple[Array, Array, Array]:
        """S, the largest (n, p) less what the thrust costs, with its first two derivatives in |n|^2."""
        power = 1 / (2 * (1 - self.theta))
        factor = (1 - self.theta) * self.end_thrust ** (2 * power - 1)
        smooth = self.peak**2 * square + SMOOTHING**2
        raised = factor * smooth**power
        slope = power * self.peak**2 * raised / smooth
        bend = (power - 1) * self.peak**2 * slope / smooth
        return raised - factor * SMOOTHING ** (2 * power), slope, bend
