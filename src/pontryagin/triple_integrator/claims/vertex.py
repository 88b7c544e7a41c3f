"""Section 3, (3.8) to (3.11): the dual function given by its vertex."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, Evidence, RightSides, Sides, Steps, vanishes
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import (
    drive,
    final,
    initial,
    required_moments,
    t0,
    tau,
    tf,
)
from pontryagin.triple_integrator.derivation.duality import piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c, multipliers
from pontryagin.triple_integrator.derivation.parabola import alpha, apex, beta, half_width, t1, t2

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
l1, l2, l3 = multipliers


@claim("(3.8)", "vertex form of the parabola", verdict="holds")
def vertex_form() -> Evidence:
    printed = alpha * (tau - apex) ** 2 - beta

    def derived() -> RightSides:
        inverse = dict(zip(multipliers, parabola.multipliers_from_vertex(), strict=True))
        return parabola.parabola().subs(tf, T).subs(inverse)

    return Equality(
        {r"\psi_3^*(\tau)": printed},
        derived,
        display=r"\psi_3^*(t) = \alpha_m (t - \tau_m)^2 - \beta_m",
    )


@claim("after (3.8): vertex", "τ_m = tf + l20/l10 = (t1 + t2)/2", verdict="holds")
def apex_of_the_parabola() -> Evidence:
    key, other = r"\tau_m", r"t_f + l_{20}/l_{10}"

    def derived() -> Sides:
        ratio = parabola.multipliers_from_zeros()
        return {key: parabola.vertex()[apex], other: sp.cancel(tf + ratio[1] / ratio[0])}

    return Equality(
        {key: tf + l2 / l1, other: (t1 + t2) / 2},
        derived,
        display=r"\tau_m = t_f + \frac{l_{20}}{l_{10}} = \frac{t_1 + t_2}{2}",
    )


@claim("after (3.8): β_m", "β_m = −ψ3*(τ_m)", verdict="holds")
def depth_of_the_parabola() -> Evidence:
    printed = -parabola.parabola().subs(tau, tf + l2 / l1)
    return Equality(
        {r"\beta_m": printed},
        lambda: parabola.vertex()[beta],
        display=r"\beta_m = -\psi_3^*(\tau_m)",
    )


@claim(
    "after (3.8): sign",
    "the parabola is assumed convex, α_m > 0 and β_m > 0; otherwise both are negative",
    verdict="conditional",
    remark="α_m and β_m do have the same sign, and replacing c by −c changes it; but for a given c the "
    "sign is not free. For c = (−γ, 0, 0) condition (3.13) reads −2γα_m = 1, which no α_m > 0 "
    "satisfies. One has to solve for c and −c, or minimise |F| instead of F in (3.14).",
)
def convex_parabola() -> Evidence:
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
        yield "that is not the least F, but the least |F|", lower_still < best

    return Conditional(argument, counterexample=counterexample)


@claim("after (3.8): t1, t2", "the zeros are τ_m ∓ √(β_m/α_m) = τ_m ∓ Δ_m", verdict="holds")
def zeros_of_the_parabola() -> Evidence:
    root = sp.sqrt(beta / alpha)
    return Equality(
        {"t_1": apex - root, "t_2": apex + root},
        parabola.zeros,
        display=r"t_{1,2} = \tau_m \mp \sqrt{\frac{\beta_m}{\alpha_m}} = \tau_m \mp \Delta_m",
    )


@claim.proof("after (3.8): t0 = 0", "without loss of generality t0 = 0, tf = T")
def time_from_zero() -> Steps:
    shift, force = sp.symbols("t_s f_0", real=True)
    h = parabola.parabola()
    yield (
        "h depends on tf − τ only",
        vanishes(h - h.subs({tau: tau + shift, tf: tf + shift}, simultaneous=True)),
    )
    ramp = force * (tau + t0)
    moved = drive(initial, T, sp.S.Zero, ramp)
    needed = final - moved
    yield (
        "a disturbance f(t) is to be read as f(t0 + t): then c is the same",
        vanishes(required_moments(force * tau).subs(t0, 0) - needed.subs(t0, 0)) and needed.has(t0),
    )


@claim("(3.9)", "vertex form from the multipliers (t0 = 0)", verdict="holds")
def vertex_from_multipliers() -> Evidence:
    printed = {
        r"\alpha_m": l1 / 2,
        r"2\alpha_m\tau_m": l1 * T + l2,
        r"\alpha_m\tau_m^2 - \beta_m": l1 * T**2 / 2 + l2 * T + l3,
    }

    def derived() -> RightSides:
        found = {symbol: value.subs(tf, T) for symbol, value in parabola.vertex().items()}
        sides = (alpha, 2 * alpha * apex, alpha * apex**2 - beta)
        return [side.subs(found) for side in sides]

    return Equality(
        printed,
        derived,
        display=r"\alpha_m = \tfrac12l_{10},\quad 2\alpha_m\tau_m = l_{10}T + l_{20},\quad "
        r"\alpha_m\tau_m^2 - \beta_m = \tfrac12l_{10}T^2 + l_{20}T + l_{30}",
    )


@claim("(3.10)", "multipliers from the vertex form", verdict="holds")
def multipliers_from_the_vertex() -> Evidence:
    printed = {
        "l_{10}": 2 * alpha,
        "l_{20}": 2 * alpha * (apex - T),
        "l_{30}": alpha * (apex - T) ** 2 - beta,
    }
    return Equality(
        printed,
        parabola.multipliers_from_vertex,
        display=r"l_{10} = 2\alpha_m;\quad l_{20} = 2\alpha_m(\tau_m - T);\quad l_{30} = \alpha_m(\tau_m - "
        r"T)^2 - \beta_m",
    )


@claim("(3.11)", "the condition l'c = 1 in the vertex form", verdict="holds")
def condition_on_the_vertex() -> Evidence:
    printed = 2 * alpha * c1 + 2 * alpha * (apex - T) * c2 + (alpha * (apex - T) ** 2 - beta) * c3
    return Equality(
        {"1": printed},
        parabola.normalisation,
        display=r"2\alpha_m c_1 + 2\alpha_m(\tau_m - T)c_2 + [\alpha_m(\tau_m - T)^2 - \beta_m]c_3 = 1",
    )
