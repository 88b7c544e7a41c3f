"""Section 1, from (1.11) to (1.12): norms, functionals, solvability."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    Proof,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.energy import gramian_is_definite
from pontryagin.triple_integrator.derivation import energy
from pontryagin.triple_integrator.derivation.channel import tau
from pontryagin.triple_integrator.derivation.duality import conjugate_norm, lengths, levels
from pontryagin.triple_integrator.derivation.model import (
    CHAIN,
    INPUT,
    T,
    c,
    impulse_response,
    moments_of,
    multipliers,
    s,
)

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
v1, v2 = levels
T1, T2 = lengths
p, q = sp.symbols("p q", positive=True)


def by_level(power: sp.Expr) -> sp.Expr:
    """Integral of |u|^power for a control that is v1 for the time T1 and v2 for the time T2."""
    return T1 * sp.Abs(v1) ** power + T2 * sp.Abs(v2) ** power


@claim("before (1.11): norm in L_q", "norm of the control in L_q, 1 ≤ q < ∞", verdict="holds")
def norm_in_lq() -> Evidence:
    exponents = (sp.S.One, sp.S(2), R(3, 2), sp.S(3))
    keys = {n: rf"\lVert u \rVert_{{L_{{{n}}}}}" for n in exponents}
    return Equality(
        {keys[n]: by_level(n) ** (1 / n) for n in exponents},
        lambda: {keys[n]: conjugate_norm(n) for n in exponents},
        display=r"\lVert u(\cdot) \rVert_{L_q} = \left(\int_{t_0}^{t_f} \left| u(\tau) \right|^q d\tau"
        r"\right)^{1/q}",
    )


@claim(
    "before (1.11): norm in L_∞",
    "norm of the control in L_∞",
    verdict="misprint",
    remark="Printed: vrai max u(t). Right: vrai max |u(t)|, as in (1.19). Without the modulus the constant "
    "control −2 would have the norm −2.",
)
def norm_in_linf() -> Evidence:
    key = r"\lVert u \rVert_{L_\infty}"
    two_levels = {v1: -2, v2: 1}
    printed = sp.Max(v1, v2)
    return Misprint(
        {key: printed},
        lambda: conjugate_norm(sp.oo),
        defect={key: sp.Max(v1, v2) - sp.Max(sp.Abs(v1), sp.Abs(v2))},
        consequence=lambda: Consequence(
            "norm of a control that is −2 and then 1", printed.subs(two_levels), sp.Integer(2)
        ),
        display=r"\lVert u(\cdot) \rVert_{L_\infty} = \operatorname{vrai\,max}_{t \in [t_0, t_f]} u(t)",
    )


@claim("before (1.11): exponents", "the spaces L_p and L_q are conjugate: 1/p + 1/q = 1", verdict="holds")
def conjugate_exponents() -> Evidence:
    # Hölder's best h is |u|^(q-1) sign u; its norm in L_p is a power of the same integral if p(q-1) = q.
    return Equality(
        {"p": sp.solve(sp.Eq(1 / p + 1 / q, 1), p)[0]},
        lambda: sp.solve(sp.Eq(p * (q - 1), q), p)[0],
        display=r"\frac1p + \frac1q = 1",
    )


@claim("(1.11)", "the moment equalities Φ(h_k) = c_k", verdict="holds")
def moment_equalities() -> Evidence:
    printed = {rf"\Phi(h_{k}(\cdot))": moment for k, moment in enumerate(c, start=1)}
    return Equality(printed, lambda: moments_of(energy.minimum_energy_control()))


@claim(
    "after (1.11): form of Φ",
    "every bounded functional on L_p is an integral with some u in L_q",
    verdict="conditional",
    remark="True for 1 ≤ p < ∞ (Riesz). For p = ∞ (q = 1, problem 3) it is false: the value at one "
    "instant, extended from the continuous functions, is bounded with norm 1 and is no integral "
    "with an integrable u. Functionals of this kind solve problem 3, see (4.9).",
)
def form_of_the_functional() -> Evidence:
    def argument() -> Steps:
        # For two levels the functional v -> w'v is the pairing with u = w/lengths, of the conjugate norm.
        w1, w2 = sp.symbols("w_1 w_2", real=True)
        represented = {v1: w1 / T1, v2: w2 / T2}
        paired = T1 * v1 * (w1 / T1) + T2 * v2 * (w2 / T2)
        yield (
            "a functional on steps (dense for p < ∞) is the integral with a step function",
            vanishes(paired - w1 * v1 - w2 * v2),
        )
        for n in (sp.S(2), R(3, 2), sp.oo):
            size = conjugate_norm(n).subs(represented, simultaneous=True)
            yield (
                f"the step function has a finite norm in L_{n}",
                size.has(w1) and not size.has(sp.zoo, sp.nan),
            )

    def counterexample() -> Steps:
        order, bound = sp.symbols("n U", positive=True)
        peaked = (1 - tau / T) ** order
        yield "h_n = (1 − τ/T)^n has the value 1 at τ = 0, for every n", peaked.subs(tau, 0) == 1
        area = sp.integrate((1 - tau) ** order, (tau, 0, 1))
        paired = bound * sp.simplify(area)
        yield (
            "its integral with any u of bound U is at most U T/(n + 1)",
            vanishes(paired - bound / (order + 1)),
        )
        yield "that bound goes to 0, not 1; bounded u are dense in L_1", sp.limit(paired, order, sp.oo) == 0

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\Phi(h(\cdot)) = \int_{t_0}^{t_f} h(\tau)u(\tau)\,d\tau",
    )


@claim.proof(
    "after (1.11): solvability",
    "the moment problem of the triple integrator is solvable for every c: h1, h2, h3 are independent",
)
def solvability() -> Steps:
    h = impulse_response()
    wronskian = sp.Matrix([[entry.diff(s, k) for entry in h] for k in range(3)]).det()
    yield "the Wronskian of h1, h2, h3 does not vanish", wronskian.is_nonzero
    controllability = sp.Matrix.hstack(INPUT, CHAIN * INPUT, CHAIN**2 * INPUT)
    yield "b, Ab, A²b span the state space", controllability.rank() == 3
    yield "the Gramian is positive definite for every T", gramian_is_definite()
    program = energy.minimum_energy_control()
    yield "a control with the moments c, for every c", vanishes(moments_of(program) - c)
    dependent = sp.Matrix([s, s, 1])
    moments = dependent.applyfunc(lambda h: sp.integrate(h * (v1 + v2 * s), (s, 0, T)))
    yield "with h1 = h2 only c1 = c2 could be met", vanishes(moments[0] - moments[1])


@claim("(1.12)", "the set P of dual functions h = Σ l_k h_k with Σ l_k c_k = 1", verdict="holds")
def dual_set() -> Evidence:
    def derived() -> RightSides:
        least = energy.stationary()[1]
        return (least.T * c)[0]

    def argument() -> Steps:
        spanned = sp.expand((multipliers.T * impulse_response())[0] - energy.minimal_element())
        found = sp.solve(sp.Poly(spanned, s).coeffs(), list(multipliers), dict=True)[0]
        yield "the least element of P is a combination of the h_k", len(found) == 3
        yield "the least element has l'c = 1", vanishes((multipliers.subs(found).T * c)[0] - 1)

    return Proof(argument, Equality({r"\sum_k l_k c_k": sp.S.One}, derived))
