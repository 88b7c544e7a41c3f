"""Section 3, example 1: the rotor (3.1), its energy and its rotating phase."""

import sympy as sp

from pontryagin.averaging.derivation import rotor
from pontryagin.averaging.derivation.rotor import FORCE, MASS, POTENTIAL, a, epsilon, u, v, x
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Equality,
    Evidence,
    Proof,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

slow, fast = sp.symbols("x_1' x_2'", positive=True)

SPEED = sp.sqrt(2 / MASS) * sp.sqrt(a - POTENTIAL)
"""x'(a, x) as printed."""

TURN = 2 * sp.pi / sp.Integral(1 / SPEED, (x, 0, 2 * sp.pi))
"""omega(a) as printed."""


@claim("(3.1)", "a rotor with mass m(x) and potential V(x) under the forces εu and εf", verdict="holds")
def equation_of_the_rotor() -> Evidence:
    printed = MASS * rotor.second + MASS.diff(x) * v**2 / 2 + POTENTIAL.diff(x)
    return Equality(
        {r"\varepsilon u + \varepsilon f": printed},
        rotor.equation_of_motion,
        display=r"m(x)x'' + \tfrac12 m'x'^2 + V'(x) = \varepsilon u + \varepsilon f(x, x')",
    )


@claim.proof(
    "(3.1): bounds",
    "with x₁' < x' < x₂' the frequency stays between x₁' and x₂', away from 0",
    remark="ω is the harmonic mean of x' over the angle. x' > 0 at the start is not enough: the bounds need "
    "a > max V along the whole motion, so that a0 and a1 must both lie above V₂.",
    display=r"\infty > x_2' > x' > x_1' > 0,\quad \infty > V_2 > V > V_1 > -\infty",
)
def frequency_is_bounded() -> Steps:
    for bound in (slow, fast):
        turn = 2 * sp.pi / rotor.over_a_turn(1 / bound)
        yield f"a constant x' = {bound} has the frequency {bound}", vanishes(turn - bound)
    whole = sp.Symbol("I", positive=True)
    yield "2π/∮dx/x' falls as 1/x' grows", (2 * sp.pi / whole).diff(whole).is_negative
    yield (
        "x' vanishes where a = V: with a below max V the rotor swings back",
        rotor.speed().subs(a, POTENTIAL) == 0,
    )


@claim("after (3.1): integration", "at ε = 0 the energy a is constant, and t + γ = ∫dx/x'", verdict="holds")
def unperturbed_motion() -> Evidence:
    def derived() -> dict[str, sp.Expr]:
        lagrangian = MASS * v**2 / 2 - POTENTIAL
        return {"a": v * lagrangian.diff(v) - lagrangian, r"d(t + \gamma)/dx": 1 / rotor.speed()}

    def argument() -> Steps:
        yield "a does not change at ε = 0", rotor.energy_rate().subs(epsilon, 0) == 0
        whole = rotor.energy().subs(v, rotor.speed())
        yield "x' = dx/dt is the speed at the energy a", vanishes(whole - a)

    printed = {"a": MASS * v**2 / 2 + POTENTIAL, r"d(t + \gamma)/dx": 1 / SPEED}
    return Proof(
        argument,
        Equality(printed, derived),
        display=r"a = \tfrac12 mx'^2 + V,\quad t + \gamma = \int dx/x'(a, x)",
    )


@claim(
    "after (3.1): standard form",
    "in energy and rotating phase the system is a' = εx'(u + f), ψ' = ω(a) + O(ε)",
    verdict="holds",
)
def standard_form() -> Evidence:
    def argument() -> Steps:
        yield (
            "psi' = ω at ε = 0: dpsi/dx times x'",
            vanishes(rotor.phase_weight() * rotor.speed() - rotor.frequency()),
        )
        turn = rotor.over_a_turn(1 / rotor.speed())
        whole = sp.simplify(rotor.frequency() * turn)
        yield "psi grows by 2π in a turn whatever a is", whole == 2 * sp.pi and whole.diff(a) == 0
        share = rotor.phase_rate() / rotor.slow_rate()
        yield "F = a'/ε times dpsi/da at a fixed x, periodic in x therefore", not share.has(u, FORCE)

    printed = {
        r"\dot a/\varepsilon": SPEED * (u + FORCE.subs(v, SPEED)),
        "x'(a, x)": SPEED,
        r"\omega(a)": TURN,
    }
    return Proof(
        argument,
        Equality(printed, lambda: (rotor.slow_rate(), rotor.speed(), rotor.frequency())),
        display=r"\dot a = \varepsilon x'(u + f),\quad x' = (2/m)^{1/2}(a - V)^{1/2},\quad "
        r"\dot\psi = \omega(a) + O(\varepsilon),\quad \omega(a) = 2\pi \Big/ \oint dx/x'",
    )


@claim("after (3.1): averaging", "averages over ψ are taken over x: dψ = ω(a)dx/x'", verdict="holds")
def averaging_over_the_angle() -> Evidence:
    return Equality({r"d\psi/dx": TURN / SPEED}, rotor.phase_weight)
