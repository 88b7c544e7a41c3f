"""Section 6, Lemma 9: the initial costate, (8) to (11)."""

from collections.abc import Sequence

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, RightSides, Steps, vanishes
from pontryagin.orbit_correction.claims.family import family, named
from pontryagin.orbit_correction.claims.shapes import plane, shape_inverse
from pontryagin.orbit_correction.derivation.exact import ExactSystem

claim = Page("Ibragimov 2017")


def parts(system: ExactSystem, psi: sp.Matrix) -> list[sp.Matrix]:
    """x^k = −H~^-1(k)ψ/√(ψ, H~^-1(k)ψ)."""
    inverses = [shape_inverse(system, k) for k in range(1, system.steps + 1)]
    return [-Q * psi / sp.sqrt((psi.T * Q * psi)[0]) for Q in inverses]


def total(system: ExactSystem, psi: sp.Matrix) -> sp.Matrix:
    """The sum of the x^k."""
    return sum(parts(system, psi), sp.zeros(*psi.shape))


def levels(system: ExactSystem, points: Sequence[sp.Matrix]) -> list[sp.Expr]:
    """(x, H~(k)x) of points x of E_1, E_2, ...; it is 1 on the boundary."""
    return [(x.T * shape_inverse(system, k).inv() * x)[0] for k, x in enumerate(points, start=1)]


@claim(
    "Lemma 9",
    "the equation for the initial costate ψ0, with −x0 as a sum of N_min vectors that depend on ψ0",
    verdict="holds",
    remark="True with the corrected H~(k).",
)
def equation_for_the_costate() -> Equality:
    return Equality(
        {f"-x_0\\ ({named(system)})": -total(system, system.costates[0]) for system in family()},
        lambda: [-system.boundary_state() for system in family()],
        display=r"-x_0 = \sum_{k=1}^{N_{\min}} \frac{\tilde H^{-1}(k)\psi_0}{\sqrt{(\psi_0, \tilde "
        r"H^{-1}(k)\psi_0)}}",
    )


@claim.proof(
    "(8)",
    "x0 is in exactly one way a sum of boundary points x^k of the E_k",
    display=r"x_0 = \sum_{k=1}^{N_{\min}} x^k,\quad x^k \in \partial E_k",
)
def decomposition_into_ellipsoids() -> Steps:
    for system in family():
        added = total(system, system.costates[0])
        yield f"{named(system)}: the x^k add up to x0", vanishes(added - system.boundary_state())
        points = parts(system, system.costates[0])
        yield "and lie on the boundaries", levels(system, points) == [1] * system.steps
        moved = points[0] + (points[0] - points[1]) / 100
        other = points[1] - (points[0] - points[1]) / 100
        outside = levels(system, (moved, other))
        yield "what is moved from one to the next takes one of them outside", max(outside) > 1


@claim.proof(
    "(9)",
    "−ψ0 is normal to X(N_min, 0) at x0, and to every E_k at x^k",
    display=r"-\psi_0 \in N(x_0, X(N_{\min}, 0)) = \bigcap_{k=1}^{N_{\min}} N(x^k, E_k)",
)
def common_normal() -> Steps:
    for system in family():
        p = -system.costates[0]
        for part, point in zip(system.summands(system.steps), parts(system, system.costates[0]), strict=True):
            yield (
                f"{named(system)}: (−ψ0, x^k) is the support function of E_k",
                p.dot(point) == part.support(p),
            )
        yield "and the sum that of X(N, 0)", p.dot(system.boundary_state()) == system.support(p, system.steps)


@claim.proof(
    "after (9): rays",
    "the normal cone at a boundary point of an ellipsoid is the ray of the gradient",
    display=r"N(x^k, E_k) = \operatorname{cone}\{\nabla_x(x, \tilde H(k)x)\Bigr|_{x=x^k}\} \setminus "
    r"\{0\}",
)
def rays() -> Steps:
    X, _, x = plane()
    gradient = sp.Matrix([X.level(x)]).jacobian(x).T
    yield "∇(x, Hx) = 2Hx", vanishes(sp.cancel(gradient - 2 * X.shape * x))
    angle = sp.Symbol("phi", real=True)
    p = sp.Matrix([sp.cos(angle), sp.sin(angle)])
    yield (
        "unit circle at e1: p = (cos φ, sin φ) with (p, e1) = |p| is φ = 0",
        sp.solveset(sp.Eq(p[0], 1), angle, sp.Interval.Lopen(-sp.pi, sp.pi)) == sp.FiniteSet(0),
    )


@claim.proof(
    "after (9): one ray",
    "hence N(x0, X(N_min, 0)) = N(x^k, E_k) for every k",
    display=r"-\psi_0 \in N(x_0, X(N_{\min}, 0)) = N(x^k, E_k)",
)
def one_ray() -> Steps:
    for system in family():
        p = -system.costates[0]
        for k, point in enumerate(parts(system, system.costates[0]), start=1):
            gradient = shape_inverse(system, k).inv() * point
            yield (
                f"{named(system)}: the gradient at x^{k} is along −ψ0",
                (vanishes(gradient * p.norm() ** 2 - p * gradient.dot(p)) and gradient.dot(p) > 0),
            )


@claim.proof(
    "(10)",
    "x^k is the point of E_k with the largest (−ψ0, x)",
    display=r"x^k = \rho_{E_k}(-\psi_0) = \arg\max_{(x, \tilde H(k)x) \le 1}(-\psi_0, x)",
)
def parts_as_support_points() -> Steps:
    for system in family():
        p = -system.costates[0]
        for part, point in zip(system.summands(system.steps), parts(system, system.costates[0]), strict=True):
            yield f"{named(system)}: x^k = ρ(−ψ0)", vanishes(point - part.point(p))


@claim("after (10): x^k", "x^k as a function of ψ0, by Lagrange's multipliers", verdict="holds")
def parts_by_multipliers() -> Equality:
    X, _, _ = plane()
    psi = sp.Matrix(sp.symbols("psi1:3", positive=True))
    inverse = X.factor * X.factor.T

    def derived() -> RightSides:
        # Lagrange's condition: -psi = 2 m H x with (x, Hx) = 1 and a positive multiplier m.
        multiplier = sp.Symbol("m", positive=True)
        stationary = -inverse * psi / (2 * multiplier)
        found = sp.solve(sp.Eq(sp.expand(X.level(stationary) * multiplier**2), multiplier**2), multiplier)
        return stationary.subs(multiplier, found[0])

    return Equality(
        {"x^k": -inverse * psi / sp.sqrt((psi.T * inverse * psi)[0])},
        derived,
        display=r"x^k = \frac{-\tilde H^{-1}(k)\psi_0}{\sqrt{(\psi_0, \tilde H^{-1}(k)\psi_0)}}",
    )


@claim.proof(
    "after Lemma 9: not unique",
    "the equation of Lemma 9 is not linear, and does not change when ψ0 is multiplied by a positive number",
)
def homogeneous_of_degree_zero() -> Steps:
    factor = sp.Symbol("c", positive=True)
    for system in family():
        psi = system.costates[0]
        same = total(system, factor * psi)
        yield f"{named(system)}: cψ0 gives the same x0", vanishes(same - system.boundary_state())
        yield "a negative factor gives −x0: not linear", total(system, -psi) == -system.boundary_state()


@claim(
    "(11)",
    "with (ψ0, ψ0) = 1 the system has exactly one solution",
    verdict="conditional",
    remark="True for x0 on the boundary of X(N_min, 0), as Lemma 9 assumes: there, and only there, the n "
    "+ 1 equations for n unknowns are consistent. For the inner points of section 5, among them "
    "the z0 of the worked example, the system has no solution. With α as a further unknown, as a "
    "factor of the sum, it has two: (ψ, α) and the spurious (−ψ, −α).",
)
def system_for_the_costate() -> Conditional:
    def argument() -> Steps:
        a, b = sp.Matrix(sp.symbols("a1:4", real=True)), sp.Matrix(sp.symbols("b1:4", real=True))
        lagrange = a.dot(a) * b.dot(b) - a.dot(b) ** 2 - a.cross(b).dot(a.cross(b))
        yield "|a|²|b|² − (a, b)² = |a × b|²: |G'ψ| is curved but along ψ", vanishes(sp.expand(lagrange))
        for system in family():
            psi = system.costates[0]
            curvature = sp.zeros(len(psi))
            for part in system.summands(system.steps):
                Q, s = part.factor * part.factor.T, part.support(psi)
                curvature += (Q - Q * psi * psi.T * Q / s**2) / s
            yield (
                f"{named(system)}: the sum's second derivative has the kernel ψ0 and no other",
                ((curvature * psi).is_zero_matrix and curvature.rank() == len(psi) - 1),
            )
            unit = psi / psi.norm()
            solved = vanishes(total(system, unit) - system.boundary_state())
            yield (
                "ψ0/|ψ0| solves, −ψ0/|ψ0| does not",
                (solved and vanishes(sp.simplify(unit.dot(unit) - 1)))
                and total(system, -psi) != system.boundary_state(),
            )

    def counterexample() -> Steps:
        for system in family()[:2]:
            psi, state = system.costates[0], system.inner_state()
            yield f"{named(system)}: x0 with gauge α = {system.inner_gauge} is inside", system.inner_gauge < 1
            for other in (psi, -psi):
                yield (
                    "every sum lies on the boundary: ( −ψ, Σ) is the support function",
                    -other.dot(total(system, other)) == system.support(-other, system.steps),
                )
            yield "so none is x0", -psi.dot(state) < system.support(-psi, system.steps)
            both = [system.inner_gauge * total(system, psi), -system.inner_gauge * total(system, -psi)]
            yield "with the factor α both (ψ, α) and (−ψ, −α) solve", both == [state, state]

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"-x_0 = \sum_{k=1}^{N_{\min}} \frac{\tilde H^{-1}(k)\psi_0}{\sqrt{(\psi_0, \tilde "
        r"H^{-1}(k)\psi_0)}},\quad (\psi_0, \psi_0) = 1",
    )
