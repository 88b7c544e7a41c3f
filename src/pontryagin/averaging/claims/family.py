"""Section 2, (2.1) and (2.2): the standard system without q, its family of solutions and its roots."""

import numpy as np
import sympy as sp

from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.derivation import principle, ripple, rotor, smooth
from pontryagin.averaging.derivation.principle import a, epsilon, f, omega, p, q, u
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

R = sp.Rational
first = principle.leading_h()
KAPPA = smooth.kappa


def smooth_instance(expression: sp.Expr) -> sp.Expr:
    """Value of a general expression in the smooth example with k = 1, where v = 1 and p = 1."""
    example = smooth.maximum().subs(smooth.k, 1)
    concrete = expression.replace(principle.h_star.func, lambda *z: example.subs(smooth.eta, z[3]))
    return concrete.subs(omega, a[0]).doit().subs({a[0]: 1, p[0]: 1})


@claim(
    "(2.1): a'",
    "the rates of the slow variables to the leading order, with f at q = 0, ε = 0",
    verdict="holds",
)
def slow_rate() -> Evidence:
    held = principle.leading(principle.u_star)

    def derived() -> RightSides:
        small = {q: epsilon * sp.Symbol("q_1"), u: principle.u_star}
        rate = (principle.rates()[0] / epsilon).subs(u, principle.u_star).subs(q, small[q])
        return rate.subs(epsilon, 0)

    return Equality(
        {r"\dot a_1/\varepsilon": f[0].subs(u, held).subs(epsilon, 0)},
        derived,
        display=r"\dot a = \varepsilon f_0^*(a, \psi, p) + \varepsilon^2 f_1,\quad \dot\psi = \omega(a) + "
        r"\varepsilon F",
    )


@claim(
    "(2.1): p'",
    "the costates to the leading order",
    verdict="misprint",
    remark="Printed: −εω'ω⁻¹(pf0*) − ε∂(pf0*)/∂a. Right: +εω'ω⁻¹(pf0*) − ε∂(pf0*)/∂a. This follows from −ω'q "
    "with q = −εω⁻¹(pf0*) of the line below it; (2.11) with (2.10) has the right sign.",
)
def costate_rate() -> Evidence:
    key = r"\dot p_1/\varepsilon"
    printed = -omega.diff(a[0]) / omega * first - first.diff(a[0])

    def shown() -> Consequence:
        right = principle.standard_costate_rates()[0]
        return Consequence(
            "p'/ε in the smooth example at v = 1, p = 1, k = 1",
            smooth_instance(printed),
            smooth_instance(right),
        )

    return Misprint(
        {key: printed},
        lambda: principle.standard_costate_rates()[0],
        defect={key: -2 * omega.diff(a[0]) / omega * first},
        consequence=shown,
        display=r"\dot p = -\varepsilon \omega'(a)\omega^{-1}(pf_0^*) - \varepsilon \partial "
        r"(pf_0^*)/\partial "
        r"a + \varepsilon^2 P_1",
    )


@claim("after (2.1): q", "q = −εω⁻¹(pf0*) + O(ε²)", verdict="holds")
def phase_costate() -> Evidence:
    return Equality(
        {r"q/\varepsilon": -first / omega},
        lambda: principle.phase_costate()[0],
        display=r"q = -\varepsilon \omega^{-1}(pf_0^*) + \varepsilon^2 Q_1",
    )


@claim.proof("after (2.1): remainders", "f1, P1 and Q1 are bounded, and may be dropped")
def remainders() -> Steps:
    second = principle.phase_costate()[1]
    numerator, denominator = sp.fraction(sp.together(second))
    yield (
        "Q1 → (h*∂h*/∂q − ω∂h*/∂ε)/ω²: ω ≥ ω0 alone divides",
        vanishes(denominator / omega**2 - 1) and not numerator.has(1 / omega),
    )
    for eps in worked.EPSILONS:
        off = worked.deviations(eps)["costate"]
        yield f"rippled example, ε = {eps}: without them p(t1) is off by {off / eps:.2f}ε", off < eps


@claim(
    "after (2.1): family",
    "t1 is the parameter of a family: for each t1 the problem without (2.2) has one solution",
    verdict="conditional",
    remark="This is an assumption of the paper that its own example 1 does not satisfy: there the motion of "
    "least time does not depend on the member of the family at all, and a solution exists for one t1 "
    "only. The smooth example, rippled or not, satisfies it as long as v does not overshoot. The "
    "phase at the end always changes from member to member, and can serve as the parameter.",
)
def one_solution_for_each_end() -> Evidence:
    def argument() -> Steps:
        T = ripple.of_kappa(ripple.duration()).subs({ripple.rise: 1})
        start, end = smooth.v0, smooth.v1
        halves = (end - start) * (
            start / sp.sqrt(smooth.k - KAPPA * start) + end / sp.sqrt(smooth.k - KAPPA * end)
        )
        whole = (sp.sqrt(smooth.k - KAPPA * start) + sp.sqrt(smooth.k - KAPPA * end)) ** 2
        rest = T.diff(KAPPA) * whole - halves
        yield (
            "smooth example: dτ1/dκ = (v1 − v0)(v0/A0 + v1/A1)/(A0 + A1)² > 0, one κ for each τ1",
            vanishes(sp.simplify(rest)),
        )
        for eps in worked.EPSILONS:
            scan = worked.in_window(eps)
            yield (
                f"rippled, ε = {eps}: t1 falls as p(0) rises, one member for each t1",
                bool(np.all(np.diff(scan.duration) < 0) and np.all(np.diff(scan.phase) < 0)),
            )

    def counterexample() -> Steps:
        gained = rotor.energy_rate(instances.ROOT_OF_MASS**2, sp.S.Zero, sp.S.Zero, sp.S.One) / rotor.v
        yield (
            "rotor, least time, u = 1: da/dx = ε, so a = a0 + εx whatever p is",
            vanishes(gained - rotor.epsilon),
        )
        mean = instances.uneven_frequency()
        T = sp.integrate(1 / mean, (rotor.a, R(1, 2), 2))
        yield "averaged from a = 1/2 to 2: τ1 = 1, and no member with τ1 = 2", T == 1

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "(2.2)", "h* = (pf*) = 0 at t1 selects the extremals", display=r"h^*|_{t_1} \equiv (pf^*)_{t_1} = 0"
)
def condition() -> Steps:
    level = omega * q + epsilon * principle.h_star
    yield (
        "on H* = 0 with q(t1) = 0: h* = 0",
        vanishes(level.subs(q, 0) - epsilon * principle.h_star.subs(q, 0)),
    )
    at_zero = sp.solve(level.subs(principle.h_star, 0), q)
    yield "and with h* = 0, as ω > 0: q(t1) = 0", at_zero == [0]
    h = principle.small_part().subs(q, 0)
    yield "h at q = 0 is (pf)", vanishes(h - sp.Matrix(p).dot(f))


@claim(
    "after (2.2): one root",
    "where the root is unique, the solution of the boundary value problem is the optimum",
    verdict="conditional",
    remark="True where an optimum exists and is normal, as the form of (1.6) supposes: the optimum is an "
    "extremal, and there is only one extremal. An abnormal optimum is not a root: a1' = εu², a2' = "
    "ε(1 + 2u), |u| ≤ 1, least time from 0 to a1(a2 + 3) = (a2 − 1)(a2 + 3) = 0 has J = 1 with u = 0, "
    "and the only root has J = 3.",
)
def one_root() -> Evidence:
    control, first_costate, second_costate = sp.symbols("u p_1 p_2", real=True)
    h = first_costate * control**2 + second_costate * (1 + 2 * control) - 1

    def argument() -> Steps:
        J = ripple.of_kappa(ripple.cost()).subs(ripple.rise, 1)
        Psi = ripple.of_kappa(ripple.turned()).subs(ripple.rise, 1)
        yield (
            "smooth example: dJ0/dκ = κ dΨ/dκ",
            vanishes(
                sp.simplify((J.diff(KAPPA) - KAPPA * Psi.diff(KAPPA)).subs({smooth.v0: 1, smooth.v1: 2}))
            ),
        )
        T, gap = sp.symbols("T Delta", positive=True)
        least = 2 * gap * sp.sqrt(smooth.k)
        square = (sp.sqrt(smooth.k * T) - gap / sp.sqrt(T)) ** 2
        yield (
            "h* at the end, −κv1, has the one root κ = 0; its J = 2|Δv|√k",
            vanishes(J.subs(KAPPA, 0) - 2 * sp.sqrt(smooth.k) * (smooth.v1 - smooth.v0)),
        )
        yield (
            "and no control does better: kT + Δv²/T is 2|Δv|√k and a square",
            vanishes(sp.expand(smooth.k * T + gap**2 / T - least - square)),
        )

    def counterexample() -> Steps:
        a1, a2 = sp.symbols("a_1 a_2", real=True)
        target = sp.Matrix([a1 * (a2 + 3), (a2 - 1) * (a2 + 3)])
        places = sp.solve(list(target), [a1, a2], dict=True)
        yield (
            "the target is the point (0, 1) and the line a2 = −3",
            (len(places) == 2 and {a1: 0, a2: 1} in places and {a2: -3} in places),
        )
        yield (
            "(0, 1) needs ∫u²dτ = 0: u = 0, τ1 = 1; a2 = −3 needs τ1 ≥ 3, as a2' ≥ −ε: the optimum is J = 1",
            ((1 + 2 * control).subs(control, 0) == 1 and (1 + 2 * control).subs(control, -1) == -1),
        )
        still = sp.solve(h.diff(control).subs(control, 0), second_costate)
        yield (
            "u = 0 maximises h only with p2 = 0, and then h = −1: no root of (2.2)",
            (still == [0] and h.subs({control: 0, second_costate: 0}) == -1),
        )
        ending = target.jacobian([a1, a2]).subs(a2, -3)
        yield "on the line p1(t1) = 0", ending[:, 0] == sp.zeros(2, 1)
        line = h.subs({first_costate: 0, control: -1})
        yield (
            "there u = −1 for p2 < 0, and h = 0 for p2 = −1: the one root, τ1 = 3, J = 3 > 1",
            (
                sp.solve(line, second_costate) == [-1]
                and h.subs(first_costate, 0).diff(control) == 2 * second_costate
            ),
        )

    return Conditional(argument, counterexample=counterexample)
