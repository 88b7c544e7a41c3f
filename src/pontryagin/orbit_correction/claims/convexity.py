"""Section 3: strictly convex compact sets, their support points and normals."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, RightSides, Slip, Steps, vanishes
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation.exact import Ellipsoid

claim = Page("Ibragimov 2017")

R = sp.Rational
E1, E2 = sp.Matrix([1, 0]), sp.Matrix([0, 1])
DISC = Ellipsoid(sp.ImmutableMatrix(sp.eye(2)))
share = sp.Symbol("lambda", positive=True)


def deficit(X: Ellipsoid, p: sp.Matrix, x: sp.Matrix) -> sp.Expr:
    """s/2 ((x − x', H(x − x')) + 1 − (x, Hx)): how far (p, x) stays below s, x' the support point."""
    return X.support(p) / 2 * (X.level(x - X.point(p)) + 1 - X.level(x))


@claim(
    "section 3: the class U_2",
    "U_2 is the class of the strictly convex compact sets: the open segment between any two "
    "points of such a set lies in its interior",
    verdict="misprint",
    remark="Printed: for all x1, x2 in X. Right: for x1 ≠ x2. As printed, x1 = x2 = e1 would make the "
    "boundary point e1 of the unit disc an inner point. Then no set with a boundary would belong "
    "to the class, hence no compact set but the empty one.",
)
def strictly_convex_sets() -> Slip:
    def argument() -> Steps:
        a, b = sp.symbols("a b", real=True)
        first = sp.Matrix([1 - a**2, 2 * a]) / (1 + a**2)
        second = sp.Matrix([1 - b**2, 2 * b]) / (1 + b**2)
        between = share * first + (1 - share) * second
        inside = 1 - DISC.level(between)
        yield (
            "unit disc: 1 − |λx1 + (1 − λ)x2|² = λ(1 − λ)|x1 − x2|² on its boundary",
            vanishes(inside - share * (1 - share) * DISC.level(first - second)),
        )
        y, z = sp.Matrix(sp.symbols("y1:4", real=True)), sp.Matrix(sp.symbols("z1:4", real=True))
        ellipsoid = family()[1].U[0]
        mixed = share * ellipsoid.level(y) + (1 - share) * ellipsoid.level(z)
        curved = mixed - ellipsoid.level(share * y + (1 - share) * z)
        yield (
            "and in the same way for (x, Hx), in space",
            vanishes(sp.expand(curved - share * (1 - share) * ellipsoid.level(y - z))),
        )

    def counterexample() -> Steps:
        point = R(1, 2) * E1 + R(1, 2) * E1
        yield (
            "unit disc, x1 = x2 = e1: λx1 + (1 − λ)x2 = e1 has |x|² = 1, no inner point",
            (point == E1 and DISC.level(point) == 1),
        )
        yield "though 0 is one", DISC.level(sp.zeros(2, 1)) < 1

    return Slip(
        argument,
        counterexample=counterexample,
        display=r"U_2 = \{X \subset \mathbb{R}^n : \forall x^1, x^2 \in X,\ \lambda \in (0; 1)\ \lambda x^1 "
        r"+ (1-\lambda)x^2 \in \operatorname{int} X,\ X \text{ compact}\}",
    )


@claim.proof(
    "section 3: support vector",
    "p ≠ 0 supports X at x if X lies in the half-space (p, u) ≤ (p, x)",
    display=r"X \subset \{u \in \mathbb{R}^n : (p, u) \le (p, x)\}",
)
def support_vectors() -> Steps:
    for system in family():
        X, p = system.U[0], system.costates[1]
        at = X.point(p)
        w = sp.Matrix(sp.symbols(f"w1:{len(at) + 1}", real=True))
        gap = X.support(p) - p.dot(w) - deficit(X, p, w)
        yield f"{named(system)}: (p, x) − (p, u) is a sum of squares for (u, Hu) ≤ 1", vanishes(gap)
        yield "so p supports the set at its support point and at no other", X.level(at) == 1


@claim.proof(
    "section 3: support function", "s(p, X) is the largest (p, x)", display=r"s(p, X) = \max_{x \in X}(p, x)"
)
def support_function() -> Steps:
    for system in family():
        p = system.costates[0]
        total = system.support(p, system.steps)
        yield f"{named(system)}: attained by the support point", p.dot(system.point(p, system.steps)) == total
        pieces = sum(part.support(p) for part in system.summands(system.steps))
        yield "and the support function of a sum is the sum", pieces == total


@claim(
    "section 3: normal cone",
    "N(x, X) is the set of the vectors that support X at x",
    verdict="misprint",
    remark="Printed: s(p, X) ≥ (p, x), which every p satisfies for x in X. Right: s(p, X) ≤ (p, x), hence "
    "equality. As printed, e2 would be normal to the unit disc at e1, and Corollary 2 would fail.",
)
def normal_cones() -> Slip:
    def argument() -> Steps:
        angle = sp.Symbol("phi", real=True)
        p = sp.Matrix([sp.cos(angle), sp.sin(angle)])
        tight = [value for value in sp.solve(sp.Eq(p.dot(E1), 1), angle) if -sp.pi < value <= sp.pi]
        yield "unit disc at e1: s(p) = |p| = (p, e1) for p along e1 alone", tight == [0]
        for system in family():
            X, q = system.U[0], system.costates[1]
            at = X.point(q)
            yield (
                f"{named(system)}: the gradient at a boundary point has s(p) = (p, x)",
                X.support(X.normal(at)) == X.normal(at).dot(at),
            )

    def counterexample() -> Steps:
        yield "s(e2) = 1 ≥ (e2, e1) = 0: e2 satisfies the print", DISC.support(E2) == 1 > E2.dot(E1) == 0
        yield (
            "but (e2, e2) = 1 > (e2, e1): e2 does not support the disc at e1",
            (DISC.level(E2) == 1 and E2.dot(E2) > E2.dot(E1)),
        )

    return Slip(
        argument,
        counterexample=counterexample,
        display=r"N(x, X) = \{p \in \mathbb{R}^n \setminus \{0\} : s(p, X) \ge (p, x)\}",
    )


@claim(
    "Lemma 2",
    "for p in R^n exactly one x' in X has (p, x') = s(p, X), and x' lies on the boundary",
    verdict="conditional",
    remark="True for p ≠ 0, the domain of ρ_X. For p = 0 every point x' of X has (p, x') = s(p, X).",
)
def one_support_point() -> Conditional:
    def argument() -> Steps:
        for system in family():
            for X, p in zip(system.U, system.costates[1:], strict=True):
                at = X.point(p)
                yield (
                    f"{named(system)}: x' has (p, x') = s and (x', Hx') = 1",
                    (p.dot(at) == X.support(p) and X.level(at) == 1),
                )
                w = sp.Matrix(sp.symbols(f"w1:{len(at) + 1}", real=True))
                loss = X.support(p) - p.dot(w)
                yield (
                    "s − (p, x) = s/2 ((x − x', H(x − x')) + 1 − (x, Hx)): positive for every other x",
                    vanishes(loss - deficit(X, p, w)),
                )

    def counterexample() -> Steps:
        zero = sp.zeros(2, 1)
        yield (
            "p = 0: s(0) = 0 = (0, e1) = (0, e2), at two points of the unit disc",
            (zero.dot(E1) == zero.dot(E2) == DISC.support(zero) == 0),
        )
        yield "and at 0, an inner point", zero.dot(zero) == 0 and DISC.level(zero) < 1

    return Conditional(argument, counterexample=counterexample, display="(p, x') = s(p, X)")


@claim(
    "proof of Lemma 2",
    "if (p, x') = (p, x'') = s(p, X), the point εp beyond the middle of x' and x'' has (p, ·) = "
    "s(p, X) + ε(p, p)",
    verdict="holds",
)
def moved_midpoint() -> Equality:
    s, size = sp.symbols("s epsilon", positive=True)
    first, second = (sp.Matrix(sp.symbols(f"{name}1:4", real=True)) for name in ("x", "y"))
    p = sp.Matrix(sp.symbols("p1:4", real=True))

    def derived() -> RightSides:
        # (p, x') = (p, x'') = s determines the last coordinates.
        levels = [p.dot(point) - s for point in (first, second)]
        known = sp.solve(levels, [first[2], second[2]], dict=True)[0]
        moved = (first + second) / 2 + size * p
        return sp.simplify(p.dot(moved.subs(known)))

    return Equality(
        {r"(p, \tfrac12 x'' + \tfrac12 x' + \varepsilon p)": s + size * p.dot(p)},
        derived,
        display=r"(p, \tfrac12 x'' + \tfrac12 x' + \varepsilon p) = \tfrac12(p, x'') + \tfrac12(p, x') + "
        r"\varepsilon(p, p) = s(p, X) + \varepsilon(p, p) > s(p, X)",
    )


@claim.proof(
    "after Lemma 2: ρ_X",
    "ρ_X(p) = arg max over X of (p, x) maps p ≠ 0 to the boundary",
    display=r"\rho_X : \mathbb{R}^n \setminus \{0\} \to \partial X,\quad \rho_X(p) = \arg\max_{x \in "
    r"X}(p, x)",
)
def support_map() -> Steps:
    h = sp.symbols("h", positive=True)
    X = Ellipsoid(sp.ImmutableMatrix(sp.diag(h, 2 * h)))
    p = sp.Matrix(sp.symbols("p1:3", positive=True))
    at = X.point(p)
    yield "ellipse with semi-axes h, 2h: ρ(p) lies on the boundary", vanishes(X.level(at) - 1)
    yield "does not depend on the length of p", vanishes(X.point(3 * p) - at)
    yield (
        "and is the gradient of the support function",
        vanishes(sp.Matrix([X.support(p)]).jacobian(p).T - at),
    )


@claim.proof(
    "Corollary 2",
    "the normal cones at two different boundary points have no vector in common",
    display=r"N(x^1, X) \cap N(x^2, X) = \emptyset",
)
def disjoint_normal_cones() -> Steps:
    v, w = sp.Matrix(sp.symbols("v1:4", real=True)), sp.Matrix(sp.symbols("w1:4", real=True))
    on_sphere = {v[2] ** 2: 1 - v[0] ** 2 - v[1] ** 2, w[2] ** 2: 1 - w[0] ** 2 - w[1] ** 2}
    lost = sp.expand(1 - v.dot(w) - (v - w).dot(v - w) / 2).subs(on_sphere)
    yield "unit sphere: v is normal at v, and 1 − (v, w) = |v − w|²/2 > 0 at any other w", vanishes(lost)
    L = sp.Matrix(3, 3, sp.symbols("L1:10", real=True))
    cofactors = L.adjugate().T
    yield (
        "ellipsoid x = Lv: L^−T v is normal there, with the same products",
        vanishes(sp.expand((cofactors * v).dot(L * w) - L.det() * v.dot(w))),
    )
