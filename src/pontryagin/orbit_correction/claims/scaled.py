"""Section 5 from (7) on: the scaled system, Lemma 7 and Theorem 4."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, Proof, Slip, Steps
from pontryagin.orbit_correction.claims.convexity import DISC, E1, E2
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import summands
from pontryagin.orbit_correction.derivation.summands import alpha

claim = Page("Ibragimov 2017")

R = sp.Rational


@claim.proof(
    "before (7): α",
    "α = μ(x0, X(N_min, 0)), the Minkowski functional, is below 1 in case (5)",
    remark="The paper's reference [22] for this functional is missing: its list ends at 21.",
    display=r"\alpha = \mu(x_0, X(N_{\min}, 0)) < 1",
)
def minkowski_functional() -> Steps:
    for system in family():
        p, state, N = -system.costates[0], system.inner_state(), system.steps
        yield f"{named(system)}: x0/α lies in X(N, 0)", state / system.inner_gauge == system.boundary_state()
        yield (
            "and no smaller α does: (p, x0) = α s(p)",
            p.dot(state) == system.inner_gauge * system.support(p, N),
        )
        yield "0 < α < 1", 0 < system.inner_gauge < 1


@claim.proof(
    "(7)",
    "the system (1) with αU(k) in place of U(k)",
    display=r"x(k+1) = A(k)x(k) + u(k),\quad x(0) = x_0,\quad u(k) \in \alpha U(k)",
)
def scaled_system() -> Steps:
    for system in family():
        scaled = [system.inner_gauge * u for u in system.controls()]
        states = system.fly(system.inner_state(), scaled)
        yield f"{named(system)}: the α-fold controls bring x0 to 0", states[-1].is_zero_matrix
        levels = [U.level(u) for U, u in zip(system.U, scaled, strict=True)]
        yield (
            "and lie on the boundaries of αU(k), inside U(k)",
            levels == [system.inner_gauge**2] * system.steps,
        )


@claim(
    "Lemma 7, i)",
    "the 0-controllable sets of (7) are αX(N, k)",
    verdict="holds",
    remark="The proof once prints X(N, t) where X(N, k) is meant.",
)
def scaled_sets() -> Equality:
    keys = [rf"x(1)\ (N = {N})" for N in (0, 1, 2, 3)]
    printed = {key: sp.expand(alpha * summands.state_brought_to_zero(N, 1)) for N, key in enumerate(keys)}
    return Equality(
        printed,
        lambda: {key: summands.state_brought_to_zero(N, 1, alpha) for N, key in enumerate(keys)},
        display=r"X_\alpha(N, k) = \sum_{i=0}^{N-1}\left(-A^{-1}(k)\cdot\ldots\cdot "
        r"A^{-1}(i+k)\right)\alpha U(k+i) = \alpha X(N, k)",
    )


@claim.proof(
    "Lemma 7, ii)",
    "the 0-controllable sets of (7) lie in X(N, k)",
    remark="This follows from α < 1, 0 ∈ X(N, k) and the convexity of X(N, k).",
    display=r"X_\alpha(N, k) \subset X(N, k)",
)
def scaled_sets_inside() -> Steps:
    for system in family():
        for k in range(system.steps):
            p, left = -system.costates[k], system.steps - k
            point = system.inner_gauge * system.point(p, left, k)
            mixed = system.inner_gauge * system.point(p, left, k) + (1 - system.inner_gauge) * sp.zeros(
                *p.shape
            )
            yield (
                f"{named(system)}: a point of αX({left}, {k}) is a mixture of one of X and 0",
                (point == mixed and 0 < system.inner_gauge < 1),
            )
            yield "and inside the half-space of X", p.dot(point) < system.support(p, left, k)


def state_on_the_scaled_boundary() -> Steps:
    """x0 is the support point of the scaled set."""
    for system in family():
        p, state = -system.costates[0], system.inner_state()
        yield (
            f"{named(system)}: (p, x0) is the support function of αX(N, 0)",
            (p.dot(state) == system.inner_gauge * system.support(p, system.steps)),
        )
        yield "and x0 is its support point", state == system.inner_gauge * system.point(p, system.steps)


@claim("Lemma 7, iii)", "x0 is on the boundary of X_α(N_min, 0)", verdict="holds")
def on_the_scaled_boundary() -> Proof:
    return Proof(state_on_the_scaled_boundary, display=r"x_0 \in \partial X_\alpha(N_{\min}, 0)")


@claim(
    "proof of Lemma 7: ε",
    "for α' < α and ε = 1/α' − 1/α the vector x0/α + εx0 is x0/α', and α times it is x0 + εαx0",
    verdict="holds",
)
def stretched_state() -> Equality:
    smaller = sp.Symbol("alpha'", positive=True)
    size = 1 / smaller - 1 / alpha
    return Equality(
        {
            r"\tfrac1\alpha x_0 + \varepsilon x_0": 1 / smaller,
            r"x_0 + \varepsilon\alpha x_0": 1 + size * alpha,
        },
        lambda: {
            r"\tfrac1\alpha x_0 + \varepsilon x_0": 1 / alpha + size,
            r"x_0 + \varepsilon\alpha x_0": alpha / smaller,
        },
        display=r"\frac1\alpha x_0 + \varepsilon x_0 = \frac1{\alpha'}x_0 \notin X(N_{\min}, 0),\quad x_0 + "
        r"\varepsilon\alpha x_0 \notin X_\alpha(N_{\min}, 0)",
    )


@claim(
    "proof of Lemma 7: boundary",
    "hence x0 is a boundary point",
    verdict="misprint",
    remark="Printed: of X(N_min, 0). Right: of X_α(N_min, 0), as iii) says; x0 is an inner point of "
    "X(N_min, 0) by (5).",
)
def which_boundary() -> Slip:
    def counterexample() -> Steps:
        for system in family():
            p = -system.costates[0]
            state = system.inner_state()
            stretched = state / system.inner_gauge
            yield (
                f"{named(system)}: x0/α, α = {system.inner_gauge}, is still in X(N, 0), so x0 is inside",
                (system.inner_gauge < 1 and p.dot(stretched) == system.support(p, system.steps)),
            )

    return Slip(
        state_on_the_scaled_boundary,
        counterexample=counterexample,
        display=r"x_0 \in \partial X(N_{\min}, 0)",
    )


@claim.proof(
    "Theorem 4",
    "α times the arg max, with −ψ(k) normal to X_α at x'(k), is optimal for system (1)",
    remark="Along the trajectory the gauge of x'(k) in X(N_min − k, k) remains α. From an inner point "
    "the optimal control is not unique: this one has the least peak.",
    display=r"x'(0) = x_0,\quad u'(k) = \alpha\arg\max_{u \in U(k)}((A^{-1}(k))^T\psi(k), u),\quad "
    r"-\psi(k) \in N(x'(k), X_\alpha(N_{\min}-k, k)),\quad x'(k+1) = A(k)x'(k) + u'(k)",
)
def optimal_from_inside() -> Steps:
    for system in family():
        size, p = system.inner_gauge, -system.costates[0]
        controls = [size * U.point(q) for U, q in zip(system.U, system.costates[1:], strict=True)]
        states = system.fly(system.inner_state(), controls)
        yield f"{named(system)}: the trajectory ends at 0", states[-1].is_zero_matrix
        yield "N − 1 steps do not do", p.dot(states[0]) > system.support(p, system.steps - 1)
        yield (
            "−ψ(k) is normal to X_α(N − k, k) at x'(k): α is constant",
            all(
                -q.dot(state) == size * system.support(-q, system.steps - k, k)
                for k, (q, state) in enumerate(zip(system.costates[:-1], states[:-1], strict=True))
            ),
        )


@claim(
    "proof of Theorem 4",
    "system (7) satisfies the conditions of the maximum principle for boundary points, so its control is "
    "the optimal one",
    verdict="conditional",
    remark="This control is optimal for (1), and the only optimal one for (7). For (1) it is one of "
    "many: with A = I and unit discs, x0 = −3/2 e1 is brought to 0 by 3/4 e1 twice, and also by "
    "e1 and then e1/2.",
)
def conditions_of_the_scaled_system() -> Conditional:
    def argument() -> Steps:
        for system in family():
            size = system.inner_gauge
            yield f"{named(system)}: α > 0, so αU(k) is an ellipsoid with 0 inside", size > 0
            yield (
                "x0 is on its boundary of N steps and not in N − 1",
                all(truth for _, truth in state_on_the_scaled_boundary()),
            )

    def counterexample() -> Steps:
        start = -R(3, 2) * E1
        first, second = (R(3, 4) * E1, R(3, 4) * E1), (E1, E1 / 2)
        for plan in (first, second):
            yield (
                f"A = I, unit discs, x0 = −3/2 e1: controls of sizes {plan[0][0]}, {plan[1][0]} end at 0",
                (start + plan[0] + plan[1]).is_zero_matrix and all(DISC.level(u) <= 1 for u in plan),
            )
        yield (
            "and so do (3/4, ±1/4): three optimal controls",
            (start + (R(3, 4) * E1 + E2 / 4) + (R(3, 4) * E1 - E2 / 4)).is_zero_matrix
            and DISC.level(R(3, 4) * E1 + E2 / 4) < 1,
        )
        yield "one step does not do", DISC.level(start) > 1

    return Conditional(argument, counterexample=counterexample)
