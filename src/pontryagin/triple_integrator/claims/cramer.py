"""Section 4, (4.6): the multipliers of Chebyshev's polynomial by Cramer's rule, its norm and its extremes."""

from typing import Any

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Equality,
    Evidence,
    LinearSystem,
    Proof,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.chebyshev import F
from pontryagin.triple_integrator.derivation import chebyshev
from pontryagin.triple_integrator.derivation.channel import tau
from pontryagin.triple_integrator.derivation.chebyshev import signed_norm
from pontryagin.triple_integrator.derivation.model import T, c, multipliers

claim = Page("Gorelov & Morozova 2012")

c1, c2, c3 = c
l1, l2, l3 = multipliers


def element() -> sp.Expr:
    """The derived polynomial h0(tau) of the Chebyshev case."""
    return chebyshev.dual_in_time().subs(chebyshev.minimal_multipliers())


def room() -> sp.Expr:
    """h0(0)^2 - h0(tau)^2 of that polynomial."""
    return sp.factor(element().subs(tau, 0) ** 2 - element() ** 2)


ROOM = 16 * tau * (T - tau) * (T - 2 * tau) ** 2 / F**2
"""The same as a product that is zero at 0, T/2 and T, and positive between them."""


@claim(
    "before (4.6): system", "the coefficients of h0 and ρ~0 T2 are equal, and (4.3) holds", verdict="holds"
)
def matching_system() -> Evidence:
    printed = [
        T**2 * l1 / 16 - signed_norm,
        T**2 * l1 / 8 + T * l2 / 8 - signed_norm,
        T**2 * l1 / 2 + T * l2 + l3 - signed_norm,
        c1 * l1 + c2 * l2 + c3 * l3 - 1,
    ]

    def derived() -> list[Any]:
        # A quadratic is equal to rho~ T_2 if the two agree at three instants.
        gap = chebyshev.dual_in_time() - signed_norm * chebyshev.chebyshev_in_time()
        return [*(gap.subs(tau, instant) for instant in (0, T / 2, T)), (multipliers.T * c)[0] - 1]

    return LinearSystem(
        printed,
        derived,
        [*multipliers, signed_norm],
        display=r"\tfrac1{16}T^2l_{10} - \tilde\rho_0 = 0;\quad \tfrac18T^2l_{10} + \tfrac18Tl_{20} - "
        r"\tilde\rho_0 = 0;\quad "
        r"\tfrac12T^2l_{10} + Tl_{20} + l_{30} - \tilde\rho_0 = 0",
    )


@claim("(4.6)", "Cramer's rule for l10, l20, l30 and ρ~0", verdict="holds")
def cramers_rule() -> Evidence:
    numerators = {"l_{10}": T / 8, "l_{20}": -(T**2) / 16, "l_{30}": T**3 / 128, r"\tilde\rho_0": T**3 / 128}
    printed = {left: numerator / (F * T / 128) for left, numerator in numerators.items()}

    def derived() -> RightSides:
        found = chebyshev.minimal_multipliers()
        return [found[unknown] for unknown in (*multipliers, signed_norm)]

    return Equality(
        printed,
        derived,
        display=r"l_{10} = \frac{D_1}{D};\quad l_{20} = \frac{D_2}{D};\quad l_{30} = \frac{D_3}{D};\quad "
        r"\tilde{\rho}_0 = \frac{D_\rho}{D}",
    )


@claim("after (4.6): determinants", "the determinants D1, D2, D3 and Dρ", verdict="holds")
def cramer_numerators() -> Evidence:
    printed = {"D_1": T / 8, "D_2": -(T**2) / 16, "D_3": T**3 / 128, r"D_\rho": T**3 / 128}
    return Equality(printed, lambda: chebyshev.cramer(chebyshev.matching())[0])


@claim("after (4.6): D", "D = FT/128 with F = 16c1 − 8Tc2 + T²c3", verdict="holds")
def cramer_denominator() -> Evidence:
    return Equality(
        {"D": F * T / 128},
        lambda: chebyshev.cramer(chebyshev.matching())[1],
        display=r"D = \tfrac{1}{128} F T,\quad F = 16c_1 - 8Tc_2 + T^2c_3",
    )


@claim("after (4.6): solution", "l10 = 16/F, l20 = −8T/F, l30 = T²/F, ρ~0 = T²/F", verdict="holds")
def multipliers_of_the_polynomial() -> Evidence:
    printed = {"l_{10}": 16 / F, "l_{20}": -8 * T / F, "l_{30}": T**2 / F, r"\tilde\rho_0": T**2 / F}

    def derived() -> RightSides:
        # The multipliers are the value and the derivatives of T_2 at the end, scaled so that l'c = 1.
        polynomial = chebyshev.chebyshev_in_time()
        end = [polynomial.diff(tau, k).subs(tau, T) * (-1) ** k for k in range(3)]
        scale = (sp.Matrix([end[2], end[1], end[0]]).T * c)[0]
        return end[2] / scale, end[1] / scale, end[0] / scale, 1 / scale

    return Equality(
        printed,
        derived,
        display=r"l_{10} = \frac{16}{F};\quad l_{20} = -\frac{8T}{F};\quad l_{30} = \frac{T^2}{F};\quad "
        r"\tilde\rho_0 = \frac{T^2}{F}",
    )


@claim("after (4.6): h0", "h0(τ) = ρ~0 (8τ²/T² − 8τ/T + 1)", verdict="holds")
def chebyshev_element() -> Evidence:
    printed = T**2 / F * (8 * tau**2 / T**2 - 8 * tau / T + 1)
    return Equality(
        {r"h_0(\tau)": printed},
        element,
        display=r"h_0(\tau) = \tilde{\rho}_0\left(\frac{8\tau^2}{T^2} - \frac{8\tau}{T} + 1\right)",
    )


@claim(
    "after (4.6): ρ0",
    "its norm is ρ0 = T²/|F|, and sign s0 = sign F",
    verdict="holds",
    remark="This is the norm of this h0. That it is the least norm is the claim after (4.3).",
)
def norm_of_the_chebyshev_element() -> Evidence:
    def derived() -> RightSides:
        start = element().subs(tau, 0)
        return sp.cancel(start**2), sp.Abs(sp.factor(start))

    def argument() -> Steps:
        yield "h0(0)² − h0(τ)² = 16τ(T − τ)(T − 2τ)²/F² ≥ 0", vanishes(room() - ROOM)
        yield "h0(0) = T²/F has the sign of F", vanishes(element().subs(tau, 0) - T**2 / F)

    return Proof(
        argument,
        Equality({r"\rho_0^2": T**4 / F**2, r"\rho_0": T**2 / sp.Abs(F)}, derived),
        display=r"\rho_0 = \frac{T^2}{\left| F \right|}",
    )


@claim("after (4.6): extremes", "h0 takes its extreme values at 0, T/2 and T", verdict="holds")
def instants_of_the_extremes() -> Evidence:
    def derived() -> RightSides:
        inner = sp.solve(element().diff(tau), tau)[0]
        return sp.S.Zero, inner, T

    def argument() -> Steps:
        yield "it is monotone between them", sp.Poly(element().diff(tau), tau).degree() == 1

    return Proof(argument, Equality({r"\tau_1^*": sp.S.Zero, r"\tau_2^*": T / 2, r"\tau_3^*": T}, derived))


@claim("after (4.6): values", "h0 = s0ρ0 at the ends and −s0ρ0 in the middle", verdict="holds")
def values_at_the_extremes() -> Evidence:
    # s0 rho0 = rho~0 = T^2/F.
    return Equality(
        {r"h_0(0)": T**2 / F, r"h_0(T/2)": -(T**2) / F, r"h_0(T)": T**2 / F},
        lambda: [sp.cancel(element().subs(tau, at)) for at in (0, T / 2, T)],
        display=r"h_0(\tau_{1,3}^*) = s_0\rho_0,\quad h_0(\tau_2^*) = -s_0\rho_0",
    )
