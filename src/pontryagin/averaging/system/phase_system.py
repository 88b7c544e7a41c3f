"""A standard system with a rotating phase, (1.1), and its Hamiltonian after the maximum over the control."""

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import cached_property

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.averaging.system.control_sets import ControlSet
from pontryagin.validation import common_shape


@dataclass(frozen=True, eq=False)
class PhaseSystem:
    """Slow variables a driven by a control u through a rotating phase, (1.1) to (1.3).

    a' = epsilon f(a, x, u),  x' = r(a, x) + epsilon F(a, x, u),  M(a(t1)) = 0,  and the cost
    g(a(t1)) + integral of (L(a, x) + cost of u) over the slow time epsilon t is to be least. The anomaly x is
    any angle that turns with the phase; r = omega / weight is its rate at epsilon = 0.

    Parameters
    ----------
    f : sequence of n expressions
        Rates of the slow variables per epsilon, affine in the control, 2 pi-periodic in the anomaly.
    omega : expression, optional
        Frequency of the phase, in the slow variables.
    control_set : ControlSet
        `Quadratic`, `Ball`, `Ellipsoid`, `Box`, `BoundedQuadratic` or `Custom`.
    slow, control : sequence of real sympy.Symbol
        a (n) and u (m).
    phase : real sympy.Symbol
        The anomaly x; the phase is zero where it is.
    target : sequence of r expressions in the slow variables
        M, 1 <= r <= n.
    running_cost : expression in the slow variables and the anomaly
        L; 1 for the least time.
    terminal_cost : expression in the slow variables
        g.
    phase_rate : expression, affine in the control
        F; the averaged problem does not depend on it, the correction and the exact extremals do.
    weight : expression
        dpsi/dx, positive, of mean one over a turn of x.
    anomaly_rate : expression, optional
        r(a, x), in the place of omega and weight where the frequency is known as the integral
        omega = 2 pi / oint dx / r only.
    numbers : mapping of real sympy.Symbol to number or (...) array, optional
        Values of the other symbols; arrays make a stack of problems.

    Raises
    ------
    TypeError, ValueError
        Naming the argument: an unknown symbol, a rate that is not affine in the control or not periodic, a
        frequency that is not positive, a control set that is not convex, a wrong number of entries.

    Examples
    --------
    A pendulum that rotates through a resisting medium is sped up: the energy a = x'^2/2 - cos x against the
    drag -x'/5, at the cost 1 + u^2. It is not in the paper.

    >>> from pontryagin.averaging import PhaseSystem, Quadratic
    >>> a, x, u = sp.symbols("a x u", real=True)
    >>> speed = sp.sqrt(2 * (a + sp.cos(x)))
    >>> pendulum = PhaseSystem(f=[speed * (u - speed / 5)], anomaly_rate=speed, control_set=Quadratic(),
    ...                        slow=[a], control=[u], phase=x, target=[a - 5])
    >>> pendulum.maximiser[0]
    p_a*sqrt(2*a + 2*cos(x))/2
    >>> from pontryagin.averaging import solve_averaged
    >>> solution = solve_averaged(pendulum, start=[2.0])
    >>> f"{solution.duration:.6f} {solution.cost:.6f}"
    '1.049933 3.849810'
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

    def __post_init__(self) -> None:
        from pontryagin.averaging.system.checks import checked

        for name, value in checked(self).items():
            object.__setattr__(self, name, value)

    @cached_property
    def costates(self) -> tuple[sp.Symbol, ...]:
        """p, conjugate to the slow variables (n)."""
        return tuple(sp.Symbol(f"p_{a}", real=True) for a in self.slow)

    @cached_property
    def phase_costate(self) -> sp.Symbol:
        """p_x, conjugate to the anomaly: the whole Hamiltonian is p_x r + epsilon h*."""
        return sp.Symbol(f"p_{self.phase}", real=True)

    @cached_property
    def rate(self) -> sp.Expr:
        """r(a, x): the anomaly's rate at epsilon = 0."""
        return self.anomaly_rate if self.omega is None else self.omega / self.weight

    @cached_property
    def drift(self) -> sp.Matrix:
        """f without control (n, 1)."""
        return sp.Matrix(self.f).subs(dict.fromkeys(self.control, 0))

    @cached_property
    def gain(self) -> sp.Matrix:
        """B: what the control enters f with (n, m)."""
        return sp.Matrix(self.f).jacobian(self.control).applyfunc(_settled(self.control))

    @cached_property
    def phase_drift(self) -> sp.Expr:
        """F without control."""
        return self.phase_rate.subs(dict.fromkeys(self.control, 0))

    @cached_property
    def phase_gain(self) -> sp.Matrix:
        """What the control enters F with (1, m)."""
        return sp.Matrix([self.phase_rate]).jacobian(self.control).applyfunc(_settled(self.control))

    @cached_property
    def switching(self) -> sp.Matrix:
        """s = B'p + F_u'p_x (m, 1): the control maximises s'u less its cost."""
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
    def model(self):
        """The numeric side of the system, compiled: a `pontryagin.averaging.system.model.Model`."""
        from pontryagin.averaging.system.average import model

        return model(self)

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """Leading axes of the stack that the numbers make."""
        return common_shape(**{str(symbol): np.shape(value) for symbol, value in self.numbers.items()})


def _settled(control: Sequence[sp.Symbol]):
    """Simplify what still shows the control although it is affine in it."""
    return lambda entry: sp.simplify(entry) if entry.has(*control) else entry
