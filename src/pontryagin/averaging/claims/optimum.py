"""Section 2, (2.14) to (2.16): the main result."""

import numpy as np
import sympy as sp

from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.derivation import averaged, optimum, ripple, rotor, smooth
from pontryagin.averaging.derivation.averaged import kappa
from pontryagin.averaging.derivation.optimum import Psi
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Equality,
    Evidence,
    Proof,
    RightSides,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
INNER = sp.Symbol("kappa_1", real=True)
SMOOTH = {smooth.v0: 1, smooth.v1: 2, smooth.k: 1, ripple.rise: 1}


def closed(form: sp.Expr) -> sp.Expr:
    """A closed form of the smooth example, v from 1 to 2 with k = 1, as a function of kappa."""
    return ripple.of_kappa(form).subs(SMOOTH)


@claim.proof(
    "before (2.14): dJ0",
    "dJ0/dκ = −(η1 dξ1/dκ)",
    remark="This holds with η1 = −(g' + αM'); with (2.4) as printed, the right-hand side would be 0.",
    display=r"dJ_0/d\kappa = -(\eta_1 d\xi_1/d\kappa)",
)
def cost_by_the_end() -> Steps:
    yield "g'dξ1 + (η1 dξ1) = 0 wherever M'dξ1 = 0", optimum.cost_by_the_end() == 0
    printed = sp.Matrix([-averaged.alpha * averaged.M.diff(x) for x in averaged.xi])
    normal = sp.Matrix([averaged.M.diff(x) for x in averaged.xi])
    moved = sp.solve(normal.dot(optimum.varied), optimum.varied[1])[0]
    left = sp.simplify(printed.dot(optimum.varied).subs(optimum.varied[1], moved))
    yield "with the printed η1 = −αM' the product is 0", left == 0


@claim(
    "before (2.14): dξ1",
    "dξ1/dκ is the sum of a term from the end time and a term along the family",
    verdict="holds",
)
def end_by_the_chain_rule() -> Evidence:
    time, end = sp.symbols("tau tau_1", real=True)
    path, T = sp.Function("xi"), sp.Function("T")(kappa)

    def at_end(expression: sp.Expr) -> sp.Expr:
        return expression.subs({time: T, end: T}).doit()

    def printed() -> sp.Expr:
        place = path(time, end, kappa)
        inner = place.diff(end) * T.diff(kappa) + place.diff(kappa)
        return place.diff(time) * T.diff(kappa) + inner

    def example(expression: sp.Expr) -> sp.Expr:
        form = sp.Lambda((time, end, kappa), time**2 * end + sp.sin(kappa * time) + end * kappa**3)
        return sp.expand(at_end(expression.replace(path, form).doit()))

    def derived() -> RightSides:
        form = time**2 * end + sp.sin(kappa * time) + end * kappa**3
        return sp.expand(form.subs({time: T, end: T}).diff(kappa))

    return Equality(
        {r"\frac{d\xi_1}{d\kappa}": example(printed())},
        derived,
        display=r"\frac{d\xi_1}{d\kappa} = \frac{d\xi}{d\tau}\Bigr|_{\tau_1}\frac{d\tau_1}{d\kappa} + "
        r"\frac{D\xi}{D\kappa}\Bigr|_{\tau_1},\quad \frac{D\xi}{D\kappa} = \frac{\partial\xi}{\partial\tau_1}"
        r"\frac{d\tau_1}{d\kappa} + \frac{\partial\xi}{\partial\kappa}",
    )


@claim("(2.14)", "the main result: dJ0/dκ = κ d/dκ ∫ω dτ", verdict="holds")
def main_result() -> Evidence:
    def argument() -> Steps:
        yield "d(ηDξ)/dτ = −κDω, D the derivative along the family", optimum.lagrange_identity() == 0
        yield "η1dξ1/dτ = −κω1", vanishes(optimum.end_work() + kappa * averaged.omega)
        J, turned = closed(ripple.cost()), closed(ripple.turned())
        yield (
            "smooth example: it holds for the closed forms",
            vanishes(sp.simplify(J.diff(kappa) - kappa * turned.diff(kappa))),
        )

    return Proof(
        argument,
        Equality({r"\frac{dJ_0}{d\kappa}": kappa * Psi.diff(kappa)}, optimum.cost_slope),
        display=r"\frac{dJ_0}{d\kappa} = \kappa\frac{d}{d\kappa}\int_0^{\tau_1}\omega(\xi(\tau, \tau_1, "
        r"\kappa))d\tau,\quad \tau_1 = \tau_1(\kappa)",
    )


@claim.proof(
    "after (2.14): stationary",
    "κ = 0 is a stationary point of J0, and under (2.13) the only one",
    remark="Where (2.13) fails away from κ = 0, J0 is stationary there too.",
)
def stationary() -> Steps:
    slope = optimum.cost_slope()
    yield "dJ0/dκ = 0 at κ = 0", slope.subs(kappa, 0).doit() == 0
    rate = sp.Symbol("dPsi", nonzero=True)
    yield (
        "with dΨ/dκ ≠ 0 it vanishes at κ = 0 alone",
        sp.solve(slope.subs(Psi.diff(kappa), rate), kappa) == [0],
    )
    turned = closed(ripple.turned())
    slopes = [turned.diff(kappa).subs(kappa, R(value, 32)).evalf(12) for value in (-24, 0, 7, 12)]
    yield (
        "smooth example: dΨ/dκ at κ = −3/4, 0, 7/32, 3/8 is "
        + ", ".join(f"{float(value):.3f}" for value in slopes),
        min(slopes) > 0,
    )


@claim(
    "(2.15)",
    "κ = 0 is a local minimum if d/dκ ∫ω dτ > 0 there",
    verdict="holds",
    remark="The condition says nothing in the paper's example 1, least time, where the derivative is 0: the "
    "motion does not depend on κ.",
)
def second_derivative() -> Evidence:
    def argument() -> Steps:
        J, turned = closed(ripple.cost()), closed(ripple.turned())
        curvature = sp.simplify(J.diff(kappa, 2).subs(kappa, 0))
        yield (
            "smooth example, v from 1 to 2, k = 1: d²J0/dκ² = 7/6 = dΨ/dκ > 0",
            (curvature == R(7, 6) == sp.simplify(turned.diff(kappa).subs(kappa, 0))),
        )
        passed = sp.integrate(1, (rotor.a, instances.a0, instances.a1))
        yield "rotor, least time: Ψ = a1 − a0, and the derivative is 0", passed.diff(kappa) == 0

    return Proof(
        argument,
        Equality(
            {r"\frac{d^2J_0}{d\kappa^2}\Bigr|_{\kappa = 0}": Psi.diff(kappa).subs(kappa, 0)},
            optimum.second_derivative,
        ),
        display=r"\frac{d^2J_0}{d\kappa^2}\Bigr|_{\kappa=0} = "
        r"\frac{d}{d\kappa}\int_0^{\tau_1}\omega(\xi(\tau, "
        r"\tau_1, \kappa))d\tau\Bigr|_{\kappa=0,\ \tau_1=\tau_1(0)} > 0",
    )


@claim.proof(
    "(2.16)",
    "the condition is sufficient for κ = 0 to give the least J0 over the whole range of κ",
    display=r"\kappa\int_0^{\tau_1}\omega(\xi)d\tau \ge \int_0^{\kappa}d\kappa_1\int_0^{\tau_1(\kappa_1)}"
    r"\omega(\xi(\tau, \tau_1(\kappa_1), \kappa_1))d\tau",
)
def global_minimum() -> Steps:
    left = kappa * Psi - sp.Integral(Psi.subs(kappa, INNER), (INNER, 0, kappa))
    yield "the two sides differ by J0(κ) − J0(0)", vanishes(left - optimum.cost_difference())
    low, high = worked.window()
    J = closed(ripple.cost())
    values = [float(J.subs(kappa, value)) for value in np.linspace(low, high, 7)]
    yield f"smooth example, κ from {low:.2f} to {high:.2f}: J0 − 2 ≥ 0", min(values) > 2 - 1e-12
    turned = sp.lambdify(kappa, closed(ripple.turned()))
    for value in (low, high):
        grid = np.linspace(0, value, 2001)
        steps = turned(grid[1:]) - turned(grid[:-1])
        yield (
            f"and Ψ rises from κ = 0 to {value:.2f}, which is enough",
            bool(np.all(steps * np.sign(value) > 0)),
        )


@claim("after (2.16): J0", "J0(κ) follows from (2.14) by integration by parts", verdict="holds")
def cost_by_parts() -> Evidence:
    inner = sp.Integral(Psi.subs(kappa, INNER), (INNER, 0, kappa))
    return Equality(
        {r"J_0(\kappa) - J_0(0)": kappa * Psi - inner},
        optimum.cost_difference,
        display=r"J_0(\kappa) = J_0(0) + \kappa\int_0^{\tau_1}\omega(\xi)d\tau - \int_0^{\kappa}d\kappa_1"
        r"\int_0^{\tau_1(\kappa_1)}\omega(\xi(\tau, \tau_1(\kappa_1), \kappa_1))d\tau",
    )
