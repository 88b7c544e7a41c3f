"""A cost between least energy and least time: a power of the thrust, whose exponent grows without limit.

Under the cost theta (|p|/p_max)^(1/theta) the thrust is not bounded. For theta = 1/2 this is the energy. As
theta tends to 0, the generalised mean of |p|/p_max, with the exponent 1/theta, tends to the largest value.
Since such means grow with the exponent, the shortest duration for which the mean can be 1 grows on the way,
from a lower bound of the least time to the least time under the bound p_max.
"""

import math
from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous.laps.ends import Ends
from pontryagin.rendezvous.laps.transcription import Path

SMOOTHING = 0.05
"""Values of p_max |n| above this are little changed; below it the thrust falls to 0 as n does."""


@dataclass(frozen=True)
class PowerCost:
    """The cost for one exponent.

    Attributes
    ----------
    theta : float
        The reciprocal of the exponent, from 1/2 for least energy to 0 for least time.
    peak : float
        p_max.
    end_switching : float
        |n| at the meeting if its time is free.
    """

    theta: float
    peak: float
    end_switching: float = 0.0

    @property
    def time_weight(self) -> float:
        """alpha1, for which |n| at the meeting is the given one."""
        return float(self.gain(np.array(self.end_switching**2))[0])

    def gain(self, square: Array) -> tuple[Array, Array, Array]:
        """S, the largest (n, p) less what the thrust costs, with its first two derivatives in |n|^2."""
        power = 1 / (2 * (1 - self.theta))
        smooth = self.peak**2 * square + SMOOTHING**2
        raised = (1 - self.theta) * smooth**power
        slope = power * self.peak**2 * raised / smooth
        bend = (power - 1) * self.peak**2 * slope / smooth
        return raised - (1 - self.theta) * SMOOTHING ** (2 * power), slope, bend

    def mean_thrust(self, ends: Ends, path: Path) -> tuple[float, float]:
        """The logarithm of the generalised mean of |p|/p_max on an extremal, and its slope over that of time.

        The slope is along extremals of fixed durations: the least integral of |p|^q over a duration, with
        q = 1/theta, falls at the rate (q - 1) |p|^q at the meeting as the duration grows.
        """
        squares = ends.square(path.nodes)
        raised = (2 * np.sqrt(squares) * self.gain(squares)[1] / self.peak) ** (1 / self.theta)
        weight = ends.weight(path.nodes)
        weight[[0, -1]] /= 2
        mean = float((raised * weight).sum() / weight.sum())
        return self.theta * math.log(mean), -(1 - self.theta) * float(raised[-1]) / mean - self.theta
