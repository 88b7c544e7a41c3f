"""Differential equations for the integrators, as heyoka's expressions and as functions of NumPy arrays.

The right-hand side is given either by SymPy expressions (`Symbolic`) or by a plain function of numbers that
runs on both (`Kernel`). Both provide the variational equations and the event functions that end an arc.
"""

import math
import types
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.complex_step import STEP, jacobian

SMALL = 200
"""heyoka compiles right-hand sides with more operations than this as loops.

Unrolled code is faster to run, but slow to compile.
"""

Values = Sequence[float] | Array
"""The values of parameters, (p,)."""
Number = Any
"""A float, a complex array, or one of heyoka's expressions."""
HeyokaSystem = tuple[list[tuple[Number, Number]], list[Number], list[Number]]
"""Pairs of variable and rate, the variables differentiated in, and the event functions."""


class Equations(Protocol):
    """x' = f(t, x, p) for n states, differentiated in m of their initial values.

    An arc ends where an event function, negative on the arc, grows through zero.
    """

    @property
    def identity(self) -> Array:
        """Derivatives of the initial states in the chosen initial values, (n, m): columns of the identity."""

    @property
    def events(self) -> int:
        """Number of event functions."""

    @property
    def large(self) -> bool:
        """Whether heyoka should compile loops, since unrolled code would take many seconds to compile."""

    def in_heyoka(self) -> HeyokaSystem:
        """The system in heyoka's expressions, without its variational equations."""

    def rates(self, time: float, state: Array, parameters: Values) -> Array:
        """f, (n,)."""

    def variational(self, time: Any, state: Array, columns: Array, parameters: Any) -> Array:
        """f and the matrix (df/dx) @ columns side by side, (n, 1 + m), for given columns (n, m)."""

    def event(self, i: int, time: float, state: Array, parameters: Values) -> float:
        """Event function i."""

    def event_gradient(self, i: int, time: float, state: Array, parameters: Values) -> tuple[Array, float]:
        """Derivatives of event function i in the states (n,) and in time."""


# --- SymPy -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Symbolic:
    """Equations given by SymPy expressions.

    Parameters
    ----------
    states, expressions, parameters : tuple
        Symbols x, expressions of their rates f, symbols p.
    clock : sympy.Symbol, optional
        The independent variable, if the expressions hold it.
    wrt : tuple of sympy.Symbol
        States in whose initial values the flow is differentiated.
    event_functions : tuple of sympy.Expr
        Functions of states, parameters and clock; see `Equations`.

    Raises
    ------
    ValueError
        If the numbers of states and rates differ, or a rate holds an unknown symbol.
    """

    states: tuple[Any, ...]
    expressions: tuple[Any, ...]
    parameters: tuple[Any, ...] = ()
    clock: Hashable = None
    wrt: tuple[Any, ...] = ()
    event_functions: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        if len(self.states) != len(self.expressions):
            raise ArgumentValueError(
                f"expressions must hold one rate for each of {len(self.states)} states, "
                f"got {len(self.expressions)}",
                "expressions",
            )
        known = {*self.states, *self.parameters, self.clock}
        unknown = {str(symbol) for rate in self.expressions for symbol in rate.free_symbols - known}
        if unknown:
            raise ArgumentValueError(
                "expressions must hold no symbols but states, parameters and the clock, "
                f"got {', '.join(sorted(unknown))}",
                "expressions",
            )

    @cached_property
    def identity(self) -> Array:
        """Derivatives of the initial states in ``wrt``, (n, m)."""
        rows = [[float(x == w) for w in self.wrt] for x in self.states]
        return np.reshape(np.array(rows), (len(self.states), len(self.wrt)))

    @property
    def events(self) -> int:
        """Number of event functions."""
        return len(self.event_functions)

    @property
    def large(self) -> bool:
        """Whether heyoka should compile loops."""
        return bool(self.wrt or self.event_functions) or compact(self.expressions)

    def in_heyoka(self) -> HeyokaSystem:
        """See `Equations`."""
        import heyoka as hy

        pairs, table = heyoka_system(self.states, self.expressions, self.parameters, self.clock)
        events = [hy.from_sympy(with_floats(g), table) for g in self.event_functions]
        return pairs, [table[symbol] for symbol in self.wrt], events

    def rates(self, time: float, state: Array, parameters: Values) -> Array:
        """See `Equations`."""
        found: Array = self._rates(time, *state, *parameters)[0][..., 0]
        return found

    def variational(self, time: Any, state: Array, columns: Array, parameters: Any) -> Array:
        """See `Equations`; takes stacks too: states (..., n), columns (..., n, m), parameters (..., p)."""
        arguments = (time, *np.moveaxis(state, -1, 0), *np.moveaxis(np.asarray(parameters), -1, 0))
        rates, *jacobian = self._rates(*arguments)
        return np.concatenate([rates, jacobian[0] @ columns], axis=-1) if self.wrt else rates

    def event(self, i: int, time: float, state: Array, parameters: Values) -> float:
        """See `Equations`."""
        return float(self._events(time, *state, *parameters)[0][i, 0])

    def event_gradient(self, i: int, time: float, state: Array, parameters: Values) -> tuple[Array, float]:
        """See `Equations`."""
        by_state, by_time = self._gradients(time, *state, *parameters)
        return by_state[i], float(by_time[i, 0])

    @cached_property
    def _arguments(self) -> list[Any]:
        import sympy as sp

        time = self.clock if self.clock is not None else sp.Dummy("t")
        return [time, *self.states, *self.parameters]

    @cached_property
    def _rates(self) -> Callable[..., tuple[Array, ...]]:
        import sympy as sp

        column = sp.Matrix(self.expressions)
        jacobian = {"jacobian": column.jacobian(list(self.states))} if self.wrt else {}
        return compiler.function("rates", self._arguments, {"rates": column} | jacobian)

    @cached_property
    def _events(self) -> Callable[..., tuple[Array, ...]]:
        import sympy as sp

        return compiler.function("events", self._arguments, {"g": sp.Matrix(self.event_functions)})

    @cached_property
    def _gradients(self) -> Callable[..., tuple[Array, ...]]:
        import sympy as sp

        column, time = sp.Matrix(self.event_functions), self._arguments[0]
        outputs = {"by_state": column.jacobian(list(self.states)), "by_time": column.diff(time)}
        return compiler.function("gradients", self._arguments, outputs)


def heyoka_system(
    states: Sequence[Any], rates: Sequence[Any], parameters: Sequence[Any], clock: Hashable
) -> tuple[list[tuple[Number, Number]], dict[Any, Number]]:
    """SymPy equations in heyoka's expressions, with shared parts built once, and the table of symbols."""
    import heyoka as hy
    import sympy as sp

    table = {symbol: hy.expression(f"x_{i}") for i, symbol in enumerate(states)}
    table |= {symbol: hy.par[i] for i, symbol in enumerate(parameters)}
    if clock is not None:
        table[clock] = hy.time
    shared, reduced = sp.cse([with_floats(rate) for rate in rates], symbols=sp.numbered_symbols(cls=sp.Dummy))
    for symbol, expression in shared:
        table[symbol] = hy.from_sympy(expression, table)
    return [(table[x], hy.from_sympy(r, table)) for x, r in zip(states, reduced, strict=True)], table


def with_floats(expression: Any) -> Any:
    """The expression with floats for fractions that heyoka cannot take: denominators not a power of two."""
    import sympy as sp

    taken = sp.sympify(expression)
    fractions = [r for r in taken.atoms(sp.Rational) if r.q & (r.q - 1)]
    return taken.xreplace({r: sp.Float(float(r)) for r in fractions})


def compact(rates: Sequence[Any]) -> bool:
    """Whether heyoka should compile loops for SymPy rates, because they hold more than `SMALL` operations."""
    import sympy as sp

    return bool(sp.count_ops(list(rates)) > SMALL)


# --- plain functions ---------------------------------------------------------------------------------


class Arithmetic(NamedTuple):
    """The functions that a plain right-hand side may call on arrays or on heyoka's expressions.

    Attributes
    ----------
    lift : callable
        Turns a kernel (a function in arithmetic, sqrt, sin and cos) into a function of such numbers.
    sqrt, tanh : callable
        Functions of such numbers.
    """

    lift: Callable[[Callable[..., Any]], Callable[..., Any]]
    sqrt: Callable[[Number], Number]
    tanh: Callable[[Number], Number]


ON_ARRAYS = Arithmetic(lambda kernel: kernel, np.sqrt, np.tanh)


def on_heyoka() -> Arithmetic:
    """`Arithmetic` on heyoka's expressions: a kernel's own code runs with heyoka's functions."""
    import heyoka as hy

    def sqrt(x: Number) -> Number:
        return math.sqrt(x) if isinstance(x, int | float) else hy.sqrt(x)  # heyoka takes no plain number

    def lift(kernel: Callable[..., Any]) -> Callable[..., Any]:
        return types.FunctionType(
            kernel.__code__, {"sqrt": sqrt, "sin": hy.sin, "cos": hy.cos}, kernel.__name__
        )

    return Arithmetic(lift, sqrt, hy.tanh)


RightHandSide = Callable[[Arithmetic, Number, Any, Any], Sequence[Number]]
"""A function (arithmetic, t, x, p) -> n rates; x and p are sequences of numbers, or arrays of such rows."""
EventFunction = Callable[[Arithmetic, Number, Any, Any], Number]
"""A function (arithmetic, t, x, p) -> value, with arguments as for `RightHandSide`."""


@dataclass(frozen=True)
class Kernel:
    """Equations given by a plain function of numbers.

    Parameters
    ----------
    names : tuple of str
        Names of the n states.
    right_hand_side : function (arithmetic, t, x, p) -> n rates
        It uses only arithmetic operators and the functions of `Arithmetic`.
    parameters : int
        Number of parameters p.
    wrt : tuple of int
        Indices of the states in whose initial values the flow is differentiated.
    event_functions : tuple of functions (arithmetic, t, x, p) -> value
        See `Equations`.
    slack : float
        heyoka ends an arc where an event function has this value rather than zero. If the next arc began
        exactly at a zero of its own event function, heyoka would overlook other zeros in the first step.
    """

    names: tuple[str, ...]
    right_hand_side: RightHandSide
    parameters: int
    wrt: tuple[int, ...] = ()
    event_functions: tuple[EventFunction, ...] = ()
    slack: float = 0.0

    @cached_property
    def identity(self) -> Array:
        """Derivatives of the initial states in those listed in ``wrt``, (n, m)."""
        return np.eye(len(self.names))[:, list(self.wrt)]

    @property
    def events(self) -> int:
        """Number of event functions."""
        return len(self.event_functions)

    large = True

    def in_heyoka(self) -> HeyokaSystem:
        """See `Equations`."""
        import heyoka as hy

        of, x = on_heyoka(), [hy.expression(name) for name in self.names]
        p = [hy.par[i] for i in range(self.parameters)]
        rates = self.right_hand_side(of, hy.time, x, p)
        events = [g(of, hy.time, x, p) - self.slack for g in self.event_functions]
        return list(zip(x, rates, strict=True)), [x[i] for i in self.wrt], events

    def rates(self, time: float, state: Array, parameters: Values) -> Array:
        """See `Equations`."""
        return np.array(self.right_hand_side(ON_ARRAYS, time, state, parameters))

    def variational(self, time: Any, state: Array, columns: Array, parameters: Any) -> Array:
        """See `Equations`; by a complex step along each column, exact to rounding."""
        x = np.column_stack([state, state[:, None] + 1j * STEP * columns])
        slopes = np.array(self.right_hand_side(ON_ARRAYS, time, x, parameters))
        return np.concatenate([slopes[:, :1].real, slopes[:, 1:].imag / STEP], axis=1)

    def event(self, i: int, time: float, state: Array, parameters: Values) -> float:
        """See `Equations`."""
        return float(self.event_functions[i](ON_ARRAYS, time, state, parameters))

    def event_gradient(self, i: int, time: float, state: Array, parameters: Values) -> tuple[Array, float]:
        """See `Equations`; by complex steps."""
        function = self.event_functions[i]
        _, (slopes,) = jacobian(
            lambda z: [function(ON_ARRAYS, z[-1], z[:-1], parameters)], np.append(state, time)
        )
        return slopes[:-1], float(slopes[-1])
