"""A rendezvous in words and numbers: what the command line prints as a table or as JSON."""

from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous import schema as asked
from pontryagin.rendezvous.reduced.solution import Extremal

Report = dict[str, dict[str, Any]]

PROOF = (
    "boundary",
    "attitude",
    "transversality",
    "hamiltonian",
    "maximality",
    "agreement",
    "cartesian",
    "cost",
    "residual",
    "condition",
)
SHOWN = 6
"""Extremals beside the best one that a table lists; JSON holds all."""


def transcript(extremal: Extremal) -> Report:
    """One solution as headings with their quantities, named as the attributes of the library.

    Parameters
    ----------
    extremal : Extremal
        As `solve` returns it.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> problem = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6),
    ...                      time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
    >>> told = transcript(solve(problem))
    >>> told["solution"]["arcs"], round(told["solution"]["cost"], 6)
    (['unsaturated'], 0.023882)
    """
    told: Report = {
        "problem": asked.written(extremal.problem),
        "solution": {
            "duration": extremal.duration,
            "cost": extremal.cost,
            "arrival_anomaly": extremal.arrival_anomaly,
            "revolutions": extremal.revolutions,
            "arcs": list(extremal.modes),
            "switch_times": extremal.switch_times,
            "initial_costate": extremal.initial_costate,
        },
        "certificate": {name: getattr(extremal.certificate, name) for name in PROOF},
        "others": {
            "count": len(extremal.others),
            "cost": [other.cost for other in extremal.others],
            "duration": [other.duration for other in extremal.others],
            "arrival_anomaly": [other.arrival_anomaly for other in extremal.others],
            "revolutions": [other.revolutions for other in extremal.others],
        },
    }
    if extremal.searched is not None:
        log, unit = extremal.searched, extremal.problem.scaled.time
        told["searched"] = {
            "durations": [unit * duration for duration in log.durations],
            "revolutions": sorted(set(log.revolutions)),
            "ends": list(log.ends),
            "given_up": list(log.given_up),
        }
    return told


def samples(extremal: Extremal, count: int) -> dict[str, Array]:
    """The solution at evenly spaced times.

    ``t`` (k,); ``state`` (k, 8): r, v1, c, phi* and lambda; ``costate`` (k, 6): rho, s1, e, nu1, nu2, nu3;
    ``control`` (k, 3): p in eta.
    """
    t = np.linspace(0.0, extremal.duration, count)
    parts = {"state": extremal.state, "costate": extremal.costate, "control": extremal.control}
    return {"t": t} | {name: part(t) for name, part in parts.items()}


def shown(told: Report) -> Report:
    """The same for a table: a line for each of the two craft, and one for each other extremal."""
    problem = {
        key: ", ".join(f"{name} {_short(item)}" for name, item in value.items())
        if isinstance(value, dict)
        else value
        for key, value in told["problem"].items()
    }
    problem["duration"] = "free" if problem["duration"] is None else problem["duration"]
    others = told["others"]
    lines: dict[str, Any] = {}
    columns = zip(others["cost"], others["duration"], others["revolutions"], strict=True)
    for place, (cost, duration, revolutions) in enumerate(columns, start=2):
        if place <= SHOWN + 1:
            lines[f"{place}"] = f"cost {cost:.8g}, time {duration:.8g}, {revolutions:.2f} revolutions"
    if others["count"] > SHOWN:
        lines["further"] = f"{others['count'] - SHOWN}, up to the cost {max(others['cost']):.8g}"
    table = told | {"problem": problem, "others found": lines or {"none": ""}}
    del table["others"]
    if "searched" in told:
        searched = told["searched"]
        table["searched"] = {
            "from durations": [float(f"{duration:.5g}") for duration in searched["durations"]],
            "revolutions more": searched["revolutions"],
            "walks ended": searched["ends"],
            "ways given up": len(searched["given_up"]),
        }
    order = ("problem", "solution", "certificate", "others found", "searched")
    return {heading: table[heading] for heading in order if heading in table}


def _short(value: Any) -> str:
    values = value if isinstance(value, list) else [value]
    text = " ".join(f"{item + 0.0:.6g}" for item in values)
    return f"({text})" if isinstance(value, list) else text


def conclusion(told: Report) -> str:
    """What the numbers say.

    Examples
    --------
    >>> told = {"others": {"count": 0}, "solution": {"cost": 0.5}, "certificate": {"residual": 1e-13}}
    >>> conclusion(told)[:72]
    'The extremal found costs 0.5, every condition met to 1e-13. Extremals sa'
    """
    count = told["others"]["count"] + 1
    found = f"The best of {count} extremals" if count > 1 else "The extremal found"
    return (
        f"{found} costs {told['solution']['cost']:.10g}, every condition met to "
        f"{float(told['certificate']['residual']):.0e}. Extremals satisfy necessary conditions; that none "
        "costs less elsewhere is not claimed."
    )
