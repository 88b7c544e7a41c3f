"""The manoeuvre, (0.6) to (0.9): both states, both times, the disturbance, and the moments c of (1.10)."""

from copy import copy
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator import kernels
from pontryagin.triple_integrator.kernels import moments
from pontryagin.triple_integrator.problem.disturbance import Disturbance, Integrals, from_start, integrals
from pontryagin.validation import common_shape, finite, times, vectors
from pontryagin.value import Packed, freeze, value_class

moments_of_stack = batched(moments, outputs=3)


def required_moments(
    x10: float, x20: float, x30: float, x1f: float, x2f: float, x3f: float, tf: float, t0: float, f: float
) -> tuple[float, ...]:
    """The moments c under a constant disturbance and the duration; infinite unless tf > t0."""
    T = tf - t0
    if not T > 0.0:
        return inf, inf, inf, inf
    c1, c2, c3 = moments(x10, x20, x30, x1f, x2f, x3f, T, f * T * T / 2.0, f * T)
    return c1, c2, c3, T


one_maneuver = batched(required_moments, outputs=4, groups=(3, 3, 1, 1, 1))

NUMBERS = "a number or an array (...)"
"""The error messages' words for what the times, and a disturbance given as numbers, may be."""


@value_class
@dataclass(frozen=True, eq=False, init=False)
class Maneuver(Packed):
    """A manoeuvre of x1' = x2, x2' = x3 + f(t), x3' = u between given ends, (0.6)-(0.9).

    Units are the user's own and consistent: with angle in rad and time in s the control is in rad/s^3.

    Parameters
    ----------
    x0, xf : (..., 3) array_like
        State at the start (0.8) and at the end (0.9): angle and rate of (0.2), control acceleration of (0.5).
    tf, t0 : (...) array_like
        Time of the end and of the start, ``tf > t0``.
    disturbance : None, number or (...) array, callable f(t), or SymPy expression in ``t``
        Acceleration f in addition to the control acceleration, integrated to 1e-13 or the rounding of its
        values. What a callable does within less than 1 % of the interval may go unseen, unless ``edges``
        say where. An expression is taken apart at its kinks (of Abs, sign, Heaviside, Max, Min, Piecewise,
        floor, ceiling, frac, Mod, atan2), and between them enclosures prove that no feature is missed, or
        it is refused; but for functions that cannot be enclosed, such as gamma, and for 1e-4 of the way
        beside a singularity such as that of sqrt(t) at 0, where its values decide.
    edges : (k,) or (..., k) array_like
        Times at which the disturbance jumps or has a kink, or between which it has a narrow feature, in any
        order: it is integrated from each to the next. Those outside the interval do no harm, so that
        members of a stack with fewer edges may repeat one. A callable's own attribute ``edges`` (k,), if it
        has one, counts as well.

    Raises
    ------
    TypeError, ValueError
        If an argument has the wrong kind or shape, is not finite, or ``tf <= t0``.

    Examples
    --------
    >>> Maneuver([0, 0, 0], [1, 0, 0], tf=2.0).moments
    array([1., 0., 0.])
    >>> import sympy as sp
    >>> t = sp.Symbol("t")
    >>> Maneuver([0, 0, 0], [1, 0, 0], tf=2.0, disturbance=6 * t).moments
    array([ -7., -12.,   0.])

    A pulse that is told:

    >>> pulse = lambda t: np.where(abs(t - 1.0628) < 1e-7, 1e7, 0.0)
    >>> edges = 1.0628 + np.array([-1e-7, 1e-7])
    >>> Maneuver([0, 0, 0], [0, 0, 0], tf=2.0, disturbance=pulse, edges=edges).moments[:2].round(8)
    array([-1.8744, -2.    ])
    """

    x0: Array
    xf: Array
    tf: Array
    t0: Array
    disturbance: Disturbance
    edges: Array

    def __init__(
        self,
        x0: ArrayLike,
        xf: ArrayLike,
        tf: ArrayLike,
        t0: ArrayLike = 0.0,
        disturbance: Disturbance = None,
        edges: ArrayLike = (),
    ) -> None:
        simple = disturbance is None or type(disturbance) is float or type(disturbance) is int
        if simple and isinstance(edges, tuple) and not edges:
            numbers = one_maneuver.call(x0, xf, tf, t0, 0.0 if disturbance is None else disturbance)
            if numbers is not None:
                values = self.__dict__
                values["_numbers"], values["disturbance"] = numbers, disturbance
                return
        self._check(x0, xf, tf, t0, disturbance, edges)

    def _check(
        self,
        x0: ArrayLike,
        xf: ArrayLike,
        tf: ArrayLike,
        t0: ArrayLike,
        disturbance: Disturbance,
        edges: ArrayLike,
    ) -> None:
        """Make the fields from any arguments, or say what is wrong with them."""
        start, end = vectors("x0", x0, 3), vectors("xf", xf, 3)
        first, last = finite("t0", t0, NUMBERS), finite("tf", tf, NUMBERS)
        cuts = _edges(edges)
        force: tuple[int, ...] = ()
        if isinstance(disturbance, np.ndarray | list | tuple):
            numbers = finite("disturbance", disturbance, NUMBERS)
            disturbance, force = numbers, numbers.shape
        flat = first.ndim == last.ndim == 0 and start.ndim == end.ndim == cuts.ndim == 1
        if not flat or force:
            shape = common_shape(
                x0=start.shape[:-1],
                xf=end.shape[:-1],
                tf=last.shape,
                t0=first.shape,
                disturbance=force,
                edges=cuts.shape[:-1],
            )
            start, end = (np.broadcast_to(x, (*shape, 3)) for x in (start, end))
            first, last = (np.broadcast_to(time, shape) for time in (first, last))
            disturbance = np.broadcast_to(numbers, shape) if force else disturbance
            cuts = np.broadcast_to(cuts, (*shape, cuts.shape[-1])) if cuts.ndim > 1 else cuts
        late = ~(last > first)
        if late.any():
            wrong = f"t0 = {first[late].flat[0]} and tf = {last[late].flat[0]}"
            raise ArgumentValueError(f"tf must be later than t0, got {wrong}", "tf")
        fields = {"x0": start, "xf": end, "tf": last, "t0": first, "disturbance": disturbance}
        self.__dict__.update(fields, edges=cuts)
        for array in (start, end, last, first, cuts):
            array.setflags(write=False)
        freeze(disturbance)
        _ = self._integrals  # Raises if the disturbance is of the wrong kind.

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        times = {"tf": numbers[..., 6], "t0": numbers[..., 7]}
        ends = {"x0": numbers[:3], "xf": numbers[3:6]}
        return {**ends, **times, "edges": np.empty(0), "moments": numbers[9:12]}

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the stack; ``()`` for one manoeuvre."""
        return self.x0.shape[:-1]

    @property
    def duration(self) -> Array:
        """T = tf - t0, (...)."""
        return self.tf - self.t0

    @cached_property
    def _numbers(self) -> bytes | None:
        """Numbers that end with the moments and the duration of one manoeuvre; None for a stack."""
        return None if self.shape else np.append(self.moments, self.duration).tobytes()

    @cached_property
    def _integrals(self) -> Integrals:
        return integrals(self.disturbance, self.t0, self.tf, self.edges)

    @cached_property
    def moments(self) -> Array:
        """c of (1.7) and (1.10), the required integrals (1.9) of (s^2/2, s, 1) u with s = tf - t, (..., 3).

        The functions s^2/2, s and 1 are the response (1.5), (1.6) of the end to the control.
        """
        if not self.shape and self.disturbance is None:
            numbers = [*self.x0.tolist(), *self.xf.tolist()]
            return np.array(moments(*numbers, float(self.tf - self.t0), 0.0, 0.0))  # type: ignore[call-arg]
        g = self._integrals(self.duration[..., None])[..., 0, :]
        ends = [x[..., i].ravel() for x in (self.x0, self.xf) for i in range(3)]
        rest = [np.broadcast_to(part, self.shape).ravel() for part in (self.duration, g[..., 0], g[..., 1])]
        return moments_of_stack(*ends, *rest).reshape(*self.shape, 3)

    @property
    def edge_offsets(self) -> Array:
        """The edges of the disturbance within the manoeuvre as times since the start, (..., j).

        They are those given and its own. Those outside are moved to the nearer end.
        """
        none = np.empty((*self.shape, 0))
        return np.asarray(getattr(self._integrals, "offsets", none))

    def from_start(self) -> "Maneuver":
        """The same manoeuvre, not a stack, on a clock that is 0 at the start and loses no digits."""
        if self.t0 == 0.0:
            return self
        moved = copy(self)
        moved.__dict__.update(
            t0=np.zeros(()),
            tf=self.duration,
            disturbance=from_start(
                self.disturbance, float(self.t0), getattr(self._integrals, "edges", np.empty(0))
            ),
            edges=self.edges - self.t0,
            _integrals=self._integrals,
            moments=self.moments,
        )
        return moved

    def times(self, t: ArrayLike) -> Array:
        """The times t (k,) or (..., k) checked to lie within the manoeuvre, as (..., k)."""
        return times("t", t, self.t0, self.tf)

    def drift(self, t: ArrayLike) -> Array:
        """The motion without control, Phi(t, t0) x0 + g(t) of (1.3), (k,) -> (..., k, 3)."""
        elapsed = self.times(t) - self.t0[..., None]
        x1, x2, x3 = (self.x0[..., None, i] for i in range(3))
        g = self._integrals(elapsed)
        free = kernels.coast(x1, x2, x3, elapsed)
        return np.stack(np.broadcast_arrays(free[0] + g[..., 0], free[1] + g[..., 1], free[2]), axis=-1)


def _edges(edges: ArrayLike) -> Array:
    """The edges in order, those shared by a stack each only once, (k,) or (..., k)."""
    array = finite("edges", edges, "an array (k,) or (..., k) of times")
    if array.ndim == 0:
        raise ArgumentValueError(f"edges must be an array (k,) or (..., k) of times, got {edges!r}", "edges")
    return np.unique(array) if array.ndim == 1 else np.sort(array, axis=-1)
