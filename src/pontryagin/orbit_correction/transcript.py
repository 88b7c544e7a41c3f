"""A plan in words and numbers: what the command line prints as a table or as JSON, and plans as CSV."""

import csv
import io
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from pontryagin.arrays import Array
from pontryagin.io import formula
from pontryagin.orbit_correction import satellite
from pontryagin.orbit_correction.plan import Plan

Report = dict[str, dict[str, Any]]

COLUMNS = ("dr", "dv_R", "dv_T")
PROOF = ("primal_residual", "primal_value", "dual_value", "gap")
TITLES = {
    "ball": "Fewest steps, three impulse components each in a ball",
    "disc": "Fewest impulses, each in a disc",
    "box": "Fewest impulses, each in a square",
}


def transcript(plan: Plan) -> Report:
    """One plan as headings with their quantities, named as the attributes of the library.

    Parameters
    ----------
    plan : Plan
        Of one state.

    Examples
    --------
    >>> from pontryagin.orbit_correction import correct
    >>> told = transcript(correct([-0.0037787, -0.0039109, 0.0141512], thrust="box"))
    >>> int(told["solution"]["impulse_count"]), bool(abs(told["states"]["end"]).max() < 1e-15)
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

    At the instant of an impulse the state is that after it.

    Examples
    --------
    >>> from pontryagin.orbit_correction import correct
    >>> told = samples(correct([0.0, 0.0, 0.004]), 3)
    >>> told["t"].tolist(), bool(abs(told["state"][-1]).max() < 1e-15)
    ([0.0, 0.375, 0.75], True)
    """
    starts = plan.thrust.interval * np.arange(len(plan.impulses))
    t = np.linspace(0.0, plan.thrust.interval * len(starts), count)
    kicks = np.einsum("jab,jb->ja", satellite.transition(-starts)[:, :, 1:], plan.impulses)
    held = plan.z0 + (starts <= t[:, None]) @ kicks
    state = np.einsum("tab,tb->ta", satellite.transition(t), held)
    return {"t": t, "state": state, "costate": plan.initial_costate @ satellite.transition(-t)}


def conclusion(plan: Plan) -> str:
    """The certificate in a sentence.

    Examples
    --------
    >>> from pontryagin.orbit_correction import correct
    >>> conclusion(correct([0.0, 0.0, 0.0]))
    'Nothing is to be corrected.'
    """
    if not int(plan.steps):
        return "Nothing is to be corrected."
    counted = f"{int(plan.steps)} steps" if plan.thrust.name == "ball" else f"{int(plan.steps)} impulses"
    least = (
        f"one fewer would take at least {float(plan.shorter_gauge):.12g} of the peak"
        if np.isfinite(plan.shorter_gauge)
        else "fewer do not span the space of states"
    )
    return f"{counted} take {float(plan.gauge):.12g} of the peak; {least}."


class States(NamedTuple):
    """The rows as they were read, and the states in them, (n, 3)."""

    header: list[str]
    rows: list[list[str]]
    z0: Array


def read(path: Path) -> States:
    """Read states from the columns ``dr, dv_R, dv_T`` of a CSV file.

    Raises
    ------
    ValueError
        With the number of the line, if a column is missing or a row does not hold a state.
    OSError
        If the file cannot be read.
    """
    with path.open(newline="", encoding="utf-8-sig") as file:
        reader = csv.reader(file)
        header = [name.strip() for name in next(reader, [])]
        missing = [name for name in COLUMNS if name not in header]
        if missing:
            raise ValueError(f"line 1: column {missing[0]} is missing, takes {', '.join(COLUMNS)}")
        rows, numbers = [], []
        for row in reader:
            if row:
                rows.append(row)
                numbers.append(_state(row, header, reader.line_num))
    if not rows:
        raise ValueError("line 2: there is no state")
    return States(header, rows, np.array(numbers))


def _state(row: list[str], header: list[str], line: int) -> list[float]:
    if len(row) != len(header):
        raise ValueError(f"line {line}: {len(row)} entries under {len(header)} columns")
    values = []
    for name in COLUMNS:
        text = row[header.index(name)]
        try:
            values.append(formula.number(text))
        except ValueError:
            raise ValueError(f"line {line}: {name} takes a number, got {text!r}") from None
    return values


def to_csv(states: States, plan: Plan) -> str:
    """The rows as they were read, each with its plan; impulses beyond a state's own are empty."""
    proof = {name: getattr(plan.certificate, name) for name in PROOF}
    columns = {"steps": plan.steps, "impulse_count": plan.impulse_count, "gauge": plan.gauge}
    columns |= {f"psi_{i + 1}": plan.initial_costate[:, i] for i in range(3)} | proof
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    most = plan.impulses.shape[-2]
    fired = [f"{side}_{j}" for j in range(most) for side in ("w1", "w2")]
    writer.writerow([*states.header, *columns, *fired])
    for i, row in enumerate(states.rows):
        told = [column[i].item() for column in columns.values()]
        own = int(plan.impulse_count[i])
        impulses = [*plan.impulses[i, :own].ravel().tolist(), *([""] * (2 * (most - own)))]
        writer.writerow([*row, *told, *impulses])
    return text.getvalue()
