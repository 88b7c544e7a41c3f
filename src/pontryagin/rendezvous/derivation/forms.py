"""The closed equations that the solvers use: states, rates and parameters, with the optimal thrust.

Four forms of one problem, with the numbers of their equations:

full            16  r, v1, c, phi*, lambda, rho, s1, e, Phi*, mu
with_attitude   14  r, v1, c, phi*, rho, s1, e, nu, lambda; regular everywhere, also where nu = 0
repaired        11  r, v1, c, phi*, rho, s1, e, nu, chi; determines the attitude
reduced         10  r, v1, c, phi*, rho, s1, e, nu; the paper's (11), (12), (13), (14) and phi*'
"""

from dataclasses import dataclass
from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import model, principle, reduction, repair
from pontryagin.rendezvous.derivation.principle import Mode


@dataclass(frozen=True)
class Form:
    """A first-order system x' = rates(x; parameters), autonomous."""

    states: tuple[sp.Symbol, ...]
    rates: tuple[sp.Expr, ...]
    parameters: tuple[sp.Symbol, ...]


def thrust(mode: Mode) -> dict[sp.Symbol, sp.Expr]:
    """The optimal p1, p2, p3 in the reduced variables, (8) and (10)."""
    return dict(zip(model.thrust, principle.optimal_thrust(mode), strict=True))


def _form(
    states: tuple[sp.Symbol, ...],
    rates: sp.Matrix,
    mode: Mode,
    names: dict[sp.Symbol, sp.Expr] | None = None,
) -> Form:
    """A form with the optimal thrust; its parameters are those of the orbit and that of the mode."""
    optimal = {p: n.subs(names or {}) for p, n in thrust(mode).items()}
    closed = tuple(repair.with_length(rate).subs(optimal) for rate in rates)
    orbit = (model.gravity, model.parameter, model.eccentricity, model.areal)
    scale = principle.energy_weight if mode == "unsaturated" else principle.peak
    return Form(tuple(states), closed, (*orbit, scale))


@cache
def full(mode: Mode) -> Form:
    """(2), (3) and the eight equations of the costates."""
    names = dict(zip(principle.nu, reduction.nu_of()[1:], strict=True))
    rates = sp.Matrix([*principle.state_rates(), *principle.costate_rates()])
    return _form((*principle.STATE, *principle.COSTATE), rates, mode, names)


@cache
def with_attitude(mode: Mode) -> Form:
    """The ten equations and that of lambda, (3)."""
    rates = sp.Matrix([*reduction.rates(), *model.attitude_rate()])
    return _form((*reduction.REDUCED, *model.attitude), rates, mode)


@cache
def repaired(mode: Mode, chart: repair.Chart = 1) -> Form:
    """The ten equations and that of chi."""
    rates = sp.Matrix([*reduction.rates(), repair.chi_rate(chart)])
    return _form((*reduction.REDUCED, repair.chi), rates, mode)


@cache
def reduced(mode: Mode) -> Form:
    """(11), (12), (13), (14) and phi*' of (3)."""
    return _form(reduction.REDUCED, reduction.rates(), mode)
