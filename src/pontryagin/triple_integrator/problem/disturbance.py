"""The disturbance f(t) and its integrals g2 = int f and g1 = int (t - tau) f of (1.8)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.io import formula
from pontryagin.io.formula import Formula
from pontryagin.numerics import compile as compiler
from pontryagin.triple_integrator.problem.panels import Panels
from pontryagin.triple_integrator.problem.samples import values
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
    def edges(self) -> Array:
        """Times at which the function may be not smooth, (..., j)."""
        return np.asarray(self.panels.clock[self.member[..., 0], 1:-1])

    @property
    def offsets(self) -> Array:
        """The edges as times since the start, (..., j)."""
        return np.asarray(self.edges - self.panels.clock[self.member[..., 0], :1])


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
        If it is of another kind, or has a wrong shape, an unknown symbol, a value that is not finite, an
        impulse, or more kinks than can be told apart.
    pontryagin.NotConverged
        If it is not resolved to 1e-13, because of a singularity or after 4096 panels of an interval.
    """
    if disturbance is None or np.size(start) == 0:
        return lambda elapsed: np.zeros((*np.shape(elapsed), 2))
    told = np.asarray(edges, dtype=float)
    expression = expression_of(disturbance)
    if expression is not None:
        from pontryagin.triple_integrator.problem.expression import Analytic

        analytic = Analytic.of(expression, start, end)
        clock, member = _intervals(start, end, _with(told, _within(analytic.edges, start, end)))
        return _tabulated(Panels(*analytic.on_stretches(clock)), member)
    if not callable(disturbance):
        takes = "None, a number, a callable f(t) or an expression in t"
        return _constant(finite("disturbance", disturbance, takes))  # type: ignore[arg-type]
    if isinstance(disturbance, FromStart) and (start == disturbance.start).all():
        disturbance = disturbance.from_start()
        told = told - np.asarray(start)[..., None]
        start, end = np.zeros_like(start), end - start
    own = getattr(disturbance, "edges", ())
    own = finite("disturbance", own, "a function of time whose edges are times").ravel()
    clock, member = _intervals(start, end, _with(told, own))
    return _tabulated(Panels(lambda _, time: values(disturbance, time), clock), member)


def from_start(disturbance: Any, start: float, edges: Array) -> Any:
    """A disturbance as that of the time since the start; its edges (j,) are not crossed by rounding."""
    if isinstance(disturbance, FromStart) and start == disturbance.start:
        return disturbance.from_start()
    if callable(disturbance) or hasattr(disturbance, "free_symbols"):
        return partial(_later, function_of(disturbance), start, np.concatenate([[-np.inf], edges, [np.inf]]))
    return disturbance


def _later(function: Callable[[Array], Array], start: float, edges: Array, elapsed: Array) -> Array:
    after = np.clip(np.searchsorted(edges - start, elapsed, side="right"), 1, edges.size - 1)
    within = np.nextafter(edges[after - 1], np.inf), np.nextafter(edges[after], -np.inf)
    return function(np.clip(start + elapsed, *within))


def function_of(disturbance: Any) -> Callable[[Any], Array]:
    """A disturbance of one manoeuvre as a function of times (k,)."""
    if hasattr(disturbance, "free_symbols"):
        symbols = sorted(disturbance.free_symbols, key=str)
        compiled = compiler.function("disturbance", symbols, {"f": disturbance})
        return partial(values, lambda t: compiled(*[t] * len(symbols))[0] * np.ones(np.shape(t)))
    if callable(disturbance):
        return partial(values, disturbance)
    level = 0.0 if disturbance is None else float(disturbance)
    return lambda t: np.full(np.shape(t), level)


def expression_of(disturbance: Any) -> Any:
    """The SymPy expression that a disturbance is, or that a formula says; None for others."""
    if not isinstance(disturbance, Formula):
        return disturbance if hasattr(disturbance, "free_symbols") else None
    if formula.is_broad(disturbance):
        return None
    try:
        return formula.expression(disturbance.text, disturbance.variable)
    except ValueError:  # Powers that SymPy would expand without end.
        return None


def _intervals(start: Array, end: Array, edges: Array) -> tuple[Array, NDArray[np.intp]]:
    """The ends of the stretches of all intervals that differ, (m, k + 2), and which is whose, (..., 1)."""
    count = edges.shape[-1]
    cuts = np.broadcast_to(edges, (*np.shape(start), count)).reshape(np.size(start), count)
    low, high = np.reshape(start, (-1, 1)), np.reshape(end, (-1, 1))
    clock, member = np.unique(np.hstack([low, np.clip(cuts, low, high), high]), axis=0, return_inverse=True)
    member = member.reshape(*np.shape(start), 1)
    freeze((clock, member))
    return clock, member


def _tabulated(panels: Panels, member: NDArray[np.intp]) -> OnIntervals:
    _ = panels.series
    return OnIntervals(panels, member)


def _with(edges: Array, others: Array) -> Array:
    """Edges of either kind, (j,) or (..., j), in order."""
    if not others.size:
        return edges
    shape = np.broadcast_shapes(edges.shape[:-1], others.shape[:-1])
    both = [np.broadcast_to(x, (*shape, x.shape[-1])) for x in (edges, others)]
    return np.sort(np.concatenate(both, axis=-1), axis=-1)


def _within(edges: Array, start: Array, end: Array) -> Array:
    """Those of the edges (j,), ascending, within intervals, filled up with the intervals' ends, (..., k)."""
    low, high = np.asarray(start)[..., None], np.asarray(end)[..., None]
    first, last = np.searchsorted(edges, low, side="right"), np.searchsorted(edges, high, side="left")
    at = first + np.arange(max(0, int((last - first).max(initial=0))))
    inside = edges[np.minimum(at, edges.size - 1)] if edges.size else np.empty(at.shape)
    return np.where(at < last, inside, high)


def _constant(value: Array) -> Integrals:
    def call(elapsed: Array) -> Array:
        level = value[(..., *[None] * (elapsed.ndim - value.ndim))] if value.ndim else value
        return np.stack([level * elapsed * elapsed / 2, level * elapsed], axis=-1)

    return call
