"""Plans as the command line prints them: one plan as a table or JSON, many as CSV."""

from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.orbit_correction.plan.correction import Plan
from pontryagin.orbit_correction.system import satellite

Report = dict[str, dict[str, Any]]
"""Quantities by their heading and, below it, by their name."""

COLUMNS = ("dr", "dv_R", "dv_T")
"""The columns of a CSV file of states."""

PROOF = ("primal_residual", "primal_value", "dual_value", "gap")
"""The quantities of a certificate that are reported."""

TITLES = {
    "ball": "Fewest steps, the three impulse components of each in a ball",
    "disc": "Fewest impulses, each in a disc",
    "box": "Fewest impulses, each in a square",
}


def transcript(plan: Plan) -> Report:
    """One plan as headings with their quantities, which are named as the attributes of `Plan`.

    Parameters
    ----------
    plan : Plan
        A plan of one state.

    Examples
    --------
    >>> from pontryagin.orbit_correction import correct
    >>> report = transcript(correct([-0.0037787, -0.0039109, 0.0141512], thrust="box"))
    >>> int(report["solution"]["impulse_count"]), bool(abs(report["states"]["end"]).max() < 1e-15)
    (5, True)
    """
    engine = plan.thrust
    return {
        "problem": {"z0": plan.z0, "interval": engine.interval, "peak": engine.peak, "thrust": engine.name},
        "solution": {
            "steps": plan.steps,
            "impulse_count": plan.impulse_count,
            "gauge": plan.gauge,
            "shorter_gauge": plan.shorter_gauge,
            "initial_costate": plan.initial_costate,
            "impulses": plan.impulses,
        },
        "states": {"start": plan.states[0], "end": plan.states[-1]},
        "certificate": {name: getattr(plan.certificate, name) for name in PROOF},
    }


def samples(plan: Plan, count: int) -> dict[str, Array]:
    """Linear motion and costate at evenly spaced times: ``t`` (k,), ``state`` and ``costate`` (k, 3).

    At the instant of an impulse the state is the one after the impulse.

    Examples
    --------
    >>> from pontryagin.orbit_correction import correct
    >>> found = samples(correct([0.0, 0.0, 0.004]), 3)
    >>> found["t"].tolist(), bool(abs(found["state"][-1]).max() < 1e-15)
    ([0.0, 0.375, 0.75], True)
    """
    starts = plan.thrust.interval * np.arange(len(plan.impulses))
    t = np.linspace(0.0, plan.thrust.interval * len(starts), count)
    kicks = np.einsum("jab,jb->ja", satellite.transition(-starts)[:, :, 1:], plan.impulses)
    carried_back = plan.z0 + (starts <= t[:, None]) @ kicks
    state = np.einsum("tab,tb->ta", satellite.transition(t), carried_back)
    return {"t": t, "state": state, "costate": plan.initial_costate @ satellite.transition(-t)}


def conclusion(plan: Plan) -> str:
    """A sentence that says what the certificate proves.

    Examples
    --------
    >>> from pontryagin.orbit_correction import correct
    >>> conclusion(correct([0.0, 0.0, 0.0]))
    'Nothing is to be corrected.'
    """
    steps = int(plan.steps)
    if not steps:
        return "Nothing is to be corrected."
    unit = "step" if plan.thrust.name == "ball" else "impulse"
    counted = f"{steps} {unit}" if steps == 1 else f"{steps} {unit}s"
    least = (
        f"with one {unit} fewer it would need at least {float(plan.shorter_gauge):.12g} of the peak"
        if np.isfinite(plan.shorter_gauge)
        else f"no peak suffices with fewer {unit}s"
    )
    return f"With {counted} the plan needs {float(plan.gauge):.12g} of the peak; {least}."


def answers(plan: Plan) -> dict[str, Any]:
    """Result columns, (n,) each, for the plans of n states; nan beyond the impulses of a state."""
    columns = {"steps": plan.steps, "impulse_count": plan.impulse_count, "gauge": plan.gauge}
    columns |= {f"psi_{i + 1}": plan.initial_costate[:, i] for i in range(3)}
    columns |= {name: getattr(plan.certificate, name) for name in PROOF}
    for j in range(plan.impulses.shape[-2]):
        fired = np.where((j < plan.instants)[:, None], plan.impulses[:, j], np.nan)
        columns |= {f"w1_{j}": fired[:, 0], f"w2_{j}": fired[:, 1]}
    return columns
