"""Section 6, Lemma 8: ellipsoids, their images and the summands of X(N, 0)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Consequence, Equality, Misprint, RightSides, Steps, vanishes
from pontryagin.orbit_correction.claims import worked
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import summands
from pontryagin.orbit_correction.derivation.exact import Ellipsoid, ExactSystem
from pontryagin.orbit_correction.derivation.summands import A, A_transposed, H

claim = Page("Ibragimov 2017")


def shape_inverse(system: ExactSystem, k: int) -> sp.Matrix:
    """H~^-1(k) of E_k, k = 1, ..., N, from the products of the A(k)."""
    product = summands.forward_product(system.A[:k])
    return (product.T * system.U[k - 1].shape * product).inv()


@claim.proof(
    "section 6: U(k)",
    "the set (u, Hu) ≤ 1 with H positive definite belongs to U_2, because (u, Hu) is strictly convex",
    display=r"U(k) = \{u \in \mathbb{R}^n : (u, H(k)u) \le 1\}",
)
def ellipsoids_are_strictly_convex() -> Steps:
    a, b, h11, h12, h22 = sp.symbols("a b h11 h12 h22", real=True)
    share = sp.Symbol("lambda", positive=True)
    shape = sp.Matrix([[h11, h12], [h12, h22]])
    x, y = sp.Matrix(sp.symbols("x1:3", real=True)), sp.Matrix([a, b])

    def form(v: sp.Matrix) -> sp.Expr:
        return (v.T * shape * v)[0]

    mixed = share * form(x) + (1 - share) * form(y) - form(share * x + (1 - share) * y)
    yield (
        "λ(x, Hx) + (1 − λ)(y, Hy) − (·) = λ(1 − λ)(x − y, H(x − y))",
        vanishes(sp.expand(mixed - share * (1 - share) * form(x - y))),
    )
    for system in family():
        yield (
            f"{named(system)}: H > 0, and 0 is an inner point",
            (system.U[0].shape.is_positive_definite and system.U[0].level(sp.zeros(*system.psi0.shape)) == 0),
        )


def plane() -> tuple[Ellipsoid, sp.Matrix, sp.Matrix]:
    """An ellipse, a nonsingular matrix and a point, all with symbols for entries."""
    L = sp.Matrix(
        [[sp.Symbol("p", positive=True), 0], [sp.Symbol("q", real=True), sp.Symbol("r", positive=True)]]
    )
    M = sp.Matrix(2, 2, sp.symbols("a b c d", real=True))
    return Ellipsoid(sp.ImmutableMatrix(L)), M, sp.Matrix(sp.symbols("x1:3", real=True))


@claim.proof("Lemma 8, i)", "A^−T H A^−1 is positive definite", display=r"(A^{-1})^T H A^{-1} > 0")
def positive_definite_image() -> Steps:
    X, M, y = plane()
    form = (y.T * M.inv().T * X.shape * M.inv() * y)[0]
    root = X.factor.inv() * M.inv() * y
    yield "(y, A^−T H A^−1 y) = |L^−1 A^−1 y|², H = L^−T L^−1", vanishes(sp.cancel(form - root.dot(root)))
    for system in family():
        inverse = system.A[0].inv()
        yield (
            f"{named(system)}: positive definite",
            (inverse.T * system.U[0].shape * inverse).is_positive_definite,
        )


@claim(
    "proof of Lemma 8, i)",
    "(y, A^−T H A^−1 y) = (A^−1 y, H A^−1 y) = (x, Hx) for x = A^−1 y",
    verdict="holds",
)
def form_of_the_image() -> Equality:
    X, M, x = plane()
    return Equality(
        {r"(y, (A^{-1})^T H A^{-1}y)": (x.T * X.shape * x)[0]},
        lambda: sp.cancel(((M * x).T * M.inv().T * X.shape * M.inv() * (M * x))[0]),
        display=r"(y, (A^{-1})^T H A^{-1}y) = (A^{-1}y, HA^{-1}y) = (x, Hx) \ge 0",
    )


@claim("Lemma 8, ii)", "AX is the ellipsoid of A^−T H A^−1", verdict="holds")
def image_of_an_ellipsoid() -> Equality:
    X, M, _ = plane()
    return Equality(
        {r"H_{AX}": M.inv().T * X.shape * M.inv()},
        lambda: X.image(M).shape,
        display=r"AX = \{x \in \mathbb{R}^n : (x, (A^{-1})^T H A^{-1}x) \le 1\}",
    )


@claim(
    "proof of Lemma 8, ii)",
    "(x, Hx) as the form of A^−T H A^−1 at Ax",
    verdict="misprint",
    remark="Printed: (Ax, A^−T H A^−1 x). Right: (Ax, A^−T H A^−1 Ax). For H = I, A = 2I, x = e1 the print "
    "gives 1/2 instead of 1.",
)
def form_at_the_image_point() -> Misprint:
    X, M, x = plane()
    key = "(x, Hx)"
    right = (x.T * X.shape * x)[0]
    printed = ((M * x).T * M.inv().T * X.shape * M.inv() * x)[0]

    def consequence() -> Consequence:
        a, b, c, d = M
        (p, _, q, r), (x1, x2) = X.factor, x
        numbers = {a: 2, b: 0, c: 0, d: 2, p: 1, q: 0, r: 1, x1: 1, x2: 0}
        return Consequence("H = I, A = 2I, x = e1: (x, Hx)", printed.subs(numbers), right.subs(numbers))

    return Misprint(
        {key: printed},
        lambda: right,
        defect={key: (x.T * X.shape * (M.inv() - sp.eye(2)) * x)[0]},
        consequence=consequence,
        display=r"(x, Hx) = (A^{-1}Ax, HA^{-1}Ax) = (Ax, (A^{-1})^T H A^{-1}x) \le 1",
    )


@claim(
    "after Lemma 8: E_k",
    "the summand E_k = A^−1(0) ... A^−1(k−1) U(k), k ≥ 1",
    verdict="misprint",
    remark="Printed with U(k). Right: U(k − 1), from Lemma 1 with i = k − 1. For x(k+1) = x(k) + u(k), "
    "|u(k)| ≤ k + 1, the print gives E_1 = [−2, 2], but X(1, 0) = [−1, 1].",
)
def summand() -> Misprint:
    key = "e_2"
    back = summands.backward_product([A(0), A(1)])

    def derived() -> RightSides:
        # The part of the state that the last of two controls brings to 0; its sign is immaterial by symmetry.
        state = summands.state_brought_to_zero(2)
        return -(state - state.subs(summands.u(1), 0))

    def consequence() -> Consequence:
        sizes = [k + 1 for k in range(3)]
        return Consequence("x(k+1) = x(k) + u(k), |u(k)| ≤ k + 1: half the length of E_1", sizes[1], sizes[0])

    return Misprint(
        {key: back * summands.u(2)},
        derived,
        defect={key: back * (summands.u(2) - summands.u(1))},
        consequence=consequence,
        display=r"E_k = A^{-1}(0)\cdot\ldots\cdot A^{-1}(k-1)U(k),\quad k \in \mathbb{N}",
    )


@claim(
    "after Lemma 8: H~(k)",
    "the matrix H~(k) of E_k",
    verdict="misprint",
    remark="Printed with H(k). Right: H(k − 1), which is also what Lemma 10 takes for H~(k+1). With the "
    "index as printed, the worked example has α = 0.8903 instead of the printed 0.9286.",
)
def shape_of_a_summand() -> Misprint:
    key = r"\tilde H(2)"
    before, after = A_transposed(0) * A_transposed(1), A(1) * A(0)

    def consequence() -> Consequence:
        shifted, right = (worked.gauge_with(4, shift=shift).alpha for shift in (1, 0))
        return Consequence("α of the worked example", sp.Float(shifted, 4), sp.Float(right, 4))

    return Misprint(
        {key: before * H(2) * after},
        lambda: summands.carried_back(2),
        defect={key: before * (H(2) - H(1)) * after},
        consequence=consequence,
        display=r"\tilde H(k) = (A(k-1)\cdot\ldots\cdot A(0))^T H(k)(A(k-1)\cdot\ldots\cdot A(0))",
    )


@claim.proof(
    "after Lemma 8: X(N, 0)",
    "X(N, 0) is the sum of E_1, ..., E_N",
    remark="True with the corrected E_k.",
    display=r"X(N, 0) = \sum_{k=1}^{N} E_k",
)
def sum_of_ellipsoids() -> Steps:
    for system in family():
        for k, part in enumerate(system.summands(system.steps), start=1):
            yield (
                f"{named(system)}: summand {k} of Lemma 1 is the ellipsoid of H~({k})",
                vanishes(part.factor * part.factor.T - shape_inverse(system, k)),
            )
