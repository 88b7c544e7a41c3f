"""The standard form of a system with a rotating phase, (1.1), and its Hamiltonian, (1.4) and (1.5)."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import cached_property

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.averaging.system.control_sets import ControlSet
from pontryagin.validation import common_shape


@dataclass(frozen=True, eq=False)
class StandardForm:
    """The data of a `PhaseSystem`, and the expressions that follow from them.

    The maximum over the control is taken here, (1.5); `average` takes the mean over the phase.
    """

    f: Sequence[sp.Expr]
    omega: sp.Expr | None = None
    control_set: ControlSet = None  # type: ignore[assignment]
    _: KW_ONLY
    slow: Sequence[sp.Symbol]
    control: Sequence[sp.Symbol]
    phase: sp.Symbol
    target: Sequence[sp.Expr]
    anomaly_rate: sp.Expr | None = None
    weight: sp.Expr = 1
    running_cost: sp.Expr = 1
    terminal_cost: sp.Expr = 0
    phase_rate: sp.Expr = 0
    numbers: Mapping[sp.Symbol, ArrayLike] = field(default_factory=dict)

    @cached_property
    def costates(self) -> tuple[sp.Symbol, ...]:
        """p, conjugate to the slow variables (n)."""
        return tuple(sp.Symbol(f"p_{a}", real=True) for a in self.slow)

    @cached_property
    def phase_costate(self) -> sp.Symbol:
        """p_x, conjugate to the anomaly: the Hamiltonian is p_x r + epsilon h*."""
        return sp.Symbol(f"p_{self.phase}", real=True)

    @cached_property
    def rate(self) -> sp.Expr:
        """r(a, x): the anomaly's rate at epsilon = 0."""
        return self.anomaly_rate if self.omega is None else self.omega / self.weight

    @cached_property
    def drift(self) -> sp.Matrix:
        """f at zero control (n, 1)."""
        return sp.Matrix(self.f).subs(dict.fromkeys(self.control, 0))

    @cached_property
    def gain(self) -> sp.Matrix:
        """B = df/du (n, m)."""
        return sp.Matrix(self.f).jacobian(self.control).applyfunc(_without_control(self.control))

    @cached_property
    def phase_drift(self) -> sp.Expr:
        """F at zero control."""
        return self.phase_rate.subs(dict.fromkeys(self.control, 0))

    @cached_property
    def phase_gain(self) -> sp.Matrix:
        """dF/du (1, m)."""
        return sp.Matrix([self.phase_rate]).jacobian(self.control).applyfunc(_without_control(self.control))

    @cached_property
    def switching(self) -> sp.Matrix:
        """s = B'p + F_u'p_x (m, 1): the control maximises s'u minus its cost."""
        return self.gain.T * sp.Matrix(self.costates) + self.phase_gain.T * self.phase_costate

    @cached_property
    def hamiltonian(self) -> sp.Expr:
        """h*(a, x, p, p_x) = max over u of (p f + p_x F - L - cost of u), (1.4) with (1.5)."""
        free = (sp.Matrix(self.costates).T * self.drift)[0] + self.phase_costate * self.phase_drift
        return free - self.running_cost + self.control_set.support(list(self.switching))

    @cached_property
    def maximiser(self) -> sp.Matrix:
        """u*(a, x, p, p_x), (1.5), (m, 1)."""
        return self.control_set.maximiser(list(self.switching))

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Leading axes of the stack of problems that arrays among the numbers make."""
        return common_shape(**{str(symbol): np.shape(value) for symbol, value in self.numbers.items()})


def _without_control(control: Sequence[sp.Symbol]) -> Callable[[sp.Expr], sp.Expr]:
    """A function that simplifies derivatives which contain the control although it cancels."""
    return lambda entry: sp.simplify(entry) if entry.has(*control) else entry
