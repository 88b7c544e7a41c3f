"""Differential equations given by SymPy expressions, as recorded operations and as NumPy functions."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.equations import Equations, Values
from pontryagin.numerics.tape import Recorded, Tape, functions

PLAIN = ("Abs", "sign")
"""SymPy's names of functions that its plain Python has under other names."""


@dataclass(frozen=True)
class Symbolic(Equations):
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
        return np.eye(len(self.states))[:, [self.states.index(w) for w in self.wrt]]

    def record(self, tape: Tape) -> tuple[list[Recorded], list[Recorded]]:
        """See `Equations`."""
        import sympy as sp

        everything = [sp.sympify(e) for e in (*self.expressions, *self.event_functions)]
        used = {type(f).__name__ for e in everything for f in e.atoms(sp.core.function.Application)}
        foreign = used - {*functions(), *PLAIN}
        if foreign:
            raise ArgumentValueError(
                f"expressions must hold functions that can be compiled, got {', '.join(sorted(foreign))}",
                "expressions",
            )
        evaluate = sp.lambdify(self._arguments, everything, modules=[functions(), "math"], cse=True)
        found = evaluate(
            tape.record("time"),
            *(tape.record("state", i) for i in range(len(self.states))),
            *(tape.record("parameter", i) for i in range(len(self.parameters))),
        )
        numbers = [tape.number(number) for number in found]
        return numbers[: len(self.states)], numbers[len(self.states) :]

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
