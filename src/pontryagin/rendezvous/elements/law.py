"""The law of thrust: functional, bound, and the mode of thrust that the switching function selects."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from pontryagin.rendezvous.elements.arcs import (
    RISING,
    Constants,
    Mode,
)
from pontryagin.rendezvous.terminal_law import end_switching


@dataclass(frozen=True)
class Law:
    """A functional and its bound, in the units of `Scaled` with alpha2 = 1.

    Parameters
    ----------
    kind : "square" or "fuel"
        alpha1 + alpha2 p^2, or alpha1 + alpha2 |p|.
    ratio : float
        alpha1/alpha2; inf for alpha2 = 0, least time.
    peak : float
        p_max.
    width : float
        Width of the smoothed jump of "fuel"; 0 for the jump itself.
    """

    kind: Literal["square", "fuel"]
    ratio: float
    peak: float
    width: float = 0.0

    @property
    def bang(self) -> bool:
        """Whether alpha2 = 0."""
        return self.ratio == np.inf

    @property
    def charge(self) -> float:
        """The running cost L at p_max, without alpha1."""
        return 0.0 if self.bang or self.peak == np.inf else self.peak ** (2 if self.kind == "square" else 1)

    @property
    def end_switching(self) -> float:
        """|n(t_k)| for a free duration, by (n, p) = L; for "fuel" with the jump itself and alpha1 > 0."""
        if self.kind == "fuel" and not self.bang:
            return 1 + self.ratio / self.peak
        return end_switching(self.ratio, self.peak)

    def mode(self, size: float) -> Mode:
        """The mode of thrust for a given size of n."""
        if self.bang:
            return "saturated"
        if self.kind == "square":
            return "saturated" if size > 2 * self.peak else "unsaturated"
        if self.width:
            return "smoothed"
        return "saturated" if size > 1 else "coast"

    def constants(self, mode: Mode) -> Constants:
        """Constants of the integrator of a mode."""
        peak = self.peak if self.peak < np.inf else 1.0
        levels = {"square": 2 * self.peak, "fuel": 1.0}
        never = self.bang or mode == "smoothed" or levels[self.kind] == np.inf
        level = (1e30 if RISING[mode] > 0 else 1e-30) if never else levels[self.kind]
        return Constants(peak, self.charge, level, self.width or 1.0)

    @property
    def jumps(self) -> bool:
        """Whether the thrust jumps at a switch."""
        return self.kind == "fuel" and not self.bang and not self.width
