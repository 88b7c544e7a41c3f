"""The gauge of the 0-controllable set of any system with ellipsoidal controls, Lemma 7 and Lemma 9."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError, Infeasible
from pontryagin.numerics.jit import compiled
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.gauges.ellipsoids import gauge_stack
from pontryagin.orbit_correction.gauges.long_sums import gauge_rows
from pontryagin.orbit_correction.gauges.proof import require_closed, unit
from pontryagin.orbit_correction.system.discrete import DiscreteSystem
from pontryagin.validation import require_digits, vectors
from pontryagin.value import value_class

SIGNATURE = "void(float64[:,:,::1],float64[:,::1],float64[:,::1],float64[:,::1])"

COMPILE_FROM = 40
"""The compiled kernel is loaded when the number of states times that of steps exceeds this."""

LONG = 1000
"""From this number of steps on, sweeps by NumPy take about as long as the compiled kernel takes."""

MANY = 4_000_000
"""From this number of states times steps on, even long sums repay loading the compiled kernel."""

FLAT = 1e-13
"""A set counts as flat along an axis if its width there, relative to the largest width, is below this.

Widths are measured in units of the reach of the controls along each coordinate.
"""

ANSWER = "with the system a gauge"
"""What a state must give within the range of floating-point numbers."""

VANISHING = 1e-100
"""Steps that add less than this share of the reach are set to zero, because their squares would underflow."""


@value_class
@dataclass(frozen=True, eq=False)
class Gauge:
    """The share of its peak that a system needs to bring states to the origin in given steps.

    Attributes
    ----------
    alpha : (...) array
        Minkowski functional of the 0-controllable set X(N, 0) of (2) at the state: at most 1 if N steps
        suffice, and only then.
    costate : (..., n) array
        psi_0, unit; zeros for the zero state.
    certificate : Certificate
        The value is the alpha of controls that reach the origin; the bound is the one that psi_0 proves.
    """

    alpha: Array
    costate: Array
    certificate: Certificate


def gauge(system: DiscreteSystem, x0: ArrayLike, steps: int) -> Gauge:
    """The gauge of the set of states that the system brings to the origin in `steps` steps.

    It is the alpha of Lemma 7, found with the costate psi_0 of Lemma 9 by maximising a concave function
    instead of solving the system (11), which has no solution for states inside the set.

    Parameters
    ----------
    system : DiscreteSystem
        Dynamics and ellipsoids.
    x0 : (..., n) array_like
        States.
    steps : int
        Number of steps N, at least one.

    Returns
    -------
    Gauge
        alpha, costate and certificate of every state.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.
    pontryagin.Infeasible
        If the controls do not span the space and a state lies outside what they span.
    pontryagin.NotConverged
        If rounding leaves a gap between the bounds.

    Examples
    --------
    >>> system = DiscreteSystem(np.eye(2), np.eye(2))
    >>> gauge(system, [[3.0, 4.0], [0.0, 5.0]], steps=5).alpha.round(9).tolist()
    [1.0, 1.0]
    """
    if not isinstance(system, DiscreteSystem):
        raise ArgumentTypeError(f"system must be a DiscreteSystem, got {type(system).__name__}", "system")
    number, n = arguments.count("steps", steps), system.step(0)[0].shape[0]
    return gauge_of_factors(system.factors(number), vectors("x0", x0, n))


def gauge_of_factors(factors: Array, x0: Array) -> Gauge:
    """The gauge of states (..., n) for the sum of the ellipsoids G_k B, factors (steps, n, m).

    A flat sum counts as a set in the subspace that it spans: only states in this subspace have a gauge.
    """
    n, shape = factors.shape[1], x0.shape[:-1]
    reach = np.abs(factors).max(axis=(0, 2))
    reach = np.where(reach > 0, reach, reach.max(initial=0.0))
    if not (reach > 0).all():
        raise Infeasible("the controls do nothing in these steps: all factors G_k are zero")
    scaled = factors / reach[:, None]
    scaled[np.abs(scaled).max(axis=(1, 2)) < VANISHING] = 0.0
    rows = -x0.reshape(int(np.prod(shape)), n)
    size = np.abs(rows).max(axis=1, initial=0.0)
    with np.errstate(over="ignore", under="ignore"):
        targets = rows / np.where(size > 0, size, 1.0)[:, None] / reach
        longest = np.abs(targets).max(axis=1, initial=0.0)
        scale = size * longest
    require_digits("x0", ANSWER, (size > 0).reshape(shape), scale.reshape(shape))
    targets /= np.where(longest > 0, longest, 1.0)[:, None]
    axes, widths, _ = np.linalg.svd(np.moveaxis(scaled, 0, 1).reshape(n, -1), full_matrices=False)
    thick = widths > FLAT * widths[0]
    axes, widths = axes[:, thick], widths[thick]
    whitening = (axes / widths).T
    within = whitening @ targets.T
    _require_reachable(targets - within.T @ (axes * widths).T, x0)
    costates, results = np.empty(within.T.shape), np.empty((len(targets), 3))
    work = len(targets) * len(factors)
    by_numpy = len(factors) >= LONG and work < MANY
    run = gauge_rows if by_numpy else compiled(gauge_stack, SIGNATURE, work > COMPILE_FROM)
    with np.errstate(all="ignore"):
        run(
            np.ascontiguousarray(whitening @ scaled),
            np.ascontiguousarray(within.T),
            costates,
            results,
        )
        lower, upper = (results[:, i].reshape(shape) * scale.reshape(shape) for i in range(2))
    require_digits("x0", ANSWER, (size > 0).reshape(shape), upper)
    proof = Certificate(results[:, 2].reshape(shape), upper, lower)
    require_closed(proof, "the gauge")
    return Gauge(lower, unit(costates @ whitening / reach).reshape(*shape, n), proof)


def _require_reachable(left: Array, x0: Array) -> None:
    """Raise `Infeasible` if a state has a part, ``left``, outside the span of the controls."""
    outside = np.abs(left).max(axis=1, initial=0.0) > 1e-9
    if outside.any():
        state = x0.reshape(left.shape)[int(np.argmax(outside))]
        raise Infeasible(
            f"the controls do not span the state space: x0 = {state.tolist()} is out of their reach, "
            "however large they are",
            "x0",
        )
