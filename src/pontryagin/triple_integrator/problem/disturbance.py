"""The disturbance f(t) and its integrals g2 = int f and g1 = int (t - tau) f of (1.8)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.numerics import compile as compiler
from pontryagin.triple_integrator.problem.panels import Function, Panels
from pontryagin.validation import finite
from pontryagin.value import freeze


class Expression(Protocol):
    """A SymPy expression."""

    @property
    def free_symbols(self) -> Any:
        """The symbols that it holds."""


@runtime_checkable
class FromStart(Protocol):
    """A function of time that keeps its digits also where times are far from zero.

    ``start`` is a time; ``from_start()`` gives the function of the time since then, with its ``edges``.
    """

    start: float

    def from_start(self) -> Any:
        """The same function on a clock that is 0 at the start."""


Disturbance = ArrayLike | Callable[[Any], Any] | Expression | None
"""What may be given as the disturbance f: nothing, numbers, a function of time, or an expression in t."""

Integrals = Callable[[Array], Array]
"""A function of times since the start, (..., k), to g1 and g2 there, (..., k, 2)."""


@dataclass(frozen=True)
class OnIntervals:
    """The integrals of a function on the intervals of a stack, of which equal ones are treated once.

    Attributes
    ----------
    panels : Panels
        The function on all intervals that differ.
    member : (..., 1) array
        Which of these intervals is whose.
    """

    panels: Panels
    member: NDArray[np.intp]

    def __call__(self, elapsed: Array) -> Array:
        """g1 and g2 at times since the start, (..., k) -> (..., k, 2)."""
        return self.panels.integrals(elapsed, self.member)

    @property
    def offsets(self) -> Array:
        """Times since the start at which the function may be not smooth, (..., j)."""
        clock = self.panels.clock[self.member[..., 0]]
        return np.asarray(clock[..., 1:-1] - clock[..., :1])


def integrals(disturbance: Disturbance, start: Array, end: Array, edges: ArrayLike = ()) -> Integrals:
    """The integrals (g1, g2) of a disturbance given as None, a number, a callable or a SymPy expression.

    Parameters
    ----------
    disturbance : None, number or array (...), callable f(t), or sympy.Expr in `t`
        Acceleration, in the units of the third state.
    start, end : (...) arrays
        The intervals of time on which it is integrated, each to an accuracy of its own.
    edges : (j,) or (..., j) array_like
        Times at which it may be not smooth, ascending; those outside an interval do not matter.

    Raises
    ------
    TypeError, ValueError
        If it is of another kind, or has a wrong shape, an unknown symbol or a value that is not finite.
    pontryagin.NotConverged
        If it is not resolved to 1e-13, because of a singularity or after 4096 panels of an interval.
    """
    if disturbance is None or np.size(start) == 0:
        return lambda elapsed: np.zeros((*np.shape(elapsed), 2))
    if hasattr(disturbance, "free_symbols"):
        disturbance = _symbolic(disturbance, (np.ravel(start)[0] + np.ravel(end)[0]) / 2)
    if not callable(disturbance):
        takes = "None, a number, a callable f(t) or an expression in t"
        return _constant(finite("disturbance", disturbance, takes))
    if isinstance(disturbance, FromStart) and (start == disturbance.start).all():
        moved = disturbance.from_start()
        return _on_intervals(moved, np.zeros_like(start), end - start, np.asarray(moved.edges))
    told = np.asarray(edges, dtype=float)
    of_function = np.asarray(getattr(disturbance, "edges", ()), dtype=float).ravel()
    if of_function.size:
        shared = np.broadcast_to(of_function, (*told.shape[:-1], of_function.size))
        told = np.sort(np.concatenate([told, shared], axis=-1), axis=-1)
    return _on_intervals(disturbance, start, end, told)


def from_start(disturbance: Any, start: float) -> Any:
    """A disturbance as that of the time since the start."""
    if isinstance(disturbance, FromStart) and start == disturbance.start:
        return disturbance.from_start()
    if callable(disturbance) or hasattr(disturbance, "free_symbols"):
        return partial(_later, function_of(disturbance), start)
    return disturbance


def _later(function: Callable[[Array], Array], start: float, elapsed: Array) -> Array:
    return function(start + elapsed)


def function_of(disturbance: Any) -> Callable[[Any], Array]:
    """A disturbance of one manoeuvre as a function of times (k,)."""
    if hasattr(disturbance, "free_symbols"):
        symbols = sorted(disturbance.free_symbols, key=str)
        compiled = compiler.function("disturbance", symbols, {"f": disturbance})
        return lambda t: compiled(*[t] * len(symbols))[0] * np.ones(np.shape(t))
    if callable(disturbance):
        return partial(values, disturbance)
    level = 0.0 if disturbance is None else float(disturbance)
    return lambda t: np.full(np.shape(t), level)


def _on_intervals(function: Callable[[Any], Any], start: Array, end: Array, edges: Array) -> OnIntervals:
    count = edges.shape[-1]
    cuts = np.broadcast_to(edges, (*np.shape(start), count)).reshape(np.size(start), count)
    low, high = np.reshape(start, (-1, 1)), np.reshape(end, (-1, 1))
    clock, member = np.unique(np.hstack([low, np.clip(cuts, low, high), high]), axis=0, return_inverse=True)
    member = member.reshape(*np.shape(start), 1)
    freeze((clock, member))
    panels = Panels(_on_stretches(function, clock), clock)
    _ = panels.series
    return OnIntervals(panels, member)


def _on_stretches(function: Callable[[Any], Any], clock: Array) -> Function:
    """A function of the time as one of stretches and the time since their starts.

    Where a stretch ends at an edge, the function is never called at the edge itself or beyond it, to which
    the rounding of the time may lead.
    """
    origin, floor, ceiling = clock[:, :-1].ravel(), clock[:, :-1].copy(), clock[:, 1:].copy()
    floor[:, 1:], ceiling[:, :-1] = np.nextafter(floor[:, 1:], np.inf), np.nextafter(ceiling[:, :-1], -np.inf)
    bounds = floor.ravel(), ceiling.ravel()

    def call(stretch: NDArray[np.intp], elapsed: Array) -> Array:
        time = origin[stretch] + elapsed
        if clock.shape[1] > 2:
            time = np.clip(time, *(bound[stretch] for bound in bounds))
        return values(function, time)

    return call


def values(function: Callable[[Any], Any], t: Array) -> Array:
    """f at the times (k,), by one call with an array if f takes it, else by a call for each time.

    Raises
    ------
    TypeError, ValueError
        If f is no function of a time, or a value is no finite number.
    """
    try:
        result = _real(function(t))
    except (TypeError, ValueError):
        result = np.empty(())
    if result.shape == ():
        result = np.asarray([_at(function, float(time)) for time in t])
    if result.shape != t.shape:
        raise ArgumentValueError(
            f"disturbance must return one number for each time: got shape {result.shape} "
            f"for times of shape {t.shape}",
            "disturbance",
        )
    if not np.isfinite(result).all():
        k = int(np.argmin(np.isfinite(result)))
        raise ArgumentValueError(f"disturbance must be finite: f({t[k]:.6g}) = {result[k]}", "disturbance")
    return result


def _at(function: Callable[[Any], Any], time: float) -> float:
    try:
        value = _real(function(time))
    except TypeError as error:
        raise ArgumentTypeError(
            f"disturbance must be a function f(t) that takes a time and returns a number: {error}",
            "disturbance",
        ) from error
    if value.shape != ():
        raise ArgumentValueError(
            f"disturbance must return one number for each time: got shape {value.shape} for one time",
            "disturbance",
        )
    return float(value)


def _real(value: object) -> Array:
    array = np.asarray(value)
    if array.dtype.kind in "cUS":
        raise TypeError(f"got {value!r}")
    return array.astype(float)


def _constant(value: Array) -> Integrals:
    def call(elapsed: Array) -> Array:
        level = value[(..., *[None] * (elapsed.ndim - value.ndim))] if value.ndim else value
        return np.stack([level * elapsed * elapsed / 2, level * elapsed], axis=-1)

    return call


def _symbolic(expression: Any, inside: float) -> Callable[[Any], Any]:
    """An expression as a function of time, which is tried at one time."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    if expression.atoms(AppliedUndef):  # The name of such a function would be run as code.
        raise ArgumentValueError(
            f"disturbance must be an expression that NumPy evaluates, got {expression}", "disturbance"
        )
    if not isinstance(expression, sp.Expr) or expression.is_real is False:
        raise ArgumentTypeError(
            f"disturbance must be a real expression in t, got {expression}", "disturbance"
        )
    foreign = {str(symbol) for symbol in expression.free_symbols} - {"t"}
    if foreign:
        raise ArgumentValueError(
            f"disturbance must be an expression in t alone, got symbols {', '.join(sorted(foreign))}",
            "disturbance",
        )
    t = sp.Symbol("t", real=True)
    expression = expression.subs(dict.fromkeys(expression.free_symbols, t))
    try:
        expression = expression.doit()  # Integrals and derivatives that are left to be done.
        value = compiler.function("disturbance", [t], {"f": expression})
        value(inside)
    except (NameError, KeyError, NotImplementedError):
        raise ArgumentValueError(
            f"disturbance must be an expression that NumPy evaluates, got {expression}", "disturbance"
        ) from None
    return lambda time: value(time)[0]
