"""Section 3, (3.5) to (3.7): a dual function given by its two zeros."""

import itertools
from typing import Any

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    LinearSystem,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.peak import (
    area_with_two_zeros,
    first,
    paired_with,
    second,
    two_switches,
    v,
)
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import t0, tau, tf
from pontryagin.triple_integrator.derivation.duality import peak_bound, piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c, multipliers
from pontryagin.triple_integrator.derivation.parabola import lower, t1, t2, upper

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
l1, l2, l3 = multipliers


@claim(
    "before (3.5): zeros",
    "the minimising function (3.3) changes sign, with zeros t1, t2 in [t0, tf]",
    verdict="conditional",
    remark="True unless the optimum is a constant control; where it has one switch only, one zero lies at an "
    "end. For c = (1/6, 1/2, 1), T = 1 the optimum is u = 1, and no h that changes sign is minimal.",
)
def zeros_in_the_interval() -> Evidence:
    def argument() -> Steps:
        moments = two_switches(v, first, second, T)
        yield (
            "the control with switches at a < b has h = (τ − a)(τ − b) as its minimising function",
            vanishes(paired_with(moments) - v * area_with_two_zeros()),
        )
        one = two_switches(v, sp.S.Zero, second, T)
        norm = area_with_two_zeros().subs(first, 0)
        yield "with one switch b, h = τ(τ − b)", vanishes(paired_with(one).subs(first, 0) - v * norm)

    def counterexample() -> Steps:
        moments = piecewise_moments([(R(1), 1)])
        yield "u = 1 has c = (1/6, 1/2, 1)", moments == sp.Matrix([R(1, 6), R(1, 2), 1])
        yield (
            "h = 1 shows that no smaller peak does",
            peak_bound(sp.Matrix([0, 0, 1]), moments, sp.S.One) == 1,
        )
        x, y = sp.symbols("P N", positive=True)
        yield "an h of both signs has ∫|h| > ∫h = l'c", (x + y - (x - y)).is_positive

    return Conditional(
        argument, counterexample=counterexample, display=r"\psi_3^*(t_1) = 0,\quad \psi_3^*(t_2) = 0"
    )


@claim("before (3.5): system", "two equations for the zeros, and l'c = 1", verdict="holds")
def system_for_the_multipliers() -> Evidence:
    printed = [
        (tf - t1) ** 2 / 2 * l1 + (tf - t1) * l2 + l3,
        (tf - t2) ** 2 / 2 * l1 + (tf - t2) * l2 + l3,
        c1 * l1 + c2 * l2 + c3 * l3 - 1,
    ]

    def derived() -> list[Any]:
        # A quadratic with these zeros is a multiple of (tau - t1)(tau - t2).
        height = sp.Symbol("k")
        matching = sp.Poly(
            sp.expand(parabola.parabola() - height * (tau - t1) * (tau - t2)), tau
        ).all_coeffs()
        found = sp.solve(matching, [height, l2, l3], dict=True)[0]
        return [l2 - found[l2], l3 - found[l3], (multipliers.T * c)[0] - 1]

    return LinearSystem(
        printed,
        derived,
        list(multipliers),
        display=r"\tfrac12 (t_f - t_k)^2 l_{10} + (t_f - t_k) l_{20} + l_{30} = 0,\ k = 1, 2;\quad "
        r"c_1 l_{10} + c_2 l_{20} + c_3 l_{30} = 1",
    )


def denominator() -> sp.Expr:
    """c0 as printed after (3.5)."""
    return c1 - c2 * (tf - (t1 + t2) / 2) + c3 / 2 * (tf - t1) * (tf - t2)


@claim("(3.5)", "multipliers from the zeros", verdict="holds")
def multipliers_from_the_zeros() -> Evidence:
    c0 = denominator()
    printed = {
        "l_{10}": 1 / c0,
        "l_{20}": -(tf - (t1 + t2) / 2) / c0,
        "l_{30}": (tf - t1) * (tf - t2) / (2 * c0),
    }
    return Equality(
        printed,
        parabola.multipliers_from_zeros,
        display=r"l_{10} = \frac{1}{c_0};\quad l_{20} = -\frac{1}{c_0}\left(t_f - \frac{t_1 + t_2}{2}\right);"
        r"\quad l_{30} = \frac{(t_f - t_1)(t_f - t_2)}{2c_0}",
    )


@claim("after (3.5): c0", "the denominator c0", verdict="holds")
def denominator_of_the_multipliers() -> Evidence:
    return Equality(
        {"c_0": denominator()},
        lambda: 1 / parabola.multipliers_from_zeros()[0],
        display=r"c_0 = c_1 - c_2\left(t_f - \frac{t_1 + t_2}{2}\right) + \frac12 c_3 (t_f - t_1)(t_f - t_2)",
    )


def between(early: sp.Expr, late: sp.Expr, lo: sp.Expr, hi: sp.Expr) -> sp.Expr:
    """Integral over [lo, hi] of h = (tau - early)(tau - late)."""
    return sp.integrate(sp.expand((tau - early) * (tau - late)), (tau, lo, hi))


def signed(early: sp.Expr, late: sp.Expr) -> sp.Expr:
    """S1 - S2 + S3 of h = (tau - early)(tau - late) on [0, T]."""
    first_area, second_area, third_area = (
        between(early, late, *ends) for ends in ((0, early), (early, late), (late, T))
    )
    return sp.expand(first_area - second_area + third_area)


@claim.proof(
    "before (3.6): unconstrained",
    "without the constraints t0 ≤ t1 and t2 ≤ tf the minimum of (3.6) is the same, so that the "
    "problem is unconstrained",
    remark="The paper assumes that the two bounds are not active. They may be; the claim holds all the same, "
    "for a zero outside only adds to S1 − S2 + S3. The order t1 < t2 must be kept.",
)
def bounds_may_be_dropped() -> Steps:
    outside, other = sp.symbols("x y", positive=True)

    early, late = -outside, second
    inside = between(early, late, late, T) - between(early, late, 0, late)
    extra = signed(early, late) - inside
    beyond = -2 * between(early, late, early, 0)
    yield "t1 before t0: S1 − S2 + S3 = ∫|h| + 2∫|h| over [t1, t0]", vanishes(extra - beyond)
    early, late = -outside - other, -outside
    extra = signed(early, late) - between(early, late, 0, T)
    yield (
        "both before t0: ∫|h| + 2∫|h| over [t1, t2]",
        vanishes(extra + 2 * between(early, late, early, late)),
    )
    yield "that integral is positive", sp.expand(extra).is_positive
    early, late = first, T + outside
    inside = between(early, late, 0, early) - between(early, late, early, T)
    extra = signed(early, late) - inside
    yield (
        "t2 after tf: S1 − S2 + S3 = ∫|h| + 2∫|h| over [tf, t2]",
        vanishes(extra + 2 * between(early, late, T, late)),
    )
    early, late = -outside, T + other
    extra = signed(early, late) + between(early, late, 0, T)
    ends = -2 * between(early, late, early, 0) - 2 * between(early, late, T, late)
    yield "t1 before t0 and t2 after tf: both excesses", vanishes(extra - ends)


@claim.proof(
    "(3.6)",
    "ρ0 is the least |S1 − S2 + S3| over t0 ≤ t1 < t2 ≤ tf",
    remark="Where the optimum has fewer than two switches the minimum lies on the boundary: at t1 = t0 or "
    "t2 = tf for one switch, at both for a constant control.",
    display=r"\rho_0 = \min_{t_0 \le t_1 < t_2 \le t_f} \left| S_1 - S_2 + S_3 \right|",
)
def least_signed_area() -> Steps:
    total = signed(first, second)
    yield "|S1 − S2 + S3| is ∫|h| where the zeros are inside", vanishes(total - area_with_two_zeros())
    moments = two_switches(v, first, second, T)
    yield (
        "at the switches of the optimum it is 1/v, its least value",
        vanishes(total * v - paired_with(moments)),
    )
    constant = paired_with(two_switches(-v, sp.S.Zero, T, T)).subs({first: 0, second: T})
    norm = area_with_two_zeros().subs({first: 0, second: T})
    yield (
        "a constant control is −v between t1 = t0 and t2 = tf: attained there",
        vanishes(constant + norm * v),
    )


@claim("after (3.6): limits", "the three pieces are [t0, t1], [t1, t2], [t2, tf]", verdict="holds")
def limits_of_the_pieces() -> Evidence:
    def derived() -> RightSides:
        cuts = (t0, *sorted((t1, t2), key=str), tf)
        return [b - a for a, b in itertools.pairwise(cuts)]

    return Equality(
        {"b_1 - a_1": t1 - t0, "b_2 - a_2": t2 - t1, "b_3 - a_3": tf - t2},
        derived,
        display=r"S_k = \int_{a_k}^{b_k} \psi_3^*(\tau)\,d\tau,\quad (a_1, b_1) = (t_0, t_1),\; (a_2, b_2) "
        r"= (t_1, t_2),\; "
        r"(a_3, b_3) = (t_2, t_f)",
    )


@claim("(3.7)", "S_k in terms of its limits and the multipliers", verdict="holds")
def piece_of_the_integral() -> Evidence:
    a, b = lower, upper
    printed = (b - a) * (
        (l1 * tf**2 / 2 + l2 * tf + l3) - (l1 * tf + l2) * (b + a) / 2 + l1 * (b**2 + b * a + a**2) / 6
    )
    return Equality(
        {"S_k": printed},
        parabola.piece,
        display=r"S_k = (b_k - a_k)\left[\left(\tfrac12 l_{10} t_f^2 + l_{20} t_f + l_{30}\right) - "
        r"\tfrac12 (l_{10} t_f + l_{20})(b_k + a_k) + \tfrac16 l_{10}(b_k^2 + b_k a_k + a_k^2)\right]",
    )
