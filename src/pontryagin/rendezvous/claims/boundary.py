"""Section 2, the conditions at the end: (15), (16), (17)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Consequence,
    Equality,
    Misprint,
    Proof,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.claims.statement import growth
from pontryagin.rendezvous.derivation import (
    model,
    primer,
    principle,
    reduction,
    terminal,
    transversality,
    variation,
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
from pontryagin.rendezvous.derivation.principle import (
    energy_weight,
    nu,
    rho,
    s1,
    switching_length,
    thrust_magnitude,
    time_weight,
)
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, pure, turn
from pontryagin.rendezvous.derivation.reduction import anomaly_constant

claim = Page("Pimkina & Chelnokov")

e = principle.e
nu1, _, nu3 = nu
p1, p2, p3 = thrust
tilde = conjugate(attitude)


@claim(
    "(15)",
    "λ~∘ν∘λ~ has the same value at t_k and at t0",
    verdict="misprint",
    remark="Printed, as far as the scan shows: a tilde over all four λ. Right: λ∘ν∘λ~, the integral ν*, as "
    "ν* = μ∘λ~ before (11) gives it. The scan was read by machine: bars and tildes are right in all "
    "other products, but it cannot be excluded that here a bar was twice taken for a tilde. At t_k, "
    "λ*(t_k) has to replace λ(t_k), or (15) says nothing about the meeting.",
)
def equal_at_both_ends() -> Misprint:
    key = r"\bar\nu^*"
    vector = pure(nu)
    printed = product(tilde, vector, tilde).expand()

    def consequence() -> Consequence:
        # On the unit circle lambda rotates about i3 by the angle t, and nu = i3 is constant.
        quarter = dict(zip(attitude, turn(model.EZ, sp.pi / 2), strict=True)) | {nu[0]: 0, nu[1]: 0, nu3: 1}
        start = dict(zip(attitude, (1, 0, 0, 0), strict=True)) | {nu[0]: 0, nu[1]: 0, nu3: 1}
        return Consequence(
            "the scalar part a quarter of the unit circle after t0, for ν = i3",
            printed[0].subs(quarter),
            printed[0].subs(start),
        )

    def derived() -> RightSides:
        # nu* = mu o lambda~, with mu = lambda o nu.
        lifted = dict(zip(principle.mu, reduction.lifted(), strict=True))
        return reduction.invariant().subs(lifted)

    return Misprint(
        {key: printed},
        derived,
        defect={key: (printed - product(attitude, vector, tilde)).expand()},
        consequence=consequence,
        display=r"\tilde{\bar\lambda}(t_k)\circ\bar\nu(t_k)\circ\tilde{\bar\lambda}(t_k) = "
        r"\tilde{\bar\lambda}(t_0)\circ\bar\nu(t_0)\circ\tilde{\bar\lambda}(t_0)",
    )


@claim.proof("(15): origin", "(15) follows from (6) and the integral ν*", remark="(15) does not imply (6).")
def origin_of_15() -> Steps:
    for k, part in enumerate(reduction.invariant()):
        moves = reduction.along(part)
        yield f"component {k} of λ∘ν∘λ~ is constant", vanishes(sp.expand(sp.simplify(moves)))
    seen = product(attitude, pure(nu), tilde)
    opposite = dict(zip(attitude, -attitude, strict=True))
    other = (seen - seen.subs(opposite, simultaneous=True)).applyfunc(sp.expand)
    yield "λ = −λ* gives the same as λ = λ*", other.is_zero_matrix


@claim("(16)", "transversality at the moving end", verdict="holds")
def moving_end() -> Proof:
    bracket = eccentricity * areal / parameter * s1 * sp.cos(anomaly) + nu3 / 2
    printed = anomaly_constant + parameter * eccentricity * rho * sp.sin(anomaly) + growth**2 * bracket

    def argument() -> Steps:
        cartesian = primer.transversality_condition() * growth**2
        at_end = transversality.condition().subs(transversality.end_values())
        yield "Cartesian coordinates give the same", vanishes(sp.simplify(cartesian - at_end))
        factor = variation.of_a_meeting().coeff(variation.anomaly_shift)
        in_constant = factor.subs(principle.anomaly_costate, reduction.anomaly_costate_of())
        yield (
            "and so does the first variation: it is the factor of dφ*_k in dJ, times (1 + e* cos φ*)²",
            vanishes(sp.simplify(in_constant * growth**2 - transversality.condition())),
        )

    return Proof(
        argument,
        Equality({"0": printed}, transversality.condition),
        display=r"C_\varphi + p^* e^*\rho(t_k)\sin\varphi_k^* + (1 + e^*\cos\varphi_k^*)^2\Bigl[\frac{e^* "
        r"c^*}{p^*}s_1(t_k)\cos\varphi_k^* + \frac12\nu_3(t_k)\Bigr] = 0",
    )


@claim.proof(
    "after (16): C_φ",
    "C_φ is a constant of integration",
    display=r"C_\varphi = \Phi^*(1 + e^*\cos\varphi^*)^2",
)
def constant_of_integration() -> Steps:
    found = reduction.anomaly_integral()
    yield "C_φ = Φ*(1 + e* cos φ*)² is constant", vanishes(sp.simplify(reduction.along(found)))
    pair = reduction.anomaly_costate_of() * model.anomaly_rate()
    yield (
        "Φ*φ*' is c*C_φ/p*², the last term of (17)",
        vanishes(pair - areal * anomaly_constant / parameter**2),
    )


@claim("(17)", "the integral H⁰ is zero, since t_k is free", verdict="holds")
def hamiltonian() -> Proof:
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
        modes: tuple[tuple[principle.Mode, str], ...] = (
            ("unsaturated", "within the bound"),
            ("saturated", "on it"),
            ("time-optimal", "with α2 = 0"),
        )
        for mode, name in modes:
            rate = variation.energy_rate(mode)
            yield f"with the optimal thrust {name} put in, dH/dt = 0 along (11) to (14)", vanishes(rate)
        yield (
            "Cartesian coordinates give the same H",
            vanishes(sp.simplify(primer.hamiltonian() - reduction.hamiltonian())),
        )
        yield from variation_at_a_free_time()

    return Proof(
        argument,
        Equality({"H^0": printed}, reduction.hamiltonian),
        display=r"H^0 = -(\alpha_1 + \alpha_2 p^{02}) + \rho v_1 + s_1\Bigl(\frac{c^2}{r^3} - "
        r"\frac{fM}{r^2} + p_1^0\Bigr) + e r p_2^0 + \frac{r\nu_1 p_3^0}{2c} + \frac{c\nu_3}{2r^2} + "
        r"\frac{c^* C_\varphi}{p^{*2}} = 0",
    )


def variation_at_a_free_time() -> Steps:
    """Why H = 0 where t_k is free: the terms of dJ at t_k, and the integral."""
    gradient, moved = variation.gradient_by_thrust(), [variation.FAMILY[p].diff(variation.s) for p in thrust]
    rest = variation.rest_of_the_variation() + gradient.dot(moved)
    yield "dJ is (ψ, dx_k) − H dt_k and −∫(dH/dp, dp)dt", vanishes(rest)
    slope = principle.switching() - 2 * energy_weight * thrust
    within, on = (
        slope.subs(dict(zip(thrust, best, strict=True))).applyfunc(sp.simplify)
        for best in (principle.optimal_thrust("unsaturated"), principle.optimal_thrust("saturated"))
    )
    yield "within the bound dH/dp = 0", vanishes(within)
    yield "on it dH/dp lies along p, and dp across it", vanishes(on.cross(principle.switching()))
    end, later = variation.of_a_meeting(), variation.delay
    yield (
        "at a meeting the factor of dt_k is −H",
        vanishes(end.coeff(later) + principle.in_nu(principle.hamiltonian())),
    )
    arriving = end.subs(variation.anomaly_shift, model.anomaly_rate() * later)
    yield (
        "φ*_k arrives with t_k, dφ*_k = φ*' dt_k: Φ* drops out of dJ, and C_φ may be taken from (16)",
        not sp.expand(arriving).has(principle.anomaly_costate),
    )
    yield (
        "then dJ = −H dt_k, which a free t_k makes 0",
        vanishes(sp.simplify(variation.cost_slope() + terminal.hamiltonian_at_a_meeting())),
    )
    in_thrust = {switching_length: 2 * energy_weight * thrust_magnitude}
    rest = time_weight - energy_weight * thrust_magnitude**2
    yield (
        "within the bound dJ*/dt_k is α1 − α2p²",
        vanishes(terminal.cost_slope("unsaturated").subs(in_thrust) - rest),
    )
