"""The smooth example of section 3, (3.2): a speed is changed at the cost k + u^2."""

from functools import partial

from numpy.typing import ArrayLike

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solved
from pontryagin.averaging.examples.models import example_model, example_system
from pontryagin.validation import common_shape, finite, positive


def smooth_example(
    v0: ArrayLike, v1: ArrayLike, k: ArrayLike = 1.0, ripple: ArrayLike = 0.0
) -> AveragedSolution:
    """Bring v from v0 to v1 under v' = epsilon (u + ripple cos x), x' = v, at the least k tau_1 + int u^2.

    Parameters
    ----------
    v0, v1 : (...) array
        Positive speeds.
    k : (...) array
        Price of a unit of slow time, positive.
    ripple : (...) array
        Amplitude of a force of mean zero, 0 in the paper. It does not change the first approximation.

    Returns
    -------
    AveragedSolution
        In the slow variable v: duration |v1 - v0| / sqrt(k), cost 2 sqrt(k) |v1 - v0|.

    Raises
    ------
    ValueError
        If an argument is not finite, or v0, v1 or k not positive.

    Examples
    --------
    >>> solution = smooth_example(1.0, 2.0, k=4.0)
    >>> round(float(solution.duration), 12), round(float(solution.cost), 12)
    (0.5, 4.0)
    """
    begin, end, price = positive("v0", v0), positive("v1", v1), positive("k", k)
    force = finite("ripple", ripple, "a number or an array (...)")
    common_shape(v0=begin.shape, v1=end.shape, k=price.shape, ripple=force.shape)
    numbers = (end, price, force)
    return solved(
        example_model("smooth"),
        ("v",),
        begin[..., None],
        numbers,
        partial(example_system, "smooth", numbers),
    )
