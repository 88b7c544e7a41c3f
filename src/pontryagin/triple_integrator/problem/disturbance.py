"""The disturbance f(t) and its integrals g2 = int f and g1 = int (t - tau) f of (1.8)."""

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.triple_integrator.problem.panels import Panels
from pontryagin.validation import finite


class Expression(Protocol):
    """A SymPy expression."""

    @property
    def free_symbols(self) -> Any:
        """The symbols that it holds."""


Disturbance = ArrayLike | Callable[[Any], Any] | Expression | None
"""What may be given as the disturbance f: nothing, numbers, a function of time, or an expression in t."""

Integrals = Callable[[Array, Array], Array]
"""A function of times and of the starts of their intervals, (...) or (..., 1), to g1 and g2, (..., 2)."""


def integrals(disturbance: Disturbance, start: Array, end: Array) -> Integrals:
    """The integrals (g1, g2) of a disturbance given as None, a number, a callable or a SymPy expression.

    Parameters
    ----------
    disturbance : None, number or array (...), callable f(t), or sympy.Expr in `t`
        Acceleration, in the units of the third state.
    start, end : (...) arrays
        The intervals of time on which it is integrated, each to an accuracy of its own.

    Raises
    ------
    TypeError, ValueError
        If it is of another kind, or has a wrong shape, an unknown symbol or a value that is not finite.
    pontryagin.NotConverged
        If it is not resolved to 1e-13, because of a singularity or after 4096 panels of an interval.
    """
    if disturbance is None or np.size(start) == 0:
        return lambda t, t0: np.zeros((*np.broadcast_shapes(np.shape(t), np.shape(t0)), 2))
    if hasattr(disturbance, "free_symbols"):
        return _on_intervals(_symbolic(disturbance, (np.ravel(start)[0] + np.ravel(end)[0]) / 2), start, end)
    if callable(disturbance):
        return _on_intervals(disturbance, start, end)
    takes = "None, a number, a callable f(t) or an expression in t"
    return _constant(finite("disturbance", disturbance, takes))


def _on_intervals(function: Callable[[Any], Any], start: Array, end: Array) -> Integrals:
    """The integrals of a function on the intervals of a stack, of which equal ones are treated once."""
    intervals, member = np.unique(np.ravel(start) + 1j * np.ravel(end), return_inverse=True)
    panels = Panels(function, intervals.real, intervals.imag)
    _ = panels.series
    return lambda t, t0: panels.integrals(t, t0, member.reshape(np.shape(t0)))


def _constant(value: Array) -> Integrals:
    def call(t: Array, t0: Array) -> Array:
        elapsed = np.asarray(t - t0)
        level = value[(..., *[None] * (elapsed.ndim - value.ndim))] if value.ndim else value
        return np.stack([level * elapsed * elapsed / 2, level * elapsed], axis=-1)

    return call


def _symbolic(expression: Any, inside: float) -> Callable[[Any], Any]:
    """An expression as a function of time, which is tried at one time."""
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
        value(inside)
    except (NameError, KeyError, NotImplementedError):
        raise ArgumentValueError(
            f"disturbance must be an expression that NumPy evaluates, got {expression}", "disturbance"
        ) from None
    return lambda time: value(time)[0]
