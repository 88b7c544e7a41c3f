"""Section 6, Lemma 10: the controls from the initial costate."""

from typing import Any

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality
from pontryagin.orbit_correction.claims.costate import parts
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.claims.shapes import shape_inverse
from pontryagin.orbit_correction.derivation import summands
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
    systems = family()
    keys = [f"u^*({k})\\ ({named(system)})" for system in systems for k in range(system.steps)]

    def printed() -> list[sp.Matrix]:
        rows = []
        for system in systems:
            for k in range(system.steps):
                product = summands.forward_product(system.A[: k + 1])
                rows.append(-product * parts(system, system.costates[0])[k])
        return rows

    return Equality(
        dict(zip(keys, printed(), strict=True)),
        lambda: dict(zip(keys, (u for system in systems for u in system.controls()), strict=True)),
        display=r"u^*(k) = \frac{A(k)\cdot\ldots\cdot A(0)\tilde H^{-1}(k+1)\psi_0}{\sqrt{(\psi_0, \tilde "
        r"H^{-1}(k+1)\psi_0)}}",
    )


@claim(
    "proof of Lemma 10: numerator", "H^−1(k) A^−T(k) ... A^−T(0) = A(k) ... A(0) H~^−1(k+1)", verdict="holds"
)
def numerator() -> Equality:
    key = r"A(1)A(0)\tilde H^{-1}(2)"

    def derived() -> dict[str, Any]:
        return {key: A(1) * A(0) * summands.carried_back(2) ** -1}

    return Equality(
        {key: H(1) ** -1 * A_transposed(1) ** -1 * A_transposed(0) ** -1},
        derived,
        display=r"H^{-1}(k)(A^{-1}(k))^T\cdot\ldots\cdot(A^{-1}(0))^T\psi_0 = A(k)\cdot\ldots\cdot "
        r"A(0)\tilde H^{-1}(k+1)\psi_0",
    )


@claim("proof of Lemma 10: root", "the expression under the root is (ψ0, H~^−1(k+1)ψ0)", verdict="holds")
def root_of_the_controls() -> Equality:
    systems = family()
    keys = [f"k = {k}\\ ({named(system)})" for system in systems for k in range(system.steps)]

    def printed() -> list[sp.Expr]:
        return [(s.psi0.T * shape_inverse(s, k + 1) * s.psi0)[0] for s in systems for k in range(s.steps)]

    def derived() -> list[sp.Expr]:
        return [s.U[k].support(s.A[k].inv().T * s.costates[k]) ** 2 for s in systems for k in range(s.steps)]

    return Equality(
        dict(zip(keys, printed(), strict=True)),
        lambda: dict(zip(keys, derived(), strict=True)),
        display=r"((A^{-1}(k))^T\psi(k), H^{-1}(k)(A^{-1}(k))^T\psi(k)) = (\psi_0, \tilde H^{-1}(k+1)\psi_0)",
    )
