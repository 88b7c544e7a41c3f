"""Section 3 from (3.5) to (3.14): the parabola with two zeros, and the areas it cuts off."""

import sympy as sp

from pontryagin.evidence import (
    Conditional,
    Consequence,
    Equality,
    LinearSystem,
    Misprint,
    Proof,
    Steps,
    vanishes,
)
from pontryagin.ledger import Page
from pontryagin.triple_integrator.claims.peak import area_with_two_zeros, first, paired_with, second, two_switches, v
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import drive, final, initial, required_moments, t0, tau, tf
from pontryagin.triple_integrator.derivation.duality import peak_bound, piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c, multipliers
from pontryagin.triple_integrator.derivation.parabola import (
    alpha,
    apex,
    beta,
    half_width,
    lower,
    price,
    t1,
    t2,
    upper,
)

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
l1, l2, l3 = multipliers
conjugate = T - apex
"""The paper's conjugate parameter, written tau_m with a tilde."""


@claim(
    "before (3.5): zeros",
    "the minimising function (3.3) changes sign, with zeros t1, t2 in [t0, tf]",
    verdict="conditional",
    remark="True unless the optimum is a constant control; where it has one switch only, one zero lies at an "
    "end. For c = (1/6, 1/2, 1), T = 1 the optimum is u = 1, and no h that changes sign is minimal.",
)
def zeros_in_the_interval():
    def argument() -> Steps:
        moments = two_switches(v, first, second, T)
        yield "the control with switches at a < b has h = (τ − a)(τ − b) as its minimising function", vanishes(
            paired_with(moments) - v * area_with_two_zeros()
        )
        one = two_switches(v, sp.S.Zero, second, T)
        norm = area_with_two_zeros().subs(first, 0)
        yield "with one switch b, h = τ(τ − b)", vanishes(paired_with(one).subs(first, 0) - v * norm)

    def counterexample() -> Steps:
        moments = piecewise_moments([(R(1), 1)])
        yield "u = 1 has c = (1/6, 1/2, 1)", moments == sp.Matrix([R(1, 6), R(1, 2), 1])
        yield "h = 1 shows that no smaller peak does", peak_bound(sp.Matrix([0, 0, 1]), moments, sp.S.One) == 1
        x, y = sp.symbols("P N", positive=True)
        yield "an h of both signs has ∫|h| > ∫h = l'c", (x + y - (x - y)).is_positive

    return Conditional(argument, counterexample=counterexample,
        display=r"\psi_3^*(t_1) = 0,\quad \psi_3^*(t_2) = 0")


@claim("before (3.5): system", "two equations for the zeros, and l'c = 1", verdict="holds")
def system_for_the_multipliers():
    printed = [
        (tf - t1) ** 2 / 2 * l1 + (tf - t1) * l2 + l3,
        (tf - t2) ** 2 / 2 * l1 + (tf - t2) * l2 + l3,
        c1 * l1 + c2 * l2 + c3 * l3 - 1,
    ]

    def derived():
        # A quadratic with these zeros is a multiple of (tau - t1)(tau - t2).
        height = sp.Symbol("k")
        matching = sp.Poly(
            sp.expand(parabola.parabola() - height * (tau - t1) * (tau - t2)), tau
        ).all_coeffs()
        found = sp.solve(matching, [height, l2, l3], dict=True)[0]
        return [l2 - found[l2], l3 - found[l3], (multipliers.T * c)[0] - 1]

    return LinearSystem(printed, derived, list(multipliers))


def denominator() -> sp.Expr:
    """c0 as printed after (3.5)."""
    return c1 - c2 * (tf - (t1 + t2) / 2) + c3 / 2 * (tf - t1) * (tf - t2)


@claim("(3.5)", "multipliers from the zeros", verdict="holds")
def multipliers_from_the_zeros():
    c0 = denominator()
    printed = {
        "l_{10}": 1 / c0,
        "l_{20}": -(tf - (t1 + t2) / 2) / c0,
        "l_{30}": (tf - t1) * (tf - t2) / (2 * c0),
    }
    return Equality(printed, lambda: dict(zip(printed, parabola.multipliers_from_zeros(), strict=True)),
        display=r"l_{10} = \frac{1}{c_0};\quad l_{20} = -\frac{1}{c_0}\left(t_f - \frac{t_1 + t_2}{2}\right);"
        r"\quad l_{30} = \frac{(t_f - t_1)(t_f - t_2)}{2c_0}")


@claim("after (3.5): c0", "the denominator c0", verdict="holds")
def denominator_of_the_multipliers():
    return Equality({"c_0": denominator()}, lambda: {"c_0": 1 / parabola.multipliers_from_zeros()[0]})


@claim(
    "before (3.6): unconstrained",
    "dropping t0 ≤ t1 and t2 ≤ tf leaves the minimum of (3.6) as it is: an unconstrained problem",
    verdict="holds",
    remark="The paper assumes that the two bounds are not active. They may be; the claim holds all the same, "
    "for a zero outside only adds to S1 − S2 + S3. The order t1 < t2 must be kept.",
)
def bounds_may_be_dropped():
    def argument() -> Steps:
        outside, other = sp.symbols("x y", positive=True)

        def signed(early: sp.Expr, late: sp.Expr) -> sp.Expr:
            h = sp.expand((tau - early) * (tau - late))
            parts = [sp.integrate(h, (tau, *ends)) for ends in ((0, early), (early, late), (late, T))]
            return sp.expand(parts[0] - parts[1] + parts[2])

        def between(early: sp.Expr, late: sp.Expr, lo: sp.Expr, hi: sp.Expr) -> sp.Expr:
            return sp.integrate(sp.expand((tau - early) * (tau - late)), (tau, lo, hi))

        early, late = -outside, second
        inside = between(early, late, late, T) - between(early, late, 0, late)
        extra = signed(early, late) - inside
        beyond = -2 * between(early, late, early, 0)
        yield "t1 before t0: S1 − S2 + S3 = ∫|h| + 2∫|h| over [t1, t0]", vanishes(extra - beyond)
        early, late = -outside - other, -outside
        extra = signed(early, late) - between(early, late, 0, T)
        yield "both before t0: ∫|h| + 2∫|h| over [t1, t2]", vanishes(extra + 2 * between(early, late, early, late))
        yield "and that is positive", sp.expand(extra).is_positive
        early, late = first, T + outside
        inside = between(early, late, 0, early) - between(early, late, early, T)
        extra = signed(early, late) - inside
        yield "t2 after tf: likewise", vanishes(extra + 2 * between(early, late, T, late))
        early, late = -outside, T + other
        extra = signed(early, late) + between(early, late, 0, T)
        ends = -2 * between(early, late, early, 0) - 2 * between(early, late, T, late)
        yield "t1 before t0 and t2 after tf: both excesses", vanishes(extra - ends)

    return Proof(argument)


@claim("(3.6)", "ρ0 is the least |S1 − S2 + S3| over t0 ≤ t1 < t2 ≤ tf", verdict="holds",
       remark="Where the optimum has fewer than two switches the minimum lies on the boundary: at t1 = t0 or "
       "t2 = tf for one switch, at both for a constant control.")
def least_signed_area():
    def argument() -> Steps:
        h = (tau - first) * (tau - second)
        signed = [sp.integrate(h, (tau, *ends)) for ends in ((0, first), (first, second), (second, T))]
        total = sp.expand(signed[0] - signed[1] + signed[2])
        yield "|S1 − S2 + S3| is ∫|h| where the zeros are inside", vanishes(total - area_with_two_zeros())
        moments = two_switches(v, first, second, T)
        yield "at the switches of the optimum it is 1/v, its least value", vanishes(
            total * v - paired_with(moments)
        )
        constant = paired_with(two_switches(-v, sp.S.Zero, T, T)).subs({first: 0, second: T})
        norm = area_with_two_zeros().subs({first: 0, second: T})
        yield "a constant control is −v between t1 = t0 and t2 = tf: attained there", vanishes(constant + norm * v)

    return Proof(argument,
        display=r"\rho_0 = \min_{t_0 \le t_1 < t_2 \le t_f} \left| S_1 - S_2 + S_3 \right|")


@claim("after (3.6): limits", "the three pieces are [t0, t1], [t1, t2], [t2, tf]", verdict="holds")
def limits_of_the_pieces():
    keys = (r"b_1 - a_1", r"b_2 - a_2", r"b_3 - a_3")
    printed = dict(zip(keys, (t1 - t0, t2 - t1, tf - t2), strict=True))

    def derived():
        cuts = (t0, *sorted((t1, t2), key=str), tf)
        return dict(zip(keys, (b - a for a, b in zip(cuts, cuts[1:], strict=False)), strict=True))

    return Equality(printed, derived, display=r"(a_1, b_1) = (t_0, t_1),\; (a_2, b_2) = (t_1, t_2),\; "
        r"(a_3, b_3) = (t_2, t_f)")


@claim("(3.7)", "S_k in terms of its limits and the multipliers", verdict="holds")
def piece_of_the_integral():
    a, b = lower, upper
    printed = (b - a) * (
        (l1 * tf**2 / 2 + l2 * tf + l3) - (l1 * tf + l2) * (b + a) / 2 + l1 * (b**2 + b * a + a**2) / 6
    )
    return Equality({"S_k": printed}, lambda: {"S_k": parabola.piece()})


@claim("(3.8)", "vertex form of the parabola", verdict="holds")
def vertex_form():
    printed = alpha * (tau - apex) ** 2 - beta

    def derived():
        inverse = dict(zip(multipliers, parabola.multipliers_from_vertex(), strict=True))
        return {r"\psi_3^*(\tau)": parabola.parabola().subs(tf, T).subs(inverse)}

    return Equality({r"\psi_3^*(\tau)": printed}, derived)


@claim("after (3.8): vertex", "τ_m = tf + l20/l10 = (t1 + t2)/2", verdict="holds")
def apex_of_the_parabola():
    key, other = r"\tau_m", r"t_f + l_{20}/l_{10}"

    def derived():
        ratio = parabola.multipliers_from_zeros()
        return {key: parabola.vertex()[apex], other: sp.cancel(tf + ratio[1] / ratio[0])}

    return Equality({key: tf + l2 / l1, other: (t1 + t2) / 2}, derived,
        display=r"\tau_m = t_f + \frac{l_{20}}{l_{10}} = \frac{t_1 + t_2}{2}")


@claim("after (3.8): β_m", "β_m = −ψ3*(τ_m)", verdict="holds")
def depth_of_the_parabola():
    printed = -parabola.parabola().subs(tau, tf + l2 / l1)
    return Equality({r"\beta_m": printed}, lambda: {r"\beta_m": parabola.vertex()[beta]},
        display=r"\beta_m = -\psi_3^*(\tau_m)")


@claim(
    "after (3.8): sign",
    "the parabola is assumed convex, α_m > 0 and β_m > 0; otherwise both are negative",
    verdict="conditional",
    remark="α_m and β_m do have one sign, and c → −c changes it; but for a given c the sign is not free. For "
    "c = (−γ, 0, 0) condition (3.13) reads −2γα_m = 1: no α_m > 0. One has to solve for c and −c, or minimise "
    "|F| instead of F in (3.14).",
)
def convex_parabola():
    def argument() -> Steps:
        width = sp.Symbol("Delta", positive=True)
        depth = sp.solve(parabola.vertex_form().subs(tau, apex + width), beta)[0]
        yield "with two zeros β_m = α_m Δ_m², of the sign of α_m", vanishes(depth - alpha * width**2)
        flipped = dict(zip(c, -c, strict=True))
        turned = parabola.normalisation().subs(flipped) - parabola.normalisation().subs(
            {alpha: -alpha, beta: -beta}
        )
        yield "c → −c turns α_m into −α_m", vanishes(turned)
        yield "and F into −F", vanishes(parabola.signed_area() + parabola.signed_area().subs(alpha, -alpha))

    def counterexample() -> Steps:
        minus = {c1: -1, c2: 0, c3: 0}
        condition = parabola.normalisation().subs(minus)
        yield "c = (−1, 0, 0), T = 1: (3.11) is −2α_m = 1", vanishes(condition + 2 * alpha)
        turned = piecewise_moments([(R(1, 4), -32), (R(1, 2), 32), (R(1, 4), -32)])
        yield "the problem has a solution, of peak 32", turned == sp.Matrix([-1, 0, 0])
        area = parabola.signed_area().subs({alpha: -R(1, 2), T: 1})
        best = area.subs({apex: R(1, 2), half_width: R(1, 4)})
        lower_still = area.subs({apex: R(1, 2), half_width: R(1, 8)})
        yield "with α_m = −1/2 its F is −1/32", best == -R(1, 32)
        yield "and is not the least F, but the least |F|", lower_still < best

    return Conditional(argument, counterexample=counterexample)


@claim("after (3.8): t1, t2", "the zeros are τ_m ∓ √(β_m/α_m) = τ_m ∓ Δ_m", verdict="holds")
def zeros_of_the_parabola():
    root = sp.sqrt(beta / alpha)
    return Equality({"t_1": apex - root, "t_2": apex + root},
        lambda: dict(zip(("t_1", "t_2"), parabola.zeros(), strict=True)))


@claim("after (3.8): t0 = 0", "without loss of generality t0 = 0, tf = T", verdict="holds")
def time_from_zero():
    def argument() -> Steps:
        shift, force = sp.symbols("t_s f_0", real=True)
        h = parabola.parabola()
        yield "h depends on tf − τ only", vanishes(h - h.subs({tau: tau + shift, tf: tf + shift}, simultaneous=True))
        ramp = force * (tau + t0)
        moved = drive(initial, T, sp.S.Zero, ramp)
        needed = final - moved
        yield "a disturbance f(t) is to be read as f(t0 + t): then c is the same", vanishes(
            required_moments(force * tau).subs(t0, 0) - needed.subs(t0, 0)
        ) and needed.has(t0)

    return Proof(argument)


@claim("(3.9)", "vertex form from the multipliers (t0 = 0)", verdict="holds")
def vertex_from_multipliers():
    keys = (r"\alpha_m", r"2\alpha_m\tau_m", r"\alpha_m\tau_m^2 - \beta_m")
    printed = dict(zip(keys, (l1 / 2, l1 * T + l2, l1 * T**2 / 2 + l2 * T + l3), strict=True))

    def derived():
        found = {symbol: value.subs(tf, T) for symbol, value in parabola.vertex().items()}
        sides = (alpha, 2 * alpha * apex, alpha * apex**2 - beta)
        return dict(zip(keys, (side.subs(found) for side in sides), strict=True))

    return Equality(printed, derived)


@claim("(3.10)", "multipliers from the vertex form", verdict="holds")
def multipliers_from_the_vertex():
    printed = {
        "l_{10}": 2 * alpha,
        "l_{20}": 2 * alpha * (apex - T),
        "l_{30}": alpha * (apex - T) ** 2 - beta,
    }
    return Equality(printed, lambda: dict(zip(printed, parabola.multipliers_from_vertex(), strict=True)))


@claim("(3.11)", "the condition l'c = 1 in the vertex form", verdict="holds")
def condition_on_the_vertex():
    printed = 2 * alpha * c1 + 2 * alpha * (apex - T) * c2 + (alpha * (apex - T) ** 2 - beta) * c3
    return Equality({"1": printed}, lambda: {"1": parabola.normalisation()})


@claim("before (3.12): S_k", "S_k in terms of α_m, τ_m and Δ_m", verdict="holds")
def piece_in_the_vertex_form():
    a, b = lower, upper
    printed = alpha * (b - a) * (
        apex**2 - half_width**2 - apex * (b + a) + (b**2 + b * a + a**2) / 3
    )
    return Equality({"S_k": printed}, lambda: {"S_k": parabola.area(a, b)})


@claim(
    "before (3.12): limits",
    "limits of the third integral",
    verdict="misprint",
    remark="Printed: b3 = T and a2 = τ_m + Δ_m. Right: a3 = τ_m + Δ_m; the line before has a2 = τ_m − Δ_m, and "
    "(3.12) uses a3.",
)
def limits_of_the_third_piece():
    def consequence() -> Consequence:
        numbers = {alpha: R(1, 2), apex: R(1, 2), half_width: R(1, 4), T: 1}
        wrong = parabola.area(apex + half_width, apex + half_width).subs(numbers)
        return Consequence("S2 of example 2 (γ = T = 1) from a2 to b2 = τ_m + Δ_m", wrong, -R(1, 96))

    return Misprint(
        {"a_2": apex + half_width},
        lambda: {"a_2": sp.solve(parabola.vertex_form().subs(beta, alpha * half_width**2), tau)[0]},
        defect={"a_2": 2 * half_width},
        consequence=consequence,
    )


@claim("(3.12)", "S1, S2 and S3", verdict="holds")
def three_areas():
    printed = {
        "S_1": alpha / 3 * (apex - half_width) ** 2 * (apex + 2 * half_width),
        "S_2": -R(4, 3) * alpha * half_width**3,
        "S_3": alpha
        / 3
        * (T - apex - half_width)
        * (half_width * (T - apex - 2 * half_width) + (T - apex) ** 2),
    }
    return Equality(printed, lambda: dict(zip(printed, parabola.areas(), strict=True)))


@claim("after (3.12): S3", "S3 in the conjugate parameter T − τ_m", verdict="holds")
def third_area_conjugate():
    printed = alpha / 3 * (conjugate**3 - 3 * conjugate * half_width**2 + 2 * half_width**3)
    return Equality({"S_3": printed}, lambda: {"S_3": parabola.areas()[2]})


@claim("after (3.12): S1", "S1 has the same form with τ_m for T − τ_m", verdict="holds")
def first_area_conjugate():
    printed = alpha / 3 * (apex**3 - 3 * apex * half_width**2 + 2 * half_width**3)

    def derived():
        # The parabola is symmetric about its apex: S1 is S3 with time reversed.
        return {"S_1": parabola.areas()[2].subs(apex, T - apex)}

    return Equality({"S_1": printed}, derived)


@claim("(3.13)", "the condition l'c = 1 in α_m, τ_m and Δ_m", verdict="holds")
def condition_on_the_zeros():
    printed = alpha * (2 * c1 - 2 * conjugate * c2 + (conjugate**2 - half_width**2) * c3)
    return Equality({"1": printed}, lambda: {"1": parabola.normalisation().subs(beta, alpha * half_width**2)})


@claim("(3.14)", "auxiliary function F + λ(…): (3.13) divided by α_m as the condition", verdict="holds")
def auxiliary_function():
    first_area = alpha / 3 * (apex - half_width) ** 2 * (apex + 2 * half_width)
    third_area = alpha / 3 * (conjugate**3 - 3 * conjugate * half_width**2 + 2 * half_width**3)
    condition = 2 * c1 - 2 * conjugate * c2 + (conjugate**2 - half_width**2) * c3 - 1 / alpha
    printed = first_area + R(4, 3) * alpha * half_width**3 + third_area + price * condition
    return Equality({r"\tilde F": printed}, lambda: {r"\tilde F": parabola.lagrangian()})
