"""Section 1, after (1.12): minimal element, duality and Krasovskii's principle, (1.13) and (1.14)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, Evidence, RightSides, Sides, Steps, vanishes
from pontryagin.triple_integrator.claims.energy import gramian_is_definite, silent_control
from pontryagin.triple_integrator.claims.turn import (
    BANG_BANG,
    IMPULSE_DUAL,
    IMPULSES,
    PEAK_DUAL,
    TURN,
    unit_turn,
)
from pontryagin.triple_integrator.derivation import chebyshev, energy
from pontryagin.triple_integrator.derivation.channel import drive, kick
from pontryagin.triple_integrator.derivation.chebyshev import three_impulses
from pontryagin.triple_integrator.derivation.duality import (
    area_of,
    conjugate_norm,
    dual_function_of,
    lengths,
    levels,
    peak_of,
    piecewise_moments,
)
from pontryagin.triple_integrator.derivation.model import T, c, impulse_response, moments_of, multipliers, s

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
v1, v2 = levels
T1, T2 = lengths


@claim.proof("after (1.11): minimal element", "a minimal element h0 of P exists, with 0 < ρ0 = ‖h0‖ ≤ ‖h‖")
def minimal_element_exists() -> Steps:
    yield "h = 0 only for l = 0, so ‖l'h‖ is a norm of l", gramian_is_definite()
    yield "l = 0 is not on the plane l'c = 1: least positive there", (sp.zeros(1, 3) * c)[0] != 1
    element = energy.minimal_element().subs(unit_turn())
    size = sp.sqrt(sp.integrate(sp.expand(element**2), (s, 0, 1)))
    yield "L2, unit turn: ρ0 = 1/√720", vanishes(size - 1 / sp.sqrt(720))
    steered = piecewise_moments(BANG_BANG)
    yield "L1: a control of peak 32 makes the turn, so no ‖h‖ is below 1/32", steered == TURN
    yield "and one is 1/32", area_of(dual_function_of(PEAK_DUAL), sp.S.One) == R(1, 32)
    turned = three_impulses(IMPULSES)
    yield "L∞: impulses of total 16 make it, so no ‖h‖ is below 1/16", turned == TURN
    yield "and one is 1/16", peak_of(dual_function_of(IMPULSE_DUAL), sp.S.One) == R(1, 16)


@claim(
    "after (1.12): Φ on P", "a functional that solves the moment problem is 1 on all of P", verdict="holds"
)
def functional_on_the_dual_set() -> Evidence:
    def derived() -> RightSides:
        program = energy.minimum_energy_control()
        h = (multipliers.T * impulse_response())[0]
        paired = sp.expand(sp.integrate(sp.expand(h * program), (s, 0, T)))
        third = sp.solve((multipliers.T * c)[0] - 1, multipliers[2])[0]
        return sp.simplify(paired.subs(multipliers[2], third))

    return Equality({r"\Phi(h(\cdot))": sp.S.One}, derived)


@claim.proof("after (1.12): criterion", "the moment problem is solvable if and only if ρ0 > 0")
def solvable_where_norm_is_positive() -> Steps:
    program = energy.minimum_energy_control()
    yield "independent h_k: ρ0 > 0, and solvable", vanishes(moments_of(program) - c)
    level, slope = sp.symbols("k_0 k_1", real=True)
    dependent = sp.Matrix([s, 2 * s, 1])
    moments = dependent.applyfunc(lambda h: sp.integrate(h * (level + slope * s), (s, 0, T)))
    wrong = sp.Matrix([1, 1, 0])
    witness = sp.Matrix([2, -1, 0])
    yield (
        "dependent h_k: an l with l'c = 1 whose h is zero, so ρ0 = 0",
        ((witness.T * wrong)[0] == 1 and (witness.T * dependent)[0] == 0),
    )
    yield "no control has the moments that belong to such h_k", vanishes((witness.T * moments)[0])


@claim.proof(
    "after (1.12): estimate",
    "‖Φ‖ ≥ 1/ρ0 for every functional that solves the moment problem",
    display=r"\lVert \Phi \rVert_{L_p^*} \ge \frac{1}{\rho_0}",
)
def norm_estimate() -> Steps:
    program, noise = energy.minimum_energy_control(), silent_control()
    cross = sp.integrate(sp.expand(noise * program), (s, 0, T))
    yield "L2: any other control is u* + n with n orthogonal to u*", vanishes(cross) and noise != 0
    own = sp.integrate(sp.expand(program**2), (s, 0, T))
    yield "and ‖u*‖ = 1/ρ0", vanishes(own - 1 / energy.dual_norm() ** 2)
    h1, h2 = sp.symbols("h_1 h_2", real=True)
    room = (T1 * v1**2 + T2 * v2**2) * (T1 * h1**2 + T2 * h2**2) - (T1 * v1 * h1 + T2 * v2 * h2) ** 2
    yield (
        "in general 1 = Φ(h0) ≤ ‖Φ‖ρ0 by Hölder; on two levels ‖u‖²‖h‖² − (∫hu)² = T1T2(v1h2 − v2h1)²",
        (vanishes(room - T1 * T2 * (v1 * h2 - v2 * h1) ** 2)),
    )


@claim("before (1.13): norm of Φ0", "the optimal functional has the norm 1/ρ0", verdict="holds")
def norm_of_the_optimum() -> Evidence:
    key = r"\lVert \Phi_0 \rVert"
    keys = [f"{key}_{{L_{p}^*}}" for p in ("2", "1", r"\infty")]

    def derived() -> Sides:
        program = energy.minimum_energy_control().subs(unit_turn())
        in_l2 = sp.sqrt(sp.integrate(sp.expand(program**2), (s, 0, 1)))
        return dict(
            zip(
                keys,
                (in_l2, sp.Integer(max(abs(v) for _, v in BANG_BANG)), sp.Integer(4 + 8 + 4)),
                strict=True,
            )
        )

    element = energy.minimal_element().subs(unit_turn())
    norms = (
        sp.sqrt(sp.integrate(sp.expand(element**2), (s, 0, 1))),
        area_of(dual_function_of(PEAK_DUAL), sp.S.One),
        peak_of(dual_function_of(IMPULSE_DUAL), sp.S.One),
    )
    return Equality(
        {k: 1 / norm for k, norm in zip(keys, norms, strict=True)},
        derived,
        display=r"\lVert \Phi_0 \rVert_{L_p^*} = \frac{1}{\rho_0}",
    )


@claim(
    "before (1.13): isometry",
    "the dual of L_p is isometric to L_q, so min ‖u‖ = min ‖Φ‖ = 1/ρ0, for all 1 ≤ q ≤ ∞",
    verdict="conditional",
    remark="True for 1 < q ≤ ∞. For q = 1 the dual of L_∞ is larger than L_1: already in example 1 the "
    "infimum 16γ/T² = 1/ρ0 over controls in L_1 is attained by no integrable control, only by impulses.",
)
def isometry() -> Evidence:
    def argument() -> Steps:
        for n in (sp.S(2), R(3, 2), sp.S(3), sp.oo):
            size = conjugate_norm(n).subs({T1: 1, T2: 1, v1: 0})
            yield (
                f"q = {n}: the norm of a functional is that of its control, here |v|",
                vanishes(size - sp.Abs(v2)),
            )
        yield "q = 2: the minimum 1/ρ0 is attained", vanishes(moments_of(energy.minimum_energy_control()) - c)
        yield "q = ∞: likewise", piecewise_moments(BANG_BANG) == TURN

    def counterexample() -> Steps:
        h = dual_function_of(IMPULSE_DUAL)
        yield "unit turn: ∫ h u = 1 for every u that makes it", (IMPULSE_DUAL.T * TURN)[0] == 1
        room = sp.factor(R(1, 16) ** 2 - h**2)
        touching = sp.Poly(room, s).real_roots()
        yield "|h| = 1/16 at three instants only", set(touching) == {0, R(1, 2), 1}
        between = [room.subs(s, x) for x in (R(1, 4), R(3, 4))]
        yield "|h| is smaller between them: hence 1 < ‖u‖/16 for every integrable u", min(between) > 0
        turned = three_impulses(IMPULSES)
        yield "impulses of total 16 make the turn, and narrow pulses approach them", turned == TURN
        width = sp.Symbol("epsilon", positive=True)
        pulses = sum(
            (
                chebyshev.spike(a, b, w)
                for a, b, w in ((0, width, 4), ((T - width) / 2, (T + width) / 2, -8), (T - width, T, 4))
            ),
            sp.zeros(3, 1),
        ).subs(T, 1)
        reached = pulses.applyfunc(lambda x: sp.limit(x, width, 0))
        yield "the pulses reach the target as their width goes to 0", reached == TURN

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\min_{u(\cdot)} \lVert u(\cdot) \rVert_{L_q} = \min_{\Phi} \lVert \Phi \rVert_{L_p^*} "
        r"= \frac{1}{\rho_0}",
    )


@claim.proof(
    "(1.13)",
    "the dual problem: least norm of h = l'Φ(tf, τ)b on l'c = 1",
    display=r"\min_{l^T c = 1} \lVert l^T \Phi(t_f, \cdot)\mathbf{b} \rVert_{L_p} = \rho_0",
)
def dual_problem() -> Steps:
    third = sp.solve((multipliers.T * c)[0] - 1, multipliers[2])[0]
    square = sp.integrate(sp.expand((multipliers.T * impulse_response())[0] ** 2), (s, 0, T))
    reduced = sp.expand(square.subs(multipliers[2], third))
    free = list(multipliers[:2])
    least = sp.solve([reduced.diff(l) for l in free], free, dict=True)[0]
    control = sp.integrate(sp.expand(energy.minimum_energy_control() ** 2), (s, 0, T))
    yield (
        "L2: with l3 eliminated, the least ‖h‖² is 1/‖u*‖²",
        vanishes(sp.simplify(1 / reduced.subs(least)) - control),
    )
    reached = piecewise_moments(BANG_BANG)
    yield (
        "L1, unit turn: ‖h‖ = 1/32 for a control of peak 32 with ∫ h u = 1",
        ((PEAK_DUAL.T * reached)[0] == 1 and area_of(dual_function_of(PEAK_DUAL), sp.S.One) == R(1, 32)),
    )


@claim.proof(
    "(1.14)",
    "Krasovskii's principle: a unique u of norm 1/ρ0 with the largest ∫h0 u is optimal",
    display=r"\max_{\lVert u(\cdot) \rVert_{L_q} = 1/\rho_0} \int_{t_0}^{t_f} h_0(\tau)u(\tau)\,d\tau = "
    r"1",
)
def krasovskii_principle() -> Steps:
    p, q = sp.S(3), R(3, 2)
    size = T1 * sp.Abs(v1) ** p + T2 * sp.Abs(v2) ** p
    best = [sp.Abs(v) ** (p - 1) * sp.sign(v) / size for v in levels]
    numbers = {v1: 2, v2: -3, T1: 1, T2: 2}
    paired = (T1 * v1 * best[0] + T2 * v2 * best[1]).subs(numbers)
    yield "u = ρ0^(−p) |h0|^(p−1) sign h0 has ∫ h0 u = 1 (h0 of two levels, p = 3)", paired == 1
    powers = sum(n * sp.Abs(u) ** q for n, u in zip(lengths, best, strict=True)).subs(numbers)
    yield "its norm is 1/ρ0: with p = 2q, (∫ |u|^q)² ∫ |h0|^p = 1", powers**2 * size.subs(numbers) == 1
    paired = energy.stationary()[1].T * moments_of(energy.minimum_energy_control())
    yield "q = 2: ∫ h0 u* = 1", vanishes(paired[0] - 1)
    yield "u* has the moments c", vanishes(moments_of(energy.minimum_energy_control()) - c)
    h = dual_function_of(PEAK_DUAL)
    signs = [sp.sign(h.subs(s, x)) for x in (R(1, 8), R(1, 2), R(7, 8))]
    yield (
        "q = ∞, unit turn: 32 sign h0 is the control that makes it",
        signs == [sp.sign(v) for _, v in BANG_BANG] and piecewise_moments(BANG_BANG) == TURN,
    )


@claim(
    "after (1.14)",
    "for J = ‖u‖ in L_q the problem is solved by (1.13) and then (1.14)",
    verdict="conditional",
    remark="True for 1 < q ≤ ∞, where (1.14) has one solution. For q = 1 it has many (or none in L_1) and "
    "does not fix the amplitudes: the moments are needed as well, as the paper does before (4.10).",
)
def two_problems_in_turn() -> Evidence:
    def argument() -> Steps:
        h = dual_function_of(PEAK_DUAL)
        yield (
            "q = ∞: h0 is a polynomial, zero at isolated instants, so sign h0 is one control",
            sp.degree(h, s) == 2,
        )
        x, y = sp.symbols("x y", real=True)
        middle = sp.expand((x**2 + y**2) / 2 - ((x + y) / 2) ** 2 - ((x - y) / 2) ** 2)
        yield "q = 2: two solutions would have a mean of smaller norm", vanishes(middle)

    def counterexample() -> Steps:
        h = dual_function_of(IMPULSE_DUAL)
        yield "q = 1, unit turn: one impulse of 16 at τ = 0 has ∫ h0 u = 1", 16 * h.subs(s, 1) == 1
        yield "and norm 1/ρ0 = 16", 1 / peak_of(h, sp.S.One) == 16
        missed = drive(kick(sp.zeros(3, 1), sp.Integer(16)), sp.S.One, sp.S.Zero)
        yield (
            "that impulse takes the craft to (8, 16, 16), not to (1, 0, 0)",
            missed == sp.Matrix([8, 16, 16]),
        )

    return Conditional(argument, counterexample=counterexample)
