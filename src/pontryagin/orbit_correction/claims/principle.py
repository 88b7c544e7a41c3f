"""Section 4, Theorem 2 and Theorem 3: adjoint vectors and the maximum principle."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, Slip, Steps
from pontryagin.orbit_correction.claims.boundary import only_controls, optimal
from pontryagin.orbit_correction.claims.convexity import DISC, E1, E2
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import exact, summands
from pontryagin.orbit_correction.derivation.summands import A_transposed

claim = Page("Ibragimov 2017")

R = sp.Rational


@claim(
    "after Theorem 1: adjoint vectors",
    "the adjoint vectors of system (1) are a family of ψ(k) with −ψ(k) normal at x*(k), for k "
    "from 0 to N_min − 1",
    verdict="misprint",
    remark="Printed: the family {ψ(0)}, k = 0, ..., N_min − 1. Right: {ψ(k)}.",
)
def adjoint_vectors() -> Slip:
    def argument() -> Steps:
        for system in family():
            states, _ = optimal(system)
            for k in range(system.steps):
                p = -system.costates[k]
                yield (
                    f"{named(system)}: −ψ({k}) is normal at x*({k})",
                    p.dot(states[k]) == system.support(p, system.steps - k, k),
                )

    def counterexample() -> Steps:
        for system in family()[:2]:
            states, _ = optimal(system)
            p = -system.costates[0]
            gap = system.support(p, system.steps - 1, 1) - p.dot(states[1])
            yield f"{named(system)}: ψ(0) in place of ψ(1) is not, by {sp.N(gap, 3)}", gap.is_positive

    return Slip(
        argument,
        counterexample=counterexample,
        display=r"\{\psi(0)\}_{k=0}^{N_{\min}-1},\quad -\psi(k) \in N(x^*(k), X(N_{\min}-k, k))",
    )


@claim(
    "Theorem 2",
    "the family of adjoint vectors obeys ψ(k+1) = A^−T(k)ψ(k), with −ψ(0) normal at x0",
    verdict="conditional",
    remark="The recursion gives a family of adjoint vectors (that is what the proof shows). For smooth "
    "sets it is the only family up to a factor for each k. Other families need not obey the "
    "recursion, because the normals at a point form a cone: for A(k) = I, unit discs and x0 = "
    "−2e1, the vectors ψ(0) = e1 and ψ(1) = 2e1 are adjoint but do not obey it. If U(1) is a "
    "lens and x*(1) its corner, not even the direction of ψ(1) is fixed.",
)
def adjoint_recursion() -> Conditional:
    def argument() -> Steps:
        for system in family():
            states, _ = optimal(system)
            for k in range(system.steps - 1):
                p = -system.A[k].inv().T * system.costates[k]
                left = system.steps - k - 1
                yield (
                    f"{named(system)}: −A^−T({k})ψ({k}) is normal at x*({k + 1})",
                    p.dot(states[k + 1]) == system.support(p, left, k + 1),
                )

    def counterexample() -> Steps:
        start = -2 * E1
        yield (
            "A(k) = I, unit discs, x0 = −2e1: u = e1 twice ends at 0, N_min = 2",
            start + E1 + E1 == sp.zeros(2, 1),
        )
        yield "−ψ(0) = −e1 is normal at x0", (-E1).dot(start) == 2 * DISC.support(E1)
        yield (
            "−ψ(1) = −2e1 is normal at x*(1) = −e1, and ψ(1) ≠ A^−T ψ(0)",
            ((-2 * E1).dot(start + E1) == DISC.support(2 * E1) and 2 * E1 != E1),
        )
        edge = exact.lens_corner_normals()[0]
        yield (
            "U(1) a lens, x*(1) its corner: (3/5, 4/5) is normal there",
            (exact.normal_at_lens_corner(edge) and edge == sp.Matrix([R(3, 5), R(4, 5)])),
        )
        yield (
            "for x0 = (0, 9/5) the normal is e2, another direction",
            (
                exact.normal_at_lens_corner(E2)
                and edge.dot(exact.LENS_CORNER + E2) < edge.dot(exact.LENS_CORNER) + 1
            ),
        )

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\psi(k+1) = (A^{-1}(k))^T\psi(k),\ k = \overline{0, N_{\min}-2};\quad -\psi(0) \in N(x_0, "
        r"X(N_{\min}, 0))",
    )


@claim("proof of Theorem 2", "ψ(k) = A^−T(k−1) ... A^−T(0) ψ(0)", verdict="holds")
def adjoint_in_closed_form() -> Equality:
    printed = A_transposed(2) ** -1 * A_transposed(1) ** -1 * A_transposed(0) ** -1
    return Equality(
        {r"\psi(3)": printed},
        lambda: summands.adjoint(3),
        display=r"-\psi(k+1) = -(A^{-1}(k))^T\psi(k) \in (A^{-1}(k))^T N(x^*(k), X(N_{\min}-k, k)) \subset "
        r"N(x^*(k+1), X(N_{\min}-k-1, k+1))",
    )


@claim.proof(
    "Theorem 3, i)",
    "u*(k) is the point of U(k) with the largest (A^−T(k)ψ(k), u)",
    display=r"u^*(k) = \arg\max_{u \in U(k)}((A^{-1}(k))^T\psi(k), u),\quad k = \overline{0, N_{\min}-1}",
)
def maximum_principle() -> Steps:
    for system in family():
        states, _ = optimal(system)
        for k in range(system.steps):
            p, left = -system.costates[k + 1], system.steps - k - 1
            flown = system.point(p, left, k + 1) - system.A[k] * states[k]
            q = system.A[k].inv().T * system.costates[k]
            yield (
                f"{named(system)}: the control from x*({k}) to x*({k + 1}) attains the maximum",
                (q.dot(flown) == system.U[k].support(q) and system.U[k].level(flown) == 1),
            )


@claim.proof("Theorem 3, ii)", "from a boundary point the optimal control is unique")
def unique_control() -> Steps:
    for system in family():
        for k, (U, q) in enumerate(zip(system.U, system.costates[1:], strict=True)):
            other = U.point(q + system.costates[0])
            yield (
                f"{named(system)}: another boundary point of U({k}) has a smaller (ψ({k + 1}), u)",
                bool(q.dot(other) < U.support(q)),
            )
    yield from only_controls()


@claim.proof(
    "proof of Theorem 3: normals",
    "−A^−T(k)ψ(k) is normal at A(k)x*(k), hence at u*; so A^−T(k)ψ(k) is normal at u*(k)",
    display=r"-(A^{-1}(k))^T\psi(k) \in N(u^*, -U(k)),\quad (A^{-1}(k))^T\psi(k) \in N(u^*(k), U(k))",
)
def normals_at_the_controls() -> Steps:
    for system in family():
        states, controls = optimal(system)
        for k in range(system.steps):
            q = system.A[k].inv().T * system.costates[k]
            left = system.steps - k
            yield (
                f"{named(system)}: −A^−Tψ({k}) is normal to A({k})X({left}, {k}) at A({k})x*({k})",
                (-q.dot(system.A[k] * states[k]) == system.support(-system.costates[k], left, k)),
            )
            mirrored = system.U[k].image(-sp.eye(len(q)))
            yield (
                "and to −U(k) at u*, its negative to U(k) at u*(k)",
                (mirrored.point(-q) == -controls[k] and system.U[k].point(q) == controls[k]),
            )


@claim(
    "proof of Theorem 3: arg max",
    "u*(k) = ρ_U(k)(A^−T(k)ψ(k)), written as an arg max",
    verdict="misprint",
    remark="Printed: arg max ((A^−1(k))^T, u), where the scalar product of a matrix and a vector is not "
    "defined. Right: arg max ((A^−1(k))^T ψ(k), u), as in part i) of the theorem.",
)
def argument_of_the_maximum() -> Slip:
    def argument() -> Steps:
        for system in family():
            q = system.A[0].inv().T * system.costates[0]
            best = q.dot(system.U[0].point(q))
            yield (
                f"{named(system)}: (A^−Tψ, u) is a number, largest at ρ_U(A^−Tψ)",
                (best.is_Rational and best == system.U[0].support(q)),
            )

    def counterexample() -> Steps:
        for system in family():
            product = system.A[0].inv().T * system.controls()[0]
            n = len(system.psi0)
            yield (
                f"{named(system)}: A^−T u has {n} coordinates, and a maximum needs one",
                product.shape
                == (n, 1)
                != (
                    1,
                    1,
                ),
            )

    return Slip(
        argument,
        counterexample=counterexample,
        display=r"u^*(k) = \rho_{U(k)}((A^{-1}(k))^T\psi(k)) = \arg\max_{u \in U(k)}((A^{-1}(k))^T, u)",
    )


@claim.proof(
    "section 4: criterion",
    "the maximum principle is a criterion of optimality: the controls that it gives are optimal",
    remark="True for x0 on the boundary and −ψ(0) normal there. The paper uses that the principle is "
    "sufficient, but does not prove it.",
)
def sufficiency() -> Steps:
    for system in family():
        states, _ = optimal(system)
        yield f"{named(system)}: its controls end at 0 after N steps", states[-1].is_zero_matrix
        p = -system.costates[0]
        yield "and N − 1 steps do not do", p.dot(states[0]) > system.support(p, system.steps - 1)
