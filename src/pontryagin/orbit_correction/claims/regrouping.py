"""Section 7, the regrouping of impulses: u~, x, A(k) and B(k)."""

from typing import Any

import numpy as np
import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Consequence, Equality, Misprint, Slip, Steps, vanishes
from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.claims import worked
from pontryagin.orbit_correction.claims.orbit import RADIAL, TRANSVERSE, printed_transition
from pontryagin.orbit_correction.claims.tables import units_off
from pontryagin.orbit_correction.derivation import interval
from pontryagin.orbit_correction.printed import CONTROLS

claim = Page("Ibragimov 2017")

once, radial, transverse, start = sp.symbols("A b1 b2 y0", commutative=False)
"""Noncommuting symbols of any size for A~, the columns of B~, and y(0)."""


def w(component: int, j: int) -> sp.Symbol:
    """w1(j) or w2(j); component 0 is radial."""
    return sp.Symbol(f"w{component + 1}({j})", real=True)


def state_after(j: int) -> sp.Expr:
    """y(j) by the recurrence."""
    state = start
    for i in range(j):
        state = once * state + radial * w(0, i) + transverse * w(1, i)
    return sp.expand(state)


def printed_inputs(k: int) -> sp.Matrix:
    """B(k), as printed."""
    once = printed_transition(interval)
    if k % 2 == 0:
        return sp.Matrix.hstack(RADIAL, once * TRANSVERSE, RADIAL)
    return sp.Matrix.hstack(TRANSVERSE, RADIAL, TRANSVERSE)


@claim("regrouping: u~", "three successive impulse components make one control", verdict="holds")
def regrouped_controls() -> Equality:
    printed = {
        r"\tilde u(2)": sp.Matrix([w(0, 3), w(1, 3), w(0, 4)]),
        r"\tilde u(3)": sp.Matrix([w(1, 4), w(0, 5), w(1, 5)]),
    }

    return Equality(
        printed,
        lambda: [sp.Matrix([w(component, j) for j, component in derivation.schedule(k)]) for k in (2, 3)],
        display=r"\tilde u(2k) = \begin{pmatrix} w_1(3k) \\ w_2(3k) \\ w_1(3k+1) \end{pmatrix},\quad \tilde "
        r"u(2k+1) = \begin{pmatrix} w_2(3k+1) \\ w_1(3k+2) \\ w_2(3k+2) \end{pmatrix}",
    )


@claim("regrouping: x", "x(2k) = y(3k), x(2k+1) = A~y(3k+1) + B~(w1(3k+1), 0)", verdict="holds")
def regrouped_states() -> Equality:
    halfway = once * state_after(1) + radial * w(0, 1)

    def derived() -> dict[str, Any]:
        # The impulses of u~(0) and then those of u~(1), each carried to the end of its step.
        after = once**2 * start + once * radial * w(0, 0) + once * transverse * w(1, 0) + radial * w(0, 1)
        end = once * after + once * transverse * w(1, 1) + radial * w(0, 2) + transverse * w(1, 2)
        return {"x(1)": sp.expand(after), "x(2)": sp.expand(end)}

    return Equality(
        {"x(1)": sp.expand(halfway), "x(2)": state_after(3)},
        derived,
        display=r"x(2k) = y(3k),\quad x(2k+1) = \tilde A y(3k+1) + \tilde B \begin{pmatrix} w_1(3k+1) \\ 0 "
        r"\end{pmatrix}",
    )


@claim("regrouping: A(k)", "A(k) is A~² for even k and A~ for odd k", verdict="holds")
def regrouped_matrices() -> Equality:
    keys = ("A(2k)", "A(2k+1)")
    printed = (printed_transition(interval) ** 2, printed_transition(interval))
    return Equality(
        dict(zip(keys, printed, strict=True)),
        lambda: {key: derivation.step_matrix(k) for k, key in enumerate(keys)},
        display=r"A(k) = \tilde A^2,\ k = 0, 2, 4, \dots;\quad \tilde A,\ k = 1, 3, 5, \dots",
    )


@claim(
    "regrouping: B(k)",
    "the matrix B(k), for even and for odd k",
    verdict="misprint",
    remark="Printed: the first column is b1 for even k and b2 for odd k. Right: A~b1 and A~b2, because "
    "these impulses act an interval before the last one of their step. As printed, columns 1 and "
    "3 are equal, det B(k) = 0 and U(k) is no ellipsoid; the worked example would have α = 0.9424 "
    "instead of the printed 0.9286.",
)
def regrouped_inputs() -> Misprint:
    keys = ("B(2k)", "B(2k+1)")
    delay = sp.eye(3) - printed_transition(interval)

    def consequence() -> Consequence:
        printed, right = (
            worked.gauge_with(4, inputs).alpha for inputs in (printed_inputs, derivation.step_inputs)
        )
        return Consequence("α of the worked example", sp.Float(printed, 4), sp.Float(right, 4))

    empty = sp.zeros(3, 2)
    return Misprint(
        {key: printed_inputs(k) for k, key in enumerate(keys)},
        lambda: {key: derivation.step_inputs(k) for k, key in enumerate(keys)},
        defect={
            keys[0]: sp.Matrix.hstack(delay * RADIAL, empty),
            keys[1]: sp.Matrix.hstack(delay * TRANSVERSE, empty),
        },
        consequence=consequence,
        display=r"B(k) = (b_1 \mid \tilde A b_2 \mid b_1),\ k = 0, 2, 4, \dots;\quad (b_2 \mid b_1 \mid "
        r"b_2),\ k = 1, 3, 5, \dots;\quad b_1 = (\sin\Delta t, \cos\Delta t, -\sin\Delta t)^T,\ b_2 = "
        r"(-2\cos\Delta t + 2, 2\sin\Delta t, 2\cos\Delta t - 1)^T",
    )


@claim(
    "regrouping: B(k) and the tables",
    "the tables were computed with B(k)",
    verdict="misprint",
    remark="The tables were computed with the corrected B(k): it gives all 39 printed numbers to a unit "
    "of the last digit, and the printed controls have |B(k)⁻¹u(k)| = 0.9286 α_max in all four "
    "steps. The printed B(k) misses the numbers by thousands of units and has no inverse.",
)
def inputs_behind_the_tables() -> Slip:
    def argument() -> Steps:
        worst = float(units_off().max())
        yield (
            f"with the corrected B(k) the worst of 39 numbers is off by {worst:.2f} of a unit",
            bool(worst <= 1),
        )
        for k, row in enumerate(CONTROLS):
            control = np.linalg.solve(worked.step_inputs(k), np.array([float(number) for number in row]))
            size = float(np.linalg.norm(control)) / worked.PEAK
            yield f"|B({k})⁻¹u({k})| of the printed u({k}) is {size:.5f} α_max", abs(size - 0.9286) < 1e-4

    def counterexample() -> Steps:
        worst = float(units_off(printed_inputs).max())
        yield f"with the printed B(k) the worst is off by {worst:.0f} units", worst > 1000
        for k in range(2):
            yield f"and det B({k}) = 0", vanishes(printed_inputs(k).det())

    return Slip(argument, counterexample=counterexample)
