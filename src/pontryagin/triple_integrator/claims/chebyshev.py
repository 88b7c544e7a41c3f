"""Section 4, (4.1) to (4.5): the dual problem, and Chebyshev's polynomial as the minimal element."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.turn import in_unit_time
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
    return Equality(
        {r"\lVert h(\cdot) \rVert_{L_\infty}": sp.Max(*map(sp.Abs, levels))},
        lambda: conjugate_norm(sp.oo),
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
    printed = l1 * (tf - tau) ** 2 / 2 + l2 * (tf - tau) + l3
    return Equality(
        {r"h_0(\tau)": printed},
        lambda: (transition(tf - tau).T * multipliers)[2],
        display=r"h_0(\tau) = \tfrac12 l_{10}(t_f - \tau)^2 + l_{20}(t_f - \tau) + l_{30}",
    )


@claim("(4.3)", "its multipliers satisfy l0'c = 1", verdict="holds")
def condition_on_the_multipliers() -> Evidence:
    def derived() -> RightSides:
        least = chebyshev.minimal_multipliers()
        return sum(m * least[l] for m, l in zip(c, multipliers, strict=True))

    return Equality({"c_1 l_{10} + c_2 l_{20} + c_3 l_{30}": sp.S.One}, derived)


@claim(
    "after (4.3): Chebyshev",
    "for arbitrary ends the minimal element is ±ρ0 T2, the polynomial that deviates least from zero",
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
        least = chebyshev.minimal_multipliers()
        polynomial = sp.Matrix([least[l].subs(in_unit_time(moments)) for l in multipliers])
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
    return Equality({"T_2(z)": 2 * z**2 - 1}, chebyshev.chebyshev)


@claim("after (4.3): z", "the variable z in [−1, 1]", verdict="holds")
def unit_variable() -> Evidence:
    return Equality(
        {"z": (2 * tau - (tf + t0)) / (tf - t0)},
        chebyshev.unit_variable,
        display=r"z = \frac{1}{t_f - t_0}[2\tau - (t_f + t_0)]",
    )


@claim("(4.4)", "h0 in powers of τ, with t0 = 0", verdict="holds")
def minimal_element_in_powers() -> Evidence:
    printed = l1 * tau**2 / 2 - (T * l1 + l2) * tau + l1 * T**2 / 2 + l2 * T + l3
    return Equality(
        {r"h_0(\tau)": printed},
        chebyshev.dual_in_time,
        display=r"h_0(\tau) = \tfrac12 l_{10}\tau^2 - (Tl_{10} + l_{20})\tau + \tfrac12 l_{10}T^2 + l_{20}T "
        r"+ l_{30}",
    )


@claim(
    "(4.5)",
    "T2 in the variable τ",
    verdict="holds",
    remark="In the sentence before it the scan shows φ in place of τ.",
)
def chebyshev_in_time() -> Evidence:
    printed = 8 * tau**2 / T**2 - 8 * tau / T + 1
    return Equality(
        {r"T_2(2\tau/T - 1)": printed},
        chebyshev.chebyshev_in_time,
        display=r"T_2\left(\frac{2\tau}{T} - 1\right) = \frac{8\tau^2}{T^2} - \frac{8\tau}{T} + 1",
    )
