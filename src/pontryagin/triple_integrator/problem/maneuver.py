"""The manoeuvre: both ends, the time for it, the disturbance, and the moments c they require, (1.10)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator import kernels
from pontryagin.triple_integrator.problem import disturbance as disturbances
from pontryagin.validation import common_shape, finite, times, vectors

moments_of_stack = batched(kernels.moments, outputs=3)


@dataclass(frozen=True, eq=False)
class Maneuver:
    """A manoeuvre of x1' = x2, x2' = x3 + f(t), x3' = u between given ends, (0.6)-(0.9).

    Units are the user's own and consistent: with angle in rad and time in s the control is in rad/s^3.

    Parameters
    ----------
    x0, xf : (..., 3) array_like
        State at the start and at the end: angle, rate, control acceleration.
    tf, t0 : (...) array_like
        End and start; ``tf > t0``.
    disturbance : None, number or (...) array, callable f(t), or SymPy expression in ``t``
        Acceleration acting beside the control. A callable is integrated to 1e-13.

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
    """

    x0: Array
    xf: Array
    tf: Array
    t0: Array = 0.0  # type: ignore[assignment]
    disturbance: ArrayLike | Callable | object | None = None

    def __post_init__(self) -> None:
        x0, xf = vectors("x0", self.x0, 3), vectors("xf", self.xf, 3)
        tf = finite("tf", self.tf, "a number or an array (...)")
        t0 = finite("t0", self.t0, "a number or an array (...)")
        if not tf.ndim == t0.ndim == 0 or not x0.ndim == xf.ndim == 1 or _shape(self.disturbance):
            x0, xf, tf, t0 = self._broadcast(x0, xf, tf, t0)
        late = ~(tf > t0)
        if late.any():
            first, last = (end[late].flat[0] for end in (t0, tf))
            raise ValueError(f"tf must be later than t0, got t0 = {first} and tf = {last}")
        fields = self.__dict__
        fields["x0"], fields["xf"], fields["tf"], fields["t0"] = x0, xf, tf, t0
        _ = self._integrals  # a disturbance of the wrong kind is refused here, not later

    def _broadcast(self, x0: NDArray, xf: NDArray, tf: NDArray, t0: NDArray) -> tuple[NDArray, ...]:
        force = _shape(self.disturbance)
        shape = common_shape(x0=x0.shape[:-1], xf=xf.shape[:-1], tf=tf.shape, t0=t0.shape, disturbance=force)
        if force:
            level = finite("disturbance", self.disturbance, "a number or an array (...)")  # type: ignore[arg-type]
            self.__dict__["disturbance"] = np.broadcast_to(level, shape)
        ends = (np.broadcast_to(x, (*shape, 3)) for x in (x0, xf))
        return (*ends, *(np.broadcast_to(time, shape) for time in (tf, t0)))

    @property
    def shape(self) -> tuple[int, ...]:
        """Leading shape of the stack; ``()`` for one manoeuvre."""
        return self.x0.shape[:-1]

    @property
    def duration(self) -> Array:
        """T = tf - t0, (...)."""
        return self.tf - self.t0

    @cached_property
    def _integrals(self) -> disturbances.Integrals:
        return disturbances.integrals(self.disturbance, self.t0, self.tf)

    @cached_property
    def moments(self) -> Array:
        """c of (1.10), (..., 3): what the integrals of (s^2/2, s, 1) u must be, s = tf - t."""
        if not self.shape and self.disturbance is None:
            ends = [*self.x0.tolist(), *self.xf.tolist()]
            return np.array(kernels.moments(*ends, float(self.tf - self.t0), 0.0, 0.0))  # type: ignore[call-arg]
        g = 0.0 if self.disturbance is None else self._integrals(self.tf, self.t0)
        g1, g2 = (g, g) if np.ndim(g) == 0 else (g[..., 0], g[..., 1])  # type: ignore[index]
        ends = [x[..., i].ravel() for x in (self.x0, self.xf) for i in range(3)]
        rest = [np.broadcast_to(part, self.shape).ravel() for part in (self.duration, g1, g2)]
        return moments_of_stack(*ends, *rest).reshape(*self.shape, 3)

    def times(self, t: ArrayLike) -> Array:
        """The times t (k,) or (..., k) checked to lie within the manoeuvre, as (..., k)."""
        return times("t", t, self.t0, self.tf)

    def drift(self, t: ArrayLike) -> Array:
        """The motion without control, Phi(t, t0) x0 + g(t) of (1.3): (k,) -> (..., k, 3)."""
        time = self.times(t)
        start = self.t0[..., None]
        elapsed = time - start
        x1, x2, x3 = (self.x0[..., None, i] for i in range(3))
        g = self._integrals(time, start)
        free = kernels.coast(x1, x2, x3, elapsed)
        return np.stack(np.broadcast_arrays(free[0] + g[..., 0], free[1] + g[..., 1], free[2]), axis=-1)


def _shape(disturbance: object) -> tuple[int, ...]:
    if not isinstance(disturbance, np.ndarray | list | tuple):
        return ()
    return finite("disturbance", disturbance, "a number or an array (...)").shape  # type: ignore[arg-type]
