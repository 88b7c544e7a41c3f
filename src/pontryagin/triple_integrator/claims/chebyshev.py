"""Section 4 up to the extremes of h0: Chebyshev's polynomial as the minimal element, (4.1) to (4.6)."""

from typing import Any

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    LinearSystem,
    Proof,
    Sides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.derivation import chebyshev
from pontryagin.triple_integrator.derivation.channel import t0, tau, tf
from pontryagin.triple_integrator.derivation.chebyshev import sign, signed_norm, z
from pontryagin.triple_integrator.derivation.duality import (
    conjugate_norm,
    dual_function_of,
    impulse_bound,
    levels,
    peak_of,
    piecewise_moments,
)
from pontryagin.triple_integrator.derivation.model import T, c, multipliers, transition

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
l1, l2, l3 = multipliers
F = 16 * c1 - 8 * T * c2 + T**2 * c3


@claim("before (4.1)", "norm of h in L_∞, the essential maximum of |h|", verdict="holds")
def norm_of_the_dual_function() -> Evidence:
    key = r"\lVert h(\cdot) \rVert_{L_\infty}"
    return Equality(
        {key: sp.Max(*map(sp.Abs, levels))},
        lambda: {key: conjugate_norm(sp.oo)},
        display=r"\lVert h(\cdot) \rVert_{L_\infty} = \operatorname{vrai\,max}_{\tau \in [t_0, t_f]} "
        r"\left| h(\tau) \right|",
    )


@claim.proof(
    "(4.1)",
    "the dual problem: least max |h| on l'c = 1",
    remark="The essential maximum is the maximum, for h is continuous.",
    display=r"\min_{h(\cdot) \in P} \lVert h(\cdot) \rVert_{L_\infty} = \min_{l_1c_1 + l_2c_2 + l_3c_3 "
    r"= 1} "
    r"\max_{\tau \in [t_0, t_f]} \left| h(\tau) \right| = \rho_0",
)
def dual_problem() -> Steps:
    a0, am, aT = sp.symbols("a_0 a_m a_T", positive=True)
    impulses = {chebyshev.impulses[0]: a0, chebyshev.impulses[1]: am, chebyshev.impulses[2]: aT}
    reached = chebyshev.impulse_transfer().subs(impulses).subs(sign, 1)
    moments = reached - transition(T) * sp.Matrix(sp.symbols("x_10 x_20 x_30", real=True))
    least = {
        key: sp.cancel(value.subs(dict(zip(c, moments, strict=True))))
        for key, value in chebyshev.minimal_multipliers().items()
    }
    yield (
        "for moments of impulses a0, −am, aT at 0, T/2, T the polynomial ρ0 T2 has ρ0 = 1/(a0 + am + aT)",
        vanishes(least[signed_norm] - 1 / (a0 + am + aT)),
    )
    condition = sum(least[l] * m for l, m in zip(multipliers, moments, strict=True))
    yield "and l'c = 1", vanishes(condition - 1)
    sample = sp.Matrix([R(1, 3), R(1, 7), R(2, 5)])
    bounds = [impulse_bound(l, sample, sp.S.One) for l in (sp.Matrix([16, -8, 1]), sp.Matrix([1, 0, 0]))]
    yield "no other h of a sample proves more than 1/ρ0", bounds[0] > bounds[1]


@claim("(4.2)", "the minimal element is a quadratic in tf − τ", verdict="holds")
def minimal_element() -> Evidence:
    key = r"h_0(\tau)"
    printed = l1 * (tf - tau) ** 2 / 2 + l2 * (tf - tau) + l3

    def derived() -> Sides:
        psi = transition(tf - tau).T * multipliers
        return {key: psi[2]}

    return Equality(
        {key: printed},
        derived,
        display=r"h_0(\tau) = \tfrac12 l_{10}(t_f - \tau)^2 + l_{20}(t_f - \tau) + l_{30}",
    )


@claim("(4.3)", "its multipliers satisfy l0'c = 1", verdict="holds")
def condition_on_the_multipliers() -> Evidence:
    def derived() -> Sides:
        least = chebyshev.minimal_multipliers()
        return {
            "c_1 l_{10} + c_2 l_{20} + c_3 l_{30}": sum(
                m * least[l] for m, l in zip(c, multipliers, strict=True)
            )
        }

    return Equality({"c_1 l_{10} + c_2 l_{20} + c_3 l_{30}": sp.S.One}, derived)


@claim(
    "after (4.3): Chebyshev",
    "for arbitrary ends the minimal element is ±ρ0 T2, the polynomial least deviating from zero",
    verdict="conditional",
    remark="True where a0, am, aT of (4.10) are all ≥ 0 for s0 = sign F (a cone of c), and nowhere else. For "
    "c = (1/6, 1/2, 1), T = 1, which u = 1 reaches, ±ρ0 T2 would have the norm 3, but h = 1 has the norm 1: "
    "the polynomial that deviates least depends on the side condition l'c = 1, which the classical problem "
    "lacks.",
)
def minimal_element_is_chebyshev() -> Evidence:
    def argument() -> Steps:
        amplitudes = chebyshev.amplitudes().values()
        total = sp.cancel(sum(amplitudes) / sign)
        yield "with a0, am, aT ≥ 0 the impulses cost a0 + am + aT = |F|/T²", vanishes(total - F / T**2)
        bound = 1 / chebyshev.minimal_multipliers()[signed_norm]
        yield "ρ0 T2 proves that less is not possible", vanishes(bound - F / T**2)
        polynomial = chebyshev.chebyshev()
        room = sp.factor(1 - polynomial**2)
        yield "|T2| ≤ 1 on [−1, 1]: 1 − T2² = 4z²(1 − z²)", vanishes(room - 4 * z**2 * (1 - z**2))

    def counterexample() -> Steps:
        moments = piecewise_moments([(R(1), 1)])
        yield "u = 1 has c = (1/6, 1/2, 1)", moments == sp.Matrix([R(1, 6), R(1, 2), 1])
        least = [
            chebyshev.minimal_multipliers()[l].subs({T: 1, **dict(zip(c, moments, strict=True))})
            for l in multipliers
        ]
        polynomial = sp.Matrix(least)
        yield (
            "±ρ0 T2 with l'c = 1 has the norm 3",
            ((polynomial.T * moments)[0] == 1 and peak_of(dual_function_of(polynomial), sp.S.One) == 3),
        )
        constant = sp.Matrix([0, 0, 1])
        yield (
            "h = 1, also with l'c = 1, has the norm 1",
            ((constant.T * moments)[0] == 1 and peak_of(dual_function_of(constant), sp.S.One) == 1),
        )

    return Conditional(argument, counterexample=counterexample)


@claim("after (4.3): T2", "Chebyshev's polynomial of the first kind, T2(z) = 2z² − 1", verdict="holds")
def chebyshev_polynomial() -> Evidence:
    return Equality({"T_2(z)": 2 * z**2 - 1}, lambda: {"T_2(z)": chebyshev.chebyshev()})


@claim("after (4.3): z", "the variable z in [−1, 1]", verdict="holds")
def unit_variable() -> Evidence:
    return Equality(
        {"z": (2 * tau - (tf + t0)) / (tf - t0)},
        lambda: {"z": chebyshev.unit_variable()},
        display=r"z = \frac{1}{t_f - t_0}[2\tau - (t_f + t_0)]",
    )


@claim("(4.4)", "h0 in powers of τ, with t0 = 0", verdict="holds")
def minimal_element_in_powers() -> Evidence:
    printed = l1 * tau**2 / 2 - (T * l1 + l2) * tau + l1 * T**2 / 2 + l2 * T + l3
    return Equality(
        {r"h_0(\tau)": printed},
        lambda: {r"h_0(\tau)": chebyshev.dual_in_time()},
        display=r"h_0(\tau) = \tfrac12 l_{10}\tau^2 - (Tl_{10} + l_{20})\tau + \tfrac12 l_{10}T^2 + l_{20}T "
        r"+ l_{30}",
    )


@claim(
    "(4.5)",
    "T2 in the variable τ",
    verdict="holds",
    remark="The scan reads τ as φ in the sentence before it.",
)
def chebyshev_in_time() -> Evidence:
    key = r"T_2(2\tau/T - 1)"
    printed = 8 * tau**2 / T**2 - 8 * tau / T + 1
    return Equality(
        {key: printed},
        lambda: {key: chebyshev.chebyshev_in_time()},
        display=r"T_2\left(\frac{2\tau}{T} - 1\right) = \frac{8\tau^2}{T^2} - \frac{8\tau}{T} + 1",
    )


@claim("before (4.6): system", "equal coefficients of h0 and ρ~0 T2, and (4.3)", verdict="holds")
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
    keys = ("l_{10}", "l_{20}", "l_{30}", r"\tilde\rho_0")
    numerators = (T / 8, -(T**2) / 16, T**3 / 128, T**3 / 128)
    printed = {key: numerator / (F * T / 128) for key, numerator in zip(keys, numerators, strict=True)}

    def derived() -> Sides:
        found = chebyshev.minimal_multipliers()
        return {key: found[unknown] for key, unknown in zip(keys, (*multipliers, signed_norm), strict=True)}

    return Equality(
        printed,
        derived,
        display=r"l_{10} = \frac{D_1}{D};\quad l_{20} = \frac{D_2}{D};\quad l_{30} = \frac{D_3}{D};\quad "
        r"\tilde{\rho}_0 = \frac{D_\rho}{D}",
    )


@claim("after (4.6): determinants", "D1, D2, D3, Dρ", verdict="holds")
def cramer_numerators() -> Evidence:
    printed = {"D_1": T / 8, "D_2": -(T**2) / 16, "D_3": T**3 / 128, r"D_\rho": T**3 / 128}
    return Equality(printed, lambda: chebyshev.cramer(chebyshev.matching())[0])


@claim("after (4.6): D", "D = FT/128 with F = 16c1 − 8Tc2 + T²c3", verdict="holds")
def cramer_denominator() -> Evidence:
    return Equality(
        {"D": F * T / 128},
        lambda: {"D": chebyshev.cramer(chebyshev.matching())[1]},
        display=r"D = \tfrac{1}{128} F T,\quad F = 16c_1 - 8Tc_2 + T^2c_3",
    )


@claim("after (4.6): solution", "l10 = 16/F, l20 = −8T/F, l30 = T²/F, ρ~0 = T²/F", verdict="holds")
def multipliers_of_the_polynomial() -> Evidence:
    printed = {"l_{10}": 16 / F, "l_{20}": -8 * T / F, "l_{30}": T**2 / F, r"\tilde\rho_0": T**2 / F}

    def derived() -> Sides:
        # The multipliers are the value and the derivatives of T_2 at the end, scaled so that l'c = 1.
        polynomial = chebyshev.chebyshev_in_time()
        end = [polynomial.diff(tau, k).subs(tau, T) * (-1) ** k for k in range(3)]
        scale = (sp.Matrix([end[2], end[1], end[0]]).T * c)[0]
        return dict(zip(printed, (end[2] / scale, end[1] / scale, end[0] / scale, 1 / scale), strict=True))

    return Equality(
        printed,
        derived,
        display=r"l_{10} = \frac{16}{F};\quad l_{20} = -\frac{8T}{F};\quad l_{30} = \frac{T^2}{F};\quad "
        r"\tilde\rho_0 = \frac{T^2}{F}",
    )


def element() -> sp.Expr:
    """The derived polynomial h0(tau) of the Chebyshev case."""
    return chebyshev.dual_in_time().subs(chebyshev.minimal_multipliers())


@claim("after (4.6): h0", "h0(τ) = ρ~0 (8τ²/T² − 8τ/T + 1)", verdict="holds")
def chebyshev_element() -> Evidence:
    printed = T**2 / F * (8 * tau**2 / T**2 - 8 * tau / T + 1)
    return Equality(
        {r"h_0(\tau)": printed},
        lambda: {r"h_0(\tau)": element()},
        display=r"h_0(\tau) = \tilde{\rho}_0\left(\frac{8\tau^2}{T^2} - \frac{8\tau}{T} + 1\right)",
    )


@claim(
    "after (4.6): ρ0",
    "its norm is ρ0 = T²/|F|, and sign s0 = sign F",
    verdict="holds",
    remark="The norm of this h0; that it is the least norm is another claim, above.",
)
def norm_of_the_chebyshev_element() -> Evidence:
    def derived() -> Sides:
        ends = [element().subs(tau, instant) for instant in (0, T / 2, T)]
        return {r"\rho_0^2": sp.cancel(ends[0] ** 2), r"\rho_0": sp.Abs(sp.factor(ends[0]))}

    def argument() -> Steps:
        below = sp.factor(element().subs(tau, 0) ** 2 - element() ** 2)
        shape = 16 * tau * (T - tau) * (T - 2 * tau) ** 2 / F**2
        yield "h0(0)² − h0(τ)² = 16τ(T − τ)(T − 2τ)²/F² ≥ 0", vanishes(below - shape)
        yield "h0(0) = T²/F has the sign of F", vanishes(element().subs(tau, 0) - T**2 / F)

    return Proof(
        argument,
        Equality({r"\rho_0^2": T**4 / F**2, r"\rho_0": T**2 / sp.Abs(F)}, derived),
        display=r"\rho_0 = \frac{T^2}{\left| F \right|}",
    )


@claim("after (4.6): extremes", "h0 is extreme at 0, T/2 and T", verdict="holds")
def instants_of_the_extremes() -> Evidence:
    keys = (r"\tau_1^*", r"\tau_2^*", r"\tau_3^*")

    def derived() -> Sides:
        inner = sp.solve(element().diff(tau), tau)[0]
        return dict(zip(keys, (sp.S.Zero, inner, T), strict=True))

    def argument() -> Steps:
        yield "it is monotone between them", sp.Poly(element().diff(tau), tau).degree() == 1

    return Proof(argument, Equality(dict(zip(keys, (sp.S.Zero, T / 2, T), strict=True)), derived))


@claim("after (4.6): values", "h0 = s0ρ0 at the ends and −s0ρ0 in the middle", verdict="holds")
def values_at_the_extremes() -> Evidence:
    keys = (r"h_0(0)", r"h_0(T/2)", r"h_0(T)")
    # s0 rho0 = rho~0 = T^2/F.
    printed = dict(zip(keys, (T**2 / F, -(T**2) / F, T**2 / F), strict=True))
    return Equality(
        printed,
        lambda: {
            key: sp.cancel(element().subs(tau, at)) for key, at in zip(keys, (0, T / 2, T), strict=True)
        },
        display=r"h_0(\tau_{1,3}^*) = s_0\rho_0,\quad h_0(\tau_2^*) = -s_0\rho_0",
    )
