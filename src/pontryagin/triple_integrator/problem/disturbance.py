"""The disturbance f(t) and its integrals g2 = int f and g1 = int (t - tau) f of (1.8)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from math import ceil
from typing import Any, Protocol

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, NotConverged
from pontryagin.validation import finite

DEGREE = 24
"""Degree of the Chebyshev series on each panel."""

COARSEST = 9
"""An interval is cut into at least so many panels, whose nodes lie less than 0.8 % of it apart. An odd number
keeps a node in the middle of the interval, where users like to put poles."""

LOOSER = 1e3
"""By how much more than its last coefficients a series may miss the function at the ends of a panel."""

PANELS = 4096
"""Largest number of panels into which an interval is cut."""


class Expression(Protocol):
    """A SymPy expression."""

    @property
    def free_symbols(self) -> Any:
        """The symbols that it holds."""


Disturbance = ArrayLike | Callable[[Any], Any] | Expression | None
"""What may be given as the disturbance f: nothing, numbers, a function of time, or an expression in t."""

Integrals = Callable[[Array, Array], Array]
"""A function from the times (t, t0), broadcast, to g1 and g2 from t0 to t, (..., 2)."""


def integrals(disturbance: Disturbance, start: Array, end: Array) -> Integrals:
    """The integrals (g1, g2) of a disturbance given as None, a number, a callable or a SymPy expression.

    Parameters
    ----------
    disturbance : None, number or array (...), callable f(t), or sympy.Expr in `t`
        Acceleration, in the units of the third state.
    start, end : (...) arrays
        The intervals of time on which it is integrated.

    Raises
    ------
    TypeError, ValueError
        If it is of another kind, or has a wrong shape, an unknown symbol or a value that is not finite.
    pontryagin.NotConverged
        If it is not resolved to 1e-13, because of a singularity or after 4096 panels.
    """
    if disturbance is None or np.size(start) == 0:
        return lambda t, t0: np.zeros((*np.broadcast_shapes(np.shape(t), np.shape(t0)), 2))
    low, high = float(np.min(start)), float(np.max(end))
    if hasattr(disturbance, "free_symbols"):
        return _symbolic(disturbance, low, high)
    if callable(disturbance):
        panels = Panels(disturbance, low, high)
        _ = panels.series
        return panels.integrals
    takes = "None, a number, a callable f(t) or an expression in t"
    return _constant(finite("disturbance", disturbance, takes))


def _constant(value: Array) -> Integrals:
    def call(t: Array, t0: Array) -> Array:
        elapsed = np.asarray(t - t0)
        level = value[(..., *[None] * (elapsed.ndim - value.ndim))] if value.ndim else value
        return np.stack([level * elapsed**2 / 2, level * elapsed], axis=-1)

    return call


def _symbolic(expression: Any, low: float, high: float) -> Integrals:
    """Antiderivatives by SymPy, where it finds them and they agree with quadrature; else quadrature."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    from pontryagin.numerics import compile as compiler

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
        value((low + high) / 2)
    except (NameError, KeyError, NotImplementedError):
        raise ArgumentValueError(
            f"disturbance must be an expression that NumPy evaluates, got {expression}", "disturbance"
        ) from None
    panels = Panels(lambda time: value(time)[0], low, high)
    antiderivatives = _antiderivatives(expression)
    if antiderivatives is None:
        return panels.integrals
    primitive = compiler.function(
        "primitives", [t], dict(zip(("first", "second"), antiderivatives, strict=True))
    )

    def exact(time: Array, t0: Array) -> Array:
        with np.errstate(all="ignore"):
            first, second = primitive(time)
            first0, second0 = primitive(t0)
        return np.stack([second - second0 - first0 * (time - t0), first - first0], axis=-1)

    probe = np.linspace(low, high, 17)
    by_quadrature = panels.integrals(probe, np.asarray(low))
    scale = np.abs(by_quadrature).max() + np.finfo(float).tiny
    try:
        difference = np.abs(exact(probe, np.asarray(low)) - by_quadrature).max()
    except (NameError, TypeError):  # NumPy lacks a special function, or the values are complex.
        return panels.integrals
    return exact if difference <= 1e-11 * scale else panels.integrals


@cache
def _antiderivatives(expression: Any) -> tuple[Any, Any] | None:
    """First and second antiderivative of a real expression, or None where SymPy does not find them."""
    import sympy as sp

    (t,) = expression.free_symbols or {sp.Symbol("t", real=True)}
    first = sp.integrate(expression, t)
    second = None if first.has(sp.Integral) else sp.integrate(first, t)
    if second is None or second.has(sp.Integral) or first.has(sp.I) or second.has(sp.I):
        return None
    return first, second


def _real(value: object) -> Array:
    array = np.asarray(value)
    if array.dtype.kind in "cUS":
        raise TypeError(f"got {value!r}")
    return array.astype(float)


@cache
def chebyshev_fit(degree: int) -> tuple[Array, Array]:
    """Chebyshev nodes in [-1, 1], and the matrix from values there to the coefficients of the series."""
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    return nodes, np.asarray(np.linalg.inv(chebyshev.chebvander(nodes, degree)), dtype=float)


@dataclass(frozen=True)
class Panels:
    """A function of time as Chebyshev series on panels, which are halved until each is resolved to rounding.

    Attributes
    ----------
    function : callable f(t)
        The function. It may have an attribute ``edges``: the times at which it is not smooth.
    low, high : float
        Ends of the interval.
    """

    function: Callable[[Any], Any]
    low: float
    high: float

    def values(self, t: Array) -> Array:
        """f at the times (k,), by one call with an array if f takes it, else by a call for each time."""
        try:
            result = _real(self.function(t))
        except (TypeError, ValueError):
            result = np.empty(())
        if result.shape == ():
            result = np.asarray([self._at(float(time)) for time in t])
        if result.shape != t.shape:
            raise ArgumentValueError(
                f"disturbance must return one number for each time: got shape {result.shape} "
                f"for times of shape {t.shape}",
                "disturbance",
            )
        if not np.isfinite(result).all():
            k = int(np.argmin(np.isfinite(result)))
            raise ArgumentValueError(
                f"disturbance must be finite: f({t[k]:.6g}) = {result[k]}", "disturbance"
            )
        return result

    def _at(self, time: float) -> float:
        try:
            value = _real(self.function(time))
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

    def _start(self) -> list[tuple[float, float]]:
        """The initial panels, in reverse order, cut at the ``edges`` of the function if it has any.

        Their nodes lie so close that no feature of 1 % of the interval falls between them.
        """
        inner = [t for t in getattr(self.function, "edges", ()) if self.low < t < self.high]
        edges = [self.low, *sorted(map(float, inner)), self.high]
        whole, cuts = self.high - self.low, [self.low]
        for start, end in pairwise(edges):
            parts = max(1, ceil(COARSEST * ((end - start) / whole)))
            cuts += [start + (end - start) * (i / parts) for i in range(1, parts)] + [end]
        return list(pairwise(cuts))[::-1]

    def _meets_its_ends(self, low: float, high: float, coefficients: Array, allowed: float) -> bool:
        """Whether a panel's series takes the function's values at the cuts that halving made.

        Otherwise a step lies so near to a cut that no node is beyond it.
        """
        known = {self.low, self.high, *map(float, getattr(self.function, "edges", ()))}
        ends = [(t, x) for t, x in ((low, -1.0), (high, 1.0)) if t not in known]
        if not ends:
            return True
        t, x = np.array(ends).T
        return bool((np.abs(self.values(t) - chebyshev.chebval(x, coefficients)) <= LOOSER * allowed).all())

    @cached_property
    def series(self) -> tuple[Array, Array, Array]:
        """Edges (p+1,), the integrals from `low` to each of them (p+1, 2), and coefficients (p, degree+1)."""
        nodes, invert = chebyshev_fit(DEGREE)
        pending, done, area = self._start(), [], 0.0
        while pending:
            low, high = pending.pop()
            middle = (low + high) / 2
            sample = self.values(low + (high - low) * (nodes + 1) / 2)
            largest = float(np.abs(sample).max())
            area = max(area, float((np.abs(sample) * ((high - low) / len(sample))).sum()))
            coefficients = invert @ sample
            tail = float(np.abs(coefficients[-3:]).max())
            allowed = max(1e-14 * largest, 1e-15 * area / (high - low))
            if largest < 1e300 and tail <= allowed and self._meets_its_ends(low, high, coefficients, allowed):
                done.append((low, high, coefficients))
            elif len(pending) + len(done) > PANELS or not low < middle < high or largest >= 1e300:
                raise NotConverged(
                    f"disturbance is not integrable to 1e-13 near t = {middle:.6g}", tail / largest
                )
            else:
                pending += [(middle, high), (low, middle)]
        edges = np.array([panel[0] for panel in done] + [self.high])
        coefficients = np.array([panel[2] for panel in done])
        running = np.zeros((len(done) + 1, 2))
        for i, panel in enumerate(coefficients):
            width = edges[i + 1] - edges[i]
            g1, g2 = _panel_integrals(panel[None], np.array([1.0]), np.array([width]))[0]
            running[i + 1] = running[i] + [running[i, 1] * width + g1, g2]
        return edges, running, coefficients

    def integrals(self, t: Array, t0: Array) -> Array:
        """g1 and g2 from t0 to t, (...) -> (..., 2)."""
        end, start = self._from_low(np.asarray(t)), self._from_low(np.asarray(t0))
        between = end - start
        between[..., 0] -= start[..., 1] * (np.asarray(t) - t0)
        return between

    def _from_low(self, t: Array) -> Array:
        edges, running, coefficients = self.series
        flat = np.ravel(t)
        index = np.clip(np.searchsorted(edges, flat, side="right") - 1, 0, len(coefficients) - 1)
        width = edges[index + 1] - edges[index]
        elapsed = flat - edges[index]
        inside = _panel_integrals(coefficients[index], 2 * elapsed / width - 1, width)
        inside += running[index]
        inside[:, 0] += running[index, 1] * elapsed
        return inside.reshape(*np.shape(t), 2)


def _panel_integrals(coefficients: Array, x: Array, width: Array) -> Array:
    """g1 and g2 from the left edge of panels (p, degree+1) to the positions x in [-1, 1], (p, 2)."""
    first = chebyshev.chebint(coefficients, 1, lbnd=-1, axis=1)
    second = chebyshev.chebint(coefficients, 2, lbnd=-1, axis=1)
    g2 = chebyshev.chebval(x, first.T, tensor=False) * width / 2
    g1 = chebyshev.chebval(x, second.T, tensor=False) * (width / 2) ** 2
    return np.stack([g1, g2], axis=-1)
