"""Section 7, (12): the ball in place of the cube, and what follows from the reduced system."""

import numpy as np
import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, Refutation, RightSides, Steps, vanishes
from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.claims import worked
from pontryagin.orbit_correction.claims.regrouping import printed_inputs
from pontryagin.orbit_correction.derivation import interval
from pontryagin.orbit_correction.derivation.exact import Ellipsoid

claim = Page("Ibragimov 2017")

CORNER = sp.ones(3, 1)


@claim.proof("regrouping: cube", "the set of admissible u~ is not strictly convex")
def cube_is_not_strictly_convex() -> Steps:
    first, second = CORNER, sp.Matrix([1, 1, -1])
    middle = (first + second) / 2
    yield (
        "between the corners (1, 1, 1) and (1, 1, −1) of the cube lies (1, 1, 0)",
        middle == sp.Matrix([1, 1, 0]),
    )
    yield "on its boundary: max |u~_i| = 1", max(map(abs, middle)) == max(map(abs, first)) == 1


@claim(
    "regrouping: ball",
    "the cube of admissible u~ is replaced by the ball of radius α_max",
    verdict="conditional",
    remark="The replacement is safe: the ball lies in the cube, so its plans are admissible. But it "
    "changes the answer: for the paper's z0 five impulses in the square suffice, and the plan for "
    "the ball fires six.",
)
def ball_in_the_cube() -> Conditional:
    def argument() -> Steps:
        u = sp.Matrix(sp.symbols("u1:4", real=True))
        for i in range(3):
            rest = u.dot(u) - u[i] ** 2
            yield f"|u~_{i + 1}|² ≤ |u~|², the rest is a sum of squares", rest.is_nonnegative
        shares = np.abs(worked.ball_plan().impulses) / worked.PEAK
        yield (
            f"the ball's plan of the example stays within {shares.max():.3f} of the square",
            bool(shares.max() < 1),
        )

    def counterexample() -> Steps:
        yield "the corner (1, 1, 1) of the cube is outside the ball: |u~|² = 3", CORNER.dot(CORNER) == 3
        yield from worked.box_certificate()

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "before (12): system",
    "x(k+1) = A(k)x(k) + B(k)u~(k) with (u~, u~) ≤ α_max²",
    remark="True with the corrected B(k).",
    display=r"x(k+1) = A(k)x(k) + B(k)\tilde u(k),\quad x(0) = z_0,\quad \tilde u(k) \in \{u \in "
    r"\mathbb{R}^3 : (u, u) \le \alpha_{\max}^2\}",
)
def regrouped_system() -> Steps:
    plan = worked.ball_plan()
    left = worked.impulses_to_rest(dict(enumerate(plan.impulses)))
    yield "the example's impulses, fired one by one at the starts of their intervals, end at 0", left < 1e-16
    yield from worked.ball_certificate()
    for k, column in enumerate(plan.states[2::2], start=1):
        state = np.array(worked.Z0)
        for impulse in plan.impulses[: 3 * k]:
            state = worked.interval_matrix() @ (state + np.array([0.0, *impulse]))
        yield f"x({2 * k}) = y({3 * k})", np.abs(state - column).max() < 1e-16


@claim(
    "(12)",
    "the same system with u(k) in the ellipsoid (u, B^−T(k)B^−1(k)u) ≤ α_max²",
    verdict="holds",
    remark="The set is right. In the form (u, H(k)u) ≤ 1 of section 6 its matrix is H(k) = "
    "B^−T(k)B^−1(k)/α_max².",
)
def system_with_ellipsoids() -> Equality:
    B, peak = sp.Matrix(2, 2, sp.symbols("B11 B12 B21 B22", real=True)), sp.Symbol("alpha_max", positive=True)

    def derived() -> RightSides:
        ball = Ellipsoid(sp.ImmutableMatrix(peak * sp.eye(2)))
        return (peak**2 * ball.image(B).shape).applyfunc(sp.cancel)

    return Equality(
        {r"H(k)\,\alpha_{\max}^2": (B.inv().T * B.inv()).applyfunc(sp.cancel)},
        derived,
        display=r"x(k+1) = A(k)x(k) + u(k),\quad x(0) = z_0,\quad u(k) \in U(k) = \{u \in \mathbb{R}^3 : "
        r"(u, (B^{-1}(k))^T B^{-1}(k)u) \le \alpha_{\max}^2\}",
    )


@claim(
    "after (12): ellipsoids",
    "every U(k) is an ellipsoid in R³, so it belongs to U_2",
    verdict="conditional",
    remark="True with the corrected B(k), for Δt that is no multiple of π: det B(k) is −sin Δt for even "
    "k and 2(1 − cos Δt) for odd k. At Δt = π the sets U(k) with even k are flat, so that H(k) "
    "does not exist, though the satellite can still be corrected. With B(k) as printed, det B(k) "
    "= 0 for every Δt.",
)
def ellipsoids_of_the_satellite() -> Conditional:
    def argument() -> Steps:
        for k, right in enumerate((-sp.sin(interval), 2 * (1 - sp.cos(interval)))):
            yield f"det B({k}) = {right}", vanishes(sp.simplify(derivation.step_inputs(k).det() - right))
        yield (
            "at Δt = 1/4 they are not 0",
            all(abs(np.linalg.det(worked.step_inputs(k))) > 0.06 for k in range(2)),
        )

    def counterexample() -> Steps:
        even = derivation.step_inputs(0).subs(interval, sp.pi)
        yield "Δt = π: B(0) has rank 2, so (u, p) = 0 on U(0) for a p ≠ 0", even.rank() == 2
        both = sp.Matrix.hstack(even, derivation.step_inputs(1).subs(interval, sp.pi))
        yield "though two steps span the space", both.rank() == 3
        yield "B(0) as printed has det 0 at Δt = 1/4", vanishes(printed_inputs(0).det())

    return Conditional(argument, counterexample=counterexample)


@claim(
    "after (12): conditions",
    "system (12) satisfies the conditions of Theorems 1 to 4 and Lemmas 9 and 10",
    verdict="conditional",
    remark="True with H(k) = B^−T(k)B^−1(k)/α_max², for Δt that is no multiple of π. With H(k) = "
    "B^−T(k)B^−1(k), which the print suggests, the bound would be 1 instead of 0.0035; then μ(z0, "
    "X(1, 0)) = 0.026 and N_min = 1.",
)
def conditions_of_the_theorems() -> Conditional:
    def argument() -> Steps:
        for k in range(2):
            yield f"det A({k}) = 1: nonsingular", vanishes(sp.simplify(derivation.step_matrix(k).det() - 1))
            inverse = np.linalg.inv(worked.step_inputs(k))
            shape = inverse.T @ inverse / worked.PEAK**2
            yield f"H({k}) is positive definite at Δt = 1/4", bool(np.linalg.eigvalsh(shape).min() > 0)
        yield from worked.ball_certificate()

    def counterexample() -> Steps:
        one = worked.gauge_with(1)
        alpha = float(one.certificate.primal_value) * worked.PEAK
        yield f"H(k) = B^−T B^−1: μ(z0, X(1, 0)) = {alpha:.3f}, so one step would do", 0.025 < alpha < 0.027
        yield "with the bound α_max = 0.0035 it does not", float(one.alpha) > 4

    return Conditional(argument, counterexample=counterexample)


@claim(
    "after (12): steps and impulses",
    "the fewest steps of (12) are the answer to the problem of the fewest correcting impulses",
    verdict="false",
    remark="A step of (12) is an impulse and a half: the N_min = 4 steps fire 6 impulses, and 5 impulses "
    "within the square are enough.",
)
def steps_and_impulses() -> Refutation:
    return Refutation(worked.box_certificate)
