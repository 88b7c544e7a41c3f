"""Example 2, (3.20): the turn of least peak, and of least time."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality, Evidence, Proof, RightSides, Sides, Steps, vanishes
from pontryagin.triple_integrator.claims.turn import EXAMPLE_1, turn
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import drive
from pontryagin.triple_integrator.derivation.duality import area_of, dual_function_of, piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c, multipliers
from pontryagin.triple_integrator.derivation.parabola import alpha, half_width

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
peak = sp.Symbol("u_0", positive=True)


@claim("example 2: l10", "for the turn of example 1, l10 = 1/c1 = 1/γ_T", verdict="holds")
def first_multiplier_of_example_2() -> Evidence:
    return Equality(
        {"l_{10}": 1 / turn},
        lambda: sp.solve(((multipliers.T * c)[0] - 1).subs(EXAMPLE_1), multipliers[0])[0],
    )


def vertex_of_the_turn() -> dict[sp.Symbol, sp.Expr]:
    """alpha_m, tau_m and Delta_m of example 2, from (3.13), (3.15) and (3.17)."""
    found = {key: value.subs(EXAMPLE_1) for key, value in parabola.curve().items()}
    condition = parabola.normalisation().subs(EXAMPLE_1) - 1
    return {alpha: sp.solve(condition, alpha)[0], **found}


@claim("example 2: parameters", "α_m = 1/(2γ_T), τ_m = T/2, Δ_m = T/4", verdict="holds")
def parameters_of_example_2() -> Evidence:
    printed = {r"\alpha_m": 1 / (2 * turn), r"\tau_m": T / 2, r"\Delta_m": T / 4}
    return Equality(printed, lambda: vertex_of_the_turn().values())


@claim("example 2: areas", "S1 = S3 = T³/(96γ_T), S2 = −T³/(96γ_T)", verdict="holds")
def areas_of_example_2() -> Evidence:
    printed = {"S_1": T**3 / (96 * turn), "S_3": T**3 / (96 * turn), "S_2": -(T**3) / (96 * turn)}

    def derived() -> Sides:
        first, second, third = (area.subs(vertex_of_the_turn()) for area in parabola.areas())
        return {"S_1": first, "S_3": third, "S_2": second}

    return Equality(printed, derived)


@claim("example 2: ρ0", "ρ0 = T³/(32γ_T)", verdict="holds")
def dual_norm_of_example_2() -> Evidence:
    def derived() -> RightSides:
        unit = {T: 1, turn: 1}
        l = parabola.multipliers_from_vertex().subs(parabola.beta, alpha * half_width**2)
        l = l.subs(vertex_of_the_turn())
        scale = sp.simplify(parabola.signed_area().subs(vertex_of_the_turn()))
        if area_of(dual_function_of(l.subs(unit)), sp.S.One) != scale.subs(unit):
            raise AssertionError("F is not the integral of |h|")
        return scale

    return Equality({r"\rho_0": T**3 / (32 * turn)}, derived)


def bang_bang_turn() -> list[tuple[sp.Expr, sp.Expr]]:
    """Example 2's control by pieces, at the level that its moments require."""
    signs = [(T / 4, peak), (T / 2, -peak), (T / 4, peak)]
    needed = sp.solve(piecewise_moments(signs)[0] - turn, peak)[0]
    return [(duration, value.subs(peak, needed)) for duration, value in signs]


@claim("(3.20)", "least peak of the turn, u0 = 32γ_T/T³", verdict="holds")
def least_peak_of_the_turn() -> Evidence:
    def argument() -> Steps:
        end = piecewise_moments(bang_bang_turn())
        yield "switching at T/4 and 3T/4 makes the turn", vanishes(end - sp.Matrix([turn, 0, 0]))
        bound = 1 / sp.simplify(parabola.signed_area().subs(vertex_of_the_turn()))
        yield "1/ρ0 is a lower bound, which it attains", vanishes(bound - bang_bang_turn()[0][1])

    return Proof(argument, Equality({"u_0": 32 * turn / T**3}, lambda: bang_bang_turn()[0][1]))


@claim("after (3.20): R", "the total impulse of this programme is R = u0 T = 32γ_T/T²", verdict="holds")
def impulse_of_the_bang_bang_turn() -> Evidence:
    return Equality(
        {"R": 32 * turn / T**2}, lambda: sum(duration * sp.Abs(value) for duration, value in bang_bang_turn())
    )


@claim("after (3.20): bound on T", "for a given u0 the duration must satisfy T³ ≥ 32γ_T/u0", verdict="holds")
def bound_on_the_duration() -> Evidence:
    def argument() -> Steps:
        least = bang_bang_turn()[0][1]
        yield (
            "the least peak falls with T, so shorter manoeuvres need more than u0",
            least.diff(T).is_negative,
        )
        rest = drive(sp.Matrix([turn, 0, 0]), sp.Symbol("w", positive=True), sp.S.Zero)
        yield "longer manoeuvres can wait at the end", vanishes(rest - sp.Matrix([turn, 0, 0]))

    return Proof(
        argument,
        Equality(
            {r"\min T^3": 32 * turn / peak}, lambda: sp.solve(sp.Eq(peak, bang_bang_turn()[0][1]), T**3)[0]
        ),
        display=r"T^3 \ge \frac{32\gamma_T}{u_0}",
    )


@claim("after (3.20): T_min", "least time of the turn, T_min = 2 (4γ_T/u0)^(1/3)", verdict="holds")
def least_time_of_the_turn() -> Evidence:
    def derived() -> RightSides:
        found = [root for root in sp.solve(sp.Eq(peak, bang_bang_turn()[0][1]), T) if root.is_positive]
        return found[0]

    return Equality(
        {r"T_{\min}": 2 * (4 * turn / peak) ** R(1, 3)},
        derived,
        display=r"T_{\min} = 2\left(\frac{4\gamma_T}{u_0}\right)^{1/3}",
    )
