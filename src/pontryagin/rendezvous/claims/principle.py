"""Section 2 up to the 16 equations: costates and the optimal thrust, (8), (9), (10)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Equality,
    Proof,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.derivation import (
    canonical,
    forms,
    model,
    primer,
    principle,
    reduction,
    transversality,
    variation,
)
from pontryagin.rendezvous.derivation.model import attitude, c, r, thrust
from pontryagin.rendezvous.derivation.principle import energy_weight, mu, nu, peak, rho, s1, time_weight
from pontryagin.rendezvous.derivation.principle import switching_length as length
from pontryagin.rendezvous.derivation.principle import thrust_magnitude as p
from pontryagin.rendezvous.derivation.quaternion import conjugate, product

claim = Page("Pimkina & Chelnokov")

e = principle.e
nu1 = nu[0]
magnitude = sp.Symbol("p^0", nonnegative=True)
multiplier = sp.Symbol("kappa", positive=True)

PLACE = {
    r: sp.Rational(11, 10),
    model.v1: sp.Rational(2, 7),
    c: sp.Rational(6, 5),
    **dict(zip(attitude, (sp.Rational(k, 5) for k in (1, 2, 2, 4)), strict=True)),
}
"""A rational state without symmetries, with |lambda| = 1, at which the 16 equations are compared."""
PRIMER = dict(zip(canonical.PSI, (sp.Rational(k, 6) for k in (2, -1, 3, 2, 3, 6)), strict=True))
"""Values of psi_R and psi_V at the state `PLACE`, with |psi_V| = 7/6."""


@claim.proof(
    "section 2: costates",
    "μ, ρ, s1, e, Φ* and ψ0 are the costates of λ, r, v1, c, φ* and g",
    display=r"\dot g = \alpha_1 + \alpha_2 p^2,\quad g(t_0) = 0",
)
def costates() -> Steps:
    left = canonical.hamiltonian_gap(PLACE) - principle.anomaly_costate * model.anomaly_rate()
    yield (
        "with (ρ, s1, e, μ) = (dX/dx)'ψ, ψ the costate of X = (R, V), H is that of R and V, and Φ*φ*'",
        vanishes(left),
    )
    yield "X' by (2) and (3) is dH/dψ, at any thrust in η", vanishes(canonical.state_gap(PLACE))
    yield (
        "(dX/dx)'ψ moves by −dH/dx as ψ moves by −dH/dX, at any thrust in η",
        vanishes(canonical.costate_gap(PLACE)),
    )
    by_thrust = variation.gradient_by_thrust().dot([variation.FAMILY[x].diff(variation.s) for x in thrust])
    yield (
        "with these and ψ0 = −1 for g, dJ is (ψ, dx) at the end and −∫(dH/dp, dp)dt: ψ0 is constant",
        vanishes(variation.rest_of_the_variation() + by_thrust),
    )


@claim("(8)", "the thrust lies along n", verdict="holds", remark="This holds where n ≠ 0.")
def direction() -> Proof:
    def derived() -> RightSides:
        n = principle.switching()
        found = sp.solve([*(n - 2 * multiplier * thrust)], list(thrust), dict=True)[0]
        stationary = thrust.subs(found)
        size = principle.size(stationary.subs({e: 0, nu1: 0, s1: length}))
        scale = sp.solve(size - magnitude, multiplier)[0]
        return stationary.subs(multiplier, scale).subs(length, principle.size(n))

    def argument() -> Steps:
        n, other = principle.switching(), thrust
        gap = n.dot(n) * other.dot(other) - n.dot(other) ** 2
        yield (
            "|n|²|p|² − (n, p)² = |n × p|²: no thrust of the same size has a larger (n, p)",
            vanishes(gap - n.cross(other).dot(n.cross(other))),
        )

    n = sp.Matrix([s1, e * r, r * nu1 / (2 * c)])
    printed = {r"\bar p_\eta^0": magnitude * n / sp.sqrt(n.dot(n))}
    return Proof(argument, Equality(printed, derived), display=r"\bar p_\eta^0 = p^0\bar n_\eta/|\bar n|")


@claim(
    "(9)",
    "n = s1 i1 + e r i2 + [r ν1/(2c)] i3, and its length",
    verdict="holds",
    remark="The scan prints ν like v; the line after (10) says that ν1 is meant.",
)
def switching_vector() -> Equality:
    printed = {
        r"\bar n_\eta": sp.Matrix([s1, e * r, r * nu1 / (2 * c)]),
        r"|\bar n|": sp.sqrt(s1**2 + r**2 * (e**2 + nu1**2 / (4 * c**2))),
    }
    return Equality(printed, lambda: (principle.switching(), principle.size(principle.switching())))


@claim("(10)", "the size of the thrust for α2 > 0: |n|/(2α2), at most p_max", verdict="holds")
def thrust_size() -> Proof:
    def argument() -> Steps:
        gain, excess = principle.along_switching(), sp.Symbol("k", positive=True)
        yield (
            "p n/|n| put into H: −α2p² + |n|p and what has no p",
            vanishes(gain - (length * p - energy_weight * p**2)),
        )
        within, beyond, _ = principle.best_magnitudes()
        lost = gain.subs(p, within) - gain
        yield (
            "any p loses α2(p − |n|/(2α2))² against |n|/(2α2)",
            vanishes(lost - energy_weight * (p - length / (2 * energy_weight)) ** 2),
        )
        lost = (gain.subs(p, beyond) - gain).subs(length, 2 * energy_weight * peak + excess)
        yield (
            "where |n| = 2α2 p_max + k, any p ≤ p_max loses (p_max − p)(k + α2(p_max − p)) against p_max",
            vanishes(lost - (peak - p) * (excess + energy_weight * (peak - p))),
        )

    return Proof(
        argument,
        Equality(
            {r"p^0": length / (2 * energy_weight), r"p^0_{\max}": peak},
            lambda: principle.best_magnitudes()[:2],
        ),
        display=r"\alpha_2 > 0:\ p^0 = \begin{cases} (2\alpha_2)^{-1}|\bar n|, & (2\alpha_2)^{-1}|\bar n| "
        r"\le p_{\max} \\ p_{\max}, & (2\alpha_2)^{-1}|\bar n| > p_{\max} \end{cases}",
    )


@claim.proof(
    "(10), α2 = 0",
    "for α2 = 0 the thrust is always p_max",
    remark="Instants with n = 0 are excepted. The page does not show that n cannot stay 0; for α1 > 0 it "
    "cannot.",
    display=r"\alpha_2 = 0:\ p^0 = p_{\max}",
)
def no_singular_arcs() -> Steps:
    gain = principle.along_switching().subs(energy_weight, 0)
    yield "H rises with p at the rate |n|", vanishes(gain.diff(p) - length)
    yield "so p = p_max where n ≠ 0", principle.best_magnitudes()[2] == peak
    n, carried = principle.switching(), primer.carried()
    second = primer.second_rate() - primer.gravity_gradient() * n
    yield "n'' = G n in inertial axes, linear in n", vanishes(second.applyfunc(sp.simplify))
    across = primer.rate_at_any_thrust(n) - carried
    torque = sp.Matrix([0, 0, r * n.cross(thrust)[0] / c])
    yield (
        "at any thrust n' has r(n × p)₁/c more along η3: nothing where n = 0, as on a singular arc",
        vanishes((across - torque).applyfunc(sp.simplify)),
    )
    unknowns = [rho, s1, e, *nu]
    (only,) = sp.linsolve([*n, *carried], unknowns)
    yield "n = n' = 0 at an instant makes ρ, s1, e, ν all 0", all(value == 0 for value in only)
    nothing = dict.fromkeys(unknowns, 0)
    still = [rate.subs(nothing) for rate in reduction.rates()[4:, :]]
    yield "and at any thrust they stay 0 up to t_k", all(rate == 0 for rate in still)
    constant = transversality.anomaly_constant_at_the_end().subs(nothing)
    yield "then (16) gives C_φ = 0", constant == 0
    nothing |= {reduction.anomaly_constant: constant, energy_weight: 0}
    energy = reduction.hamiltonian().subs(nothing)
    yield "and (17) says −α1 = 0", vanishes(energy + time_weight)


@claim("after (10): ν", "ν1 is a component of ν = λ~∘μ", verdict="holds")
def variable_nu() -> Equality:
    def derived() -> RightSides:
        gradient = (principle.hamiltonian() + principle.running_cost()).diff(thrust[2])
        return sp.expand(2 * c / r * gradient)

    return Equality(
        {r"\nu_1": product(conjugate(attitude), mu)[1]},
        derived,
        display=r"\bar\nu = \nu_0 + \nu_1\bar i_1 + \nu_2\bar i_2 + \nu_3\bar i_3 = "
        r"\tilde{\bar\lambda}\circ\bar\mu",
    )


@claim.proof("section 2: 16", "the problem leads to 16 differential equations")
def sixteen() -> Steps:
    form = forms.full("unsaturated")
    yield "eight for r, v1, c, φ*, λ and eight for their costates", len(form.rates) == 16
    outside = set().union(*(rate.free_symbols for rate in form.rates)) - set(form.states)
    yield "with the optimal thrust nothing else in them changes", outside <= set(form.parameters)
    modes: tuple[tuple[principle.Mode, str], ...] = (("unsaturated", "within"), ("saturated", "on"))
    for mode, name in modes:
        gap = canonical.optimal_gap(mode, PLACE, PRIMER)
        yield f"{name} the bound they are the canonical equations in R and V, ψ_V along p", vanishes(gap)
