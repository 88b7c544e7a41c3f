"""Section 3, Lemma 3 and Lemma 4: images and sums stay strictly convex."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, RightSides, Steps, vanishes
from pontryagin.orbit_correction.claims.convexity import DISC, E1, E2, share
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation.exact import Ellipsoid

claim = Page("Ibragimov 2017")

R = sp.Rational


def transformed() -> tuple[sp.Matrix, sp.Matrix, sp.Matrix, sp.Matrix]:
    """A nonsingular A with symbols for entries, x, x' and p, in the plane."""
    A = sp.Matrix(2, 2, sp.symbols("a b c d", real=True))
    return A, *(sp.Matrix(sp.symbols(f"{name}1:3", real=True)) for name in ("x", "y", "p"))


@claim.proof(
    "Lemma 3",
    "a nonsingular A maps the boundary of X to that of AX, A^−T maps the normals, and AX belongs to U_2",
    remark="The proof of ii) shows that A^−T N(x, X) lies in N(Ax, AX). The other inclusion follows in "
    "the same way, with A^−1 for A.",
    display=r"A\,\partial X = \partial(AX),\quad N(Ax, AX) = (A^{-1})^T N(x, X),\quad AX \in U_2",
)
def nonsingular_images() -> Steps:
    A, x, y, p = transformed()
    kept = (A.inv().T * p).dot(A * y) - p.dot(y)
    yield "(A^−T p, Ay) = (p, y): p supports X at x exactly where A^−T p supports AX at Ax", vanishes(kept)
    L = sp.Matrix([[2, 0], [1, 1]])
    X = Ellipsoid(sp.ImmutableMatrix(L))
    yield (
        "i) levels are kept, inner points stay inner",
        vanishes(sp.simplify(X.image(A).level(A * x) - X.level(x))),
    )
    yield (
        "ii) the gradient is carried by A^−T",
        vanishes(sp.simplify(X.image(A).normal(A * x) - A.inv().T * X.normal(x))),
    )
    for system in family():
        X, M, q = system.U[0], system.A[1], system.costates[1]
        image = X.image(M)
        yield (
            f"{named(system)}: support points go to support points",
            image.point(M.inv().T * q) == M * X.point(q),
        )
        middle = (X.point(q) + X.point(-q) / 3) / 2
        yield "iii) the middle of two points stays inside", image.level(M * middle) == X.level(middle) < 1


@claim("proof of Lemma 3: products", "(p, x) = (A^−T p, Ax) and (A^−T p, x') = (p, A^−1 x')", verdict="holds")
def products_under_a_map() -> Equality:
    A, x, y, p = transformed()
    return Equality(
        {"(p, x)": p.dot(x), r"((A^{-1})^T p, x')": sp.cancel((A.inv().T * p).dot(y))},
        lambda: {
            "(p, x)": sp.cancel((A.inv().T * p).dot(A * x)),
            r"((A^{-1})^T p, x')": sp.cancel(p.dot(A.inv() * y)),
        },
        display=r"(p, x) = (p, A^{-1}Ax) = ((A^{-1})^T p, Ax) < ((A^{-1})^T p, x') = (p, A^{-1}x')",
    )


@claim("proof of Lemma 3: segment", "A^−1 maps a segment of AX to a segment of X", verdict="holds")
def segments_under_a_map() -> Equality:
    A, x, y, _ = transformed()
    inverse = A.inv()
    return Equality(
        {r"A^{-1}(\lambda x' + (1-\lambda)x'')": share * inverse * x + (1 - share) * inverse * y},
        lambda: inverse * (share * x + (1 - share) * y),
        display=r"A^{-1}(\lambda x' + (1-\lambda)x'') = \lambda A^{-1}x' + (1-\lambda)A^{-1}x'' \in "
        r"\operatorname{int} X",
    )


@claim.proof(
    "Lemma 4",
    "the sum of two sets of U_2 belongs to U_2",
    remark="The printed proof has a gap: see the entry on its parts, below.",
    display=r"X_1, X_2 \in U_2 \;\Rightarrow\; X_1 + X_2 \in U_2",
)
def sums_stay_strictly_convex() -> Steps:
    for system in family():
        first, second = system.U[0], system.U[1]
        p, q = system.costates[1], system.costates[2]
        ends = [(first.point(d), second.point(e)) for d, e in ((p, q), (p, -q), (-p, q))]
        for a, b in ((0, 1), (0, 2), (1, 2)):
            halves = [(ends[a][i] + ends[b][i]) / 2 for i in range(2)]
            room = 2 - first.level(halves[0]) - second.level(halves[1])
            both = first.level(halves[0]) <= 1 and second.level(halves[1]) <= 1
            yield (
                f"{named(system)}: of the middles of the two parts of y1 ≠ y2 at least one lies inside "
                f"its "
                "set, so a ball about it, plus the other part, lies in the sum",
                both and room > 0,
            )


@claim.proof(
    "proof of Lemma 4: balls",
    "the sum of a ball about x1 and a ball about x2 contains the ball of the smaller radius about x1 + x2",
    remark="The paper defines O_r(x0) as a part of a space L that it does not introduce; R^n is meant.",
    display=r"O_{\min\{\varepsilon_1,\varepsilon_2\}}(x^1 + x^2) \subset O_{\varepsilon_1}(x^1) + "
    r"O_{\varepsilon_2}(x^2) \subset Y",
)
def sums_of_balls() -> Steps:
    w = sp.Matrix(sp.symbols("w1:4", real=True))
    small, large = sp.symbols("epsilon_1 epsilon_2", positive=True)
    part = small / (small + large)
    yield "w = part of it in the first ball + the rest in the second", vanishes(part * w + (1 - part) * w - w)
    yield (
        "|w| < ε1 + ε2 makes the parts shorter than ε1 and ε2",
        vanishes(part * (small + large) - small) and vanishes((1 - part) * (small + large) - large),
    )
    yield (
        "and min(ε1, ε2) is below ε1 + ε2",
        all((small + large - radius).is_positive for radius in (small, large)),
    )


@claim(
    "proof of Lemma 4: segment",
    "λy1 + (1 − λ)y2 is the sum of λx11 + (1 − λ)x12 and λx21 + (1 − λ)x22",
    verdict="holds",
)
def segments_of_a_sum() -> Equality:
    parts = sp.Matrix(2, 2, sp.symbols("x11 x12 x21 x22"))

    def derived() -> RightSides:
        first, second = parts[0, 0] + parts[1, 0], parts[0, 1] + parts[1, 1]
        return share * first + (1 - share) * second

    middles = [share * parts[i, 0] + (1 - share) * parts[i, 1] for i in range(2)]
    return Equality({r"\lambda y^1 + (1-\lambda)y^2": sum(middles)}, derived)


@claim(
    "proof of Lemma 4: parts",
    "for y1 = x11 + x21 and y2 = x12 + x22 both λx11 + (1 − λ)x12 and λx21 + (1 − λ)x22 are inner points",
    verdict="conditional",
    remark="True where x11 ≠ x12 and x21 ≠ x22. From y1 ≠ y2 only one of the two follows: for two unit "
    "discs, y1 = e1 + e2 and y2 = e1 − e2, the first point is e1, which lies on the boundary. "
    "Lemma 4 is true all the same, because x + int X2 is open.",
)
def parts_inside() -> Conditional:
    def argument() -> Steps:
        for system in family():
            X, p = system.U[0], system.costates[1]
            middle = (X.point(p) + X.point(-p)) / 2
            yield (
                f"{named(system)}: between two different boundary points the level is below 1",
                X.level(middle) < 1,
            )

    def counterexample() -> Steps:
        first, second = (E1 + E2, E1 - E2)
        yield "unit discs: y1 = e1 + e2 and y2 = e1 − e2 differ", first != second
        part = R(1, 2) * E1 + R(1, 2) * E1
        yield "λx11 + (1 − λ)x12 = e1 has |x|² = 1, no inner point", DISC.level(part) == 1
        other = R(1, 2) * E2 - R(1, 2) * E2
        yield (
            "the sum's middle e1 + 0 is one all the same: a disc of radius 1 about it lies in e1 + X2",
            (DISC.level(other) == 0),
        )

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\lambda x^{11} + (1-\lambda)x^{12} \in \operatorname{int} X_1,\quad \lambda x^{21} + "
        r"(1-\lambda)x^{22} \in \operatorname{int} X_2",
    )
