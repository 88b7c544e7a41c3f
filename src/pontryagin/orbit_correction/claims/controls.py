"""Section 6, Lemma 10: the controls from the initial costate."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality
from pontryagin.orbit_correction.claims.costate import parts
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.claims.shapes import shape_inverse
from pontryagin.orbit_correction.derivation import summands
from pontryagin.orbit_correction.derivation.exact import ExactSystem
from pontryagin.orbit_correction.derivation.summands import A, A_transposed, H

claim = Page("Ibragimov 2017")


@claim(
    "Lemma 10",
    "the optimal control u*(k) as a function of ψ0 and H~(k+1)",
    verdict="holds",
    remark="True for x0 on the boundary, with the corrected H~. For inner points the right-hand side has "
    "to be multiplied by the α of Theorem 4.",
)
def controls_from_the_costate() -> Equality:
    def printed(system: ExactSystem, k: int) -> sp.Matrix:
        return -summands.forward_product(system.A[: k + 1]) * parts(system, system.costates[0])[k]

    return Equality(
        {f"u^*({k})\\ ({named(s)})": printed(s, k) for s in family() for k in range(s.steps)},
        lambda: [u for system in family() for u in system.controls()],
        display=r"u^*(k) = \frac{A(k)\cdot\ldots\cdot A(0)\tilde H^{-1}(k+1)\psi_0}{\sqrt{(\psi_0, \tilde "
        r"H^{-1}(k+1)\psi_0)}}",
    )


@claim(
    "proof of Lemma 10: numerator", "H^−1(k) A^−T(k) ... A^−T(0) = A(k) ... A(0) H~^−1(k+1)", verdict="holds"
)
def numerator() -> Equality:
    return Equality(
        {r"A(1)A(0)\tilde H^{-1}(2)": H(1) ** -1 * A_transposed(1) ** -1 * A_transposed(0) ** -1},
        lambda: A(1) * A(0) * summands.carried_back(2) ** -1,
        display=r"H^{-1}(k)(A^{-1}(k))^T\cdot\ldots\cdot(A^{-1}(0))^T\psi_0 = A(k)\cdot\ldots\cdot "
        r"A(0)\tilde H^{-1}(k+1)\psi_0",
    )


@claim("proof of Lemma 10: root", "the expression under the root is (ψ0, H~^−1(k+1)ψ0)", verdict="holds")
def root_of_the_controls() -> Equality:
    def printed(system: ExactSystem, k: int) -> sp.Expr:
        return (system.psi0.T * shape_inverse(system, k + 1) * system.psi0)[0]

    def derived(system: ExactSystem, k: int) -> sp.Expr:
        return system.U[k].support(system.A[k].inv().T * system.costates[k]) ** 2

    return Equality(
        {f"k = {k}\\ ({named(s)})": printed(s, k) for s in family() for k in range(s.steps)},
        lambda: [derived(s, k) for s in family() for k in range(s.steps)],
        display=r"((A^{-1}(k))^T\psi(k), H^{-1}(k)(A^{-1}(k))^T\psi(k)) = (\psi_0, \tilde H^{-1}(k+1)\psi_0)",
    )
