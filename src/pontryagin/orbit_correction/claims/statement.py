"""Abstract and section 1: what is to be minimised; (1)."""

import numpy as np
import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality, Refutation, Steps, vanishes
from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.claims import worked

claim = Page("Ibragimov 2017")

R = sp.Rational


@claim(
    "abstract",
    "the original problem reduces to a time-optimal problem of a linear nonstationary discrete system",
    verdict="false",
    remark="The problem does not reduce to the paper's system (12): a step of (12) spends an impulse and "
    "a half, and its ball of controls is smaller than the cube of the admissible ones. For the "
    "paper's own z0 five impulses suffice, while the four steps of (12) fire six. The reduction "
    "without loss is y(k+1) = A~y(k) + B~w(k), with one impulse in each step, and this system is "
    "stationary.",
)
def reduction_of_the_problem() -> Refutation:
    return Refutation(worked.box_certificate)


@claim(
    "section 1: firings",
    "if the number of impulses is free, the least time is the least number of times that the "
    "engine is switched on",
    verdict="false",
    remark="The two differ, because the engine may skip an interval. For the paper's z0 and its square "
    "of impulses four firings suffice, at the starts of intervals 0, 2, 3 and 5, while the least "
    "time, five intervals, takes five firings.",
)
def firings_and_time() -> Refutation:
    def counterexample() -> Steps:
        impulses = worked.sparse_impulses()
        left = worked.impulses_to_rest(impulses)
        yield "four impulses, at 0, 2, 3 and 5, bring z0 to 0", left < 1e-16 and len(impulses) == 4
        share = np.abs(list(impulses.values())).max() / worked.PEAK
        yield f"each within {share:.3f} of the square", share < 1
        yield from worked.box_certificate()
        fired = np.abs(worked.box_plan().impulses).max(axis=1)
        yield "none of the five is 0", fired.min() > 0.1 * worked.PEAK

    return Refutation(counterexample)


@claim(
    "section 1: bang-bang",
    "in continuous time, for a linear autonomous system and a convex set of controls, the time-optimal "
    "control is piecewise constant with finitely many switches",
    verdict="false",
    remark="True for a polytope in general position. For a ball, the kind of set that this paper uses, "
    "the control turns: for x1' = x2 + u1, x2' = u2, |u| ≤ 1 and the costate (1, −t) it is u = "
    "(1, −t)/√(1 + t²).",
)
def piecewise_constant_controls() -> Refutation:
    time = sp.Symbol("t", real=True)
    chain = sp.Matrix([[0, 1], [0, 0]])

    def counterexample() -> Steps:
        costate = sp.Matrix([1, -time])
        control = costate / sp.sqrt(1 + time**2)
        yield (
            "x1' = x2 + u1, x2' = u2: ψ = (1, −t) solves ψ' = −A'ψ",
            vanishes(costate.diff(time) + chain.T * costate),
        )
        yield "u = (1, −t)/√(1 + t²) has |u| = 1", vanishes(control.dot(control) - 1)
        angle = sp.Symbol("phi", real=True)
        other = sp.Matrix([sp.cos(angle), sp.sin(angle)])
        across = costate[0] * other[1] - costate[1] * other[0]
        yield (
            "and is the one control of the ball with the largest (ψ, u): |ψ|² − (ψ, w)² is a square for |w| "
            "= 1",
            vanishes(costate.dot(costate) - costate.dot(other) ** 2 - across**2),
        )
        start = -((sp.eye(2) - chain * time) * control).applyfunc(
            lambda part: sp.integrate(sp.simplify(part), (time, 0, 1))
        )
        needed = sp.integrate(sp.sqrt(1 + time**2), (time, 0, 1))
        yield (
            "it brings x0 to 0 in the time 1, and (−ψ(0), x0) = ∫|ψ| leaves none to spare",
            vanishes(sp.simplify(-start[0] - needed)),
        )
        yield (
            "so it is time-optimal, and nowhere constant",
            vanishes(control[1].diff(time) + (1 + time**2) ** R(-3, 2)),
        )

    return Refutation(counterexample)


@claim.proof(
    "(1)",
    "a nonstationary linear system with A(k) nonsingular, 0 inside U(k), and U(k) strictly convex "
    "and compact; the satellite of section 7 is such a system",
    remark="Checked for the satellite at the paper's Δt = 0.25.",
    display=r"x(k+1) = A(k)x(k) + u(k),\quad x(0) = x_0,\quad u(k) \in U(k),\quad k = 0, 1, 2, \dots",
)
def system() -> Steps:
    for k in range(2):
        yield f"det A({k}) = 1", vanishes(sp.simplify(derivation.step_matrix(k).det() - 1))
        yield (
            f"det B({k}) is not 0 at Δt = 1/4: U({k}) is an ellipsoid about 0",
            abs(np.linalg.det(worked.step_inputs(k))) > 0.06,
        )
    yield (
        "A(0) is not A(1): nonstationary",
        not vanishes(derivation.step_matrix(0)[0, 1] - derivation.step_matrix(1)[0, 1]),
    )


@claim("after (1): scalar product", "(x, y) is the sum of the products of coordinates", verdict="holds")
def scalar_product() -> Equality:
    pair = sp.symbols("x1:4 y1:4")
    return Equality(
        {"(x, y)": sum(a * b for a, b in zip(pair[:3], pair[3:], strict=True))},
        lambda: (sp.Matrix([pair[:3]]) * sp.Matrix(pair[3:]))[0],
        display=r"(x, y) = x_1y_1 + \ldots + x_ny_n",
    )
