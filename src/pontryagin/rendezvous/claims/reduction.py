"""Section 2, the reduction: integrals, (11), (12), (13), (14), and the order of the system."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Equality,
    Refutation,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.claims import meetings
from pontryagin.rendezvous.claims.statement import at_unit_norm
from pontryagin.rendezvous.derivation import principle, reduction, terminal, transversality, variation
from pontryagin.rendezvous.derivation.model import anomaly, attitude, c, gravity, r, thrust, v1
from pontryagin.rendezvous.derivation.principle import mu, nu, nu0, rho, s1
from pontryagin.rendezvous.derivation.quaternion import conjugate, product
from pontryagin.rendezvous.derivation.reduction import anomaly_constant

claim = Page("Pimkina & Chelnokov")

e = principle.e
nu1, nu2, nu3 = nu
p1, p2, p3 = thrust


def rates(*variables: sp.Symbol) -> list[sp.Expr]:
    """The derived rates of the given variables, which are among the ten."""
    known = dict(zip(reduction.REDUCED, reduction.rates(), strict=True))
    return [known[x] for x in variables]


def constant(expression: sp.Expr) -> bool:
    """Whether an expression is an integral of the 16 equations, at any thrust."""
    return vanishes(sp.expand(sp.simplify(reduction.along(expression))))


@claim.proof(
    "section 2: ν*",
    "ν* = μ∘λ~ is a first integral",
    remark="This holds at any thrust.",
    display=r"\bar\nu^* = \bar\mu\circ\tilde{\bar\lambda} = \mathrm{const}",
)
def invariant() -> Steps:
    for k, part in enumerate(reduction.invariant()):
        yield f"component {k} of μ∘λ~ is constant along the 16 equations", constant(part)


@claim.proof(
    "section 2: ν = λ~∘ν*∘λ",
    "the new variable ν is obtained from the integral ν*",
    display=r"\bar\nu = \tilde{\bar\lambda}\circ\bar\nu^*\circ\bar\lambda",
)
def nu_from_the_invariant() -> Steps:
    seen = product(conjugate(attitude), reduction.invariant(), attitude)
    for k, (a, b) in enumerate(zip(seen, reduction.nu_of(), strict=True)):
        yield f"component {k} of λ~∘ν*∘λ is that of λ~∘μ, for |λ| = 1", vanishes(at_unit_norm(a - b))


@claim.proof(
    "section 2: integrals",
    "the boundary value problem has first integrals, which are taken into account",
    remark="The integrals are ν* (four), |λ|, C_φ and H. ν0 is one of the four, the scalar part of ν*, and "
    "may be chosen at will, as no thrust contains it. |ν| is constant along (14) and is not used: the "
    "ten equations are one more than needed.",
)
def integrals() -> Steps:
    norm, gauge, square = reduction.norms()
    yield "|λ|² is constant", constant(norm)
    yield "C_φ = Φ*(1 + e* cos φ*)² is constant", constant(reduction.anomaly_integral())
    yield "ν0 is constant", constant(gauge)
    without = {principle.in_nu(part).has(nu0) for part in (principle.hamiltonian(), *principle.switching())}
    yield "and neither H nor n contains it", without == {False}
    yield "ν1² + ν2² + ν3² is constant", constant(square)
    for mode in principle.MODES:
        yield f"H is constant, the {mode} thrust put in", vanishes(variation.energy_rate(mode))


@claim.proof("section 2: six", "the order falls by six for any control p")
def six() -> Steps:
    whole = [*principle.STATE, *principle.COSTATE]
    yield "16 − 4 (λ) − 4 (μ) − 1 (Φ*) + 3 (ν) = 10", len(whole) - 6 == len(reduction.REDUCED)
    outside = set().union(*(rate.free_symbols for rate in reduction.rates())) - set(reduction.REDUCED)
    yield "the ten rates contain no λ, μ, Φ*", outside.isdisjoint(whole)
    yield "and p1, p2, p3 as they are: any control", set(thrust) < outside
    yield "ν0 drops out too: its rate is 0", reduction.gauge_rate() == 0


@claim("(11)", "rates of v1, r, c", verdict="holds")
def translation() -> Equality:
    printed = {r"\dot v_1": c**2 / r**3 - gravity / r**2 + p1, r"\dot r": v1, r"\dot c": r * p2}
    return Equality(printed, lambda: rates(v1, r, c))


@claim("(12)", "rates of s1 and ρ", verdict="holds")
def radial_costates() -> Equality:
    printed = {
        r"\dot s_1": -rho,
        r"\dot\rho": ((3 * c**2 / r - 2 * gravity) * s1 + c * nu3) / r**3 - e * p2 - nu1 * p3 / (2 * c),
    }
    return Equality(printed, lambda: rates(s1, rho))


@claim("(13)", "rate of e", verdict="holds")
def areal_costate() -> Equality:
    printed = -(2 * c * s1 / r + nu3 / 2) / r**2 + r * nu1 * p3 / (2 * c**2)
    return Equality({r"\dot e": printed}, lambda: rates(e)[0])


@claim("(14)", "rates of ν1, ν2, ν3", verdict="holds")
def nu_rates() -> Equality:
    printed = {
        r"\dot\nu_1": c * nu2 / r**2,
        r"\dot\nu_2": -c * nu1 / r**2 + r * nu3 * p3 / c,
        r"\dot\nu_3": -r * nu2 * p3 / c,
    }
    return Equality(printed, lambda: rates(*nu))


@claim.proof("after (14): order", "(11) to (14) and φ*' form a system of order ten")
def order_ten() -> Steps:
    yield "ten variables", len(reduction.REDUCED) == len(reduction.rates()) == 10
    n = dict(zip(thrust, principle.optimal_thrust("saturated"), strict=True))
    closed = [rate.subs(n) for rate in reduction.rates()]
    outside = set().union(*(rate.free_symbols for rate in closed)) - set(reduction.REDUCED)
    yield "with the optimal thrust they are closed", outside.isdisjoint((*attitude, *mu, *thrust, nu0))
    yield "φ*' contains φ* alone", set(reduction.REDUCED) & rates(anomaly)[0].free_symbols == {anomaly}
    yield (
        "and no other rate contains φ*",
        not any(rate.has(anomaly) for x, rate in zip(reduction.REDUCED, closed, strict=True) if x != anomaly),
    )


@claim.proof(
    "after (14): eleven",
    "ten arbitrary constants appear, and t_k is the eleventh unknown",
    remark="The ten constants are those of (11) to (14) and φ*'. A twelfth unknown, C_φ, comes with (16); "
    "the paper does not count it in what follows. The law (n, p) = α1 + α2p² at t_k takes the place "
    "of (16) and (17) and does not contain C_φ.",
)
def eleven_unknowns() -> Steps:
    closed = reduction.rates().subs(dict(zip(thrust, principle.optimal_thrust("saturated"), strict=True)))
    changing = {*principle.STATE, *principle.COSTATE, *nu, anomaly_constant}
    inside = closed.free_symbols & changing
    yield "ten rates of ten variables, in nothing else that changes", inside <= set(reduction.REDUCED)
    start = dict.fromkeys(reduction.REDUCED, sp.Rational(1, 2))
    smooth = closed.jacobian(reduction.REDUCED).subs(start)
    yield (
        "their derivatives are finite where n ≠ 0: one motion for each ten values at t0",
        not smooth.has(sp.zoo, sp.nan, sp.oo),
    )
    law = terminal.hamiltonian_at_a_meeting()
    yield "(16) put into (17) leaves no C_φ", not law.has(anomaly_constant)


@claim(
    "before (15)",
    "(5), (15), (16) and (17) determine six unknown constants and t_k",
    verdict="false",
    remark="With C_φ there are eight unknowns. (5), (16) and (17) are five conditions, and (15) counts for "
    "two, since |ν| is constant: seven in all. One-parameter families satisfy all of them, see the "
    "entry on the conclusion.",
)
def six_unknowns() -> Refutation:
    def counterexample() -> Steps:
        yield "C_φ is in (16), with the factor 1", transversality.condition().diff(anomaly_constant) == 1
        yield "and none of the ten variables", anomaly_constant not in reduction.REDUCED
        member = meetings.INCLINED[0]
        other = meetings.residual_of_16(member, meetings.outcome(member).anomaly_constant + 1)
        yield (
            f"a meeting, the same ten constants and t_k, C_φ + 1: (16) leaves {other:.9f}",
            abs(other - 1) < 1e-9,
        )
        found = meetings.singular_values(meetings.INCLINED[0], repaired=False)
        yield "eight conditions, eight unknowns: ρ, s1, e, ν, t_k, C_φ", len(found) == 8
        yield (
            f"at a meeting their Jacobian has the singular values {found[0]:.0f} ... {found[-2]:.3f}, "
            f"{found[-1]:.0e}",
            found[-1] < 1e-7 < 1e-2 < found[-2],
        )
        pair = meetings.INCLINED[:2]
        outcomes = [meetings.outcome(member) for member in pair]
        left = max(outcome.printed_conditions for outcome in outcomes)
        yield f"two sets of constants leave {left:.1e} in all of them", left < meetings.ROUNDING
        apart = max(abs(a - b) for a, b in zip(pair[0].costates, pair[1].costates, strict=True))
        yield f"and differ by {apart:.2f}", apart > 0.1

    return Refutation(counterexample)
