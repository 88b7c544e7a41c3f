"""Section 3, Lemma 5: the boundary of a sum."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Consequence, Misprint, Steps, vanishes
from pontryagin.orbit_correction.claims.convexity import DISC, E1, deficit
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.derivation import exact

claim = Page("Ibragimov 2017")


@claim.proof(
    "Lemma 5, i)",
    "a boundary point of X1 + X2 is in exactly one way a sum of a point of X1 and a point of X2",
    display=r"y^* = x^{1*} + x^{2*},\quad x^{1*} \in X_1,\ x^{2*} \in X_2",
)
def one_decomposition() -> Steps:
    for system in family():
        p, N = -system.costates[0], system.steps
        parts = system.summands(N)
        points = [part.point(p) for part in parts]
        yield (
            f"{named(system)}: y* is the sum of the support points",
            vanishes(sum(points, sp.zeros(*p.shape)) - system.boundary_state()),
        )
        w = sp.Matrix(sp.symbols(f"w1:{len(p) + 1}", real=True))
        for part in parts:
            yield (
                "any other x of a summand loses s/2 ((x − x*, H(x − x*)) + 1 − (x, Hx)) > 0",
                vanishes(sp.expand(part.support(p) - p.dot(w) - deficit(part, p, w))),
            )
        yield (
            "and nothing can make up for it: the supports add up to (p, y*)",
            (sum(part.support(p) for part in parts) == p.dot(system.boundary_state())),
        )


@claim.proof(
    "Lemma 5, ii)",
    "these two points lie on the boundaries of X1 and X2",
    display=r"x^{1*} \in \partial X_1,\ x^{2*} \in \partial X_2",
)
def parts_on_the_boundary() -> Steps:
    for system in family():
        p = -system.costates[0]
        levels = [part.level(part.point(p)) for part in system.summands(system.steps)]
        yield f"{named(system)}: all parts have (x, Hx) = 1", levels == [1] * system.steps


def lens_and_disc() -> Steps:
    """The lens plus the unit disc: a corner of one summand is smoothed in the sum."""
    p = sp.Matrix([1, 4]) / sp.sqrt(17)
    edges = exact.lens_corner_normals()
    yield (
        "lens plus unit disc: p = (1, 4)/√17 is normal at the lens's corner (0, 4/5)",
        (exact.normal_at_lens_corner(p) and exact.lens_level(exact.LENS_CORNER) == 1),
    )
    yield "as are (−3/5, 4/5) and (3/5, 4/5)", all(exact.normal_at_lens_corner(edge) for edge in edges)
    yield (
        "but at y* = (0, 4/5) + p only p is: the disc's support point is another for those",
        all(edge.norm() == 1 and edge.dot(p) < 1 for edge in edges),
    )


@claim.proof(
    "Lemma 5, iii)",
    "a normal of the sum at this point is a normal of both summands at their points",
    remark="Printed as an inclusion. It is an equality, as the last line of the proof says and as (4) "
    "and (9) require. At a corner of one summand the intersection is smaller than the normal cone "
    "of that summand.",
    display=r"N(y^*, Y) \subset N(x^{1*}, X_1) \cap N(x^{2*}, X_2)",
)
def normals_of_a_sum() -> Steps:
    for system in family():
        p, N = -system.costates[0], system.steps
        yield (
            f"{named(system)}: p is normal to every summand at its part",
            all(part.support(p) == p.dot(part.point(p)) for part in system.summands(N)),
        )
        total = sum(p.dot(part.point(p)) for part in system.summands(N))
        yield "and what is normal to all is normal to the sum", total == system.support(p, N)
    yield from lens_and_disc()


@claim(
    "proof of Lemma 5: maximum",
    "the maxima over X1 and X2 add up to the maximum over Y",
    verdict="misprint",
    remark="Printed, twice: the maximum of (p, x1 + x2) over x1 in X1 alone. Right: over x1 in X1 and x2 "
    "in X2 (the second line may be lost in the scan). For two unit discs, p = e1 and x2 = 0 the "
    "print gives 1 instead of 2.",
)
def maximum_over_the_sum() -> Misprint:
    p, second = E1, sp.zeros(2, 1)
    key = r"\max_{x^1 \in X_1,\, x^2 \in X_2}(p, x^1 + x^2)"
    return Misprint(
        {key: DISC.support(p) + p.dot(second)},
        lambda: 2 * DISC.support(p),
        defect={key: sp.Integer(-1)},
        consequence=lambda: Consequence(
            "two unit discs, p = e1: the maximum that the print gives for x2 = 0",
            DISC.support(p) + p.dot(second),
            p.dot(DISC.point(p) + DISC.point(p)),
        ),
        display=r"(p, x^{1*} + x^{2*}) = \max_{x^1 \in X_1}(p, x^1) + \max_{x^2 \in X_2}(p, x^2) = "
        r"\max_{x^1 \in X_1}(p, x^1 + x^2) = \max_{y \in Y}(p, y)",
    )


@claim.proof(
    "proof of Lemma 5: uniqueness",
    "another decomposition, with x1 ≠ x1* on the boundary of X1, would have (p, x1) < (p, x1*)",
    remark="The paper does not consider inner points x1 of X1; the same inequality excludes them.",
    display="(p, x^1) < (p, x^{1*})",
)
def other_decompositions() -> Steps:
    for system in family():
        X, p = system.U[0], system.costates[1]
        other, inner = X.point(system.costates[0]), X.point(p) / 2
        yield (
            f"{named(system)}: another boundary point has a smaller (p, x)",
            bool(p.dot(other) < X.support(p)) and vanishes(X.level(other) - 1),
        )
        yield "and so has an inner point", p.dot(inner) < X.support(p) and X.level(inner) < 1


@claim.proof(
    "proof of Lemma 5: equality",
    "N(y*, Y) is the intersection of the two normal cones",
    remark="The paper once prints X² where X_2 is meant.",
    display=r"N(y^*, Y) = N(x^{1*}, X_1) \cap N(x^{2*}, X_2)",
)
def equality_of_normal_cones() -> Steps:
    for system in family():
        p, N = -system.costates[0], system.steps
        normals = [part.normal(part.point(p)) for part in system.summands(N)]
        yield (
            f"{named(system)}: the normals at all parts are one ray, that of p",
            all(
                vanishes(normal * p.norm() ** 2 - p * normal.dot(p)) and normal.dot(p) > 0
                for normal in normals
            ),
        )
    yield from lens_and_disc()
