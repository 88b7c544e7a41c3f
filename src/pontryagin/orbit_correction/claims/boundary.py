"""Section 4, Theorem 1: boundary points, (3) and (4)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Proof, Slip, Steps, vanishes
from pontryagin.orbit_correction.claims.convexity import DISC, deficit
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import exact
from pontryagin.orbit_correction.derivation.exact import ExactSystem

claim = Page("Ibragimov 2017")


def optimal(system: ExactSystem) -> tuple[list[sp.Matrix], list[sp.Matrix]]:
    """States and controls of the maximum principle from the boundary state."""
    controls = system.controls()
    return system.fly(system.boundary_state(), controls), controls


@claim.proof(
    "Theorem 1, i)",
    "an optimal trajectory that starts on the boundary has every x*(k) on the boundary of X(N_min − k, k)",
    display=r"x^*(k) \in \partial X(N_{\min} - k, k),\quad k = \overline{0, N_{\min}}",
)
def trajectory_on_the_boundaries() -> Steps:
    for system in family():
        states, _ = optimal(system)
        yield f"{named(system)}: the trajectory ends at 0", states[-1].is_zero_matrix
        for k, state in enumerate(states[:-1]):
            left = system.steps - k
            p = -system.costates[k]
            yield (
                f"x*({k}) is the support point of X({left}, {k}) for −ψ({k})",
                vanishes(state - system.point(p, left, k)),
            )


@claim.proof(
    "Theorem 1, ii)",
    "the normal cone at x*(k) lies in A'(k) times the normal cone at x*(k+1)",
    remark="The inclusion can be strict: for A(k) = I, U(0) a disc, U(1) a lens and x*(1) the corner of "
    "the lens, the two cones differ.",
    display=r"N(x^*(k), X(N_{\min}-k, k)) \subset A^T(k)N(x^*(k+1), X(N_{\min}-k-1, k+1)),\quad k = "
    r"\overline{0, N_{\min}-2}",
)
def normals_along_the_trajectory() -> Steps:
    for system in family():
        for k in range(system.steps - 1):
            here, after = -system.costates[k], -system.costates[k + 1]
            state = optimal(system)[0][k + 1]
            yield (
                f"{named(system)}: A'({k}) times the normal at x*({k + 1}) is the one at x*({k})",
                vanishes(system.A[k].T * after - here),
            )
            left = system.steps - k - 1
            yield "and it is normal there", after.dot(state) == system.support(after, left, k + 1)
    p = sp.Matrix([1, 4]) / sp.sqrt(17)
    state = exact.LENS_CORNER + p
    yield (
        "A = I, U(0) the disc, U(1) the lens: x0 = (0, 4/5) + p goes to the corner by u(0) = −p",
        (state - p == exact.LENS_CORNER and DISC.level(p) == 1),
    )
    edges = exact.lens_corner_normals()
    yield (
        "(±3/5, 4/5) are normal at the corner, and not normal at x0",
        all(
            exact.normal_at_lens_corner(edge) and edge.dot(state) < edge.dot(exact.LENS_CORNER) + 1
            for edge in edges
        ),
    )


def only_controls() -> Steps:
    """Any other control of a step gives less of (psi, u), and the sum that these controls give is needed."""
    for system in family():
        _, controls = optimal(system)
        for k, (U, q) in enumerate(zip(system.U, system.costates[1:], strict=True)):
            w = sp.Matrix(sp.symbols(f"w1:{len(q) + 1}", real=True))
            lost = U.support(q) - q.dot(w) - deficit(U, q, w)
            yield f"{named(system)}: any other u({k}) gives less of (ψ({k + 1}), u)", vanishes(lost)
        needed = -system.costates[0].dot(system.boundary_state())
        given = sum(q.dot(u) for q, u in zip(system.costates[1:], controls, strict=True))
        yield "and all of it is needed to end at 0", needed == given


@claim("Theorem 1, iii)", "from a boundary point the optimal trajectory is unique", verdict="holds")
def unique_trajectory() -> Proof:
    return Proof(only_controls)


@claim(
    "proof of Theorem 1: induction",
    "the step of the induction: if x*(k) lies on the boundary, so does x*(k+1)",
    verdict="misprint",
    remark="Printed for k from 1 to N_min − 2. The induction starts at k = 0: the step is needed for k from "
    "0 to N_min − 1. As printed, nothing is said of x*(1), nor of x*(N_min − 1) when N_min = 2.",
)
def steps_of_the_induction() -> Slip:
    def reached(steps: range) -> set[int]:
        known = {0}
        for k in steps:
            if k in known:
                known.add(k + 1)
        return known

    def argument() -> Steps:
        for N in range(1, 6):
            yield (
                f"N_min = {N}: steps k = 0, ..., {N - 1} reach all x*(k)",
                reached(range(N)) == set(range(N + 1)),
            )
        for system in family():
            state = system.A[0] * system.boundary_state() + system.controls()[0]
            p = -system.costates[1]
            yield (
                f"{named(system)}: the step k = 0 leads to the boundary",
                p.dot(state) == system.support(p, system.steps - 1, 1),
            )

    def counterexample() -> Steps:
        for N in (2, 3, 4):
            yield (
                f"N_min = {N}: steps k = 1, ..., {N - 2} reach nothing beyond x*(0)",
                reached(range(1, N - 1)) == {0},
            )

    return Slip(
        argument,
        counterexample=counterexample,
        display=r"x^*(k) \in \partial X(N_{\min}-k, k),\quad k = \overline{1, N_{\min}-2}",
    )


@claim.proof(
    "(3)",
    "with u* in −U(k) and u*(k) = −u*, the decomposition A(k)x*(k) = x*(k+1) + u* is a step of the system",
    display=r"A(k)x^*(k) = x^*(k+1) + u^*,\quad x^*(k+1) = A(k)x^*(k) + u^*(k)",
)
def decomposition_as_a_step() -> Steps:
    for system in family():
        states, controls = optimal(system)
        for k in range(system.steps):
            p, left = -system.costates[k + 1], system.steps - k - 1
            part = system.U[k].image(-sp.eye(len(p))).point(p)
            yield f"{named(system)}: the part of A({k})x*({k}) in −U({k}) is −u*({k})", part == -controls[k]
            yield (
                "the rest is x*(k+1), a support point",
                vanishes(system.A[k] * states[k] - part - system.point(p, left, k + 1)),
            )


@claim.proof(
    "(4)",
    "the normal cone at A(k)x*(k) is the intersection of those at x*(k+1) and at u*",
    remark="This follows from the equality that the proof of Lemma 5 shows. The inclusion that Lemma 5 "
    "states is not enough.",
    display=r"N(A(k)x^*(k), A(k)X(N_{\min}-k, k)) = N(x^*(k+1), X(N_{\min}-k-1, k+1)) \cap N(u^*, -U(k))",
)
def normals_of_a_step() -> Steps:
    for system in family():
        states, controls = optimal(system)
        for k in range(system.steps - 1):
            p, left = -system.costates[k + 1], system.steps - k - 1
            u = -controls[k]
            total = p.dot(states[k + 1]) + p.dot(u)
            yield (
                f"{named(system)}: −ψ({k + 1}) is normal to both parts",
                (
                    p.dot(states[k + 1]) == system.support(p, left, k + 1)
                    and p.dot(u) == system.U[k].support(p)
                ),
            )
            yield "and to their sum", total == system.support(system.A[k].T * p, left + 1, k)
            gradient = system.U[k].normal(u)
            yield (
                "the gradient at u* has the same direction",
                vanishes(gradient * p.norm() ** 2 - p * gradient.dot(p)),
            )
