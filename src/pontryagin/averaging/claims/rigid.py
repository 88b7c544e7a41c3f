"""Section 3, example 3: Euler's equations of a symmetric body (3.10) in the standard form."""

import sympy as sp

from pontryagin.averaging.derivation import rigid_body
from pontryagin.averaging.derivation.rigid_body import a, c, d, epsilon, psi, u, w
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    RightSides,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
ux, uy, uz = u
wx, wy, wz = w


@claim("(3.10)", "Euler's equations of a symmetric body under small torques", verdict="holds")
def equations_of_the_body() -> Evidence:
    printed = {
        r"\dot\omega_x": epsilon * ux - (d - 1) * wy * wz,
        r"\dot\omega_y": epsilon * uy - (1 - d) * wx * wz,
        r"\dot\omega_z": epsilon * uz,
    }
    return Equality(
        printed,
        rigid_body.symmetric_rates,
        display=r"\dot\omega_x + (d - 1)\omega_y\omega_z = \varepsilon u_x,\quad \dot\omega_y + (1 - "
        r"d)\omega_x\omega_z = \varepsilon u_y,\quad \dot\omega_z = \varepsilon u_z,\quad d = I_zI_x^{-1} "
        r"\ne 1",
    )


@claim(
    "after (3.10): change of variables",
    "with ω_x = a cos ψ, ω_y = a sin ψ, ω_z = c: rates of a, c and ψ, and their initial values",
    verdict="holds",
    remark="The gyroscopic terms cancel in a', and with their signs they leave ψ' = +(d − 1)c.",
)
def polar_variables() -> Evidence:
    start = sp.sqrt(wx**2 + wy**2)
    printed = {
        r"\dot a": epsilon * (ux * sp.cos(psi) + uy * sp.sin(psi)),
        r"\dot c": epsilon * uz,
        r"\dot\psi": (d - 1) * c + epsilon / a * (uy * sp.cos(psi) - ux * sp.sin(psi)),
        "a_0": start,
        "c_0": wz,
    }

    def derived() -> RightSides:
        rates = rigid_body.polar_rates()
        square = sp.simplify(rigid_body.POLAR[wx] ** 2 + rigid_body.POLAR[wy] ** 2)
        radius = a * sp.sqrt((wx**2 + wy**2) / square)
        return *rates, radius, wz

    return Equality(printed, derived)


@claim(
    "after (3.10): standard form",
    "for a > 0, c ≠ 0 the system is of the standard form (1.1)",
    verdict="conditional",
    remark="True where (d − 1)c > 0 and a is bounded away from 0. For (d − 1)c < 0 take −ψ for the phase, "
    "since (1.1) requires a positive frequency. The target a = 0 lies on the boundary of the region: "
    "F grows as 1/a there, so that (1.1) and section 2 do not cover it. The result is right "
    "nevertheless: in axes that turn with the free motion there is no 1/a (see τ₁ below).",
)
def standard_form() -> Evidence:
    def argument() -> Steps:
        slow, F = rigid_body.slow_rates(), rigid_body.phase_rate()
        shifted = [(q.subs(psi, psi + 2 * sp.pi) - q).simplify() for q in (*slow, F)]
        yield "the rates are 2π-periodic in ψ", shifted == [0, 0, 0]
        rest = rigid_body.polar_rates()[2] - rigid_body.anomaly_rate()
        yield "ψ' = (d − 1)c + εF", vanishes(rest - epsilon * F)
        bound = sp.simplify((a * F).diff(ux) ** 2 + (a * F).diff(uy) ** 2)
        yield "|F| ≤ |u|/a", bound == 1
        yield "−ψ turns with (1 − d)c", vanishes(-rigid_body.anomaly_rate() - (1 - d) * c)

    def counterexample() -> Steps:
        yield "d = 1/2, c = 1: ψ' = −1/2", rigid_body.anomaly_rate().subs({d: R(1, 2), c: 1}) == -R(1, 2)
        near = rigid_body.phase_rate().subs({ux: 0, uy: 1, psi: 0, a: R(1, 1000)})
        yield "at a = 1/1000, u = (0, 1), ψ = 0: F = 1000", near == 1000

    return Conditional(argument, counterexample=counterexample)
