"""Section 1, (1.4) to (1.8): the maximum principle."""

import sympy as sp

from pontryagin.averaging.derivation import principle, smooth
from pontryagin.averaging.derivation.principle import F, alpha, epsilon, f, g, h_star, omega, p, psi, q
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    RightSides,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

M, a = principle.M, principle.a


def cost_costate(transversality: sp.Expr) -> sp.Expr:
    """p_b at t1 in the smooth example, g = b and M = v - v1, from a condition for the second costate."""
    speed, paid = a
    concrete = {principle.g: paid, M: speed - 2}
    return transversality.subs(concrete).doit()


@claim("(1.4)", "Hamiltonian H = ωq + εh with h = (pf) + qF", verdict="holds")
def hamiltonian() -> Evidence:
    H = r"H"
    small = r"h"
    return Equality(
        {
            H: epsilon * (p[0] * f[0] + p[1] * f[1]) + q * (omega + epsilon * F),
            small: p[0] * f[0] + p[1] * f[1] + q * F,
        },
        lambda: {H: principle.hamiltonian(), small: principle.small_part()},
        display=r"H = \varepsilon(pf) + q(\omega + \varepsilon F) \equiv \omega q + \varepsilon h",
    )


@claim(
    "(1.5)",
    "where the optimum is unique, the maximum of H over U determines one control",
    verdict="conditional",
    remark="True where h is strictly concave in u, or where U is strictly convex and the vector that "
    "multiplies u is not zero. Uniqueness of the optimum alone is not enough: a1' = εu, |u| ≤ 1, a2' "
    "= ε, J = ∫a1²dτ, a1(0) = a2(0) = 0, M = a2 − 1 has the single optimum u = 0, along which H does "
    "not depend on u.",
)
def one_control() -> Evidence:
    control, costate, state = sp.symbols("u p_1 a_1", real=True)

    def argument() -> Steps:
        h = sp.Matrix([[smooth.eta, -1]]).dot(smooth.slow_rates())
        yield (
            "smooth example: ∂²h/∂u² = −2, one maximum, u = p/2",
            (h.diff(smooth.u, 2) == -2 and smooth.maximiser() == smooth.eta / 2),
        )
        angle = sp.Symbol("phi", real=True)
        size = sp.Symbol("s", positive=True)
        gain = size * sp.cos(angle)
        yield (
            "unit ball: s cos φ is largest at φ = 0 alone",
            sp.solveset(sp.Eq(gain, size), angle, sp.Interval.Lopen(-sp.pi, sp.pi)) == sp.FiniteSet(0),
        )

    def counterexample() -> Steps:
        h = costate * control + sp.Symbol("p_2") - state**2
        yield (
            "J = ∫a1²dτ ≥ 0 over 0 ≤ τ ≤ 1, and 0 for a1 = 0 alone: u = 0 is the one optimum",
            (sp.solve(state**2, state) == [0]),
        )
        yield "p1' = −ε∂h/∂a1 = 0 along a1 = 0, and p1(t1) = 0: p1 = 0", h.diff(state).subs(state, 0) == 0
        yield "so ∂h/∂u = 0: every u from −1 to 1 attains the maximum", h.diff(control).subs(costate, 0) == 0

    return Conditional(
        argument, counterexample=counterexample, display=r"u = u^*(a, \psi, p, q, \varepsilon)"
    )


@claim("(1.6): p'", "rate of the slow variables' costate", verdict="holds")
def costate_rate() -> Evidence:
    h = p[0] * f[0] + p[1] * f[1] + q * F
    return Equality(
        {r"\dot p_1": -omega.diff(a[0]) * q - epsilon * h.diff(a[0])},
        lambda: principle.costate_rates()[0],
        display=r"\dot p = -\frac{\partial H}{\partial a}\Bigr|_{u^*} = -\omega' q - \varepsilon "
        r"\frac{\partial h}{\partial a}\Bigr|_{u^*}",
    )


@claim(
    "(1.6): p(t1)",
    "transversality for the slow variables",
    verdict="misprint",
    remark="Printed without the terminal cost: p(t1) = −∂(αM)/∂a. Right: p(t1) = −∂(g + αM)/∂a. With the "
    "printed condition no control is better than another: in the smooth example the costate of the "
    "cost would be 0. The formula dJ0/dκ = −(η1 dξ1/dκ) before (2.14) needs the right form, and "
    "section 3 uses it.",
)
def transversality() -> Evidence:
    key = r"p_2(t_1)"

    def shown() -> Consequence:
        printed = cost_costate(-(alpha * M).diff(a[1]))
        required = cost_costate(principle.end_conditions()[0][1])
        return Consequence("costate of the cost b in the smooth example, g = b", printed, required)

    return Misprint(
        {key: -(alpha * M).diff(a[1])},
        lambda: principle.end_conditions()[0][1],
        defect={key: g.diff(a[1])},
        consequence=shown,
        display=r"p(t_1) = -\frac{\partial}{\partial a}(\alpha M)_{t_1}",
    )


@claim("(1.6): q", "rate of the phase's costate, and its value at the end", verdict="holds")
def phase_costate() -> Evidence:
    rate, ending = r"\dot q", "q(t_1)"
    h = p[0] * f[0] + p[1] * f[1] + q * F
    return Equality(
        {rate: -epsilon * h.diff(psi), ending: sp.S.Zero},
        lambda: {rate: principle.costate_rates()[2], ending: principle.end_conditions()[0][2]},
        display=r"\dot q = -\frac{\partial H}{\partial \psi}\Bigr|_{u^*} = -\varepsilon \frac{\partial "
        r"h}{\partial \psi}\Bigr|_{u^*},\quad q(t_1) = 0",
    )


@claim.proof(
    "(1.6): u*",
    "the derivatives of H may be taken with u held fixed, or after u* is inserted",
    display=r"\frac{\partial H}{\partial a}\Bigr|_{u^*}",
)
def envelope() -> Steps:
    for variable, rest in zip((*a, psi, *p, q), principle.envelope(), strict=True):
        yield f"dh(u*)/d{variable} = ∂h/∂{variable} + (∂h/∂u)(∂u*/∂{variable})", rest == 0
    h = sp.Matrix([[smooth.eta, -1]]).dot(smooth.slow_rates())
    yield "smooth example: ∂h/∂u = 0 at u*", vanishes(h.diff(smooth.u).subs(smooth.u, smooth.maximiser()))
    s = sp.Matrix(sp.symbols("s1 s2", real=True))
    best = s / s.norm()
    yield "unit ball, u* = s/|s| on its boundary: s·∂u*/∂s = 0", vanishes(best.jacobian(s).T * s)


@claim("(1.7)", "since the end time is free, H* = εh* = 0 at t1", verdict="holds")
def free_end() -> Evidence:
    h = p[0] * f[0] + p[1] * f[1]

    def derived() -> RightSides:
        ends, level = principle.end_conditions()
        return sp.expand(level.subs(q, ends[2]))

    return Equality(
        {"H^*|_{t_1}": epsilon * h},
        derived,
        display=r"H^*|_{t_1} = \varepsilon h(a, \psi, p, 0, u^*, \varepsilon)|_{t_1} = 0",
    )


@claim.proof(
    "(1.8)", "H* = ωq + εh* = 0 along the whole motion", display=r"H^* = \omega q + \varepsilon h^* = 0"
)
def conserved() -> Steps:
    H = omega * q + epsilon * h_star
    yield "the rate of H* along its canonical equations is 0", principle.along(H) == 0
    yield "h* alone is not constant", principle.along(h_star) != 0


@claim.proof(
    "after (1.8): standard form",
    "H* = 0 turns the canonical equations, with their term −ω'q, into a standard system",
)
def reducible() -> Steps:
    first, second = principle.phase_costate()
    yield (
        "q = εq1 + ε²q2 + ... from H* = 0, with ω alone in denominators: q is small",
        not (first.has(q, epsilon) or second.has(q, epsilon)),
    )
    size = sp.simplify(first * omega + principle.leading_h())
    yield "q1 = −h*/ω at q = 0, ε = 0", size == 0
    rate = -omega.diff(a[0]) * (epsilon * first)
    yield "so −ω'q is of the order ε, as a' is", sp.simplify(rate / epsilon).has(epsilon) is False
