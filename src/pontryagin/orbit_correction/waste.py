"""The impulses that the paper's ball wastes, in comparison with the disc and the square that it replaces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from pontryagin.validation import vectors
from pontryagin.value import value_class


@value_class
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
        """How many more impulses the ball needs than another set, (...)."""
        return self.counts["ball"] - self.counts[thrust]


def count_impulses(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035) -> Waste:
    """Count the impulses that ball, disc and box need for the same states.

    The square contains the ball and the disc, so that it never needs more impulses than they do. After an odd
    number of steps of the ball, half of the last impulse is unused. Neither the ball nor the disc contains
    the other.

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
    """Normal deviations whose components have the standard deviation `size`, (count, 3), from a seed.

    Examples
    --------
    >>> random_states(500).shape
    (500, 3)
    """
    number, spread = arguments.count("count", count), arguments.positive_number("size", size)
    return spread * np.random.default_rng(arguments.count("seed", seed, least=0)).standard_normal((number, 3))
