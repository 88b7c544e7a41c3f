"""Section 3, (3.15) to (3.19): stationarity and the one-dimensional search."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    RightSides,
    Sides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.areas import conjugate
from pontryagin.triple_integrator.claims.peak import two_switches
from pontryagin.triple_integrator.claims.turn import BANG_BANG, EXAMPLE_1, in_unit_time
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.duality import piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c
from pontryagin.triple_integrator.derivation.parabola import alpha, apex, half_width, level, price, slope

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c


def cubic() -> sp.Expr:
    """The bracket of (3.16)."""
    return T**3 / 3 - T * (T - apex) * apex - T * half_width**2 + R(8, 3) * half_width**3


@claim("after (3.14): ∂/∂τ_m", "derivative with respect to τ_m", verdict="holds")
def derivative_by_apex() -> Evidence:
    printed = alpha * (apex**2 - conjugate**2) + 2 * price * (c2 - conjugate * c3)
    return Equality(
        {r"\partial\tilde F/\partial\tau_m": printed},
        lambda: parabola.gradient()[apex],
        display=r"\frac{\partial\tilde F}{\partial\tau_m} = \alpha_m(\tau_m^2 - \tilde{\tau}_m^2) + "
        r"2\lambda(c_2 - \tilde{\tau}_m c_3)",
    )


@claim("after (3.14): ∂/∂α_m", "derivative with respect to α_m", verdict="holds")
def derivative_by_curvature() -> Evidence:
    printed = (apex**3 + conjugate**3) / 3 - T * half_width**2 + R(8, 3) * half_width**3 + price / alpha**2
    return Equality(
        {r"\partial\tilde F/\partial\alpha_m": printed},
        lambda: parabola.gradient()[alpha],
        display=r"\frac{\partial\tilde F}{\partial\alpha_m} = \tfrac13(\tau_m^3 + \tilde{\tau}_m^3) - "
        r"T\Delta_m^2 + \tfrac83\Delta_m^3 + "
        r"\frac{\lambda}{\alpha_m^2} = 0",
    )


@claim("after (3.14): ∂/∂Δ_m", "derivative with respect to Δ_m", verdict="holds")
def derivative_by_width() -> Evidence:
    printed = 2 * half_width * (4 * alpha * half_width - alpha * T - price * c3)
    return Equality(
        {r"\partial\tilde F/\partial\Delta_m": printed},
        lambda: parabola.gradient()[half_width],
        display=r"\frac{\partial\tilde F}{\partial\Delta_m} = 2\Delta_m(4\alpha_m\Delta_m - \alpha_m T - "
        r"\lambda c_3) = 0",
    )


@claim("before (3.15)", "the three conditions with τ_m + (T − τ_m) = T", verdict="holds")
def transformed_conditions() -> Evidence:
    printed = {
        r"\partial\tilde F/\partial\tau_m": alpha * T * (2 * apex - T) + 2 * price * (c2 - (T - apex) * c3),
        r"\partial\tilde F/\partial\alpha_m": cubic() + price / alpha**2,
        r"(2\Delta_m)^{-1}\,\partial\tilde F/\partial\Delta_m": 4 * alpha * half_width
        - alpha * T
        - price * c3,
    }

    def derived() -> RightSides:
        by_apex, by_curvature, by_width = parabola.gradient().values()
        return by_apex, by_curvature, by_width / (2 * half_width)

    return Equality(
        printed,
        derived,
        display=r"\alpha_m T(2\tau_m - T) + 2\lambda[c_2 - (T - \tau_m)c_3] = 0;\quad \tfrac13 T^3 - T(T - "
        r"\tau_m)\tau_m - "
        r"T\Delta_m^2 + \tfrac83\Delta_m^3 + \frac{\lambda}{\alpha_m^2} = 0;\quad 4\alpha_m\Delta_m - "
        r"\alpha_m T - \lambda c_3 = 0",
    )


@claim("(3.15)", "the condition for a stationary point in τ_m, with λ = α_m λ~", verdict="holds")
def stationary_in_the_apex() -> Evidence:
    printed = T * (2 * apex - T) + 2 * slope * (c2 - (T - apex) * c3)
    return Equality(
        {"0": printed},
        lambda: parabola.stationarity()[0],
        display=r"T(2\tau_m - T) + 2\tilde\lambda[c_2 - (T - \tau_m)c_3] = 0",
    )


@claim("(3.16)", "the condition for a stationary point in α_m", verdict="holds")
def stationary_in_the_curvature() -> Evidence:
    return Equality(
        {"0": cubic() + slope / alpha},
        lambda: parabola.stationarity()[1],
        display=r"\tfrac13 T^3 - T(T - \tau_m)\tau_m - T\Delta_m^2 + \tfrac83\Delta_m^3 + "
        r"\frac{\tilde\lambda}{\alpha_m} = 0",
    )


@claim("(3.17)", "the condition for a stationary point in Δ_m", verdict="holds")
def stationary_in_the_width() -> Evidence:
    return Equality(
        {"0": 4 * half_width - T - slope * c3},
        lambda: parabola.stationarity()[2],
        display=r"4\Delta_m - T - \tilde\lambda c_3 = 0",
    )


@claim("after (3.17): τ_m", "τ_m from (3.15), in two forms", verdict="holds")
def apex_on_the_curve() -> Evidence:
    printed = {
        r"\tau_m": (T**2 - 2 * slope * (c2 - T * c3)) / (2 * (T + slope * c3)),
        r"\tau_m ": (T / 2 - slope * (c2 - T * c3) / T) / (1 + slope * c3 / T),
    }
    return Equality(
        printed,
        lambda: dict.fromkeys(printed, parabola.curve()[apex]),
        display=r"\tau_m = \frac{T^2 - 2\tilde\lambda(c_2 - Tc_3)}{2(T + \tilde\lambda c_3)} = \left(\frac "
        r"T2 - "
        r"\frac{\tilde\lambda(c_2 - Tc_3)}{T}\right)\left(1 + \frac{\tilde\lambda c_3}{T}\right)^{-1}",
    )


@claim("(3.18)", "Δ_m from (3.17)", verdict="holds")
def width_on_the_curve() -> Evidence:
    return Equality(
        {r"\Delta_m": (T + slope * c3) / 4},
        lambda: parabola.curve()[half_width],
        display=r"\Delta_m = \tfrac14(T + \tilde\lambda c_3)",
    )


@claim("(3.19)", "t1 and t2 as functions of λ~", verdict="holds")
def switches_on_the_curve() -> Evidence:
    middle = (T**2 - 2 * slope * (c2 - T * c3)) / (2 * (T + slope * c3))
    printed = {"t_1": middle - (T + slope * c3) / 4, "t_2": middle + (T + slope * c3) / 4}

    def derived() -> Sides:
        curve = parabola.curve()
        return {"t_1": curve[apex] - curve[half_width], "t_2": curve[apex] + curve[half_width]}

    return Equality(
        printed,
        derived,
        display=r"t_{1,2} = \tau_m \mp \Delta_m = \frac{T^2 - 2\tilde\lambda(c_2 - Tc_3)}{2(T + "
        r"\tilde\lambda c_3)} \mp "
        r"\tfrac14(T + \tilde\lambda c_3)",
    )


@claim(
    "after (3.19): search",
    "the problem (3.6) is now a one-dimensional search in λ~",
    verdict="conditional",
    remark="True for the global minimum of |S1 − S2 + S3| (with the modulus) over the λ~ with T + λ~c3 > "
    "0, that is t1 < t2; λ~ = −1/v for the level v. It is not true over all λ~: for c = (0, 0, "
    "1), T = 1, λ~ = −3.1 puts t1 after t2 and gives 0.152, below ρ0 = 0.228. There is also a "
    "local minimum, 1.19, at λ~ = 1.19. And for c2 = c3 = 0 (example 2) every λ~ gives the same "
    "t1, t2, so that the search does not determine λ~.",
)
def one_dimensional_search() -> Evidence:
    def argument() -> Steps:
        v, early, late = sp.symbols("v a b", positive=True)
        moments = two_switches(v, early, late, T)
        at = dict(zip(c, moments, strict=True))
        curve = {key: value.subs(at).subs(slope, -1 / v) for key, value in parabola.curve().items()}
        first = sp.cancel(curve[apex] - curve[half_width])
        second = sp.cancel(curve[apex] + curve[half_width])
        yield (
            "the optimum of level v with switches a < b lies on the curve (3.19): t1 = a",
            vanishes(first - early),
        )
        yield "there t2 = b, both at λ~ = −1/v", vanishes(second - late)
        width = sp.cancel(T + (slope * c3).subs(at).subs(slope, -1 / v))
        yield "there T + λ~c3 = 2(b − a) > 0", vanishes(width - 2 * (late - early))

    def counterexample() -> Steps:
        moments = sp.Matrix([0, 0, 1])
        pieces = [(R(4, 25), R(1911, 436)), (R(77, 200), -R(111046, 25179)), (R(91, 200), R(1198, 273))]
        yield (
            "c = (0, 0, 1), T = 1: a control of peak below 9/2, so ρ0 > 2/9",
            (piecewise_moments(pieces) == moments and max(abs(u) for _, u in pieces) < R(9, 2)),
        )
        at = {**in_unit_time(moments), slope: -R(31, 10)}
        middle, half = (parabola.curve()[key].subs(at) for key in (apex, half_width))
        value = parabola.objective((middle - half, middle + half), moments, sp.S.One)
        yield "λ~ = −31/10 on the curve has |S1 − S2 + S3| < 2/9", abs(value) < R(2, 9)
        yield "with t1 > t2", half < 0
        at.pop(slope)

        def along(place: sp.Rational) -> sp.Expr:
            middle, half = (parabola.curve()[key].subs(at).subs(slope, place) for key in (apex, half_width))
            return abs(parabola.objective((middle - half, middle + half), moments, sp.S.One))

        yield (
            "there is a local minimum above 1 between λ~ = 1.1 and 1.3",
            (along(R(11, 10)) > along(R(6, 5)) < along(R(13, 10)) and along(R(6, 5)) > 1),
        )
        turned = {key: value.subs(EXAMPLE_1) for key, value in parabola.curve().items()}
        yield (
            "example 2: t1 and t2 do not depend on λ~",
            not any(value.has(slope) for value in turned.values()),
        )

    return Conditional(argument, counterexample=counterexample)


@claim(
    "after (3.19): τ_m*, Δ_m*",
    "τ_m* and Δ_m* are half the sum and half the difference of t2* and t1*",
    verdict="holds",
)
def vertex_from_the_switches() -> Evidence:
    t1, t2 = parabola.t1, parabola.t2
    printed = {r"\tau_m^*": (t2 + t1) / 2, r"\Delta_m^*": (t2 - t1) / 2}

    def derived() -> Sides:
        found = sp.solve([apex - half_width - t1, apex + half_width - t2], [apex, half_width], dict=True)[0]
        return {r"\tau_m^*": found[apex], r"\Delta_m^*": found[half_width]}

    return Equality(
        printed,
        derived,
        display=r"\tau_m^* = \frac{t_2^* + t_1^*}{2},\quad \Delta_m^* = \frac{t_2^* - t_1^*}{2}",
    )


@claim(
    "after (3.19): α_m",
    "α_m from (3.16)",
    verdict="misprint",
    remark="Printed: α_m = −λ~[…]. Right: α_m = −λ~[…]⁻¹, from (3.16). In example 2 with γ = T = 1 the print "
    "gives 1/512 instead of 1/2.",
)
def curvature_from_the_search() -> Evidence:
    key = r"\alpha_m"
    numbers = {T: 1, apex: R(1, 2), half_width: R(1, 4), slope: -R(1, 32)}

    def consequence() -> Consequence:
        least = sp.Matrix([1, -R(1, 2), R(3, 32)])
        moments = piecewise_moments(BANG_BANG)
        scale = (least.T * moments)[0]
        return Consequence(
            "α_m of the unit turn, l10/2", (-slope * cubic()).subs(numbers), least[0] / (2 * scale)
        )

    return Misprint(
        {key: -slope * cubic()},
        parabola.curvature_on_the_curve,
        defect={key: -slope * cubic() + slope / cubic()},
        consequence=consequence,
        display=r"\alpha_m = -\tilde\lambda^*\left[\tfrac13 T^3 - T(T - \tau_m^*)\tau_m^* - T(\Delta_m^*)^2 "
        r"+ "
        r"\tfrac83(\Delta_m^*)^3\right]",
    )


@claim.proof(
    "after (3.19): closed form",
    "(3.15) to (3.17) have an analytic solution, too bulky to print",
    remark="With (3.13) they leave the quartic 3v⁴ + (48c2 − 96c1 − 12c3)v³ + (96c1c3 − 48c2² − 6c3²)v² + "
    "4c3³v − c3⁴ = 0 (T = 1) in the level v = −1/λ~; u0 is its real root of largest modulus.",
)
def closed_form() -> Steps:
    quartic = sp.Poly(parabola.level_polynomial(), level)
    yield "eliminating τ_m, Δ_m and α_m leaves a quartic in v, solvable in radicals", quartic.degree() == 4
    v, early, late = sp.symbols("v a b", positive=True)
    at = dict(zip(c, two_switches(v, early, late, T), strict=True))
    yield (
        "v is a root for the moments of every control with two switches",
        vanishes(quartic.as_expr().subs(level, v).subs(at)),
    )
    yield (
        "−v is a root for the moments of its negative",
        vanishes(quartic.as_expr().subs(level, -v).subs({key: -value for key, value in at.items()})),
    )
    remembered = 3 * level**4 + (48 * c2 - 96 * c1 - 12 * c3) * level**3
    remembered += (96 * c1 * c3 - 48 * c2**2 - 6 * c3**2) * level**2 + 4 * c3**3 * level - c3**4
    yield "for T = 1 it is the quartic of the remark", vanishes(quartic.as_expr().subs(T, 1) - remembered)
