"""Section 3, example 2, from (3.7) to the costate of K: the maximum principle and its average."""

import sympy as sp

from pontryagin.averaging.derivation import kepler, kepler_optimum
from pontryagin.averaging.derivation import kepler_principle as principle
from pontryagin.averaging.derivation.kepler import (
    anomaly,
    e,
    energy,
    epsilon,
    gamma,
    momentum,
    parameter,
    phi,
    r,
    u_radial,
    u_transverse,
    v_radial,
    v_transverse,
)
from pontryagin.averaging.derivation.kepler_optimum import duration, energy0, energy1, momentum0, tau
from pontryagin.averaging.derivation.kepler_principle import (
    costate_energy,
    costate_momentum,
    costate_pericentre,
    costate_phase,
    kappa,
    price,
)
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
p_E, p_K = costate_energy, costate_momentum
ESCAPE = {energy0: -R(1, 2), momentum0: R(1, 2), price: 4}
"""Initial data with e² = 3/4, and the price of time, for the flight to E1 = 0."""
SAMPLE = {energy: -R(1, 2), momentum: R(1, 2), p_E: 1, p_K: 1, price: 1, kappa: 0}


@claim(
    "(3.7)",
    "to minimise l τ1 + ∫ u² dτ up to the energy E1 ≤ 0 is a problem of the form of section 1",
    verdict="conditional",
    remark="True for E1 < 0. E1 = 0 is not of that form: ω(E1) = 0, while (1.1) requires ω ≥ ω0 > 0, and "
    "(3.9) divides by E1. τ1 stays finite, but K and the period grow without limit on the way.",
)
def problem() -> Evidence:
    def argument() -> Steps:
        motion = kepler.mean_motion()
        slope = motion.diff(energy)
        yield "ω = (2|E|)^(3/2) falls as E grows", slope.is_negative is True
        yield (
            "for E1 < 0 it is at least ω(max(E0, E1)) > 0 on the way",
            motion.subs(energy, energy1).is_positive is True,
        )
        target = energy - energy1
        yield (
            "the target holds no phase, and binds one of the slow variables E, K, γ",
            target.free_symbols
            == {
                energy,
                energy1,
            },
        )
        rate = principle.running_cost()
        yield (
            "J is the end value of one more slow variable, of rate ε(l + u²)",
            vanishes(rate - price - u_radial**2 - u_transverse**2),
        )

    def counterexample() -> Steps:
        yield "ω(0) = 0", sp.limit(kepler.mean_motion(), energy, 0, "-") == 0
        length = kepler_optimum.optimal_duration().subs(ESCAPE)
        ending = sp.limit(length, energy1, 0, "-")
        yield "for E0 = −1/2, K0 = 1/2, l = 4 the time τ1 tends to 1/2 as E1 → 0", ending == R(1, 2)
        yield (
            "while |ρ| = (2l/|E1|)^(1/2) → ∞",
            sp.limit(kepler_optimum.costate_size().subs(ESCAPE), energy1, 0, "-") == sp.oo,
        )
        K1 = kepler_optimum.solution()[momentum].subs(tau, duration)
        K1 = K1.subs(kepler_optimum.rho, 2 * (1 - kepler_optimum.shrinkage()) / duration).subs(ESCAPE)
        yield "and K(τ1) = K0 (E0/E1)^(1/2) → ∞", sp.limit(sp.simplify(K1), energy1, 0, "-") == sp.oo

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"E(t_1) = E_1 \leq 0,\quad J = l\tau_1 + \int_0^{\tau_1} u^2 d\tau,\quad l > 0,\quad u^2 = "
        r"u_r^2 + u_\varphi^2",
    )


@claim.proof(
    "after (3.7): p_γ",
    "the angle does not enter the right-hand sides, so its costate vanishes identically",
    display=r"\dot p_\gamma = -\partial H/\partial\gamma = 0,\quad p_\gamma(t_1) = 0",
)
def costate_of_the_pericentre() -> Steps:
    H = principle.hamiltonian()
    yield "H holds neither γ nor φ: p_γ is constant", not H.has(gamma, phi)
    yield "with M = E − E1 and no γ in the cost it ends at 0", (energy - energy1).diff(gamma) == 0


def phase_influence() -> sp.Matrix:
    """The coefficients of u_r and u_phi in psi'/epsilon."""
    rate = sp.expand(principle.hamiltonian()).coeff(costate_phase) / epsilon
    return sp.Matrix([sp.expand(rate).coeff(u) for u in kepler.CONTROL])


@claim.proof(
    "before (3.8): p_ψ",
    "p_ψ = O(ε) over times of order 1/ε, and the controls follow from E and K alone",
    remark="True for 0 < e < 1: H = 0 gives it over any time; p_ψ' = O(ε) alone would leave O(1).",
    display=r"p_\psi = O(\varepsilon),\quad t_1 \sim \varepsilon^{-1}",
)
def costate_of_the_phase() -> Steps:
    H = principle.hamiltonian().subs(costate_pericentre, 0)
    yield "H is affine in p_ψ", vanishes(H.diff(costate_phase, 2))
    rest, rate = H.subs(costate_phase, 0), H.diff(costate_phase)
    yield "without it H is εh, h free of ε", not sp.expand(rest / epsilon).has(epsilon)
    yield (
        "its coefficient is ω + O(ε), so H = 0 gives p_ψ = −εh/(ω + O(ε))",
        vanishes(rate.subs(epsilon, 0) - kepler.mean_motion()),
    )
    best = sp.solve([H.diff(u) for u in kepler.CONTROL], list(kepler.CONTROL), dict=True)[0]
    control = sp.Matrix([best[u] for u in kepler.CONTROL])
    first = sp.Matrix([principle.maximiser()[u] for u in kepler.CONTROL]).subs(kepler.conic())
    yield (
        "the best u is (3.8) and ½ p_ψ times the coefficients of u in ψ'/ε",
        vanishes(control - first - costate_phase * phase_influence() / 2),
    )


@claim("(3.8)", "the optimal control of the first approximation", verdict="holds")
def optimal_control() -> Evidence:
    printed = {"u_r^*": p_E * v_radial / 2, r"u_\varphi^*": (p_E * v_transverse + p_K * r) / 2}
    return Equality(
        printed,
        lambda: [principle.maximiser()[u] for u in kepler.CONTROL],
        display=r"u_r^* = \tfrac12 p_E v_r,\quad u_\varphi^* = \tfrac12(p_E v_\varphi + p_K r)",
    )


@claim("after (3.8): dψ", "the weight with which the average over ψ is taken in x", verdict="holds")
def average_weight() -> Evidence:
    period = 2 * sp.pi * (2 * sp.Abs(energy)) ** R(-3, 2)
    printed = 2 * sp.pi * period**-1 * sp.sqrt(parameter()) ** 3 * (1 + e * sp.cos(anomaly)) ** -2
    return Equality(
        {r"d\psi/dx": kepler.in_slow_variables(printed)},
        lambda: kepler.in_slow_variables(kepler.weight()),
        display=r"d\psi = 2\pi T^{-1} p^{3/2}(1 + e\cos x)^{-2} dx",
    )


def hamiltonian_drift(momentum_costate_rate: sp.Expr) -> sp.Expr:
    """dh0/dtau of the averaged system at kappa = 0 for a given rate of p_K; Hamilton's equations give 0."""
    h0 = principle.averaged_hamiltonian()
    rates = dict(principle.averaged_rates()) | {p_K: momentum_costate_rate}
    return sum(h0.diff(variable) * rate for variable, rate in rates.items()).subs(SAMPLE)


@claim(
    "after (3.8): dp_K/dτ",
    "the averaged equation of p_K",
    verdict="misprint",
    remark="Printed: p_E ∂⟨v_φ r⟩/∂K. Right: ½ p_E ∂⟨v_φ r⟩/∂K, from h0 = ¼⟨(p_E v_r)² + (p_E v_φ + p_K r)²⟩ "
    "− l; the ¼ of the other term is right. The common factor p_K is printed, so that p_K ≡ 0 is not "
    "affected, nor is anything after it.",
)
def momentum_costate_rate() -> Evidence:
    key = r"dp_K/d\tau"
    means = principle.averages()
    r_squared, sweep = (means[sp.Symbol(name)].diff(momentum) for name in ("r^2", "v_phi r"))
    printed = -(p_K / 4 * r_squared + p_E * sweep) * p_K

    def consequence() -> Consequence:
        drifts = [hamiltonian_drift(rate) for rate in (printed, principle.averaged_rates()[p_K])]
        return Consequence("dh0/dτ at E = −1/2, K = 1/2, p_E = p_K = 1, κ = 0", *drifts)

    return Misprint(
        {key: printed},
        lambda: principle.averaged_rates()[p_K],
        defect={key: -p_E * p_K / 2},
        consequence=consequence,
        display=r"\frac{dp_K}{d\tau} = -\left(\frac{p_K}{4}\frac{\partial\langle r^2\rangle}{\partial K} + "
        r"p_E\frac{\partial\langle v_\varphi r\rangle}{\partial K}\right) p_K",
    )


@claim.proof(
    "after (3.8): p_K ≡ 0",
    "the costate of K vanishes identically in the first approximation",
    remark="True for every κ, with the right and with the printed equation.",
    display=r"p_K \equiv 0",
)
def costate_of_the_momentum() -> Steps:
    rate = principle.averaged_rates()[p_K]
    yield (
        "dp_K/dτ is a polynomial in p_K over p_K: the rate has the factor p_K",
        vanishes(rate.subs(p_K, 0)) and sp.Poly(rate, p_K).degree() == 2,
    )
    yield "the phase does not enter it: ω does not depend on K", not rate.has(kappa)
    yield "the target leaves K free: p_K(τ1) = 0", (energy - energy1).diff(momentum) == 0
    rest = sp.fraction(sp.together(rate / p_K))[1]
    yield "the other factor is finite for E < 0, so p_K = 0 alone ends there", rest.free_symbols == {energy}
