"""The kernels of a phase system: its average over the phase in closed form, or the density to integrate."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import sympy as sp

from pontryagin.averaging.system.bounds import bounds
from pontryagin.averaging.system.jets import expressions
from pontryagin.averaging.system.model import Model
from pontryagin.averaging.system.standard_form import StandardForm
from pontryagin.numerics import compile as compiler

EFFORT = 400
"""A closed form is tried for integrands of at most this many operations."""


def closed_mean(integrand: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """Mean over a turn of a trigonometric polynomial in x; None for anything else.

    Examples
    --------
    >>> a, x = sp.symbols("a x", real=True)
    >>> closed_mean((a + sp.cos(x)) ** 2, x)
    a**2 + 1/2
    """
    if not integrand.has(x):
        return integrand
    if integrand.count_ops() > EFFORT:
        return None
    c, s = sp.Dummy("c"), sp.Dummy("s")
    constant = {e: sp.Dummy() for e in integrand.atoms(sp.exp) if not e.has(x)}
    expanded = sp.expand_trig(integrand.xreplace(constant)).subs({sp.cos(x): c, sp.sin(x): s})
    if expanded.has(x):
        return None
    back = {dummy: e for e, dummy in constant.items()}
    try:
        terms = sp.Poly(expanded, c, s).terms()
    except sp.PolynomialError:
        return None
    return sp.Add(*(coefficient.xreplace(back) * _moment(*powers) for powers, coefficient in terms))


def _moment(i: int, j: int) -> sp.Rational:
    """Mean of cos^i sin^j."""
    if i % 2 or j % 2:
        return sp.Integer(0)
    return sp.Rational(sp.factorial2(i - 1) * sp.factorial2(j - 1), sp.factorial2(i + j))


def averages(system: StandardForm) -> tuple[sp.Expr, sp.Expr] | None:
    """h0 and omega in closed form, (2.3), or None where none is found and quadrature has to be used."""
    h = system.hamiltonian.subs(system.phase_costate, 0)
    if system.omega is not None:
        mean = closed_mean(sp.expand_mul(h * system.weight), system.phase)
        return None if mean is None else (mean, system.omega)
    turn = closed_mean(1 / system.rate, system.phase)
    mean = None if turn is None else closed_mean(sp.expand_mul(h / system.rate), system.phase)
    return None if mean is None or turn is None else (mean / turn, 1 / turn)


def compiled_model(system: StandardForm) -> Model:
    """The kernels of a system, compiled once for systems that differ in the values of their numbers only."""
    key = (
        *(system.slow, system.control, system.phase, tuple(system.numbers), system.f, system.target),
        *(system.omega, system.rate, system.weight, system.running_cost, system.terminal_cost),
        *(system.hamiltonian, system.maximiser.as_immutable()),
    )
    if key not in _MODELS:
        known = averages(system)
        kernels: dict[str, Any] = {
            name: None if columns is None else compiler.columns(name, arguments, columns)
            for name, (arguments, columns) in _kernel_expressions(system, known).items()
        }
        origin = partial(compiled_model, system)
        _MODELS[key] = Model(
            slow=len(system.slow),
            target=len(system.target),
            origin=origin,
            bounds=bounds(system, known),
            **kernels,
        )
    return _MODELS[key]


def kernel_expressions(
    system: StandardForm, averaged: sp.Expr | None = None
) -> dict[str, tuple[tuple[sp.Symbol, ...], Sequence[sp.Expr] | None]]:
    """Arguments and columns of every kernel of `Model`, by name.

    Parameters
    ----------
    system : StandardForm
    averaged : sympy.Expr, optional
        h0, where a derivation has found it already.
    """
    return _kernel_expressions(system, averages(system) if averaged is None else (averaged, system.omega))


def _kernel_expressions(
    system: StandardForm, known: tuple[sp.Expr, sp.Expr] | None
) -> dict[str, tuple[tuple[sp.Symbol, ...], Sequence[sp.Expr] | None]]:
    a, p, x, numbers = system.slow, system.costates, system.phase, tuple(system.numbers)
    z = (*a, *p)
    integral = known is None and system.omega is None
    density: list[sp.Expr] | None = None
    switching: list[sp.Expr] | None = None
    if known is None:
        weight = 1 / system.rate if integral else system.weight
        integrand = system.hamiltonian.subs(system.phase_costate, 0) * weight
        density = [*expressions(integrand, z), expressions(integrand, [x])[1]]
        if integral:
            density += expressions(weight, a)
        kinks = switching_functions(integrand, x)
        switching = [*kinks, *(expressions(kink, [x])[1] for kink in kinks)] or None
    frequency = known[1] if known is not None else system.omega
    ends = [column for e in (*system.target, system.terminal_cost) for column in expressions(e, a)]
    cost = system.running_cost + system.control_set.cost(list(system.control))
    return {
        "mean": ((*z, *numbers), None if known is None else expressions(known[0], z)),
        "density": ((*z, x, *numbers), density),
        "frequency": ((*a, *numbers), None if frequency is None else expressions(frequency, a)),
        "switching": ((*z, x, *numbers), switching),
        "boundary": ((*a, *numbers), ends),
        "control": ((*z, x, *numbers), list(system.maximiser.subs(system.phase_costate, 0))),
        "rates": ((*a, x, *system.control, *numbers), [*system.f, cost]),
        "pace": ((*a, x, *numbers), [1 / system.rate]),
    }


def switching_functions(integrand: sp.Expr, x: sp.Symbol) -> list[sp.Expr]:
    """Functions of x at whose zeros the integrand is not smooth: arguments of Abs, Max, Min, Piecewise."""
    found = [modulus.args[0] for modulus in integrand.atoms(sp.Abs, sp.sign)]
    for extreme in integrand.atoms(sp.Max, sp.Min):
        first, *others = extreme.args
        found += [first - other for other in others]
    for pieces in integrand.atoms(sp.Piecewise):
        for condition in (condition for _, condition in pieces.args):
            found += [
                relation.lhs - relation.rhs for relation in condition.atoms(sp.core.relational.Relational)
            ]
    return list(dict.fromkeys(kink for kink in found if kink.has(x)))


_MODELS: dict[tuple[object, ...], Model] = {}
"""Compiled kernels by the expressions that they were made from."""
