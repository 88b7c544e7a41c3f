"""Section 3, example 2, (3.6) and the lines after it: osculating elements under thrust."""

import sympy as sp

from pontryagin.averaging.derivation import kepler, kepler_phase
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
from pontryagin.averaging.derivation.kepler_phase import eccentricity_rate, pericentre_rate
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
sin, cos = sp.sin(anomaly), sp.cos(anomaly)
PRINTED_PERIOD = 2 * sp.pi * (2 * sp.Abs(energy)) ** R(-3, 2)
PRINTED_PERICENTRE = (
    epsilon * e**-1 * sp.sqrt(p) * (u_radial * cos + (2 + e * cos) * (1 + e * cos) ** -1 * u_transverse * sin)
)
PLACE = {u_radial: 1, u_transverse: 0, epsilon: 1, momentum: 1, e: R(1, 2), anomaly: sp.pi / 3}
"""A radial push of size 1 at the anomaly 60° of the orbit K = 1, e = 1/2."""


@claim.proof(
    "before (3.6): type (1.1)",
    "(3.4) and (3.5) take (3.3) to a system of the form (1.1)",
    remark="This holds for 0 < e < 1. The slow variables are E, K and γ, the phase is ψ; the rates of γ and "
    "ψ grow as 1/e near the circle.",
)
def standard_form() -> Steps:
    rates = kepler.element_rates()
    slow = [rates[key] / epsilon for key in (energy, momentum, gamma)]
    yield (
        "the rates of E, K, γ are ε times functions free of ε",
        not any(sp.cancel(rate).has(epsilon) for rate in slow),
    )
    turned = [vanishes(rate - rate.subs(anomaly, anomaly + 2 * sp.pi)) for rate in slow]
    yield "of period 2π in x, and so in ψ", all(turned)
    yield (
        "dψ/dx > 0: x is a function of ψ",
        vanishes(kepler.weight() * (1 + e * cos) ** 2 - sp.sqrt(1 - e**2) ** 3),
    )
    still = kepler_phase.mean_anomaly_rate().subs({pericentre_rate: 0, eccentricity_rate: 0})
    yield "ψ' is ω(E) > 0 up to ε", still.free_symbols == {energy} and still.is_positive is True


@claim("(3.6): E and K", "how thrust changes energy and angular momentum", verdict="holds")
def energy_and_momentum() -> Evidence:
    printed = {
        r"\dot E": epsilon * (v_radial * u_radial + v_transverse * u_transverse),
        r"\dot K": epsilon * r * u_transverse,
    }
    return Equality(
        printed, lambda: map(kepler.along_the_motion, (kepler.energy_of_state(), kepler.momentum_of_state()))
    )


def radius_rate(pericentre: sp.Expr) -> sp.Expr:
    """r' − v_r by the rates of the elements, for a given γ'.

    It vanishes if γ' is right, since an impulse does not displace the body.
    """
    rates = kepler.element_rates()
    radius = kepler.conic()[r]
    moved = radius.diff(momentum) * rates[momentum] + radius.diff(e) * rates[e]
    return moved - radius.diff(anomaly) * pericentre


@claim(
    "(3.6): γ",
    "how thrust turns the orbit",
    verdict="misprint",
    remark="Printed: +u_r cos x. Right: −u_r cos x. As printed, a radial impulse would displace the body: r' "
    "− v_r is −2ε p^(3/2) u_r sin x cos x (1 + e cos x)^(−2), not 0. What the example concludes is "
    "not affected: γ' enters neither (3.8) nor the averages of E and K, and the mean of u_r* cos x, "
    "odd in x, is 0 with either sign. Corrections beyond the first approximation are affected.",
)
def pericentre() -> Evidence:
    key = r"\dot\gamma"

    def consequence() -> Consequence:
        rates = [radius_rate(rate) for rate in (PRINTED_PERICENTRE, kepler.element_rates()[gamma])]
        printed, required = (sp.nsimplify(sp.simplify(rate.subs(PLACE))) for rate in rates)
        return Consequence("r' − v_r for u_r = 1, ε = K = 1, e = 1/2, x = π/3", printed, required)

    return Misprint(
        {key: PRINTED_PERICENTRE},
        lambda: kepler.element_rates()[gamma],
        defect={key: 2 * epsilon * sp.sqrt(p) * u_radial * cos / e},
        consequence=consequence,
        display=r"\dot\gamma = \varepsilon e^{-1} p^{1/2} [u_r\cos x + (2 + e\cos x)(1 + e\cos x)^{-1} "
        r"u_\varphi\sin x]",
    )


@claim(
    "(3.6): ψ",
    "how thrust changes the phase, in terms of γ' and e'",
    verdict="holds",
    remark="This holds with the right γ'. The braces are −(1 − e²)^(1/2) (2 + e cos x) sin x (1 + e cos "
    "x)^(−2).",
)
def phase_rate() -> Evidence:
    first = (1 + e) * (1 + e * cos) ** -1 * sin * (sp.sqrt(1 - e) * (1 + e) ** R(-1, 2)).diff(e)
    second = (e * sp.sqrt(1 - e**2) * (1 + e * cos) ** -1).diff(e) * sin
    braces = (first - second).subs(sp.sqrt(1 - e), sp.sqrt(1 - e**2) / sp.sqrt(1 + e))
    turn = (1 - e**2) ** R(3, 2) * (1 + e * cos) ** -2 * pericentre_rate
    return Equality(
        {r"\dot\psi": 2 * sp.pi / PRINTED_PERIOD - turn + sp.simplify(braces) * eccentricity_rate},
        kepler_phase.mean_anomaly_rate,
        display=r"\dot\psi = 2\pi T^{-1} - (1 - e^2)^{3/2}(1 + e\cos x)^{-2}\dot\gamma + \{(1 + e)(1 + e\cos "
        r"x)^{-1}\sin x\, \partial[(1 - e)^{1/2}(1 + e)^{-1/2}]/\partial e - \partial[e(1 - e^2)^{1/2}(1 + "
        r"e\cos x)^{-1}]/\partial e\, \sin x\}\dot e",
    )


@claim.proof(
    "after (3.6): initial data",
    "the initial values of (3.6) follow from (3.3)–(3.5)",
    remark="e cos x = r v_φ² − 1 and e sin x = r v_φ v_r give e and x; then γ = φ − x, and ψ follows from "
    "(3.5). This needs e > 0.",
)
def initial_data() -> Steps:
    state = [r * v_transverse**2 - 1, r * v_transverse * v_radial]
    on_orbit = [kepler.on_the_orbit(part) for part in state]
    yield (
        "r v_φ² − 1 = e cos x, r v_φ v_r = e sin x",
        all(vanishes(part - e * value) for part, value in zip(on_orbit, (cos, sin), strict=True)),
    )
    K, E = r * v_transverse, kepler.energy_of_state()
    yield "and e² = 1 + 2EK² is the same e", vanishes(sum(part**2 for part in state) - (1 + 2 * E * K**2))
    example = {r: 1, phi: R(1, 3), v_radial: R(1, 2), v_transverse: 1}
    values = [part.subs(example) for part in state]
    yield "r = 1, v_r = 1/2, v_φ = 1: e cos x = 0, e sin x = 1/2; e = 1/2, x = π/2", values == [0, R(1, 2)]


@claim("after (3.6): e and p", "how thrust changes eccentricity and focal parameter", verdict="holds")
def eccentricity_and_parameter() -> Evidence:
    bracket = (e * (1 + cos**2) + 2 * cos) * (1 + e * cos) ** -1
    printed = {
        r"\dot e": epsilon * sp.sqrt(p) * (u_radial * sin + u_transverse * bracket),
        r"\dot p": 2 * epsilon * sp.sqrt(p) ** 3 * u_transverse * (1 + e * cos) ** -1,
    }

    def derived() -> RightSides:
        rates = kepler.element_rates()
        return rates[e], p.diff(momentum) * rates[momentum]

    return Equality(
        printed,
        derived,
        display=r"\dot e = \varepsilon p^{1/2}\{u_r\sin x + u_\varphi[e(1 + \cos^2 x) + 2\cos x](1 + e\cos "
        r"x)^{-1}\},\quad \dot p = 2\varepsilon p^{3/2} u_\varphi (1 + e\cos x)^{-1}",
    )
