"""Section 5, (5) and (6): interior points, and Lemma 6 about them."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality, Steps, vanishes
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import summands

claim = Page("Ibragimov 2017")


@claim.proof(
    "(5)",
    "the case that x0 lies in int X(N_min, 0) but not in X(N_min − 1, 0); the only other case is "
    "x0 on the boundary of X(N_min, 0)",
    display=r"x_0 \in \operatorname{int} X(N_{\min}, 0) \setminus X(N_{\min} - 1, 0)",
)
def interior_points() -> Steps:
    for system in family():
        p, state = -system.costates[0], system.inner_state()
        whole, shorter = (system.support(p, N) for N in (system.steps, system.steps - 1))
        yield (
            f"{named(system)}: αx with x on the boundary and α < 1 is an inner point",
            system.inner_gauge < 1,
        )
        yield "and not in X(N − 1, 0): N_min = N", shorter < p.dot(state) < whole
        grown = system.summands(system.steps)[-1]
        yield (
            "X(N − 1, 0) lies inside X(N, 0): the last summand has 0 inside",
            grown.level(sp.zeros(*p.shape)) < 1,
        )


@claim.proof("after (5): normal cone", "at an inner point there is no normal")
def no_normal_inside() -> Steps:
    for system in family():
        state = system.inner_state()
        for p in (-system.costates[0], -state, state):
            yield f"{named(system)}: (p, x0) < s(p)", bool(p.dot(state) < system.support(p, system.steps))
    radius, slope = sp.symbols("r m", positive=True)
    yield (
        "with a ball of radius r about x0 inside, (p, x0 + rp/|p|) exceeds (p, x0) by r|p| > 0",
        (radius * slope).is_positive,
    )


@claim.proof(
    "Lemma 6",
    "if optimal controls from an inner point obey (6), then ψ0 = 0",
    remark="True with Arg max, the set of all maximum points, in place of arg max: for ψ0 = 0 every "
    "control attains the maximum, so that (6) says nothing about the controls.",
    display=r"\psi_0 = 0",
)
def zero_costate_inside() -> Steps:
    for system in family():
        state, controls = system.inner_state(), system.controls()
        end = system.fly(state, controls)[-1]
        yield f"{named(system)}: the controls of ψ0 ≠ 0 do not bring αx to 0", not end.is_zero_matrix
        missed = (system.inner_gauge - 1) * system.boundary_state()
        for A in system.A:
            missed = A * missed
        yield "they miss it by A(N−1) ... A(0)(x0 − ρ(−ψ0))", vanishes(end - missed)
    x, y = summands.x, sp.Symbol("y", commutative=False)
    apart = summands.final_state(3) - summands.final_state(3).subs(x, y)
    product = summands.forward_product([summands.A(k) for k in range(3)])
    yield (
        "same controls, two states, matrices of any size: they stay apart by the product of the A(k)",
        vanishes(sp.expand(apart - product * (x - y))),
    )


@claim.proof(
    "(6)",
    "the maximum principle, with the costates of the recursion that starts at ψ(0) = ψ0",
    display=r"u^*(k) = \arg\max_{u \in U(k)}((A^{-1}(k))^T\psi(k), u),\quad \psi(k+1) = "
    r"(A^{-1}(k))^T\psi(k),\quad \psi(0) = \psi_0",
)
def principle_with_recursion() -> Steps:
    for system in family():
        controls = system.controls()
        for k, u in enumerate(controls):
            q = system.A[k].inv().T * system.costates[k]
            yield (
                f"{named(system)}: u*({k}) attains the maximum, ψ({k + 1}) = A^−T ψ({k})",
                (q.dot(u) == system.U[k].support(q) and q == system.costates[k + 1]),
            )
        yield "from ρ(−ψ0) they end at 0", system.fly(system.boundary_state(), controls)[-1].is_zero_matrix


@claim(
    "proof of Lemma 6: both states",
    "the same controls would bring x0 and ρ(−ψ0) to 0, so the two agree",
    verdict="holds",
)
def both_states() -> Equality:
    N = 3
    state = summands.state_brought_to_zero(N)
    return Equality(
        {"x(N)": sp.S.Zero},
        lambda: sp.expand(summands.final_state(N).subs(summands.x, state)),
        display=r"A(N_{\min}-1)\cdot\ldots\cdot A(0)x_0 + A(N_{\min}-1)\cdot\ldots\cdot A(1)u(0) + \ldots + "
        r"u(N_{\min}-1) = 0\ \Rightarrow\ x_0 = \rho_{X(N_{\min}, 0)}(-\psi_0) \in \partial X(N_{\min}, 0)",
    )


@claim.proof(
    "after Lemma 6: Arg max",
    "for ψ0 = 0 every admissible control attains the maximum",
    display=r"\operatorname{Arg}\max_{u \in U(k)}((A^{-1}(k))^T\psi(k), u) = U(k)",
)
def maximum_attained_everywhere() -> Steps:
    for system in family():
        zero = sp.zeros(*system.psi0.shape)
        yield f"{named(system)}: ψ(k) = A^−T ... 0 = 0", (system.A[0].inv().T * zero).is_zero_matrix
        yield (
            "(0, u) = 0 for the controls and for none at all",
            (zero.dot(system.controls()[0]) == zero.dot(zero) == system.U[0].support(zero) == 0),
        )
