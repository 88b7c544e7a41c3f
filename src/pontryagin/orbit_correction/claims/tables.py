"""The worked example: N_min, alpha and the two tables, number by number."""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.ledger import Entry, Page
from pontryagin.ledger.decimals import Decimals, unit
from pontryagin.ledger.evidence import Conditional, Steps
from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.claims import worked
from pontryagin.orbit_correction.printed import CONTROLS, COSTATES, FEWEST_STEPS, GAUGE, STATES

claim = Page("Ibragimov 2017")

NUMBERS = [number for table in (STATES[:4], COSTATES, CONTROLS) for row in table for number in row]

ROUNDED = np.array([0.0672568, -0.4136316, -0.4168327])
"""A change of z0, in units of its last printed digit, for which all printed numbers are correctly rounded."""


def example(
    inputs: worked.Inputs = derivation.step_inputs, z0: Array = worked.Z0
) -> tuple[Array, Array, Array]:
    """States, costates and controls of Theorem 4 by Lemma 9 and Lemma 10, with alpha, for given B(k)."""
    found = worked.gauge_with(4, inputs, z0=z0)
    alpha, state, costate = float(found.alpha), z0, np.asarray(found.costate)
    states, costates, controls = [state], [], []
    for k in range(4):
        A, B = worked.step_matrix(k), worked.PEAK * worked.numbers(inputs(k % 2))
        costates.append(costate)
        costate = np.asarray(np.linalg.solve(A.T, costate), dtype=float)
        controls.append(alpha * B @ B.T @ costate / np.linalg.norm(B.T @ costate))
        state = A @ state + controls[-1]
        states.append(state)
    return np.array(states), np.array(costates), np.array(controls)


def units_off(inputs: worked.Inputs = derivation.step_inputs, z0: Array = worked.Z0) -> Array:
    """Distances of the 36 computed nonzero numbers from the printed ones, in units of their last digits."""
    states, costates, controls = example(inputs, z0)
    computed = np.concatenate([states[:4].ravel(), costates.ravel(), controls.ravel()])
    scales = np.array([unit(number) for number in NUMBERS])
    return np.asarray(np.abs(computed - np.array([float(number) for number in NUMBERS])) / scales)


@claim(
    "after (12): N_min",
    "the least number of steps is 4",
    verdict="holds",
    remark="The paper says this of system (7), but (12) is meant, because (7) is built from N_min. Four "
    "steps fire six impulses.",
)
def number_of_steps() -> Decimals:
    return Decimals(
        {r"N_{\min}": FEWEST_STEPS},
        lambda: {r"N_{\min}": float(worked.ball_plan().steps)},
        worked.ball_certificate,
    )


@claim("after (12): α", "the Minkowski functional of X(4, 0) at z0 is 0.9286", verdict="holds")
def gauge_of_the_example() -> Decimals:
    key = r"\alpha = \mu(z_0, X(4, 0))"
    return Decimals({key: GAUGE}, lambda: {key: float(worked.ball_plan().gauge)}, worked.ball_certificate)


@claim.proof(
    "after (12): boundary",
    "z0 is on the boundary of X_0.9286(4, 0)",
    remark="True to the printed digits: the gauge is 0.928574, so z0 lies inside by 3 parts in 100,000.",
    display=r"z_0 \in \partial X_{0.9286}(4, 0)",
)
def on_the_scaled_boundary() -> Steps:
    yield from worked.ball_certificate()
    share = float(worked.ball_plan().gauge) / 0.9286
    yield f"the gauge of z0 in 0.9286 X(4, 0) is {share:.6f}", 1 - 1e-4 / 0.9286 < share < 1


@claim(
    "after (12): ψ0 from (11)",
    "ψ0 is found from the system (11)",
    verdict="conditional",
    remark="True for the system (11) that belongs to (7), with α² H~^−1(k) in place of H~^−1(k). For "
    "(12) itself the system (11) has no solution: z0 is an inner point of X(4, 0), with the gauge "
    "0.9286, and every sum in (11) lies on the boundary.",
)
def costate_of_the_example() -> Conditional:
    def argument() -> Steps:
        plan, G = worked.ball_plan(), worked.factors(4)
        psi, alpha = plan.initial_costate, float(plan.gauge)
        reach = np.einsum("kij,i->kj", G, psi)
        total = np.einsum("kij,kj->i", G, reach / np.linalg.norm(reach, axis=1)[:, None])
        yield "−z0 = α Σ H~⁻¹ψ0/√(ψ0, H~⁻¹ψ0)", np.abs(alpha * total + worked.Z0).max() < 1e-15
        yield "(ψ0, ψ0) = 1", abs(float(psi @ psi) - 1) < 1e-15
        printed = np.array([float(number) for number in COSTATES[0]])
        yield "ψ0 is the printed one", np.abs(psi - printed).max() < 1e-4

    def counterexample() -> Steps:
        yield from worked.ball_certificate()
        alpha = float(worked.ball_plan().gauge)
        yield (
            f"(−z0, ψ) ≤ {alpha:.4f} Σ|G'ψ| for all ψ, while a solution ψ has (−z0, ψ) = Σ|G'ψ|",
            alpha < 0.93,
        )

    return Conditional(argument, counterexample=counterexample)


@claim(
    "after (12): controls from Lemma 10",
    "the optimal control follows from Lemma 10",
    verdict="conditional",
    remark="True with the factor α of Theorem 4, which the formula of Lemma 10 lacks and the table "
    "contains: without it u2*(0) would be −0.26686·10⁻² instead of the printed −0.24779·10⁻².",
)
def controls_of_the_example() -> Conditional:
    printed = float(CONTROLS[0][1])

    def argument() -> Steps:
        controls = example()[2]
        yield (
            "α times Lemma 10 gives u2*(0) to a unit of the last digit",
            abs(float(controls[0, 1]) - printed) < 1e-7,
        )
        yield "and ends at 0", np.abs(example()[0][-1]).max() < 1e-16

    def counterexample() -> Steps:
        states, _, controls = example()
        full = controls / float(worked.ball_plan().gauge)
        yield f"without α u2*(0) is {100 * full[0, 1]:.5f}·10⁻²", abs(float(full[0, 1]) - printed) > 1.9e-4
        state = states[0]
        for k, control in enumerate(full):
            state = worked.step_matrix(k) @ state + control
        yield (
            f"and the state ends {np.linalg.norm(state):.4f} away from 0",
            float(np.linalg.norm(state)) > 1e-3,
        )

    return Conditional(argument, counterexample=counterexample)


def row(table: int, k: int, columns: dict[str, tuple[str, str, str]], remark: str = "") -> Entry:
    """The ledger's entry for one row of a table; its numbers are given by symbol."""
    keys = [f"{name}_{i}({k})" for name in columns for i in (1, 2, 3)]
    printed = dict(zip(keys, (number for numbers in columns.values() for number in numbers), strict=True))

    def computed() -> dict[str, float]:
        found = dict(zip(("x^*", r"\psi", "u^*"), example(), strict=True))
        values = (float(value) for name in columns for value in found[name][k])
        return dict(zip(keys, values, strict=True))

    def evidence() -> Decimals:
        return Decimals(printed, computed, worked.ball_certificate)

    words = " and ".join(name.replace("^*", "*").replace(r"\psi", "ψ") + f"({k})" for name in columns)
    return claim(f"table {table}, k = {k}", f"{words} of the worked example", verdict="holds", remark=remark)(
        evidence
    )


OFF = {
    (1, 2): "ψ1 = 0.26165, printed 0.2617: 0.51 of a unit off.",
    (2, 0): "u2 = −0.247798·10⁻², printed −0.24779·10⁻²: 0.81 of a unit off; u3 = −0.271844·10⁻², printed "
    "−0.27185·10⁻²: 0.58.",
    (2, 2): "u2 = −0.524756·10⁻², printed −0.52475·10⁻²: 0.59 of a unit off.",
    (2, 3): "u2 = −0.388775·10⁻², printed −0.38877·10⁻²: 0.50 of a unit off.",
}
"""Remarks on the rows in which a number is off by more than half a unit of its last digit."""

for k in range(4):
    row(1, k, {"x^*": STATES[k], r"\psi": COSTATES[k]}, OFF.get((1, k), ""))
row(1, 4, {"x^*": STATES[4]})
for k in range(4):
    row(2, k, {"u^*": CONTROLS[k]}, OFF.get((2, k), ""))


@claim(
    "tables: rounding",
    "the numbers of the tables are those of the printed z0, rounded",
    verdict="conditional",
    remark="All 39 numbers agree to one unit of the last digit, but five are off by more than half a "
    "unit. The printed z0 is rounded too: a z0 within half a unit of it gives every printed digit "
    "by rounding.",
)
def rounded_tables() -> Conditional:
    def argument() -> Steps:
        off = units_off()
        yield f"the worst number is off by {off.max():.2f} of a unit", bool(off.max() <= 1)
        yield "x*(4) is 0", bool(np.abs(example()[0][-1]).max() < 1e-16)
        yield (
            "the z0 of `ROUNDED` is within half a unit of the printed one",
            bool(np.abs(ROUNDED).max() < 0.5),
        )
        moved = units_off(z0=worked.Z0 + 1e-7 * ROUNDED)
        yield f"and makes all 36 others within {moved.max():.2f} of a unit", bool(moved.max() < 0.5)

    def counterexample() -> Steps:
        yield (
            "from the printed z0, 5 numbers are off by more than half a unit",
            (units_off() > 0.5).sum() == 5,
        )
        yield from worked.ball_certificate()

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "tables: consistency",
    "the printed numbers fit each other",
    remark="Checked with A(k); B(k) does not enter.",
)
def consistent_tables() -> Steps:
    states, costates, controls = (
        np.array([[float(number) for number in numbers] for numbers in table])
        for table in (STATES, COSTATES, CONTROLS)
    )
    for k in range(4):
        gap = states[k + 1] - worked.step_matrix(k) @ states[k] - controls[k]
        yield (
            f"x*({k + 1}) = A({k})x*({k}) + u*({k}) to two units of the last digit",
            np.abs(gap).max() < 2e-7,
        )
    for k in range(3):
        turned = worked.step_matrix(k).T @ costates[k + 1] - costates[k]
        yield f"ψ({k}) = A'({k})ψ({k + 1}) to two units", np.abs(turned).max() < 2e-4
    yield "(ψ0, ψ0) = 1", abs(float(costates[0] @ costates[0]) - 1) < 1e-4
