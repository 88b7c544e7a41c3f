"""Section 3, (3.12) to (3.14): the areas between the parabola and the axis."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Consequence, Equality, Evidence, Misprint, RightSides
from pontryagin.triple_integrator.claims.peak import area_with_two_zeros, first, second
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import tau
from pontryagin.triple_integrator.derivation.model import T, c
from pontryagin.triple_integrator.derivation.parabola import (
    alpha,
    apex,
    beta,
    half_width,
    lower,
    price,
    upper,
)

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
conjugate = T - apex
"""The paper's conjugate parameter, written tau_m with a tilde."""


@claim("before (3.12): S_k", "S_k in terms of α_m, τ_m and Δ_m", verdict="holds")
def piece_in_the_vertex_form() -> Evidence:
    a, b = lower, upper
    printed = alpha * (b - a) * (apex**2 - half_width**2 - apex * (b + a) + (b**2 + b * a + a**2) / 3)
    return Equality(
        {"S_k": printed},
        lambda: parabola.area(a, b),
        display=r"S_k = \alpha_m (b_k - a_k)\left[\tau_m^2 - \Delta_m^2 - \tau_m(b_k + a_k) + "
        r"\tfrac13 (b_k^2 + b_k a_k + a_k^2)\right]",
    )


@claim(
    "before (3.12): limits",
    "limits of the third integral",
    verdict="misprint",
    remark="Printed: b3 = T and a2 = τ_m + Δ_m. Right: a3 = τ_m + Δ_m; the line before has a2 = τ_m − Δ_m, "
    "and (3.12) uses a3.",
)
def limits_of_the_third_piece() -> Evidence:
    def consequence() -> Consequence:
        numbers = {alpha: R(1, 2), apex: R(1, 2), half_width: R(1, 4), T: 1}
        wrong = parabola.area(apex + half_width, apex + half_width).subs(numbers)
        return Consequence("S2 of example 2 (γ = T = 1) from a2 to b2 = τ_m + Δ_m", wrong, -R(1, 96))

    return Misprint(
        {"a_2": apex + half_width},
        lambda: sp.solve(parabola.vertex_form().subs(beta, alpha * half_width**2), tau)[0],
        defect={"a_2": 2 * half_width},
        consequence=consequence,
        display=r"b_3 = T,\quad a_2 = \tau_m + \Delta_m",
    )


@claim("(3.12)", "S1, S2 and S3", verdict="holds")
def three_areas() -> Evidence:
    printed = {
        "S_1": alpha / 3 * (apex - half_width) ** 2 * (apex + 2 * half_width),
        "S_2": -R(4, 3) * alpha * half_width**3,
        "S_3": alpha
        / 3
        * (T - apex - half_width)
        * (half_width * (T - apex - 2 * half_width) + (T - apex) ** 2),
    }
    return Equality(
        printed,
        parabola.areas,
        display=r"S_1 = \tfrac13 \alpha_m(\tau_m - \Delta_m)^2(\tau_m + 2\Delta_m);\quad S_2 = -\tfrac43 "
        r"\alpha_m"
        r"\Delta_m^3;\quad S_3 = \tfrac13 \alpha_m(T - \tau_m - \Delta_m)[\Delta_m(T - \tau_m - 2\Delta_m) + "
        r"(T - \tau_m)^2]",
    )


@claim("after (3.12): S3", "S3 in the conjugate parameter T − τ_m", verdict="holds")
def third_area_conjugate() -> Evidence:
    printed = alpha / 3 * (conjugate**3 - 3 * conjugate * half_width**2 + 2 * half_width**3)
    return Equality(
        {"S_3": printed},
        lambda: parabola.areas()[2],
        display=r"S_3 = \tfrac13 \alpha_m(\tilde{\tau}_m^3 - 3\tilde{\tau}_m\Delta_m^2 + 2\Delta_m^3),\quad "
        r"\tilde{\tau}_m = T - \tau_m",
    )


@claim("after (3.12): S1", "S1 has the same form with τ_m in place of T − τ_m", verdict="holds")
def first_area_conjugate() -> Evidence:
    printed = alpha / 3 * (apex**3 - 3 * apex * half_width**2 + 2 * half_width**3)

    def derived() -> RightSides:
        # The parabola is symmetric about its apex: S1 is S3 with time reversed.
        return parabola.areas()[2].subs(apex, T - apex)

    return Equality(
        {"S_1": printed},
        derived,
        display=r"S_1 = \tfrac13 \alpha_m(\tau_m^3 - 3\tau_m\Delta_m^2 + 2\Delta_m^3)",
    )


@claim("(3.13)", "the condition l'c = 1 in α_m, τ_m and Δ_m", verdict="holds")
def condition_on_the_zeros() -> Evidence:
    printed = alpha * (2 * c1 - 2 * conjugate * c2 + (conjugate**2 - half_width**2) * c3)
    return Equality(
        {"1": printed},
        lambda: parabola.normalisation().subs(beta, alpha * half_width**2),
        display=r"\alpha_m[2c_1 - 2\tilde{\tau}_m c_2 + (\tilde{\tau}_m^2 - \Delta_m^2)c_3] = 1",
    )


@claim(
    "before (3.14): F",
    "F = S1 − S2 + S3 is to be minimised under (3.13); for α_m > 0 it is ∫|ψ3*|",
    verdict="holds",
    remark="For α_m < 0, F is −∫|ψ3*|: see the entry on the sign of α_m.",
)
def signed_area() -> Evidence:
    sides = (
        alpha / 3 * (apex - half_width) ** 2 * (apex + 2 * half_width),
        -R(4, 3) * alpha * half_width**3,
        alpha / 3 * (conjugate**3 - 3 * conjugate * half_width**2 + 2 * half_width**3),
    )

    def derived() -> RightSides:
        at = {first: apex - half_width, second: apex + half_width}
        return sp.expand(alpha * area_with_two_zeros().subs(at))

    return Equality({"F": sides[0] - sides[1] + sides[2]}, derived, display="F = S_1 - S_2 + S_3")


@claim(
    "(3.14)",
    "the auxiliary function F + λ(…), where the condition in the brackets is (3.13) divided by α_m",
    verdict="holds",
)
def auxiliary_function() -> Evidence:
    first_area = alpha / 3 * (apex - half_width) ** 2 * (apex + 2 * half_width)
    third_area = alpha / 3 * (conjugate**3 - 3 * conjugate * half_width**2 + 2 * half_width**3)
    condition = 2 * c1 - 2 * conjugate * c2 + (conjugate**2 - half_width**2) * c3 - 1 / alpha
    printed = first_area + R(4, 3) * alpha * half_width**3 + third_area + price * condition
    return Equality(
        {r"\tilde F": printed},
        parabola.lagrangian,
        display=r"\tilde F = S_1 - S_2 + S_3 + \lambda\left[2c_1 - 2\tilde{\tau}_m c_2 + (\tilde{\tau}_m^2 - "
        r"\Delta_m^2)c_3 - \frac{1}{\alpha_m}\right]",
    )
