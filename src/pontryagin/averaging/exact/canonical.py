"""The exact canonical system (1.1), (1.6) of a phase system, with the anomaly or slow time as the clock.

States are (a, p, y, tau, J): slow variables, costates, y = p_x/epsilon, slow time and cost. Rates come from
p f + p_x F - L - (cost of u) at the maximising u*, differentiated at fixed u (envelope theorem). With the
anomaly as the clock an end at a given anomaly is an end at a given time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import sympy as sp

from pontryagin.averaging.exact.modes import modal
from pontryagin.averaging.system.standard_form import StandardForm

epsilon = sp.Symbol("epsilon", positive=True)
y, tau, cost = sp.symbols("y tau J", real=True)


@dataclass(frozen=True)
class Canonical:
    """The equations of a phase system's exact extremals, in SymPy.

    Attributes
    ----------
    slow, costates : tuple of n symbols
        a and p.
    anomaly : symbol
        x.
    parameters : tuple of symbols
        epsilon, then the system's numbers.
    rates : tuple of 2n + 3 expressions
        d(a, p, y, tau, J)/dx; they may hold the modes.
    time_rates : tuple of 2n + 4 expressions
        d(a, p, y, tau, J, x)/dtau.
    modes : tuple of (symbol, expression)
        Symbols of signs in the rates, each with the function whose sign it stands for.
    control : tuple of m expressions
        u*, without modes.
    hamiltonian : expression
        h* + y r, which vanishes on extremals, (1.8).
    gap : expression
        h* minus p f + p_x F - L - (cost of u) at u*: never negative, and zero where u* maximises.
    rate : expression
        r.
    motion : tuple of n + 1 expressions
        f and dx/dt = r + epsilon F at u*, without modes: the derivatives of `hamiltonian` in p and y.
    free : bool
        Whether the control costs nothing and does not move the anomaly.
    boundary : tuple of r expressions
        M, the target.
    terminal_cost : expression
        g.
    """

    slow: tuple[sp.Symbol, ...]
    costates: tuple[sp.Symbol, ...]
    anomaly: sp.Symbol
    parameters: tuple[sp.Symbol, ...]
    rates: tuple[sp.Expr, ...]
    time_rates: tuple[sp.Expr, ...]
    modes: tuple[tuple[sp.Symbol, sp.Expr], ...]
    control: tuple[sp.Expr, ...]
    hamiltonian: sp.Expr
    gap: sp.Expr
    rate: sp.Expr
    motion: tuple[sp.Expr, ...]
    free: bool
    boundary: tuple[sp.Expr, ...]
    terminal_cost: sp.Expr

    def unswitched(self, expressions: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
        """The expressions with every mode replaced by the sign that it stands for."""
        table: dict[sp.Expr, sp.Expr] = {}
        for mode, switching in self.modes:
            table[mode] = sp.sign(switching.xreplace(table))
        return tuple(e.xreplace(table) for e in expressions)

    @property
    def states(self) -> tuple[sp.Symbol, ...]:
        """(a, p, y, tau, J)."""
        return (*self.slow, *self.costates, y, tau, cost)


def canonical(system: StandardForm) -> Canonical:
    """The exact equations of a `PhaseSystem`; systems with equal expressions share them.

    Examples
    --------
    >>> from pontryagin.averaging import PhaseSystem, Quadratic
    >>> v, x, u = sp.symbols("v x u", real=True)
    >>> pushed = PhaseSystem(f=[u], omega=v, control_set=Quadratic(), slow=[v], control=[u], phase=x,
    ...                      target=[v - 2])
    >>> equations = canonical(pushed)
    >>> equations.time_rates[:3]
    (p_v/2, -y, 0)
    """
    s = system
    return _derived(
        s.slow,
        s.costates,
        s.phase,
        s.phase_costate,
        tuple(s.control),
        s.f,
        s.rate,
        s.phase_rate,
        s.running_cost,
        s.control_set.cost(s.control),
        tuple(s.maximiser),
        s.hamiltonian,
        s.target,
        s.terminal_cost,
        tuple(s.numbers),
    )


@lru_cache(maxsize=32)
def _derived(
    slow: Sequence[sp.Symbol],
    costates: Sequence[sp.Symbol],
    anomaly: sp.Symbol,
    phase_costate: sp.Symbol,
    control: Sequence[sp.Symbol],
    f: Sequence[sp.Expr],
    rate: sp.Expr,
    phase_rate: sp.Expr,
    running_cost: sp.Expr,
    control_cost: sp.Expr,
    maximiser: Sequence[sp.Expr],
    hamiltonian: sp.Expr,
    target: Sequence[sp.Expr],
    terminal_cost: sp.Expr,
    numbers: Sequence[sp.Symbol],
) -> Canonical:
    scaled = {phase_costate: epsilon * y}
    cost_rate = running_cost + control_cost
    pontryagin = (
        sum((p * g for p, g in zip(costates, f, strict=True)), phase_costate * phase_rate) - cost_rate
    )
    optimal = tuple(u.subs(scaled) for u in maximiser)
    switched, modes = modal(optimal)

    def at(expression: sp.Expr, controls: Sequence[sp.Expr]) -> sp.Expr:
        return expression.subs(scaled).xreplace(dict(zip(control, controls, strict=True)))

    def costate_rate(variable: sp.Symbol) -> sp.Expr:
        return -(y * rate.diff(variable) + pontryagin.diff(variable))

    per_time = [
        *f,
        *(costate_rate(a) for a in slow),
        costate_rate(anomaly) / epsilon,
        sp.Integer(1),
        cost_rate,
    ]
    anomaly_rate = at(rate + epsilon * phase_rate, switched)
    in_time = [at(g, switched) for g in per_time]
    return Canonical(
        slow=tuple(slow),
        costates=tuple(costates),
        anomaly=anomaly,
        parameters=(epsilon, *numbers),
        rates=tuple(epsilon * g / anomaly_rate for g in in_time),
        time_rates=(*in_time, anomaly_rate / epsilon),
        modes=modes,
        control=optimal,
        hamiltonian=hamiltonian.subs(scaled) + y * rate,
        gap=hamiltonian.subs(scaled) - at(pontryagin, optimal),
        rate=rate,
        motion=tuple(at(g, optimal) for g in [*f, rate + epsilon * phase_rate]),
        free=control_cost == 0 and not phase_rate.has(*control),
        boundary=tuple(target),
        terminal_cost=terminal_cost,
    )
