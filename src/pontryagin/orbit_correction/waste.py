"""How many impulses the paper's ball wastes: counted against the disc and the square it stands for."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from pontryagin.validation import positive, vectors


@dataclass(frozen=True, eq=False)
class Waste:
    """Fewest impulses of the same states under the three sets of impulses.

    Attributes
    ----------
    z0 : (..., 3) array
        Deviations (dr, dv_R, dv_T), dimensionless.
    counts : dict of (...) int arrays
        Impulses by the name of the set, "ball", "disc", "box".
    """

    z0: Array
    counts: dict[str, NDArray[np.int64]]

    def wasted(self, thrust: str = "box") -> NDArray[np.int64]:
        """Impulses that the ball fires more than another set, (...)."""
        return self.counts["ball"] - self.counts[thrust]


def count_impulses(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035) -> Waste:
    """Count the impulses that ball, disc and box need for the same states.

    The ball lies in the square, so that the square never needs more; a ball's odd step also leaves half of
    its last impulse unused. Neither of ball and disc contains the other.

    Parameters
    ----------
    z0 : (..., 3) array_like
        Deviations, dimensionless.
    interval, peak : float
        As in `correct`.

    Raises
    ------
    TypeError, ValueError, pontryagin.Infeasible
        As `correct`.

    Examples
    --------
    >>> found = count_impulses([-0.0037787, -0.0039109, 0.0141512])
    >>> {name: int(count) for name, count in found.counts.items()}, int(found.wasted())
    ({'ball': 6, 'disc': 5, 'box': 5}, 1)
    """
    states = vectors("z0", z0, 3)
    return Waste(states, {name: correct(states, interval, peak, name).impulse_count for name in THRUSTS})


def random_states(count: int, size: float = 0.01, seed: int = 2017) -> Array:
    """Normal deviations with the same standard deviation in every component, (count, 3), seeded.

    Examples
    --------
    >>> random_states(500).shape
    (500, 3)
    """
    if not isinstance(count, int | np.integer) or count < 1:
        raise ValueError(f"count must be a positive whole number, got {count!r}")
    return float(positive("size", size)) * np.random.default_rng(seed).standard_normal((int(count), 3))
