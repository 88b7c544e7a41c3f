"""Section 2, (2) to Corollary 1: the 0-controllable sets."""

from itertools import pairwise

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Consequence, Equality, Misprint, Proof, Steps, vanishes
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import summands
from pontryagin.orbit_correction.derivation.summands import A, u, x

claim = Page("Ibragimov 2017")

R = sp.Rational


@claim.proof(
    "(2)",
    "X(N, k) is the set of states that admissible controls bring to 0 in the N steps from step k on",
    display=r"X(N, k) = \{x(k) \in \mathbb{R}^n : \exists u(k) \in U(k), \dots, u(N+k-1) \in U(N+k-1) : "
    r"x(N+k) = 0\},\ N \in \mathbb{N};\quad \{0\},\ N = 0",
)
def controllable_sets() -> Steps:
    reach = sp.S.Zero
    for N, end in ((1, R(1, 2)), (2, R(3, 4)), (3, R(7, 8))):
        yield (
            f"x(k+1) = 2x(k) + u(k), |u| ≤ 1: u = −1 brings {end} just into X({N - 1}, k+1)",
            2 * end - 1 == reach,
        )
        beyond = end + R(1, 100)
        yield "and brings no larger x there", 2 * beyond - 1 > reach
        reach = end
    for system in family():
        state = system.boundary_state()
        end = system.fly(state, system.controls())[-1]
        yield f"{named(system)}: a state of X(N, 0) and controls that bring it to 0", end.is_zero_matrix
        outside = (-system.costates[0]).dot(R(11, 10) * state)
        yield "and 11/10 of it is outside", outside > system.support(-system.costates[0], system.steps)


@claim.proof(
    "after (2): N_min finite",
    "N_min < ∞ means that x0 lies in the union of X(N, 0)",
    remark="N_min < ∞ is an assumption. It does not follow from 0 in int U(k): for x(k+1) = 2x(k) + "
    "u(k), |u| ≤ 1, the union is the interval (−1, 1).",
    display=r"x_0 \in \bigcup_{N=0}^{\infty} X(N, 0)",
)
def finite_number_of_steps() -> Steps:
    N, i = sp.symbols("N i", integer=True, positive=True)
    reach = sp.summation(2**-i, (i, 1, N))
    yield "x(k+1) = 2x(k) + u(k): X(N, 0) = [−(1 − 2^−N), 1 − 2^−N]", vanishes(sp.simplify(reach - 1 + 2**-N))
    yield "which never holds x0 = 1: no number of steps does", sp.limit(reach, N, sp.oo) == 1
    yield "and holds x0 = 3/4 from N = 2 on: N_min = 2", reach.subs(N, 1) < R(3, 4) == reach.subs(N, 2)


@claim(
    "after (2): N_min",
    "N_min is the least natural N with x0 in X(N, 0)",
    verdict="conditional",
    remark="True for x0 ≠ 0. The paper's natural numbers start at 1, since it writes k ∈ N ∪ {0}. For x0 "
    "= 0, which lies in X(0, 0), the formula therefore gives N_min = 1; the least N is to be "
    "taken over N ∪ {0}.",
)
def least_number_of_steps() -> Conditional:
    def argument() -> Steps:
        for system in family():
            p = -system.costates[0]
            reached = [system.support(p, N) for N in range(system.steps + 1)]
            state = p.dot(system.boundary_state())
            yield f"{named(system)}: x0 needs all N steps", reached[-2] < state == reached[-1]
            yield (
                "the sets grow with N, so the least N is well defined",
                all(a < b for a, b in pairwise(reached)),
            )
            yield "and x0 ≠ 0 is not in X(0, 0)", state > reached[0] == 0

    def counterexample() -> Steps:
        candidates = [N for N in range(3) if (1 - R(1, 2) ** N) >= 0]
        yield "x0 = 0 of x(k+1) = 2x(k) + u(k) lies in X(0, 0), X(1, 0), X(2, 0)", candidates == [0, 1, 2]
        natural = [N for N in candidates if N >= 1]
        yield "the least natural N is 1, but 0 steps do", min(natural) == 1 and min(candidates) == 0

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"N_{\min} = \min\{N \in \mathbb{N} : x_0 \in X(N, 0)\}",
    )


@claim.proof(
    "after (2): optimal trajectory",
    "a trajectory is optimal exactly if x*(k) lies in X(N_min − k, k) for every k",
    display=r"x^*(k) \in X(N_{\min} - k, k),\quad k = \overline{0, N_{\min}}",
)
def optimal_trajectories() -> Steps:
    for system in family():
        states = system.fly(system.boundary_state(), system.controls())
        yield f"{named(system)}: x*(N) = 0, the only point of X(0, N)", states[-1].is_zero_matrix
        for k, state in enumerate(states[:-1]):
            p = -system.costates[k]
            left = system.support(p, system.steps - k, k)
            yield f"x*({k}) lies in X({system.steps - k}, {k}), on its boundary", p.dot(state) == left
        late = R(1, 2) * system.controls()[0]
        strayed = system.A[0] * states[0] + late
        p = -system.costates[1]
        yield (
            "after another first control, half of it, x(1) is outside X(N − 1, 1)",
            p.dot(strayed) > system.support(p, system.steps - 1, 1),
        )


def printed_state(N: int) -> sp.Expr:
    """- A^-1(0) u(0) - A^-1(0) A^-1(1) u(1) - ..., as Lemma 1 prints it."""
    return sp.Add(*(-summands.backward_product([A(j) for j in range(i + 1)]) * u(i) for i in range(N)))


@claim("Lemma 1", "X(N, k) is a sum of linear images of U(k), ..., U(k+N−1)", verdict="holds")
def sum_of_images() -> Proof:
    sizes = (1, 2, 3, 4)

    def argument() -> Steps:
        for N in sizes:
            state = summands.state_brought_to_zero(N)
            yield (
                f"N = {N}, matrices of any size: that state is flown to 0",
                vanishes(sp.expand(summands.final_state(N).subs(x, state))),
            )
        longer = sp.expand(A(0) ** -1 * (summands.state_brought_to_zero(4, 1) - u(0)))
        yield "and one step more is put in front", vanishes(longer - summands.state_brought_to_zero(5))

    return Proof(
        argument,
        Equality(
            {rf"x(0)\ (N = {N})": printed_state(N) for N in sizes},
            lambda: {rf"x(0)\ (N = {N})": summands.state_brought_to_zero(N) for N in sizes},
        ),
        display=r"X(N, k) = \sum_{i=0}^{N-1} \left(-A^{-1}(k)\cdot\ldots\cdot A^{-1}(i+k)\right)U(k+i)",
    )


@claim(
    "proof of Lemma 1: x(N+k)", "the state after N steps in terms of x(k) and the controls", verdict="holds"
)
def state_after_steps() -> Equality:
    printed = A(2) * A(1) * A(0) * x + A(2) * A(1) * u(0) + A(2) * u(1) + u(2)
    return Equality(
        {"x(3)": printed},
        lambda: summands.final_state(3),
        display=r"0 = A(N+k-1)\cdot\ldots\cdot A(k)x(k) + A(N+k-1)\cdot\ldots\cdot A(k+1)u(k) + \dots + "
        r"A(N+k-1)u(N+k-2) + u(N+k-1)",
    )


@claim(
    "proof of Lemma 1: x(k)",
    "the state x(k) that the controls bring to 0, with the inverse of the product in front",
    verdict="misprint",
    remark="Printed: x(k) = (A(N+k−1)…A(k))⁻¹(…). Right: with a minus in front, as in the next line of "
    "the paper.",
)
def state_with_the_product_inverted() -> Misprint:
    controls = A(2) * A(1) * u(0) + A(2) * u(1) + u(2)
    inverse = summands.backward_product([A(0), A(1), A(2)])
    right = summands.state_brought_to_zero(3)

    def consequence() -> Consequence:
        # One step of x(k+1) = 2x(k) + u(k) with u = 1.
        numbers = {A(0): 2, u(0): 1}
        required = summands.state_brought_to_zero(1).subs(numbers)
        return Consequence("x(k+1) = 2x(k) + u(k), N = 1, u = 1: x(k)", -required, required)

    return Misprint(
        {"x(0)": sp.expand(inverse * controls), "x(0) ": printed_state(3)},
        lambda: {"x(0)": right, "x(0) ": right},
        defect={"x(0)": -2 * right},
        consequence=consequence,
        display=r"x(k) = (A(N+k-1)\cdot\ldots\cdot A(k))^{-1}(A(N+k-1)\cdot\ldots\cdot A(k+1)u(k) + \dots + "
        r"u(N+k-1)) = -A(k)^{-1}u(k) - \ldots - A(k)^{-1}\cdot\ldots\cdot A(N+k-1)^{-1}u(N+k-1)",
    )


@claim("Corollary 1", "A(k) X(N+1, k) is the sum of X(N, k+1) and −U(k)", verdict="holds")
def recurrence() -> Equality:
    sizes = (0, 1, 2, 3)

    printed = {rf"A(0)x(0)\ (N = {N})": summands.state_brought_to_zero(N, 1) - u(0) for N in sizes}
    return Equality(
        printed,
        lambda: {
            rf"A(0)x(0)\ (N = {N})": sp.expand(A(0) * summands.state_brought_to_zero(N + 1)) for N in sizes
        },
        display=r"A(k)X(N+1, k) = X(N, k+1) + (-U(k))",
    )
