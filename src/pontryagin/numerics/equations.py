"""Differential equations for the integrators, as recorded operations and as functions of NumPy arrays.

`Equations` says what an integrator needs: rates, variational equations, and the event functions that end an
arc. `Kernel` provides them for a plain function of numbers, which runs on both a `Tape` and arrays;
`pontryagin.numerics.symbolic.Symbolic` for SymPy expressions.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import STEP, jacobian
from pontryagin.numerics.tape import Recorded, Tape, call, lifted

Values = Sequence[float] | Array
"""The values of parameters, (p,)."""
Number = Any
"""A float, a complex array, or a recorded number."""


class Equations(ABC):
    """x' = f(t, x, p) for n states, differentiated in m of their initial values.

    An arc ends where an event function, negative on the arc, grows through zero.
    """

    event_functions: tuple[Any, ...]

    @property
    def events(self) -> int:
        """Number of event functions."""
        return len(self.event_functions)

    @property
    @abstractmethod
    def identity(self) -> Array:
        """Derivatives of the initial states in the chosen initial values, (n, m): columns of the identity."""

    @abstractmethod
    def record(self, tape: Tape) -> tuple[list[Recorded], list[Recorded]]:
        """The rates and the event functions on a tape, in its states, parameters and time."""

    @abstractmethod
    def rates(self, time: float, state: Array, parameters: Values) -> Array:
        """f, (n,)."""

    @abstractmethod
    def variational(self, time: Any, state: Array, columns: Array, parameters: Any) -> Array:
        """f and the matrix (df/dx) @ columns side by side, (n, 1 + m), for given columns (n, m)."""

    @abstractmethod
    def event(self, i: int, time: float, state: Array, parameters: Values) -> float:
        """Event function i."""

    @abstractmethod
    def event_gradient(self, i: int, time: float, state: Array, parameters: Values) -> tuple[Array, float]:
        """Derivatives of event function i in the states (n,) and in time."""


class Arithmetic(NamedTuple):
    """The functions that a plain right-hand side may call on arrays or on recorded numbers.

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
ON_TAPE = Arithmetic(lifted, partial(call, "sqrt"), partial(call, "tanh"))


RightHandSide = Callable[[Arithmetic, Number, Any, Any], Sequence[Number]]
"""A function (arithmetic, t, x, p) -> n rates; x and p are sequences of numbers, or arrays of such rows."""
EventFunction = Callable[[Arithmetic, Number, Any, Any], Number]
"""A function (arithmetic, t, x, p) -> value, with arguments as for `RightHandSide`."""


@dataclass(frozen=True)
class Kernel(Equations):
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
    """

    names: tuple[str, ...]
    right_hand_side: RightHandSide
    parameters: int
    wrt: tuple[int, ...] = ()
    event_functions: tuple[EventFunction, ...] = ()

    @cached_property
    def identity(self) -> Array:
        """Derivatives of the initial states in those listed in ``wrt``, (n, m)."""
        return np.eye(len(self.names))[:, list(self.wrt)]

    def record(self, tape: Tape) -> tuple[list[Recorded], list[Recorded]]:
        """See `Equations`."""
        time = tape.record("time")
        x = [tape.record("state", i) for i in range(len(self.names))]
        p = [tape.record("parameter", i) for i in range(self.parameters)]
        rates = self.right_hand_side(ON_TAPE, time, x, p)
        events = [g(ON_TAPE, time, x, p) for g in self.event_functions]
        return [tape.number(rate) for rate in rates], [tape.number(g) for g in events]

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
