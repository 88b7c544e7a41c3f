"""Section 2, the conditions at the end: (15) to (17), and the conclusion."""

import sympy as sp

from pontryagin.evidence import Consequence, Equality, Misprint, Proof, Refutation, Steps, vanishes
from pontryagin.ledger import Page
from pontryagin.rendezvous.claims import meetings
from pontryagin.rendezvous.claims.statement import at_unit_norm, growth
from pontryagin.rendezvous.derivation import (
    forms,
    model,
    primer,
    principle,
    reduction,
    repair,
    terminal,
    transversality,
)
from pontryagin.rendezvous.derivation.model import (
    anomaly,
    areal,
    attitude,
    c,
    eccentricity,
    gravity,
    parameter,
    r,
    thrust,
    v1,
)
from pontryagin.rendezvous.derivation.principle import energy_weight, nu, rho, s1, time_weight
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, pure, turn, vect
from pontryagin.rendezvous.derivation.reduction import anomaly_constant

claim = Page("Pimkina & Chelnokov")

e = principle.e
nu1, _, nu3 = nu
p1, p2, p3 = thrust
tilde = conjugate(attitude)


@claim(
    "(15)",
    "what is equal at t_k and t0: λ~∘ν∘λ~",
    verdict="misprint",
    remark="Printed, or so the scan shows: a tilde over all four λ. Right: λ∘ν∘λ~, the integral ν*. At t_k, "
    "λ*(t_k) has to stand for λ(t_k), or it says nothing of the meeting.",
)
def equal_at_both_ends():
    key = r"\bar\nu^*"
    vector = pure(nu)
    printed = product(tilde, vector, tilde).expand()

    def consequence() -> Consequence:
        # On the unit circle lambda turns about i3 by t, and nu = i3 is constant.
        quarter = dict(zip(attitude, turn(model.EZ, sp.pi / 2), strict=True)) | {nu[0]: 0, nu[1]: 0, nu3: 1}
        start = dict(zip(attitude, (1, 0, 0, 0), strict=True)) | {nu[0]: 0, nu[1]: 0, nu3: 1}
        return Consequence(
            "the scalar part a quarter of the unit circle after t0, for ν = i3",
            printed[0].subs(quarter),
            printed[0].subs(start),
        )

    def derived():
        # nu* = mu o lambda~, with mu = lambda o nu.
        lifted = dict(zip(principle.mu, reduction.lifted(), strict=True))
        return {key: reduction.invariant().subs(lifted)}

    return Misprint(
        {key: printed},
        derived,
        defect={key: (printed - product(attitude, vector, tilde)).expand()},
        consequence=consequence,
        display=r"\tilde{\bar\lambda}(t_k)\circ\bar\nu(t_k)\circ\tilde{\bar\lambda}(t_k) = "
        r"\tilde{\bar\lambda}(t_0)\circ\bar\nu(t_0)\circ\tilde{\bar\lambda}(t_0)",
    )


@claim(
    "(15): origin",
    "it follows from (6) and the integral ν*",
    verdict="holds",
    remark="It does not imply (6).",
)
def origin_of_15():
    def argument() -> Steps:
        for k, part in enumerate(reduction.invariant()):
            moves = reduction.along(part)
            yield f"component {k} of λ∘ν∘λ~ is constant", vanishes(sp.expand(sp.simplify(moves)))
        seen = product(attitude, pure(nu), tilde)
        opposite = dict(zip(attitude, -attitude, strict=True))
        other = (seen - seen.subs(opposite, simultaneous=True)).applyfunc(sp.expand)
        yield "λ = −λ* gives the same as λ = λ*", other.is_zero_matrix

    return Proof(argument)


@claim("(16)", "transversality at the moving end", verdict="holds")
def moving_end():
    key = "0"
    bracket = eccentricity * areal / parameter * s1 * sp.cos(anomaly) + nu3 / 2
    printed = anomaly_constant + parameter * eccentricity * rho * sp.sin(anomaly) + growth**2 * bracket

    def argument() -> Steps:
        cartesian = primer.transversality_condition() * growth**2
        at_end = transversality.condition().subs(transversality.end_values())
        yield "Cartesian coordinates give the same", vanishes(sp.simplify(cartesian - at_end))

    return Proof(
        argument,
        Equality({key: printed}, lambda: {key: transversality.condition()}),
        display=r"C_\varphi + p^* e^*\rho(t_k)\sin\varphi_k^* + (1 + e^*\cos\varphi_k^*)^2\Bigl[\frac{e^* "
        r"c^*}{p^*}s_1(t_k)\cos\varphi_k^* + \frac12\nu_3(t_k)\Bigr] = 0",
    )


@claim("after (16): C_φ", "C_φ is a constant of integration", verdict="holds")
def constant_of_integration():
    def argument() -> Steps:
        found = reduction.anomaly_integral()
        yield "C_φ = Φ*(1 + e* cos φ*)² is constant", vanishes(sp.simplify(reduction.along(found)))
        yield (
            "with Φ* it is the same unknown",
            vanishes(reduction.anomaly_costate_of() * growth**2 - anomaly_constant),
        )

    return Proof(argument, display=r"C_\varphi = \Phi^*(1 + e^*\cos\varphi^*)^2")


@claim("(17)", "the integral H⁰, zero since t_k is free", verdict="holds")
def hamiltonian():
    key = "H^0"
    printed = (
        -(time_weight + energy_weight * (p1**2 + p2**2 + p3**2))
        + rho * v1
        + s1 * (c**2 / r**3 - gravity / r**2 + p1)
        + e * r * p2
        + r * nu1 * p3 / (2 * c)
        + c * nu3 / (2 * r**2)
        + areal * anomaly_constant / parameter**2
    )

    def argument() -> Steps:
        yield (
            "H does not hold t: it is constant",
            vanishes(principle.in_nu(reduction.along(principle.hamiltonian()))),
        )
        yield (
            "Cartesian coordinates give the same H",
            vanishes(sp.simplify(primer.hamiltonian() - reduction.hamiltonian())),
        )
        slope = terminal.cost_slope("unsaturated")
        length = terminal.switching_length
        yield (
            "H = 0 is dJ/dt_k = α1 − α2p² = 0 with p = |n|/(2α2) at the end",
            vanishes(slope - (time_weight - energy_weight * (length / (2 * energy_weight)) ** 2)),
        )

    return Proof(
        argument,
        Equality({key: printed}, lambda: {key: reduction.hamiltonian()}),
        display=r"H^0 = -(\alpha_1 + \alpha_2 p^{02}) + \rho v_1 + s_1\Bigl(\frac{c^2}{r^3} - "
        r"\frac{fM}{r^2} + p_1^0\Bigr) + e r p_2^0 + \frac{r\nu_1 p_3^0}{2c} + \frac{c\nu_3}{2r^2} + "
        r"\frac{c^* C_\varphi}{p^{*2}} = 0",
    )


@claim(
    "conclusion: reduced",
    "the boundary value problem of 16 equations is reduced to one of ten",
    verdict="false",
    remark="(15) compares two vectors of equal length: rank 2, where (6) has rank 3. The turn about ν* is "
    "lost, in one plane the whole place on the orbit. Families of false meetings satisfy (5), (15), (16) and "
    "(17) to rounding; one that is 20° ahead even costs less than the true one. Repair: an eleventh "
    "equation, χ' = c/r² + (r p3/c) ν1/(|ν| + ν3), and χ(t_k) from λ*.",
)
def reduced_problem():
    def counterexample() -> Steps:
        yield from rank_of_15()
        for members in (meetings.COPLANAR, meetings.INCLINED):
            yield from meetings.true_meeting(members)
            yield from meetings.false_meetings(members)
        true, cheap = (meetings.outcome(member).cost for member in meetings.COPLANAR[:2])
        yield (
            f"the false meeting 20° ahead has J = {cheap:.4f}, the true one {true:.4f}",
            cheap < 0.75 * true,
        )
        yield from repaired()

    return Refutation(counterexample)


def rank_of_15() -> Steps:
    """(6) sees three turns, (15) two."""
    yield "by small turns of λ, (6) has rank 3", repair.change_of_mismatch().rank() == 3
    seen = repair.change_of_invariant()
    yield "(15) has rank 2", seen.rank() == 2 and sp.expand(seen.det()) == 0
    (blind,) = seen.nullspace()
    yield "it does not see turns about ν", vanishes(blind.cross(nu))
    angle, axis = sp.Symbol("delta", real=True), sp.Matrix([0, 0, 1])
    turned = product(turn(axis, angle), attitude)
    aligned = product(tilde, pure(axis), attitude)
    kept = vect(product(turned, aligned, conjugate(turned))) - axis
    yield (
        "nor large ones: λ turned about ν* by any δ leaves ν* = i3 as it is",
        all(vanishes(sp.simplify(at_unit_norm(part))) for part in kept),
    )


def repaired() -> Steps:
    """chi, the eleventh variable, and what the conditions become."""
    charts: tuple[tuple[repair.Chart, str], ...] = ((1, "ν3 = −|ν|"), (-1, "ν3 = |ν|"))
    for chart, name in charts:
        whole = repair.turning(chart)
        yield f"λ = S∘(turn by χ)∘T~ solves (3), regular off {name}", vanishes(sp.Matrix(whole[:3]))
        expected = c / r**2 + chart * r * p3 / c * nu1 / (repair.length + chart * nu3)
        yield (
            f"with χ' = c/r² ± (r p3/c)ν1/(|ν| ± ν3), ± = {chart:+d}",
            vanishes(repair.chi_rate(chart) - expected),
        )
    at_end = terminal.law().subs(transversality.end_values())
    yield (
        "(16) and (17) with (5) come to (n, p) = α1 + α2p²",
        vanishes(sp.simplify(terminal.hamiltonian_at_a_meeting() - at_end)),
    )
    found = meetings.singular_values(meetings.INCLINED[0], repaired=True)
    yield f"(5), (6) and that law have rank 7: least singular value {found[-1]:.4f}", found[-1] > 1e-3


@claim(
    "conclusion: simpler",
    "the right-hand sides have become simpler",
    verdict="holds",
    remark="With the eleventh equation too.",
)
def simpler():
    def argument() -> Steps:
        for mode in ("unsaturated", "saturated"):
            systems = (forms.full(mode), forms.repaired(mode), forms.reduced(mode))
            sixteen, eleven, ten = (sum(sp.count_ops(rate) for rate in form.rates) for form in systems)
            yield (
                f"{mode}: {sixteen} operations in 16 equations, {eleven} in 11, {ten} in 10",
                (ten < eleven < sixteen / 2),
            )
            shared = [sum(sp.count_ops(part) for part in evaluated(form)) for form in systems]
            yield (
                f"what occurs twice counted once: {shared[0]}, {shared[1]}, {shared[2]}",
                shared[2] < shared[1] < shared[0],
            )

    return Proof(argument)


def evaluated(form: forms.Form) -> list[sp.Expr]:
    """What is evaluated when subexpressions that occur twice are evaluated once."""
    parts, rest = sp.cse(form.rates)
    return [part for _, part in parts] + list(rest)
