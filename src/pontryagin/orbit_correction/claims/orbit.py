"""Section 7 up to A~ and B~: the motion near the circle, and an impulse at the start of each interval."""

from typing import Any

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Consequence,
    Equality,
    Misprint,
    Proof,
    RightSides,
    Steps,
    Unreadable,
    vanishes,
)
from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.derivation import interval, r, t, v_radial, v_transverse

claim = Page("Ibragimov 2017")

sin, cos = sp.sin(interval), sp.cos(interval)
deviations = sp.Matrix(sp.symbols("Delta_r Delta_vR Delta_vT", real=True))
impulse = sp.symbols("w1 w2", real=True)
LINEAR = sp.Matrix([[0, 1, 0], [1, 0, 2], [0, -1, 0]])
CIRCLE = {r: 1, v_radial: 0, v_transverse: 1}


def printed_transition(angle: sp.Expr) -> sp.Matrix:
    """The solution matrix, as printed for t and for Delta t."""
    s, c = sp.sin(angle), sp.cos(angle)
    return sp.Matrix([[2 - c, s, 2 - 2 * c], [s, c, 2 * s], [c - 1, -s, 2 * c - 1]])


RADIAL, TRANSVERSE = sp.Matrix([sin, cos, -sin]), sp.Matrix([2 - 2 * cos, 2 * sin, 2 * cos - 1])
"""The columns of B~, as printed."""


@claim(
    "section 7: equations of motion",
    "motion in the field 1/r² in polar coordinates",
    verdict="misprint",
    remark="Printed: v_R' = v_R²/r − 1/r². Right: v_R' = v_T²/r − 1/r², from which the linearised system "
    "below follows. As printed, the circle is no solution (v_R' = −1 on it), and the second row "
    "of the linearised system would be (2, 0, 0) instead of (1, 0, 2).",
)
def equations_of_motion() -> Misprint:
    keys = (r"\dot r", r"\dot\theta", r"\dot v_R", r"\dot v_T")
    printed = (v_radial, v_transverse / r, v_radial**2 / r - 1 / r**2, -v_radial * v_transverse / r)

    def derived() -> RightSides:
        radius, radial, transverse = derivation.equations_of_motion()
        return radius, derivation.angular_rate(), radial, transverse

    return Misprint(
        dict(zip(keys, printed, strict=True)),
        derived,
        defect={keys[2]: (v_radial**2 - v_transverse**2) / r},
        consequence=lambda: Consequence(
            "v_R' on the circle r = 1, v_R = 0, v_T = 1",
            printed[2].subs(CIRCLE),
            derivation.equations_of_motion()[1].subs(CIRCLE),
        ),
    )


@claim.proof(
    "section 7: θ",
    "the angle of rotation does not matter",
    remark="True for the shape of the orbit. The position of the satellite along the orbit is not restored.",
)
def angle_does_not_matter() -> Steps:
    angle = sp.Symbol("theta")
    rates = derivation.equations_of_motion()
    yield "r', v_R' and v_T' do not contain θ", not rates.has(angle, sp.Function("theta"))
    yield "they form a system of their own", rates.free_symbols == {r, v_radial, v_transverse}
    yield "while θ' = 1 on the circle: the phase runs on", derivation.angular_rate().subs(CIRCLE) == 1


@claim.proof(
    "section 7: circle",
    "the circular orbit is described by r0, v_R0 and v_T0",
    remark="The linearised system takes them as r0 = 1, v_R0 = 0, v_T0 = 1; in general v_T0 = r0^(−1/2).",
)
def circular_orbit() -> Steps:
    radius = sp.Symbol("r_0", positive=True)
    at = {r: radius, v_radial: 0, v_transverse: 1 / sp.sqrt(radius)}
    yield (
        "r' = v_R' = v_T' = 0 for v_R = 0, v_T = r0^(−1/2)",
        derivation.equations_of_motion().subs(at).is_zero_matrix,
    )
    yield "for r0 = 1: v_T0 = 1", derivation.equations_of_motion().subs(CIRCLE).is_zero_matrix


@claim(
    "section 7: deviations",
    "Δr, Δv_R and Δv_T are the differences from the values on the circle",
    verdict="holds",
)
def deviations_from_the_circle() -> Equality:
    keys = ("r", "v_R", "v_T")
    start = sp.symbols("r_0 v_R0 v_T0")
    whole = sp.symbols("r v_R v_T")

    def derived() -> dict[str, Any]:
        found = sp.solve(
            [a + d - b for a, d, b in zip(start, deviations, whole, strict=True)], list(deviations)
        )
        return {rf"\Delta {key}": found[d] for key, d in zip(keys, deviations, strict=True)}

    printed = {rf"\Delta {key}": b - a for key, a, b in zip(keys, start, whole, strict=True)}
    return Equality(printed, derived)


@claim("section 7: linearised system", "Δr' = Δv_R, Δv_R' = Δr + 2Δv_T, Δv_T' = −Δv_R", verdict="holds")
def linearised_system() -> Equality:
    radius, radial, transverse = deviations
    return Equality(
        {r"\Delta\dot r": radial, r"\Delta\dot v_R": radius + 2 * transverse, r"\Delta\dot v_T": -radial},
        lambda: derivation.linearised() * deviations,
        display=r"\Delta\dot r = \Delta v_R,\quad \Delta\dot v_R = \Delta r + 2\Delta v_T,\quad \Delta\dot "
        r"v_T = -\Delta v_R",
    )


z, rate = sp.symbols("z z'", real=True)


@claim(
    "section 7: Cauchy problem",
    "the linearised system as a matrix equation for z(t)",
    verdict="unreadable",
    remark="The dot over z on the left-hand side cannot be seen. Without it the equation would be z = "
    "Az, which only z = 0 satisfies.",
)
def cauchy_problem() -> Unreadable:
    return Unreadable(
        {r"\text{left side}": z, "A": LINEAR},
        lambda: (rate, derivation.linearised()),
        legible=("A",),
        display=r"z(t) = \begin{pmatrix} 0 & 1 & 0 \\ 1 & 0 & 2 \\ 0 & -1 & 0 \end{pmatrix} z(t),\quad z(0) "
        r"= z_0",
    )


@claim("section 7: solution", "the solution z(t) of the linearised system", verdict="holds")
def solution_matrix() -> Proof:
    def argument() -> Steps:
        printed = printed_transition(t)
        yield (
            "the printed matrix obeys the equation",
            vanishes(printed.diff(t) - derivation.linearised() * printed),
        )
        yield "and is I at t = 0", printed.subs(t, 0) == sp.eye(3)

    return Proof(
        argument,
        Equality({"e^{At}": printed_transition(t)}, lambda: sp.Matrix(derivation.transition(t))),
    )


@claim(
    "section 7: impulse",
    "an impulse at the start of the interval: z(0) = y(k) + (0, w1(k), w2(k))",
    verdict="unreadable",
    remark="The dot over z on the left-hand side cannot be seen, as in the Cauchy problem above.",
)
def impulsive_cauchy_problem() -> Unreadable:
    keys = (r"\text{left side}", "A", "z(0) - y(k)")

    def derived() -> RightSides:
        jump = derivation.RADIAL * impulse[0] + derivation.TRANSVERSE * impulse[1]
        return rate, derivation.linearised(), jump

    return Unreadable(
        dict(zip(keys, (z, LINEAR, sp.Matrix([0, *impulse])), strict=True)),
        derived,
        legible=keys[1:],
        display=r"z(t) = \begin{pmatrix} 0 & 1 & 0 \\ 1 & 0 & 2 \\ 0 & -1 & 0 \end{pmatrix} z(t),\quad z(0) "
        r"= y(k) + (0, w_1(k), w_2(k))^T",
    )


@claim("section 7: recurrence", "y(k+1) = A~y(k) + B~w(k)", verdict="holds")
def recurrence() -> Equality:
    y = sp.Matrix(sp.symbols("y1:4", real=True))
    control = sp.Matrix(impulse)

    def derived() -> RightSides:
        start = y + derivation.RADIAL * impulse[0] + derivation.TRANSVERSE * impulse[1]
        return sp.Matrix(derivation.transition(interval)) * start

    printed = printed_transition(interval) * y + sp.Matrix.hstack(RADIAL, TRANSVERSE) * control
    return Equality(
        {"y(k+1)": printed},
        derived,
        display=r"y(k+1) = \tilde A y(k) + \tilde B w(k),\quad y(0) = z_0,\quad w(k) \in [-\alpha_{\max}; "
        r"\alpha_{\max}] \times [-\alpha_{\max}; \alpha_{\max}]",
    )


@claim("section 7: A~", "the matrix A~ of an interval", verdict="holds")
def interval_matrix() -> Equality:
    return Equality(
        {r"\tilde A": printed_transition(interval)}, lambda: sp.Matrix(derivation.transition(interval))
    )


@claim("section 7: B~", "the matrix B~ of an impulse", verdict="holds")
def impulse_matrix() -> Equality:
    return Equality(
        {r"\tilde B": sp.Matrix.hstack(RADIAL, TRANSVERSE)},
        lambda: sp.Matrix.hstack(*derivation.impulse_directions()),
    )


@claim.proof(
    "section 7: dimensions",
    "state and control differ in dimension, so the maximum principle of Theorems 1 to 3 does not apply",
    remark="The conditions of these theorems fail: the vectors B~w form a flat set without inner points. "
    "The gauge and its dual problem do not need these conditions.",
)
def flat_controls() -> Steps:
    inputs = sp.Matrix.hstack(*derivation.impulse_directions())
    normal = derivation.impulse_directions()[0].cross(derivation.impulse_directions()[1])
    yield "B~ has three rows and two columns", inputs.shape == (3, 2)
    yield (
        "b1 × b2 is orthogonal to all B~w: 0 is no inner point of the set of B~w",
        vanishes(sp.simplify(normal.T * inputs)),
    )
    yield (
        "and it is not 0: at Δt = π/2 it is (−1, −1, 2) or longer",
        normal.subs(interval, sp.pi / 2).norm() > 1,
    )
