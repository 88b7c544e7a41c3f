"""Section 3, example 2, from the controls of (3.9) to the remark on small eccentricities."""

import sympy as sp

from pontryagin.averaging.claims.kepler_optimum import PRINTED_ENERGY, PRINTED_MOMENTUM, SPENT
from pontryagin.averaging.derivation import kepler, kepler_optimum, kepler_phase
from pontryagin.averaging.derivation import kepler_principle as principle
from pontryagin.averaging.derivation.kepler import (
    anomaly,
    e,
    energy,
    epsilon,
    gamma,
    momentum,
    parameter,
    v_radial,
    v_transverse,
)
from pontryagin.averaging.derivation.kepler_optimum import OPTIMUM, energy0, momentum0, solution, tau
from pontryagin.averaging.derivation.kepler_principle import costate_energy, price
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Consequence,
    Equality,
    Evidence,
    Misprint,
    RightSides,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
p = parameter()


@claim(
    "(3.9): u",
    "the controls on the optimum",
    verdict="holds",
    remark="The thrust lies along the velocity.",
)
def controls_on_the_optimum() -> Evidence:
    printed = {"u_r^*": costate_energy * v_radial / 2, r"u_\varphi^*": costate_energy * v_transverse / 2}

    def derived() -> RightSides:
        best = principle.maximiser()
        return [best[u].subs(OPTIMUM) for u in kepler.CONTROL]

    return Equality(
        printed,
        derived,
        display=r"u_r^* = \tfrac12 p_E(\tau) v_r,\quad u_\varphi^* = \tfrac12 p_E(\tau) v_\varphi",
    )


@claim.proof(
    "after (3.9): γ",
    "γ = γ0 on the average, since the mean of γ' vanishes",
    remark="True with the controls (3.8), for either sign in (3.6), to O(ε/e); a constant u_r = 1 would turn "
    "the orbit at the mean rate εp^(1/2).",
    display=r"\gamma = \gamma_0 = \mathrm{const}",
)
def pericentre_stays() -> Steps:
    rate = kepler.element_rates()[gamma] / epsilon
    best = {u: principle.maximiser()[u].subs(kepler.conic()) for u in kepler.CONTROL}
    under = sp.simplify(rate.subs(best))
    yield (
        "γ' under (3.8) is odd in x, the weight is even",
        vanishes(under + under.subs(anomaly, -anomaly))
        and vanishes(kepler.weight() - kepler.weight().subs(anomaly, -anomaly)),
    )
    optimal = sp.simplify(under.subs(OPTIMUM))
    yield "on the optimum it is ε p_E sin x/e", vanishes(optimal - costate_energy * sp.sin(anomaly) / e)
    yield "of mean 0", vanishes(kepler_phase.average(optimal))
    still = rate.subs(dict(zip(kepler.CONTROL, (1, 0), strict=True)))
    yield "u_r = 1, u_φ = 0 has the mean εp^(1/2)", vanishes(kepler_phase.average(still) - sp.sqrt(p))


@claim(
    "after (3.9): v",
    "the velocity in terms of φ and γ0",
    verdict="misprint",
    remark="Printed: v_r = ε p⁻¹ K sin(φ − γ0), with the small parameter. Right: the eccentricity e, as in "
    "v_φ beside it and in the remark u_r ~ e below. As printed the energy is not E.",
)
def velocity() -> Evidence:
    printed = {
        "v_r": epsilon * p**-1 * momentum * sp.sin(anomaly),
        r"v_\varphi": p**-1 * momentum * (1 + e * sp.cos(anomaly)),
    }

    def derived() -> list[sp.Expr]:
        return [kepler.conic()[v] for v in (v_radial, v_transverse)]

    def consequence() -> Consequence:
        place = {momentum: 1, e: R(1, 2), anomaly: sp.pi / 2, epsilon: R(1, 100)}
        levels = []
        for speeds in (printed.values(), derived()):
            level = kepler.energy_of_state().subs(dict(zip((v_radial, v_transverse), speeds, strict=True)))
            levels.append(level.subs(kepler.conic()).subs(place))
        return Consequence("E at x = π/2 on K = 1, e = 1/2, with ε = 1/100", *levels)

    return Misprint(
        printed,
        derived,
        defect={"v_r": (epsilon - e) * sp.sin(anomaly) / momentum},
        consequence=consequence,
        display=r"v_r = \varepsilon p^{-1} K\sin(\varphi - \gamma_0),\quad v_\varphi = p^{-1} K[1 + "
        r"e\cos(\varphi - \gamma_0)]",
    )


@claim.proof(
    "after (3.9): e, p",
    "the averaged e and p follow from E(τ) and K(τ) of (3.9)",
    remark="True with the square in E(τ). Then EK² is constant, and so is e: the orbit keeps its shape and p "
    "= p0E0/E. The printed E(τ) would change e² from 1/2 to 3/4 for E0 = −1, E1 = −4, l = 2, K0 = "
    "1/2.",
)
def shape_on_the_optimum() -> Steps:
    found = solution()
    squared = kepler.eccentricity() ** 2
    shape = squared.subs({energy: found[energy], momentum: found[momentum]})
    yield "E(τ)K(τ)² = E0K0²: e is constant", vanishes(shape - (1 + 2 * energy0 * momentum0**2))
    yield (
        "p(τ)E(τ) = p0E0",
        vanishes(found[energy] * p.subs(momentum, found[momentum]) - energy0 * momentum0**2),
    )
    printed = squared.subs({energy: PRINTED_ENERGY, momentum: PRINTED_MOMENTUM}).subs(SPENT)
    yield "as printed e² runs from 1/2 to 3/4", [printed.subs(tau, at) for at in (0, 1)] == [R(1, 2), R(3, 4)]


@claim.proof(
    "after (3.9): u_r ~ e",
    "for small e the radial control is small, of order e",
    remark="u_r* = ∓(l/(1 − e²))^(1/2) e sin x. The first approximation leaves out terms O(ε), so that this "
    "is the leading term where e ≫ ε.",
    display=r"u_r^* \sim e",
)
def radial_control() -> Steps:
    radial = kepler_optimum.thrust_on_the_way()[0]
    size = sp.sqrt(price / (1 - e**2))
    yield (
        "u_r* = σ (l/(1 − e²))^(1/2) e sin x, σ the sign of E1 − E0",
        vanishes(radial - kepler_optimum.direction * size * e * sp.sin(anomaly)),
    )
    yield (
        "u_r*/e has a limit as e → 0",
        vanishes(sp.limit(radial / e, e, 0) - kepler_optimum.direction * sp.sqrt(price) * sp.sin(anomaly)),
    )
    excess = kepler_phase.from_eccentric(kepler_optimum.ripple().diff(kepler.eccentric))
    yield "h* is O(e) on the optimum, which makes up for 1/e in ψ'", vanishes(excess.subs(e, 0))


@claim.proof(
    "after (3.9): u_φ ~ 1",
    "the transverse control is a slowly varying function with small vibrations of amplitude ~ e",
    remark="More is true: u_φ* = ∓(l/(1 − e²))^(1/2) (1 + e cos x), and e is constant: the slowly varying "
    "function is constant, the thrust depends on the place on the orbit only, and ⟨u²⟩ = l.",
    display=r"u_\varphi^* \sim 1",
)
def transverse_control() -> Steps:
    radial, transverse = kepler_optimum.thrust_on_the_way()
    size = sp.sqrt(price / (1 - e**2))
    yield (
        "u_φ* = σ (l/(1 − e²))^(1/2) (1 + e cos x)",
        vanishes(transverse - kepler_optimum.direction * size * (1 + e * sp.cos(anomaly))),
    )
    yield "neither E nor K is left in it", not transverse.has(energy, momentum)
    found = solution()
    ratio = sp.simplify((found[costate_energy] / found[momentum]).diff(tau))
    yield "p_E/K of (3.9) is constant", vanishes(ratio)
    square = sp.expand((radial**2 + transverse**2).subs(kepler_optimum.direction, 1))
    yield "⟨u²⟩ = l", vanishes(kepler_phase.average(square) - price)
