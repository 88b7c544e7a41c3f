"""How controllability, the gauge and the number of impulses depend on the interval between impulses.

At intervals of whole revolutions all impulses act at one place of the orbit, and the radius cannot be changed
there. At half revolutions all radial impulses are parallel, so that H(k) of (12) does not exist; the states
can still be corrected.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.system.satellite import impulse_columns, step_factors
from pontryagin.validation import positive
from pontryagin.value import value_class


def singular_values(intervals: ArrayLike, impulses: int) -> Array:
    """Singular values of the controllability matrix, (..., 3), the largest first.

    The columns of the matrix are the effects of unit impulses on the initial state.

    Parameters
    ----------
    intervals : (...) array_like
        Times between impulses, rad.
    impulses : int
        Number of impulses, at least two.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.

    Examples
    --------
    >>> singular_values([np.pi, 2 * np.pi], 2).round(9)[:, -1].tolist()
    [0.794155604, 0.0]
    """
    instants = arguments.count("impulses", impulses, least=2)
    spacings = positive("intervals", intervals)
    stacked = [np.hstack(list(impulse_columns(instants, float(h)))) for h in spacings.ravel()]
    return np.linalg.svd(np.array(stacked), compute_uv=False).reshape(*spacings.shape, 3)


def step_condition(intervals: ArrayLike) -> Array:
    """Condition numbers of B(k) of (12) for an even and an odd step, (..., 2).

    If a condition number exceeds the inverse of the rounding error, H(k) does not exist.

    Examples
    --------
    >>> bool(step_condition(np.pi)[0] > 1e15)
    True
    """
    spacings = positive("intervals", intervals)
    stacked = np.array([step_factors(2, float(h)) for h in spacings.ravel()])
    return np.asarray(np.linalg.cond(stacked)).reshape(*spacings.shape, 2)


@value_class
@dataclass(frozen=True, eq=False)
class Sweep:
    """Plans for one state at many intervals between impulses.

    Attributes
    ----------
    intervals : (k,) array
        Times between impulses, rad.
    impulses : (k,) array
        Fewest impulses; nan where no number suffices.
    gauge : (k,) array
        alpha of the plan; nan where there is none.
    """

    intervals: Array
    impulses: Array
    gauge: Array

    @property
    def duration(self) -> Array:
        """Time from the first impulse to the end of the last interval."""
        return self.impulses * self.intervals


def sweep(z0: ArrayLike, intervals: ArrayLike, peak: float = 0.0035, thrust: str = "ball") -> Sweep:
    """Correct one state at each of the intervals between impulses.

    Parameters
    ----------
    z0 : (3,) array_like
        Deviation, dimensionless.
    intervals : (k,) array_like
        Times between impulses, rad.
    peak, thrust
        As in `correct`.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.

    Examples
    --------
    >>> found = sweep([-0.0037787, -0.0039109, 0.0141512], [0.25, np.pi, 2 * np.pi])
    >>> found.impulses.tolist()
    [6.0, 8.0, nan]
    """
    state, spacings = arguments.state(z0), np.atleast_1d(positive("intervals", intervals))
    counts, gauges = np.full(len(spacings), np.nan), np.full(len(spacings), np.nan)
    for i, interval in enumerate(spacings):
        try:
            plan = correct(state, float(interval), peak, thrust)
        except Infeasible:
            continue
        counts[i], gauges[i] = float(plan.impulse_count), float(plan.gauge)
    return Sweep(spacings, counts, gauges)
