"""Least time between two states under |u| <= U, the problem mutual to the least peak (section 3)."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError, NotConverged
from pontryagin.triple_integrator.least_time.arrival import solve_stack
from pontryagin.triple_integrator.problem.bang_bang import BangBang
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.validation import beyond_range, common_shape, finite, members_of, positive, vectors
from pontryagin.value import Packed, value_class


@value_class
@dataclass(frozen=True, eq=False)
class TimeSolution(Packed, BangBang):
    """Transfer of least duration under |u| <= peak.

    Attributes
    ----------
    x0, xf : (..., 3) array
        The states at the start and at the end.
    peak, disturbance : (...) array
        Bound on |u|, and the constant disturbance f.
    duration : (...) array
        Least time; 0 where both states agree.
    levels : (...) array
        Signed level of the control near both ends of a two-switch programme.
    shares : (..., 2) array
        Both switches a >= b as shares of the duration to go; 1 and 0 where they do not happen.
    certificate : Certificate
        Residual of the moments, relative to the data; the duration; and the time just before which a
        separating functional proves the target out of reach. This proof is local. That no control arrives
        at a still earlier time follows from the quartics, which have no smaller admissible root.
    """

    x0: Array
    xf: Array
    peak: Array
    disturbance: Array
    duration: Array
    levels: Array
    shares: Array
    certificate: Certificate

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        given = {"x0": numbers[:3], "xf": numbers[3:6]}
        given |= {"disturbance": numbers[..., 6], "peak": numbers[..., 7]}
        return given | _answer(numbers[8:])

    @cached_property
    def maneuver(self) -> Maneuver:
        """The fixed-time manoeuvre of this duration, from t0 = 0.

        Raises
        ------
        ValueError
            If both states agree: a manoeuvre takes a positive time.
        """
        return Maneuver(self.x0, self.xf, self.duration, disturbance=self.disturbance)

    @cached_property
    def _motion(self) -> Maneuver:
        """The manoeuvre, with the duration 1 where both states agree, since there only its start is used."""
        longer = np.where(self.duration > 0, self.duration, 1.0)
        return Maneuver(self.x0, self.xf, longer, disturbance=self.disturbance)

    @property
    def _interval(self) -> tuple[Array, Array]:
        return np.zeros_like(self.duration), self.duration

    @property
    def _moments(self) -> Array:
        return np.where((self.duration > 0)[..., None], self._motion.moments, 0.0)


def _answer(result: Array) -> dict[str, Any]:
    """The fields of a solution from the results of `solve_time`, (..., 6)."""
    duration = result[..., 0]
    certificate = Certificate(result[..., 4], duration, result[..., 5])
    found = {"duration": duration, "levels": result[..., 1], "shares": result[..., 2:4]}
    return {**found, "certificate": certificate}


def minimum_time(
    x0: ArrayLike, xf: ArrayLike, peak: ArrayLike, disturbance: ArrayLike | None = None
) -> TimeSolution:
    """Least time between two states of the triple integrator under the bound (0.7), |u| <= peak.

    Section 3 calls this problem mutual to the least peak. This is true if one of the two states is an
    equilibrium. Otherwise the least peak need not fall as the time grows, and the least time is the first at
    which the least peak meets the bound.

    Parameters
    ----------
    x0, xf : (..., 3) array_like
        The states at the start and at the end.
    peak : (...) array_like
        Bound on |u|, positive.
    disturbance : (...) array_like, optional
        Constant acceleration in addition to the control acceleration.

    Returns
    -------
    TimeSolution
        ``duration`` is the least time; the other attributes are those of `minimum_peak`'s solution.

    Raises
    ------
    TypeError, ValueError
        If an argument has the wrong kind, shape or sign, or is not finite.
    pontryagin.NotConverged
        If no root of the quartics gives a control that reaches the target to 1e-9.

    Examples
    --------
    >>> w = minimum_time([0, 0, 0], [1, 0, 0], peak=32.0)
    >>> float(w.duration), w.switch_times.tolist(), w.certificate.holds(1e-12)
    (1.0, [0.25, 0.75], True)
    """
    numbers = solve_stack.call(x0, xf, 0.0 if disturbance is None else disturbance, peak)
    if numbers is not None:
        return TimeSolution.from_numbers(numbers)
    start, end, bound = vectors("x0", x0, 3), vectors("xf", xf, 3), positive("peak", peak)
    if callable(disturbance) or hasattr(disturbance, "free_symbols"):
        raise ArgumentTypeError(
            f"disturbance must be None or a constant for minimum_time, got {disturbance!r}", "disturbance"
        )
    force = finite("disturbance", 0.0 if disturbance is None else disturbance, "None, a number or an array")
    if start.ndim == end.ndim == 1 and bound.ndim == force.ndim == 0:
        result = solve_stack.one(*start.tolist(), *end.tolist(), float(force), float(bound))
    else:
        shape = common_shape(
            x0=start.shape[:-1], xf=end.shape[:-1], peak=bound.shape, disturbance=force.shape
        )
        start, end = (np.broadcast_to(x, (*shape, 3)) for x in (start, end))
        bound, force = (np.broadcast_to(value, shape) for value in (bound, force))
        columns = [x[..., i].ravel() for x in (start, end) for i in range(3)]
        result = solve_stack(*columns, force.ravel(), bound.ravel()).reshape(*shape, 6)
    lost = ~np.isfinite(result[..., 0])
    if lost.any():
        beyond = np.isnan(result[..., 0])
        if beyond.any():
            raise beyond_range("xf", "with x0 and peak a motion and a duration", beyond)
        reason = f"minimum_time found no control that reaches xf for {lost.sum()} of {lost.size} transfers"
        raise NotConverged(reason, float(result[..., 4].max()), members_of(lost))
    return TimeSolution(start, end, bound, force, **_answer(result))
